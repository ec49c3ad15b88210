//! Contours of a field on a rectangular grid: isolines and the outlines of "at least this value" regions.
//!
//! Both come from one walk over the cells (marching squares, linear along the cell sides). In a cell whose diagonal
//! corners are high the mean of the four decides whether the high corners are joined. A cell with a corner that
//! is not finite is blank.

use super::{error::FigureError, geometry::Point};
use ndarray::Array2;

/// Whether all numbers are finite and each is larger than the one before.
pub(super) fn strictly_increasing(numbers: &[f64]) -> bool {
    numbers.iter().all(|v| v.is_finite()) && numbers.windows(2).all(|w| w[0] < w[1])
}

/// Values at the nodes of a rectangular grid, of shape `(x.len(), y.len())`: `values[[i, j]]` belongs to `(x[i], y[j])`.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    x: Vec<f64>,
    y: Vec<f64>,
    values: Array2<f64>,
}

impl Field {
    /// A field from its nodes and values.
    ///
    /// # Errors
    /// If the shape is not `(x.len(), y.len())`, an extent is below two, or nodes do not increase strictly.
    pub fn new(x: Vec<f64>, y: Vec<f64>, values: Array2<f64>) -> Result<Field, FigureError> {
        let (rows, columns) = values.dim();
        if (rows, columns) != (x.len(), y.len()) || rows < 2 || columns < 2 {
            return Err(FigureError::FieldShape { rows, columns, x: x.len(), y: y.len() });
        }
        if !strictly_increasing(&x) {
            return Err(FigureError::NotIncreasing { what: "x nodes of a field" });
        }
        if !strictly_increasing(&y) {
            return Err(FigureError::NotIncreasing { what: "y nodes of a field" });
        }
        Ok(Field { x, y, values })
    }

    /// The field of a function of two variables.
    ///
    /// # Errors
    /// As [`Field::new`].
    pub fn from_fn(
        x: Vec<f64>,
        y: Vec<f64>,
        f: impl Fn(f64, f64) -> f64,
    ) -> Result<Field, FigureError> {
        let values = Array2::from_shape_fn((x.len(), y.len()), |(i, j)| f(x[i], y[j]));
        Field::new(x, y, values)
    }

    /// The x nodes.
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// The y nodes.
    pub fn y(&self) -> &[f64] {
        &self.y
    }

    /// The outline of the region where the field is at least `level`: closed rings, counterclockwise around the region
    /// and clockwise around its holes, in the coordinates of the nodes.
    pub fn region_at_least(&self, level: f64) -> Vec<Vec<Point>> {
        self.on(&self.x, &self.y).regions(&[level]).swap_remove(0)
    }

    /// The field seen through a change of both coordinates (an axis): contours are linear in the *new* coordinates.
    pub(super) fn on<'a>(&'a self, x: &'a [f64], y: &'a [f64]) -> Trace<'a> {
        let finite = |i: usize, j: usize| {
            self.values[[i, j]].is_finite() && x[i].is_finite() && y[j].is_finite()
        };
        let valid = Array2::from_shape_fn((x.len() + 1, y.len() + 1), |(i, j)| {
            let inside = i > 0 && j > 0 && i < x.len() && j < y.len();
            inside && CORNERS.iter().all(|&(di, dj)| finite(i - 1 + di, j - 1 + dj))
        });
        let kinds = Array2::from_shape_fn(valid.dim(), |(i, j)| {
            if !valid[[i, j]] {
                Kind::Blank
            } else if NEIGHBOURS.iter().all(|&(di, dj)| valid[[i - 1 + di, j - 1 + dj]]) {
                Kind::Inner
            } else {
                Kind::Rim
            }
        });
        Trace { x, y, values: &self.values, kinds }
    }
}

/// What a cell is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A corner is not finite.
    Blank,
    /// All neighbours have values.
    Inner,
    /// A neighbour is blank or beyond the grid.
    Rim,
}

