//! Pairs of interacting particles, and each particle's neighbours in a canonical order.

use super::cells::Cells;
use super::domain::{Domain, Image};
use super::vector::{Vector, dot};
use rayon::prelude::*;

/// Particles are handled in blocks of this many, whatever the number of threads.
const BLOCK: usize = 1024;

/// Two particles, or a particle and an image, closer than the larger of their radii. It is evaluated once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair<const D: usize> {
    /// The particle that is itself.
    pub first: u32,
    /// The particle whose image is the other end.
    pub second: u32,
    /// Which image of the second: an index into [`Neighbours::images`], 0 for itself.
    pub image: u16,
    /// Whether the first is left of the second: the first non-zero component of the displacement
    /// is positive.
    pub first_is_left: bool,
    /// Distance of the two ends.
    pub distance: f64,
    /// Unit vector from the left end to the right end (zero for coincident ends).
    pub direction: Vector<D>,
}

/// One end of a pair as a particle sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Neighbour {
    pub distance: f64,
    /// The particle at the other end.
    pub other: u32,
    /// Block and index of the pair.
    block: u32,
    index: u32,
    /// Whether this particle is the pair's first.
    pub is_first: bool,
    /// Whether the other end is to the right.
    pub to_right: bool,
}

/// The pairs owned by a block of particles, and the neighbours of each of them.
#[derive(Debug, Clone, Default)]
pub(super) struct Block<const D: usize> {
    /// The first particle of the block.
    pub start: usize,
    /// How many there are.
    pub len: usize,
    /// Pairs owned by the block's particles.
    pub pairs: Vec<Pair<D>>,
    neighbours: Vec<Neighbour>,
    /// `starts[k]..starts[k + 1]` are the neighbours of particle `start + k`.
    starts: Vec<u32>,
    next: Vec<u32>,
}

impl<const D: usize> Block<D> {
    /// The neighbours of the `k`-th particle of the block, nearest first.
    #[inline]
    pub fn neighbours(&self, k: usize) -> &[Neighbour] {
        &self.neighbours[self.starts[k] as usize..self.starts[k + 1] as usize]
    }
}

impl Neighbour {
    /// Where the pair is: block and index in it.
    #[inline]
    pub fn pair(&self) -> (usize, usize) {
        (self.block as usize, self.index as usize)
    }
}

/// All pairs and neighbours. Buffers are kept from one search to the next, so that a step allocates
/// nothing once they have grown.
///
/// **Which pairs.** Those with `r ≤ max(R_first, R_second)`, each once: it is found by the particle with the
/// larger radius (the lower index among equals), because only that one is sure to see it. A mirror
/// image seen from here is this particle's image seen from there, so reflected pairs obey the same rule.
///
/// **In which order.** A particle's neighbours are sorted by distance, the left one first among equals. Sums over
/// them depend neither on threads nor on how particles are numbered, and on an exactly
/// representable lattice opposite forces cancel exactly.
#[derive(Debug, Clone)]
pub struct Neighbours<const D: usize> {
    cells: Cells<D>,
    pub(super) blocks: Vec<Block<D>>,
}

impl<const D: usize> Default for Neighbours<D> {
    fn default() -> Self {
        Self { cells: Cells::default(), blocks: Vec::new() }
    }
}

/// Runs a task on every block; a single block stays on the calling thread, since waking
/// another one costs more than a step of a few hundred particles.
pub(super) fn for_each_block<T: Send>(blocks: &mut [T], task: impl Fn(&mut T) + Sync + Send) {
    match blocks {
        [only] => task(only),
        many => many.par_iter_mut().for_each(task),
    }
}

impl<const D: usize> Neighbours<D> {
    /// Finds all pairs of `positions` (units length) with interaction `radii`.
    pub fn search(&mut self, domain: &Domain<D>, positions: &[Vector<D>], radii: &[f64]) {
        let count = positions.len();
        self.cells.build(domain, positions, radii);
        self.blocks.resize_with(count.div_ceil(BLOCK), Block::default);
        for (index, block) in self.blocks.iter_mut().enumerate() {
            block.start = index * BLOCK;
            block.len = BLOCK.min(count - block.start);
        }
        let cells = &self.cells;
        for_each_block(&mut self.blocks, |block| {
            block.pairs.clear();
            for first in block.start..block.start + block.len {
                find_pairs(cells, positions, radii, first, &mut block.pairs);
            }
        });
        self.gather();
    }

