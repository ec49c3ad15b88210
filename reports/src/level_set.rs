//! Level sets of fields on rectangular grids, by marching squares.
//!
//! A contour is linear along the sides of the cells. In a cell whose diagonal corners are inside, the mean of the four
//! decides whether they are joined. A field may be bounded by another one, its border: its level sets then end where the
//! border is 0, in the middle of a cell too.
//!
//! ```
//! use courant_reports::level_set::Field;
//! use ndarray::array;
//!
//! // x + y on the unit square is at least 1/2 beyond the line from (0, 1/2) to (1/2, 0).
//! let field = Field::new(vec![0.0, 1.0], vec![0.0, 1.0], array![[0.0, 1.0], [1.0, 2.0]])?;
//! let outline = &field.outlines(&[0.5])[0];
//! assert_eq!(outline.lines(), [[[0.0, 0.5], [0.5, 0.0]]]);
//! assert_eq!(outline.rings().next().unwrap().len(), 5);
//! # Ok::<(), courant_reports::level_set::FieldError>(())
//! ```

use ndarray::{Array2, Zip};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A point `[x, y]`.
type Point = [f64; 2];

/// The parts of a field do not fit together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a field needs finite ascending nodes, two at least each way, and a value for each")]
pub struct FieldError;

/// Values at the nodes of a rectangular grid, of shape `(x.len(), y.len())`: `values[[i, j]]` belongs to `(x[i], y[j])`.
#[derive(Debug, Clone)]
pub struct Field {
    x: Vec<f64>,
    y: Vec<f64>,
    values: Array2<f64>,
    border: Option<Array2<f64>>,
}

/// The outline of the region where a field is at least some level.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline(Vec<Vec<Corner>>);

#[derive(Debug, Clone, Copy, PartialEq)]
struct Corner {
    at: Point,
    /// Whether the field has the level there, and it is no border.
    of_level: bool,
}

impl Field {
    /// A field from its nodes and values. Nodes whose value is no number are outside of every region.
    ///
    /// # Errors
    /// If the shape is not `(x.len(), y.len())`, an extent is below two, or nodes do not increase strictly.
    pub fn new(x: Vec<f64>, y: Vec<f64>, values: Array2<f64>) -> Result<Field, FieldError> {
        let ascend = |nodes: &[f64]| {
            nodes.len() > 1
                && nodes.iter().all(|v| v.is_finite())
                && nodes.windows(2).all(|w| w[0] < w[1])
        };
        match values.dim() == (x.len(), y.len()) && ascend(&x) && ascend(&y) {
            true => Ok(Field { x, y, values, border: None }),
            false => Err(FieldError),
        }
    }

    /// The field where `border` is at least 0; it is linear between nodes as well, so that the edge need not follow the
    /// grid.
    ///
    /// # Errors
    /// If the shape is another one.
    pub fn within(self, border: Array2<f64>) -> Result<Field, FieldError> {
        match border.dim() == self.values.dim() {
            true => Ok(Field { border: Some(border), ..self }),
            false => Err(FieldError),
        }
    }

    /// The corners of the grid: the lower left and the upper right one.
    pub fn extent(&self) -> [Point; 2] {
        [[self.x[0], self.y[0]], [self.x[self.x.len() - 1], self.y[self.y.len() - 1]]]
    }

    /// The outline for each of some ascending levels.
    pub fn outlines(&self, levels: &[f64]) -> Vec<Outline> {
        let cells = self.crossed_cells(levels);
        let cells = cells.par_iter().zip(levels);
        cells.map(|(cells, level)| self.outline_in(cells, *level)).collect()
    }

    fn is_inside(&self, node: [usize; 2], level: f64) -> bool {
        self.values[node] >= level && self.border.as_ref().is_none_or(|border| border[node] >= 0.0)
    }

    /// Where the way from a node inside to one outside leaves the region, as a fraction, and whether at the level.
    fn exit(&self, inside: [usize; 2], outside: [usize; 2], level: f64) -> (f64, bool) {
        let cut = |low: f64, high: f64| match low {
            _ if low.is_nan() => 0.0,
            // Halved, so that the difference of huge values stays finite.
            _ if low < 0.0 => ((0.5 * high) / (0.5 * high - 0.5 * low)).clamp(0.0, 1.0),
            _ => f64::INFINITY,
        };
        let value = cut(self.values[outside] - level, self.values[inside] - level);
        let border = self.border.as_ref();
        let border = border.map_or(f64::INFINITY, |border| cut(border[outside], border[inside]));
        (value.min(border), value <= border && self.values[outside].is_finite())
    }