/// The data of walks over the cells.
pub(super) struct Trace<'a> {
    x: &'a [f64],
    y: &'a [f64],
    values: &'a Array2<f64>,
    /// The kinds of the cells, with a border of blank ones around them.
    kinds: Array2<Kind>,
}

/// The corners of a cell, counterclockwise, as offsets from its lower left node.
const CORNERS: [(usize, usize); 4] = [(0, 0), (1, 0), (1, 1), (0, 1)];
/// The neighbour across each side (side k runs from corner k to corner k+1), plus one.
const NEIGHBOURS: [(usize, usize); 4] = [(1, 0), (2, 1), (1, 2), (0, 1)];

/// A directed piece of outline between two places; a place is a node or the crossing on a side, so pieces join exactly.
type Piece = (u64, u64);

impl Trace<'_> {
    /// The lines of each value, which ascend; a closed one repeats its first point.
    pub(super) fn isolines(&self, levels: &[f64]) -> Vec<Vec<Vec<Point>>> {
        let mut pieces = vec![Vec::new(); levels.len()];
        self.for_each_cell(levels, |which, cell| cell.crossings(&mut pieces[which]));
        pieces.into_iter().zip(levels).map(|(pieces, &level)| self.join(pieces, level)).collect()
    }

    /// The outlines of the regions of at least each value, which ascend.
    pub(super) fn regions(&self, levels: &[f64]) -> Vec<Vec<Vec<Point>>> {
        let mut pieces = vec![Vec::new(); levels.len()];
        self.for_each_cell(levels, |which, cell| {
            let pieces = &mut pieces[which];
            cell.crossings(pieces);
            for (side, (di, dj)) in NEIGHBOURS.into_iter().enumerate() {
                // A side between two cells would be walked once in each direction: both are left out.
                if self.kinds[[cell.i + di, cell.j + dj]] == Kind::Blank {
                    cell.side(side, pieces);
                }
            }
        });
        let outlines = |(pieces, &level): (Vec<Piece>, &f64)| {
            let mut rings = self.join(pieces, level);
            // Where the level only touches a node a ring is no more than a point.
            rings.retain(|ring| ring.len() > 3);
            for ring in &mut rings {
                ring.pop();
            }
            rings
        };
        pieces.into_iter().zip(levels).map(outlines).collect()
    }

    /// Visits the cells that a level crosses, and the high ones at the rim, with the number of the level: one walk serves all of them.
    fn for_each_cell(&self, levels: &[f64], mut visit: impl FnMut(usize, Cell)) {
        debug_assert!(levels.windows(2).all(|pair| pair[0] <= pair[1]), "levels ascend");
        // How many levels each node reaches. A cell is crossed by those that some of its corners reach and others do not.
        let reached = self.values.mapv(|value| levels.partition_point(|level| *level <= value));
        for i in 0..self.x.len() - 1 {
            let (left, right) = (reached.row(i), reached.row(i + 1));
            let kinds = self.kinds.row(i + 1);
            // Iterators rather than indices: this is the inner loop of every map.
            let sides = left.iter().zip(right).map(|(&a, &b)| [a, b]);
            let cells = sides.clone().zip(sides.skip(1)).zip(kinds.iter().skip(1));
            for (j, (([a, b], [d, c]), &kind)) in cells.enumerate() {
                let crossed = match kind {
                    Kind::Blank => continue,
                    Kind::Inner => a.min(b).min(c.min(d))..a.max(b).max(c.max(d)),
                    Kind::Rim => 0..a.max(b).max(c.max(d)),
                };
                for which in crossed {
                    let high = [a, b, c, d].map(|reached| reached > which);
                    // Quarters before the sum, so that huge values do not overflow.
                    let quarter = |(di, dj): (usize, usize)| 0.25 * self.values[[i + di, j + dj]];
                    let centre = CORNERS.into_iter().map(quarter).fold(0.0, |sum, part| sum + part);
                    let centre_high = centre >= levels[which];
                    visit(which, Cell { i, j, rows: self.y.len(), high, centre_high });
                }
            }
        }
    }

    fn place(&self, key: u64, level: f64) -> Point {
        let (node, kind) = ((key / 3) as usize, key % 3);
        let (i, j) = (node / self.y.len(), node % self.y.len());
        let (k, l) = match kind {
            0 => return [self.x[i], self.y[j]],
            1 => (i + 1, j),
            _ => (i, j + 1),
        };
        let (a, b) = (self.values[[i, j]], self.values[[k, l]]);
        // Halved, so that the difference of huge values stays finite.
        let t = ((0.5 * level - 0.5 * a) / (0.5 * b - 0.5 * a)).clamp(0.0, 1.0);
        let between = |p: f64, q: f64| p + t * (q - p);
        [between(self.x[i], self.x[k]), between(self.y[j], self.y[l])]
    }

    /// Chains of pieces, the larger values to the left of the way.
    fn join(&self, mut pieces: Vec<Piece>, level: f64) -> Vec<Vec<Point>> {
        pieces.sort_unstable();
        let mut ends: Vec<u64> = pieces.iter().map(|p| p.1).collect();
        ends.sort_unstable();
        let mut used = vec![false; pieces.len()];
        let next = |from: u64, used: &[bool]| {
            let first = pieces.partition_point(|p| p.0 < from);
            (first..pieces.len()).take_while(|&k| pieces[k].0 == from).find(|&k| !used[k])
        };
        let mut lines = Vec::new();
        let open = (0..pieces.len()).filter(|&k| ends.binary_search(&pieces[k].0).is_err());
        // Open lines from their free end first, then what is left is closed.
        for start in open.chain(0..pieces.len()) {
            if used[start] {
                continue;
            }
            used[start] = true;
            let (first, mut last) = pieces[start];
            let mut keys = vec![first, last];
            while last != first {
                let Some(k) = next(last, &used) else { break };
                used[k] = true;
                last = pieces[k].1;
                keys.push(last);
            }
            let mut points: Vec<Point> = keys.iter().map(|&k| self.place(k, level)).collect();
            points.dedup(); // a line through a node meets it on two sides
            lines.push(points);
        }
        lines
    }
}

