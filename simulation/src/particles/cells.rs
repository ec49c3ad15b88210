//! A cell list: particles and their images sorted into the boxes of a grid.

use super::domain::{Domain, Image};
use super::vector::Vector;

/// A particle, or an image of one, in a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Occupant {
    pub particle: u32,
    pub image: u16,
}

/// The grid. All buffers are kept from one build to the next.
#[derive(Debug, Clone)]
pub(super) struct Cells<const D: usize> {
    pub images: Vec<Image<D>>,
    origin: Vector<D>,
    size: f64,
    counts: [usize; D],
    starts: Vec<u32>,
    occupants: Vec<Occupant>,
    unsorted: Vec<(u32, Occupant)>,
}

impl<const D: usize> Default for Cells<D> {
    fn default() -> Self {
        Self {
            images: Vec::new(),
            origin: [0.0; D],
            size: 1.0,
            counts: [1; D],
            starts: Vec::new(),
            occupants: Vec::new(),
            unsorted: Vec::new(),
        }
    }
}

impl<const D: usize> Cells<D> {
    /// Sorts all particles, and all images within the largest radius of a particle, into cells.
    ///
    /// The cells are as wide as the *mean* radius: a few wide particles in a cavity then visit many
    /// cells, instead of all the others finding half the gas in theirs.
    pub fn build(&mut self, domain: &Domain<D>, positions: &[Vector<D>], radii: &[f64]) {
        let mut low = [f64::INFINITY; D];
        let mut high = [f64::NEG_INFINITY; D];
        for x in positions {
            for axis in 0..D {
                low[axis] = low[axis].min(x[axis]);
                high[axis] = high[axis].max(x[axis]);
            }
        }
        let largest = radii.iter().fold(0.0_f64, |a, &b| a.max(b));
        let mean = radii.iter().sum::<f64>() / radii.len().max(1) as f64;
        domain.images(&low, &high, largest, &mut self.images);
        self.origin = std::array::from_fn(|axis| low[axis] - largest);
        // No more than a few cells for each particle, however thin the gas is spread.
        let extent = |axis: usize| high[axis] - low[axis] + 2.0 * largest;
        let volume: f64 = (0..D).map(extent).product();
        let budget = 4.0 * positions.len().max(1) as f64;
        self.size = mean.max((volume / budget).powf(1.0 / D as f64));
        self.counts = std::array::from_fn(|axis| (extent(axis) / self.size) as usize + 1);

        self.unsorted.clear();
        for (index, image) in (0..).zip(&self.images) {
            for (particle, x) in (0..).zip(positions) {
                let x = image.position(x);
                let near =
                    |axis: usize| x[axis] >= low[axis] - largest && x[axis] <= high[axis] + largest;
                if (0..D).all(near) {
                    let cell = self.flat(&std::array::from_fn(|axis| self.coordinate(&x, axis)));
                    self.unsorted.push((cell as u32, Occupant { particle, image: index }));
                }
            }
        }
        let cells: usize = self.counts.iter().product();
        self.starts.clear();
        self.starts.resize(cells + 1, 0);
        for &(cell, _) in &self.unsorted {
            self.starts[cell as usize + 1] += 1;
        }
        for cell in 0..cells {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.occupants.clear();
        self.occupants.resize(self.unsorted.len(), Occupant { particle: 0, image: 0 });
        // Fill from the back, counting each start up and then shifting it home again.
        for &(cell, occupant) in &self.unsorted {
            let next = &mut self.starts[cell as usize];
            self.occupants[*next as usize] = occupant;
            *next += 1;
        }
        for cell in (1..=cells).rev() {
            self.starts[cell] = self.starts[cell - 1];
        }
        self.starts[0] = 0;
    }

    #[inline]
    fn coordinate(&self, x: &Vector<D>, axis: usize) -> usize {
        // Negative values saturate at zero.
        (((x[axis] - self.origin[axis]) / self.size) as usize).min(self.counts[axis] - 1)
    }

    #[inline]
    fn flat(&self, coordinates: &[usize; D]) -> usize {
        coordinates.iter().zip(&self.counts).fold(0, |flat, (at, count)| flat * count + at)
    }

    /// Calls `visit` for every occupant of the cells that touch the cube of half-width `radius`
    /// about `x`.
    #[inline]
    pub fn around(&self, x: &Vector<D>, radius: f64, mut visit: impl FnMut(Occupant)) {
        let edge = |sign: f64| {
            let corner: Vector<D> = std::array::from_fn(|axis| x[axis] + sign * radius);
            std::array::from_fn(|axis| self.coordinate(&corner, axis))
        };
        let (first, last): ([usize; D], [usize; D]) = (edge(-1.0), edge(1.0));
        let mut at = first;
        loop {
            let cell = self.flat(&at);
            for index in self.starts[cell]..self.starts[cell + 1] {
                visit(self.occupants[index as usize]);
            }
            // The next cell of the block, last axis fastest.
            let Some(axis) = (0..D).rev().find(|&axis| at[axis] < last[axis]) else { return };
            at[axis] += 1;
            at[axis + 1..].copy_from_slice(&first[axis + 1..]);
        }
    }
}
