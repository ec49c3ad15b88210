//! Fields on rectangular grids, and their contours by marching squares.
//!
//! A contour is linear along the sides of the cells. In a cell whose diagonal corners are inside, the mean of the four
//! decides whether they are joined. A field may be bounded by another one, its border: what is drawn then ends where the
//! border is 0, in the middle of a cell too.

use super::{FigureError, geometry::Point};
use ndarray::{Array2, Zip};
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex};

/// Whether all numbers are finite and each is larger than the one before.
pub(super) fn strictly_increasing(numbers: &[f64]) -> bool {
    numbers.iter().all(|v| v.is_finite()) && numbers.windows(2).all(|w| w[0] < w[1])
}

/// Values at the nodes of a rectangular grid, of shape `(x.len(), y.len())`: `values[[i, j]]` belongs to `(x[i], y[j])`.
#[derive(Debug, Clone)]
pub struct Field {
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// Shared between layers and with the page.
    values: Arc<Array2<f64>>,
    border: Option<Arc<Array2<f64>>>,
    /// What is known by the bits of each level: areas and lines, PNG and SVG follow the same outlines.
    known: Arc<Mutex<HashMap<u64, Arc<Vec<Ring>>>>>,
}

impl Field {
    /// A field from its nodes and values. Nodes whose value is no number are outside of every contour.
    ///
    /// # Errors
    /// If the shape is not `(x.len(), y.len())`, an extent is below two, or nodes do not increase strictly.
    pub fn new(x: Vec<f64>, y: Vec<f64>, values: Array2<f64>) -> Result<Field, FigureError> {
        let shape = values.dim() == (x.len(), y.len()) && x.len() > 1 && y.len() > 1;
        match shape && strictly_increasing(&x) && strictly_increasing(&y) {
            true => {
                Ok(Field { x, y, values: Arc::new(values), border: None, known: Arc::default() })
            }
            false => Err(FigureError::Field),
        }
    }

    /// The field where `border` is at least 0; it is linear between nodes as well, so that the edge need not follow the
    /// grid.
    ///
    /// # Errors
    /// If the shape is another one.
    pub fn within(self, border: Array2<f64>) -> Result<Field, FigureError> {
        match border.dim() == self.values.dim() {
            true => Ok(Field { border: Some(Arc::new(border)), known: Arc::default(), ..self }),
            false => Err(FigureError::Field),
        }
    }

    /// The field at other nodes: those of the page.
    pub(super) fn on(&self, x: Vec<f64>, y: Vec<f64>) -> Field {
        Field { x, y, ..self.clone() }
    }

    /// Outlines of the regions where the field is at least each level: closed rings, counterclockwise around the region and
    /// clockwise around its holes.
    pub(super) fn regions(&self, levels: &[f64]) -> Vec<Vec<Vec<Point>>> {
        let region = |rings: Arc<Vec<Ring>>| {
            // Where the level only touches a node a ring is no more than a point.
            let areas = rings.iter().filter(|ring| ring.len() > 2);
            areas.map(|ring| ring.iter().map(|place| self.point(place)).collect()).collect()
        };
        self.outlines(levels).into_iter().map(region).collect()
    }

    /// The lines of each level: the outlines without what runs along the border and the sides of the grid. A closed one
    /// repeats its first point.
    pub(super) fn isolines(&self, levels: &[f64]) -> Vec<Vec<Vec<Point>>> {
        self.outlines(levels).into_iter().map(|rings| self.lines_of(&rings)).collect()
    }

    fn is_inside(&self, node: [usize; 2], level: f64) -> bool {
        self.values[node] >= level && self.border.as_ref().is_none_or(|border| border[node] >= 0.0)
    }

    /// Where the way from a node inside to one outside leaves the region, as a fraction, and whether at the level.
    fn exit(&self, inside: [usize; 2], outside: [usize; 2], level: f64) -> (f64, bool) {
        let cut = |low: f64, high: f64| match low < 0.0 {
            // Halved, so that the difference of huge values stays finite.
            true => ((0.5 * high) / (0.5 * high - 0.5 * low)).clamp(0.0, 1.0),
            false => {
                if low.is_nan() {
                    0.0
                } else {
                    f64::INFINITY
                }
            }
        };
        let value = cut(self.values[outside] - level, self.values[inside] - level);
        let border = self.border.as_ref();
        let border = border.map_or(f64::INFINITY, |border| cut(border[outside], border[inside]));
        (value.min(border), value <= border && self.values[outside].is_finite())
    }

