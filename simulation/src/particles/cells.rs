//! Particles sorted in space: a grid of cells for each octave of the radius.

use super::domain::{Domain, Image};
use super::parallel::{fill, largest};
use super::vector::{Vector, dot};

/// Radii are told apart by factors of two down to this many of them.
const OCTAVES: usize = 16;
/// Width of a cell over the largest radius in its grid.
const WIDTH: f64 = 0.5;
/// The cube that is searched is wider than the radius by rounding.
const ROUNDING: f64 = 1.0 + 1e-9;

/// The particles of one octave, or rather where they are.
#[derive(Debug, Clone)]
struct Grid<const D: usize> {
    low: Vector<D>,
    high: Vector<D>,
    /// No radius is larger.
    largest: f64,
    cells_per_length: f64,
    counts: [usize; D],
    first_cell: usize,
}

/// The particles in spatial order: by octave, by cell, and by position in a cell, whatever their numbers are.
///
/// A wide particle sees many narrow ones, and a narrow one must see the wide ones that reach it: with a grid
/// for each octave both look through cells of a size that suits. All buffers are kept from one build to the next.
#[derive(Debug, Clone, Default)]
pub(super) struct Cells<const D: usize> {
    /// From left to right, by where they show the centre of the domain.
    pub images: Vec<Image<D>>,
    /// Which of them is the identity.
    pub identity: usize,
    /// Particle numbers in spatial order.
    pub order: Vec<u32>,
    /// Positions in spatial order, inside the periodic domain when the cells were built.
    pub position: Vec<Vector<D>>,
    square: Vec<f64>,
    grids: Vec<Grid<D>>,
    starts: Vec<u32>,
    /// By particle number: positions, those shifted into the periodic domain, and their cells.
    built: Vec<Vector<D>>,
    wrapped: Vec<Vector<D>>,
    cell: Vec<u32>,
}

impl<const D: usize> Grid<D> {
    fn empty(largest: f64) -> Self {
        Self {
            low: [f64::INFINITY; D],
            high: [f64::NEG_INFINITY; D],
            largest,
            cells_per_length: 1.0,
            counts: [1; D],
            first_cell: 0,
        }
    }

    /// Cells for `particles` of them; no more than a few for each, however thin the gas is spread.
    fn divide(&mut self, particles: usize) {
        let volume: f64 = (0..D).map(|axis| self.extent(axis) + self.largest).product();
        let fewest = (volume / (4.0 * particles as f64)).powf(1.0 / D as f64);
        self.cells_per_length = 1.0 / fewest.max(WIDTH * self.largest);
        self.counts =
            std::array::from_fn(|axis| (self.extent(axis) * self.cells_per_length) as usize + 1);
    }

    fn extent(&self, axis: usize) -> f64 {
        self.high[axis] - self.low[axis]
    }

    #[inline]
    fn coordinates(&self, x: &Vector<D>) -> [usize; D] {
        // Negative values saturate at zero.
        std::array::from_fn(|axis| {
            (((x[axis] - self.low[axis]) * self.cells_per_length) as usize)
                .min(self.counts[axis] - 1)
        })
    }

    #[inline]
    fn flat(&self, coordinates: &[usize; D]) -> usize {
        coordinates.iter().zip(&self.counts).fold(0, |flat, (at, count)| flat * count + at)
    }
}

fn octave(largest: f64, radius: f64) -> usize {
    // The exponent of a number that is not below one.
    let exponent = ((largest / radius).to_bits() >> 52) as usize;
    exponent.saturating_sub(1023).min(OCTAVES - 1)
}

impl<const D: usize> Cells<D> {
    /// Sorts the particles.
    pub fn build(&mut self, domain: &Domain<D>, positions: &[Vector<D>], radii: &[f64]) {
        let count = positions.len();
        let widest = largest(count, |i| radii[i]);
        self.built.clear();
        self.built.extend_from_slice(positions);
        fill(&mut self.wrapped, count, |i| domain.wrap(&positions[i]));

        let mut grids: Vec<(Grid<D>, usize)> =
            (0..OCTAVES).map(|k| (Grid::empty(widest / f64::from(1_u32 << k)), 0)).collect();
        for (x, &radius) in self.wrapped.iter().zip(radii) {
            let (grid, members) = &mut grids[octave(widest, radius)];
            *members += 1;
            for ((low, high), &x) in grid.low.iter_mut().zip(&mut grid.high).zip(x) {
                (*low, *high) = (low.min(x), high.max(x));
            }
        }
        let mut grid_of = [0; OCTAVES];
        let mut cells = 0;
        self.grids.clear();
        for (k, (mut grid, members)) in grids.into_iter().enumerate().filter(|(_, (_, m))| *m > 0) {
            grid.divide(members);
            grid.first_cell = cells;
            cells += grid.counts.iter().product::<usize>();
            grid_of[k] = self.grids.len();
            self.grids.push(grid);
        }
        let (grids, wrapped) = (&self.grids, &self.wrapped);
        fill(&mut self.cell, count, |i| {
            let grid = &grids[grid_of[octave(widest, radii[i])]];
            (grid.first_cell + grid.flat(&grid.coordinates(&wrapped[i]))) as u32
        });
        self.sort(cells);
        let (order, wrapped) = (&self.order, &self.wrapped);
        fill(&mut self.position, count, |at| wrapped[order[at] as usize]);
        fill(&mut self.square, count, |at| radii[order[at] as usize] * radii[order[at] as usize]);
        self.find_images(domain, widest);
    }