    /// The images that occur in pairs.
    pub fn images(&self) -> &[Image<D>] {
        &self.cells.images
    }

    /// All pairs, in the order of their first particles.
    pub fn pairs(&self) -> impl Iterator<Item = &Pair<D>> {
        self.blocks.iter().flat_map(|block| &block.pairs)
    }

    /// How many pairs there are.
    pub fn len(&self) -> usize {
        self.blocks.iter().map(|block| block.pairs.len()).sum()
    }

    /// Whether there is no pair.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// From pairs to the neighbours of each particle.
    fn gather(&mut self) {
        for block in &mut self.blocks {
            block.next.clear();
            block.next.resize(block.len, 0);
        }
        for at in 0..self.blocks.len() {
            for index in 0..self.blocks[at].pairs.len() {
                let pair = self.blocks[at].pairs[index];
                let first = pair.first as usize;
                self.blocks[at].next[first % BLOCK] += 1;
                if pair.second != pair.first {
                    let second = pair.second as usize;
                    self.blocks[second / BLOCK].next[second % BLOCK] += 1;
                }
            }
        }
        for block in &mut self.blocks {
            let mut total = 0;
            block.starts.clear();
            block.starts.push(0);
            for next in &mut block.next {
                let start = total;
                total += *next;
                block.starts.push(total);
                *next = start;
            }
            let empty = Neighbour {
                distance: 0.0,
                other: 0,
                block: 0,
                index: 0,
                is_first: true,
                to_right: true,
            };
            block.neighbours.clear();
            block.neighbours.resize(total as usize, empty);
        }
        for at in 0..self.blocks.len() {
            for index in 0..self.blocks[at].pairs.len() {
                let pair = self.blocks[at].pairs[index];
                let seen = Neighbour {
                    distance: pair.distance,
                    other: pair.second,
                    block: at as u32,
                    index: index as u32,
                    is_first: true,
                    to_right: pair.first_is_left,
                };
                self.blocks[at].put(pair.first as usize % BLOCK, seen);
                // A particle and its own image are one particle: both images of a periodic one,
                // the one image in a mirror, are pairs of their own and enter as first only.
                if pair.second != pair.first {
                    let second = pair.second as usize;
                    let back = Neighbour {
                        other: pair.first,
                        is_first: false,
                        // In a mirror left is right: each of the two sees the other beyond the wall.
                        to_right: pair.first_is_left
                            == self.cells.images[pair.image as usize].reflects(),
                        ..seen
                    };
                    self.blocks[second / BLOCK].put(second % BLOCK, back);
                }
            }
        }
        for_each_block(&mut self.blocks, |block| {
            for k in 0..block.len {
                let range = block.starts[k] as usize..block.starts[k + 1] as usize;
                block.neighbours[range].sort_unstable_by(|a, b| {
                    (a.distance.total_cmp(&b.distance))
                        .then(a.to_right.cmp(&b.to_right))
                        .then((a.block, a.index).cmp(&(b.block, b.index)))
                });
            }
        });
    }
}

impl<const D: usize> Block<D> {
    fn put(&mut self, k: usize, neighbour: Neighbour) {
        let next = &mut self.next[k];
        self.neighbours[*next as usize] = neighbour;
        *next += 1;
    }
}

fn find_pairs<const D: usize>(
    cells: &Cells<D>,
    positions: &[Vector<D>],
    radii: &[f64],
    first: usize,
    pairs: &mut Vec<Pair<D>>,
) {
    let (x, radius) = (&positions[first], radii[first]);
    cells.around(x, radius, |occupant| {
        let second = occupant.particle as usize;
        if (second == first && occupant.image == 0)
            || radii[second] > radius
            || (radii[second] == radius && second < first)
        {
            return;
        }
        let image = &cells.images[occupant.image as usize];
        let displacement = image.displacement(x, &positions[second]);
        let square = dot(&displacement, &displacement);
        if square > radius * radius {
            return;
        }
        let distance = square.sqrt();
        let first_is_left = displacement.iter().find(|&&d| d != 0.0).is_none_or(|&d| d > 0.0);
        let sign = if first_is_left { 1.0 } else { -1.0 };
        let direction = if distance > 0.0 {
            displacement.map(|component| sign * component / distance)
        } else {
            [0.0; D]
        };
        pairs.push(Pair {
            first: first as u32,
            second: occupant.particle,
            image: occupant.image,
            first_is_left,
            distance,
            direction,
        });
    });
}