    /// The cells that each level crosses, and those at the rim of the grid that have a part inside: one walk for all.
    fn crossed_cells(&self, levels: &[f64]) -> Vec<Vec<[usize; 2]>> {
        // How many levels each node reaches: a cell is crossed by those that some of its nodes reach and others do not.
        // This is the inner loop of every map: counted for one level after the other, many nodes at once.
        let mut reached = Array2::<i16>::zeros(self.values.dim());
        for level in levels {
            let counts = Zip::from(&mut reached).and(&self.values);
            counts.for_each(|count, value| *count += i16::from(value >= level));
        }
        if let Some(border) = &self.border {
            let counts = Zip::from(&mut reached).and(border);
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
                    let crossing = &mut cells[first as usize..most as usize];
                    crossing.iter_mut().for_each(|cells| cells.push([i, j]));
                }
            }
        }
        cells
    }

    /// The outline at a level, from the cells that may hold a part of it.
    fn outline_in(&self, cells: &[[usize; 2]], level: f64) -> Outline {
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
        let mut rings = Vec::new();
        while let Some((start, mut to)) = next.pop_first() {
            let mut ring = vec![self.corner(start, level)];
            while to != start {
                ring.push(self.corner(to, level));
                to = next.remove(&to).expect("every way in has one way out");
            }
            rings.push(ring);
        }
        Outline(rings)
    }

    /// A node by its key, or the crossing on one of its sides.
    fn corner(&self, key: usize, level: f64) -> Corner {
        let node = [key / 3 / self.y.len(), key / 3 % self.y.len()];
        let place = |[i, j]: [usize; 2]| [self.x[i], self.y[j]];
        let end = match key % 3 {
            0 => return Corner { at: place(node), of_level: false },
            1 => [node[0] + 1, node[1]],
            _ => [node[0], node[1] + 1],
        };
        let [inside, outside] = if self.is_inside(node, level) { [node, end] } else { [end, node] };
        let (way, of_level) = self.exit(inside, outside, level);
        let (from, to) = (place(inside), place(outside));
        Corner { at: [0, 1].map(|axis| from[axis] + way * (to[axis] - from[axis])), of_level }
    }
}

impl Outline {
    /// Closed rings, counterclockwise around the region and clockwise around its holes. Where the level only touches a
    /// node there is none.
    pub fn rings(&self) -> impl Iterator<Item = Vec<Point>> {
        let areas = self.0.iter().filter(|ring| ring.len() > 2);
        areas.map(|ring| ring.iter().map(|corner| corner.at).collect())
    }

    /// The lines of the level: the outline without what runs along the border and the sides of the grid. A closed one
    /// repeats its first point.
    pub fn lines(&self) -> Vec<Vec<Point>> {
        let mut lines = Vec::new();
        for mut ring in self.0.iter().cloned() {
            match ring.iter().position(|corner| !corner.of_level) {
                Some(gap) => ring.rotate_left(gap),
                None => ring.push(ring[0]),
            }
            let runs = ring.split(|corner| !corner.of_level).filter(|run| run.len() > 1);
            lines.extend(runs.map(|run| {
                let mut points: Vec<Point> = run.iter().map(|corner| corner.at).collect();
                points.dedup(); // a line through a node meets it on two sides
                points
            }));
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    impl Field {
        fn outline(&self, level: f64) -> Outline {
            let alone = self.outlines(&[level]).swap_remove(0);
            // Among others it is the same.
            assert_eq!(self.outlines(&[level - 0.5, level, level + 0.5])[1], alone);
            alone
        }

        fn region(&self, level: f64) -> Vec<Vec<Point>> {
            self.outline(level).rings().collect()
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
        let lines = bowl.outline(0.49).lines();
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
        assert!((area(&bounded.region(-1.0)) - (1.0 - 1.0 / 9.0)).abs() < 1e-8);
        let everywhere = &bounded.outlines(&[f64::NEG_INFINITY])[0];
        assert!(everywhere.lines().is_empty());
        assert_eq!(everywhere.rings().collect::<Vec<_>>(), bounded.region(-1.0));
        // The line x = 3/4 from within the cell of the edge, at y = 5/24, up.
        let lines = bounded.outline(0.75).lines();
        assert!(lines.len() == 1 && lines[0].iter().all(|p| (p[0] - 0.75).abs() < 1e-12));
        assert!(half.region(0.0).len() == 1 && half.outline(0.0).lines().len() == 1);
    }

    #[test]
    fn wrong_fields_are_errors() {
        let make = |x: &[f64], y: &[f64]| Field::new(x.into(), y.into(), Array2::zeros((2, 3)));
        assert!(make(&[0.0, 1.0], &[0.0, 1.0, 2.0]).is_ok());
        for (x, y) in [([0.0, 1.0], [0.0, 1.0, 1.0]), ([1.0, 0.0], [0.0, 1.0, 2.0])] {
            assert!(make(&x, &y).is_err());
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
            let [low, high] = [-1.0, 1.0].map(|sign| Field { values: values.mapv(|v| sign * v), ..one.clone() });
            prop_assert!((area(&high.region(level)) + area(&low.region(-level)) - 1.0).abs() < 1e-12);
            // Bounded by itself a field is what it is at least 0.
            let bounded = high.clone().within(values).unwrap();
            prop_assert_eq!(area(&bounded.region(-2.0)), area(&high.region(0.0)));
            for point in high.outline(level).lines().iter().flatten() {
                let [i, j] = [point[0] * 5.0, point[1] * 6.0];
                let on_line = (i - i.round()).abs() < 1e-9 || (j - j.round()).abs() < 1e-9;
                prop_assert!(on_line, "{point:?} is on no line of the grid");
            }
        }
    }
}