    /// The cells that each level, of any order, crosses, and those at the rim of the grid that have a part inside: one walk for all.
    fn crossed_cells(&self, levels: &[f64]) -> Vec<Vec<[usize; 2]>> {
        let mut order: Vec<usize> = (0..levels.len()).collect();
        order.sort_by(|&a, &b| levels[a].total_cmp(&levels[b]));
        // How many levels each node reaches: a cell is crossed by those that some of its nodes reach and others do not.
        // This is the inner loop of every map: counted for one level after the other, many nodes at once.
        let mut reached = Array2::<i16>::zeros(self.values.dim());
        for level in levels {
            let counts = Zip::from(&mut reached).and(&*self.values);
            counts.for_each(|count, value| *count += i16::from(value >= level));
        }
        if let Some(border) = &self.border {
            let counts = Zip::from(&mut reached).and(&**border);
            counts.for_each(|count, border| *count *= i16::from(*border >= 0.0));
        }
        let (columns, rows) = self.values.dim();
        let mut cells = vec![Vec::new(); levels.len()];
        let mut sides = vec![[0; 2]; rows];
        for i in 0..columns - 1 {
            let nodes = reached.row(i).into_iter().zip(reached.row(i + 1));
            sides.iter_mut().zip(nodes).for_each(|(side, (&a, &b))| *side = [a.min(b), a.max(b)]);
            let is_outer_column = i == 0 || i + 2 == columns;
            for (j, ends) in sides.windows(2).enumerate() {
                let [least, most] = [ends[0][0].min(ends[1][0]), ends[0][1].max(ends[1][1])];
                let is_outer = is_outer_column || j == 0 || j + 2 == rows;
                let first = if is_outer { 0 } else { least };
                // Nearly always nothing.
                if first < most {
                    let crossing = &order[first as usize..most as usize];
                    crossing.iter().for_each(|&which| cells[which].push([i, j]));
                }
            }
        }
        cells
    }

    /// Rings of places of each level.
    fn outlines(&self, levels: &[f64]) -> Vec<Arc<Vec<Ring>>> {
        let mut known = self.known.lock().expect("nobody panics while contours are followed");
        let mut new: Vec<f64> = levels.to_vec();
        new.retain(|level| !known.contains_key(&level.to_bits()));
        if !new.is_empty() {
            for (level, cells) in new.iter().zip(self.crossed_cells(&new)) {
                known.insert(level.to_bits(), Arc::new(self.outlines_in(&cells, *level)));
            }
        }
        levels.iter().map(|level| known[&level.to_bits()].clone()).collect()
    }

    /// Follows the outlines of these levels, which are then known.
    pub(super) fn follow(&self, levels: &[f64]) {
        self.outlines(levels);
    }

    /// Where a place is.
    fn point(&self, place: &Place) -> Point {
        let [from, to] = place.ends.map(|[i, j]| [self.x[i], self.y[j]]);
        super::geometry::between(from, to, place.way)
    }

    /// What of the rings runs along the level.
    fn lines_of(&self, rings: &[Ring]) -> Vec<Vec<Point>> {
        let mut lines = Vec::new();
        for ring in rings {
            let mut ring: Vec<&Place> = ring.iter().collect();
            match ring.iter().position(|place| !place.of_level) {
                Some(gap) => ring.rotate_left(gap),
                None => ring.push(ring[0]),
            }
            let runs = ring.split(|place| !place.of_level).filter(|run| run.len() > 1);
            lines.extend(runs.map(|run| {
                let mut points: Vec<Point> = run.iter().map(|place| self.point(place)).collect();
                points.dedup(); // a line through a node meets it on two sides
                points
            }));
        }
        lines
    }