/// A cell, which of its corners are high, and whether its middle is.
struct Cell {
    i: usize,
    j: usize,
    rows: usize,
    high: [bool; 4],
    centre_high: bool,
}

impl Cell {
    fn node(&self, corner: usize) -> u64 {
        let (di, dj) = CORNERS[corner % 4];
        3 * ((self.i + di) * self.rows + self.j + dj) as u64
    }

    /// The place where the level crosses a side: the node at its lower left end, marked 1 for a side along x and 2 along y.
    fn crossing(&self, side: usize) -> u64 {
        match side {
            0 => self.node(0) + 1,
            1 => self.node(1) + 2,
            2 => self.node(3) + 1,
            _ => self.node(0) + 2,
        }
    }

    fn crossings(&self, pieces: &mut Vec<Piece>) {
        let high = |k: usize| self.high[k % 4];
        for exit in (0..4).filter(|&k| high(k) && !high(k + 1)) {
            // With a high centre each low corner is cut off (on to the next way in); with a low one each high corner.
            let step = if self.centre_high { 1 } else { 3 };
            let entry = (1..4)
                .map(|n| (exit + n * step) % 4)
                .find(|&k| !high(k) && high(k + 1))
                .expect("going round, what is left must be entered again");
            pieces.push((self.crossing(exit), self.crossing(entry)));
        }
    }

    /// The high part of one side.
    fn side(&self, side: usize, pieces: &mut Vec<Piece>) {
        let (a, b) = (self.node(side), self.node(side + 1));
        match (self.high[side], self.high[(side + 1) % 4]) {
            (true, true) => pieces.push((a, b)),
            (true, false) => pieces.push((a, self.crossing(side))),
            (false, true) => pieces.push((self.crossing(side), b)),
            (false, false) => {}
        }
    }
}

#[cfg(test)]
mod tests;
