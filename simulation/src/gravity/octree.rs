//! Barnes & Hut's tree: cubes halved until few particles are left, with the moments of each.

use crate::particles::{Vector, dot, plus_scaled};
use rayon::prelude::*;

/// A cell with no more particles is not divided.
const LEAF: usize = 8;
/// Halvings along an axis: three times 21 bits fill a key.
const DEPTH: u32 = 21;

/// Masses that attract.
#[derive(Debug, Clone, Copy)]
pub struct Bodies<'a> {
    /// Where they are.
    pub position: &'a [Vector<3>],
    /// Their masses.
    pub mass: &'a [f64],
    /// Their smoothing lengths: each is spread like the cubic spline.
    pub smoothing: &'a [f64],
}

/// Mass, centre and quadrupole of the particles in a cell.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Cell {
    pub mass: f64,
    pub centre: Vector<3>,
    /// `Σ m (3 d d − d²)` about the centre: xx, xy, xz, yy, yz, zz.
    pub quadrupole: [f64; 6],
    /// No particle is farther from the centre.
    pub radius: f64,
    /// The largest smoothing length.
    pub smoothing: f64,
    /// The first cell, in the order of the tree, that is not inside this one.
    pub next: u32,
    /// The particles of a leaf, as a range of the order; an inner cell has none.
    pub first: u32,
    pub last: u32,
}

/// The tree. Cells are stored depth first, each before its children, so that a walk needs no stack. Particles are sorted
/// along Morton's curve; what the tree is does not depend on threads.
#[derive(Debug, Clone, Default)]
pub struct Octree {
    pub(super) cells: Vec<Cell>,
    /// Particles by their place on the curve.
    pub(super) order: Vec<u32>,
    keys: Vec<(u64, u32)>,
}

impl Octree {
    /// Sorts the bodies into a new tree, in the memory of the last.
    ///
    /// # Panics
    /// If a position is not finite.
    pub fn build(&mut self, bodies: &Bodies<'_>) {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for x in bodies.position {
            for axis in 0..3 {
                assert!(x[axis].is_finite(), "a body is somewhere");
                low[axis] = low[axis].min(x[axis]);
                high[axis] = high[axis].max(x[axis]);
            }
        }
        let width = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
        // The last of the 2^21 places belongs to the upper face.
        let scale = if width > 0.0 { f64::from((1_u32 << DEPTH) - 1) / width } else { 0.0 };
        self.keys.clear();
        self.keys.par_extend(bodies.position.par_iter().enumerate().map(|(index, x)| {
            let place = |axis: usize| spread(((x[axis] - low[axis]) * scale) as u64);
            (place(0) | place(1) << 1 | place(2) << 2, index as u32)
        }));
        self.keys.par_sort_unstable();
        self.order.clear();
        self.order.extend(self.keys.iter().map(|&(_, index)| index));
        self.cells.clear();
        if !self.keys.is_empty() {
            self.divide(bodies, 0, self.keys.len(), DEPTH);
        }
    }

    /// Makes the cell of a range of the curve, `halvings` of which are left; its index.
    fn divide(&mut self, bodies: &Bodies<'_>, first: usize, last: usize, halvings: u32) -> usize {
        let at = self.cells.len();
        self.cells.push(Cell::default());
        let mut cell = Cell::default();
        if last - first <= LEAF || halvings == 0 {
            (cell.first, cell.last) = (first as u32, last as u32);
            let parts = self.order[first..last].iter().map(|&index| {
                let index = index as usize;
                Cell {
                    mass: bodies.mass[index],
                    centre: bodies.position[index],
                    smoothing: bodies.smoothing[index],
                    ..Cell::default()
                }
            });
            cell.sum(parts);
        } else {
            let digit = |key: u64| key >> (3 * (halvings - 1)) & 7;
            let mut from = first;
            while from < last {
                let here = digit(self.keys[from].0);
                let to =
                    from + self.keys[from..last].partition_point(|&(key, _)| digit(key) == here);
                self.divide(bodies, from, to, halvings - 1);
                from = to;
            }
            let cells = &self.cells;
            let child = |index: usize| cells.get(index).copied();
            cell.sum(std::iter::successors(child(at + 1), |last| child(last.next as usize)));
        }
        cell.next = self.cells.len() as u32;
        self.cells[at] = cell;
        at
    }
}

impl Cell {
    /// The moments of all parts together.
    fn sum(&mut self, parts: impl Iterator<Item = Self> + Clone) {
        let mut middle = [0.0; 3];
        let mut count = 0.0;
        for part in parts.clone() {
            self.mass += part.mass;
            self.centre = plus_scaled(&self.centre, part.mass, &part.centre);
            self.smoothing = self.smoothing.max(part.smoothing);
            middle = plus_scaled(&middle, 1.0, &part.centre);
            count += 1.0;
        }
        // Bodies without mass have a middle all the same.
        self.centre = if self.mass > 0.0 {
            self.centre.map(|sum| sum / self.mass)
        } else {
            middle.map(|sum| sum / count)
        };
        for part in parts {
            let d = plus_scaled(&part.centre, -1.0, &self.centre);
            let square = dot(&d, &d);
            self.radius = self.radius.max(square.sqrt() + part.radius);
            for (entry, [i, j]) in
                [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]].into_iter().enumerate()
            {
                let trace = if i == j { square } else { 0.0 };
                self.quadrupole[entry] +=
                    part.quadrupole[entry] + part.mass * (3.0 * d[i] * d[j] - trace);
            }
        }
    }

    /// `Q·d`.
    #[inline]
    pub fn quadrupole_times(&self, d: &Vector<3>) -> Vector<3> {
        let [xx, xy, xz, yy, yz, zz] = self.quadrupole;
        [
            xx * d[0] + xy * d[1] + xz * d[2],
            xy * d[0] + yy * d[1] + yz * d[2],
            xz * d[0] + yz * d[1] + zz * d[2],
        ]
    }
}

/// The 21 low bits, two zeros between each and the next.
fn spread(bits: u64) -> u64 {
    let mut x = bits & 0x1f_ffff;
    x = (x | x << 32) & 0x1f_0000_0000_ffff;
    x = (x | x << 16) & 0x1f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}