    /// Rings of places, from the cells that may hold some.
    fn outlines_in(&self, cells: &[[usize; 2]], level: f64) -> Vec<Ring> {
        let (columns, rows) = self.values.dim();
        // A node, or the crossing on the side that leads from it to the right (1) or upwards (2).
        let key = |[i, j]: [usize; 2], side: usize| 3 * (i * rows + j) + side;
        let mut next: BTreeMap<usize, usize> = BTreeMap::new();
        for &[i, j] in cells {
            let nodes = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
            let inside = nodes.map(|node| self.is_inside(node, level));
            let outer = [j == 0, i + 2 == columns, j + 2 == rows, i == 0];
            let crossing = [key(nodes[0], 1), key(nodes[1], 2), key(nodes[3], 1), key(nodes[0], 2)];
            let mean =
                |field: &Array2<f64>| nodes.iter().map(|&node| 0.25 * field[node]).sum::<f64>();
            let joined = mean(&self.values) >= level
                && self.border.as_ref().is_none_or(|border| mean(border) >= 0.0);
            for exit in (0..4).filter(|&k| inside[k] && !inside[(k + 1) % 4]) {
                // Joined corners: each outer one is cut off, on to the next way in; else each inner one is.
                let step = if joined { 1 } else { 3 };
                let entry = (1..4).map(|n| (exit + n * step) % 4);
                let mut entry = entry.filter(|&k| !inside[k] && inside[(k + 1) % 4]);
                next.insert(
                    crossing[exit],
                    crossing[entry.next().expect("what is left is entered")],
                );
            }
            for side in (0..4).filter(|&side| outer[side]) {
                let (a, b) = (key(nodes[side], 0), key(nodes[(side + 1) % 4], 0));
                match (inside[side], inside[(side + 1) % 4]) {
                    (true, true) => next.insert(a, b),
                    (true, false) => next.insert(a, crossing[side]),
                    (false, true) => next.insert(crossing[side], b),
                    (false, false) => None,
                };
            }
        }
        let place = |key: usize| {
            let node = [key / 3 / rows, key / 3 % rows];
            let end = match key % 3 {
                0 => return Place { ends: [node; 2], way: 0.0, of_level: false },
                1 => [node[0] + 1, node[1]],
                _ => [node[0], node[1] + 1],
            };
            let ends = if self.is_inside(node, level) { [node, end] } else { [end, node] };
            let (way, of_level) = self.exit(ends[0], ends[1], level);
            Place { ends, way, of_level }
        };
        let mut rings = Vec::new();
        while let Some((start, mut to)) = next.pop_first() {
            let mut ring = vec![place(start)];
            while to != start {
                ring.push(place(to));
                to = next.remove(&to).expect("every way in has one way out");
            }
            rings.push(ring);
        }
        rings
    }
}

/// A place on a side of a cell, or a node.
#[derive(Debug)]
struct Place {
    /// The node inside and the one outside.
    ends: [[usize; 2]; 2],
    /// The part of the way from the one to the other.
    way: f64,
    /// Whether it is a crossing of the level, and not of the border.
    of_level: bool,
}