    /// Counting sort by cell, then by position in each.
    fn sort(&mut self, cells: usize) {
        self.starts.clear();
        self.starts.resize(cells + 1, 0);
        for &cell in &self.cell {
            self.starts[cell as usize + 1] += 1;
        }
        for cell in 0..cells {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.order.clear();
        self.order.resize(self.cell.len(), 0);
        // Counts each start up to the next one, and shifts them home again.
        for (particle, &cell) in (0..).zip(&self.cell) {
            let next = &mut self.starts[cell as usize];
            self.order[*next as usize] = particle;
            *next += 1;
        }
        self.starts.copy_within(0..cells, 1);
        self.starts[0] = 0;
        let wrapped = &self.wrapped;
        let before = |a: &u32, b: &u32| {
            let (x, y) = (&wrapped[*a as usize], &wrapped[*b as usize]);
            let axes = x.iter().zip(y).map(|(x, y)| x.total_cmp(y));
            axes.fold(std::cmp::Ordering::Equal, |known, next| known.then(next)).then(a.cmp(b))
        };
        for cell in 0..cells {
            let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
            if range.len() > 1 {
                self.order[range].sort_unstable_by(before);
            }
        }
    }

    fn find_images(&mut self, domain: &Domain<D>, reach: f64) {
        let bound = |start: f64, pick: fn(f64, f64) -> f64, end: fn(&Grid<D>) -> &Vector<D>| {
            std::array::from_fn(|axis| {
                self.grids.iter().map(|grid| end(grid)[axis]).fold(start, pick)
            })
        };
        let low: Vector<D> = bound(f64::INFINITY, f64::min, |grid| &grid.low);
        let high: Vector<D> = bound(f64::NEG_INFINITY, f64::max, |grid| &grid.high);
        domain.images(&low, &high, reach, &mut self.images);
        let centre: Vector<D> =
            std::array::from_fn(|axis| 0.5 * (domain.lower[axis] + domain.upper[axis]));
        self.images.sort_by(|a, b| {
            let (a, b) = (a.displacement(&centre, &centre), b.displacement(&centre, &centre));
            let axes = a.iter().zip(&b).map(|(a, b)| a.total_cmp(b));
            axes.fold(std::cmp::Ordering::Equal, |known, next| known.then(next))
        });
        let identity = self.images.iter().position(|image| *image == Image::IDENTITY);
        self.identity = identity.expect("the identity is among the images");
    }

    /// How far the particle has moved since the cells were built that has moved furthest.
    pub fn moved(&self, positions: &[Vector<D>]) -> f64 {
        let square = |i: usize| {
            let step: Vector<D> =
                std::array::from_fn(|axis| positions[i][axis] - self.built[i][axis]);
            dot(&step, &step)
        };
        largest(positions.len(), square).sqrt()
    }

    /// Moves the particles without sorting them anew.
    pub fn refresh(&mut self, positions: &[Vector<D>]) {
        let (order, built, wrapped) = (&self.order, &self.built, &self.wrapped);
        fill(&mut self.position, positions.len(), |at| {
            let i = order[at] as usize;
            // The same periods away as before.
            std::array::from_fn(|axis| positions[i][axis] - (built[i][axis] - wrapped[i][axis]))
        });
    }

    /// Calls `visit` for everyone, by place in the spatial order and by image, whose distance from the particle at
    /// place `at` is not above the larger of both radii. Images from left to right, each in spatial order.
    #[inline]
    pub fn around(&self, at: usize, mut visit: impl FnMut(usize, usize)) {
        let (x, square) = (self.position[at], self.square[at]);
        let radius = square.sqrt();
        for (index, image) in self.images.iter().enumerate() {
            // Where a particle is whose image is here.
            let centre: Vector<D> =
                std::array::from_fn(|axis| image.flip[axis] * (x[axis] - image.shift[axis]));
            for grid in &self.grids {
                let range = radius.max(grid.largest) * ROUNDING;
                let misses = |axis: usize| {
                    centre[axis] + range < grid.low[axis] || centre[axis] - range > grid.high[axis]
                };
                if (0..D).any(misses) {
                    continue;
                }
                let first = grid.coordinates(&centre.map(|component| component - range));
                let last = grid.coordinates(&centre.map(|component| component + range));
                let mut row = first;
                loop {
                    // Cells along the last axis are side by side in memory.
                    let from = grid.first_cell + grid.flat(&row);
                    let to = from + (last[D - 1] - first[D - 1]);
                    for other in self.starts[from] as usize..self.starts[to + 1] as usize {
                        let displacement = image.displacement(&x, &self.position[other]);
                        let near =
                            dot(&displacement, &displacement) <= square.max(self.square[other]);
                        if near && (other != at || index != self.identity) {
                            visit(other, index);
                        }
                    }
                    let Some(axis) = (0..D - 1).rev().find(|&axis| row[axis] < last[axis]) else {
                        break;
                    };
                    row[axis] += 1;
                    row[axis + 1..].copy_from_slice(&first[axis + 1..]);
                }
            }
        }
    }
}