/// The way around a region.
type Ring = Vec<Place>;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    impl Field {
        fn region(&self, level: f64) -> Vec<Vec<Point>> {
            // Among others, out of order, it is the same, and so it is with others known before.
            let fresh = || Field { known: Arc::default(), ..self.clone() };
            let several = fresh().regions(&[level + 0.5, level, level - 0.5, level]);
            assert_eq!(several[1], several[3]);
            let alone = fresh().regions(&[level]).swap_remove(0);
            let later = fresh();
            later.follow(&[level + 0.5, level - 0.5]);
            assert_eq!(later.regions(&[level]).swap_remove(0), alone);
            assert_eq!(several[1], alone);
            alone
        }

        fn isoline(&self, level: f64) -> Vec<Vec<Point>> {
            self.isolines(&[level]).swap_remove(0)
        }
    }

    fn nodes(n: usize, low: f64, high: f64) -> Vec<f64> {
        (0..n).map(|i| low + (high - low) * i as f64 / (n - 1) as f64).collect()
    }

    fn field(n: usize, m: usize, high: f64, f: impl Fn(f64, f64) -> f64) -> Field {
        let (x, y) = (nodes(n, 0.0, high), nodes(m, 0.0, high));
        let values = Array2::from_shape_fn((n, m), |(i, j)| f(x[i], y[j]));
        Field::new(x, y, values).unwrap()
    }

    /// Signed area of rings, by the shoelace formula.
    fn area(rings: &[Vec<Point>]) -> f64 {
        let sides = |r: &Vec<Point>| -> f64 {
            let pairs = (0..r.len()).map(|k| (r[k], r[(k + 1) % r.len()]));
            pairs.map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum()
        };
        rings.iter().map(sides).sum()
    }

    #[test]
    fn a_circle_is_one_closed_line_near_its_radius() {
        let bowl = field(101, 101, 2.0, |x, y| (x - 1.0).powi(2) + (y - 1.0).powi(2));
        let lines = bowl.isoline(0.49);
        assert!(lines.len() == 1 && lines[0].first() == lines[0].last());
        for p in &lines[0] {
            // Linear interpolation of r² over a side of h = 0.02 errs by at most h²/4 in r², that is h²/(8 r) in r.
            let radius = (p[0] - 1.0).hypot(p[1] - 1.0);
            assert!((radius - 0.7).abs() <= 0.02f64.powi(2) / (8.0 * 0.7) + 1e-12);
        }
        // Larger values lie to the left: the way around the low middle is clockwise.
        assert!(area(&lines) < 0.0);
        assert!((area(&bowl.region(0.49)) - (4.0 - 0.49 * std::f64::consts::PI)).abs() < 1e-3);
    }

    #[test]
    fn saddles_follow_the_mean() {
        let saddle = |high: f64| field(2, 2, 1.0, |x, y| if x == y { high } else { 0.0 });
        // Mean above the level: the high diagonal is one region; below: two corners.
        assert_eq!(saddle(1.2).region(0.5).len(), 1);
        assert_eq!(saddle(0.8).region(0.5).len(), 2);
    }

    #[test]
    fn a_border_cuts_cells_and_is_no_isoline() {
        // x within y >= x / 2 - 1/3, whose edge lies between the nodes.
        let half = field(7, 7, 1.0, |_, y| y - 1.0 / 3.0);
        let cut =
            Array2::from_shape_fn((7, 7), |(i, j)| (j as f64 - 0.5 * i as f64 + 1.0) / 6.0 - 1e-9);
        let bounded = field(7, 7, 1.0, |x, _| x).within(cut).unwrap();
        // All of it: the square less the triangle below the edge, from (1/3, 0) to (1, 1/3).
        assert!((area(&bounded.region(f64::NEG_INFINITY)) - (1.0 - 1.0 / 9.0)).abs() < 1e-8);
        assert!(bounded.isoline(f64::NEG_INFINITY).is_empty());
        // The line x = 3/4 from within the cell of the edge, at y = 5/24, up.
        let lines = bounded.isoline(0.75);
        assert!(lines.len() == 1 && lines[0].iter().all(|p| (p[0] - 0.75).abs() < 1e-12));
        assert!(half.region(0.0).len() == 1 && half.isoline(0.0).len() == 1);
    }

    #[test]
    fn wrong_fields_are_errors() {
        let make = |x: &[f64], y: &[f64]| Field::new(x.into(), y.into(), Array2::zeros((2, 3)));
        assert!(make(&[0.0, 1.0], &[0.0, 1.0, 2.0]).is_ok());
        for (x, y) in [([0.0, 1.0], [0.0, 1.0, 1.0]), ([1.0, 0.0], [0.0, 1.0, 2.0])] {
            assert!(matches!(make(&x, &y), Err(FigureError::Field)));
        }
        assert!(make(&[0.0, 1.0, 2.0], &[0.0, 1.0]).is_err());
        let square = field(2, 2, 1.0, |x, _| x);
        assert!(square.within(Array2::zeros((2, 3))).is_err());
    }

    proptest! {
        #[test]
        fn region_and_complement_fill_the_field(
            values in prop::collection::vec(-1.0f64..1.0, 42), level in -0.9f64..0.9,
        ) {
            let one = field(6, 7, 1.0, |_, _| 0.0);
            let values = Array2::from_shape_vec((6, 7), values).unwrap();
            // The negated field swaps high and low everywhere, saddles included.
            let [low, high] = [-1.0, 1.0].map(|sign| Field { values: Arc::new(values.mapv(|v| sign * v)), ..one.clone() });
            prop_assert!((area(&high.region(level)) + area(&low.region(-level)) - 1.0).abs() < 1e-12);
            // Bounded by itself a field is what it is at least 0.
            let bounded = high.clone().within(values).unwrap();
            prop_assert_eq!(area(&bounded.region(-2.0)), area(&high.region(0.0)));
            for point in high.isoline(level).iter().flatten() {
                let [i, j] = [point[0] * 5.0, point[1] * 6.0];
                let on_line = (i - i.round()).abs() < 1e-9 || (j - j.round()).abs() < 1e-9;
                prop_assert!(on_line, "{point:?} is on no line of the grid");
            }
        }
    }
}
