//! The neighbours of each particle, in a canonical order.

use super::cells::Cells;
use super::domain::{Domain, Image};
use super::parallel::{fill, first, for_each_block};
use super::vector::{Vector, dot};

/// Particles are handled in blocks of this many, whatever the number of threads.
pub(super) const BLOCK: usize = 256;

/// One of a particle's neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Neighbour {
    /// Its place in the spatial order.
    pub(super) other: u32,
    link: u32,
}

/// How a pair is evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Link {
    /// With an image: from both its ends, each for itself.
    Image(usize),
    /// The neighbour, which comes first in the spatial order, has evaluated the pair and left the result here.
    Known(usize),
    /// By this particle, which comes first or whose neighbour is passive.
    Own,
}

const IMAGE: u32 = 1 << 31;
const OWN: u32 = IMAGE - 1;

impl Neighbour {
    #[inline]
    pub(super) fn link(self) -> Link {
        if self.link & IMAGE != 0 {
            Link::Image((self.link & !IMAGE) as usize)
        } else if self.link == OWN {
            Link::Own
        } else {
            Link::Known(self.link as usize)
        }
    }
}

/// The neighbours of a block of active particles that follow each other in the spatial order.
#[derive(Debug, Clone, Default)]
pub(super) struct Block {
    /// The first one's index among the active particles.
    pub start: usize,
    /// How many there are.
    pub len: usize,
    /// The number of pairs evaluated by the blocks before this one.
    first_pair: usize,
    /// Neighbours before and after each particle.
    before: Vec<Neighbour>,
    after: Vec<Neighbour>,
    before_starts: Vec<u32>,
    after_starts: Vec<u32>,
}

impl Block {
    /// Neighbours before the `k`-th particle of the block: images on the left, and those that come first.
    #[inline]
    pub fn before(&self, k: usize) -> &[Neighbour] {
        &self.before[self.before_starts[k] as usize..self.before_starts[k + 1] as usize]
    }

    /// Neighbours after it: those that come later, and images on the right.
    #[inline]
    pub fn after(&self, k: usize) -> &[Neighbour] {
        &self.after[self.after_starts[k] as usize..self.after_starts[k + 1] as usize]
    }

    /// All of them, before and after.
    #[inline]
    pub fn all(&self, k: usize) -> impl Iterator<Item = &Neighbour> {
        self.before(k).iter().chain(self.after(k))
    }
}

/// The neighbours of the active particles. Buffers are kept from one search to the next, so that a step allocates
/// nothing once they have grown.
///
/// **Who is a neighbour.** Everyone, image or not, with `r ≤ max(R, R_other)`: each of two active particles
/// has the other in its list.
///
/// **In which order.** That of the cells: space, not numbers. On a line it is from left to right; there the sums of those
/// before, from near to far, and of those after, from near to far, cancel exactly on an exactly representable lattice.
#[derive(Debug, Clone, Default)]
pub struct Neighbours<const D: usize> {
    pub(super) cells: Cells<D>,
    /// Places of the active particles in the spatial order, ascending.
    pub(super) active: Vec<u32>,
    /// The index of a place among those of the active ones, or [`PASSIVE`].
    rank: Vec<u32>,
    pub(super) blocks: Vec<Block>,
    next: Vec<u32>,
    /// Radii by number.
    radii: Vec<f64>,
    complete: bool,
    /// Searches done so far, of one particle each.
    pub(super) searches: u64,
}

const PASSIVE: u32 = u32::MAX;

impl<const D: usize> Neighbours<D> {
    /// Finds everybody's neighbours within `radii` (units length).
    pub fn search(&mut self, domain: &Domain<D>, positions: &[Vector<D>], radii: &[f64]) {
        self.search_from(domain, positions, None, |i| radii[i]);
    }

    /// Finds the neighbours of the active particles (all, if there is no list of their numbers) within
    /// `radius(number)`.
    pub(super) fn search_from(
        &mut self,
        domain: &Domain<D>,
        positions: &[Vector<D>],
        active: Option<&[u32]>,
        radius: impl Fn(usize) -> f64 + Sync,
    ) {
        fill(&mut self.radii, positions.len(), radius);
        self.cells.build(domain, positions, &self.radii);
        self.activate(active);
        self.complete = active.is_none();
        self.searches += self.active.len() as u64;
        let count = self.active.len();
        self.blocks.resize_with(count.div_ceil(BLOCK), Block::default);
        for (index, block) in self.blocks.iter_mut().enumerate() {
            block.start = index * BLOCK;
            block.len = BLOCK.min(count - block.start);
        }
        let (cells, active) = (&self.cells, &self.active);
        for_each_block(&mut self.blocks, &|block| block.search(cells, active));
        self.link();
    }

    /// Whether everybody's lists still hold all neighbours within `radius(number)` after a motion since they were
    /// made; then the places are brought up to date. Returns what must be left of the radii searched in: twice
    /// the largest displacement.
    pub(super) fn reuse(
        &mut self,
        positions: &[Vector<D>],
        radius: impl Fn(usize) -> f64 + Sync,
    ) -> Option<f64> {
        if !self.complete || self.radii.len() != positions.len() {
            return None;
        }
        let slack = 2.0 * self.cells.moved(positions);
        let radii = &self.radii;
        if first(radii.len(), |i| radius(i) + slack > radii[i]).is_some() {
            return None;
        }
        self.cells.refresh(positions);
        Some(slack)
    }

    /// The radius a particle was searched with, by number.
    pub(super) fn radius(&self, particle: usize) -> f64 {
        self.radii[particle]
    }

    /// The images that occur in pairs.
    pub fn images(&self) -> &[Image<D>] {
        &self.cells.images
    }

    /// Whether the particle at a place is active.
    #[inline]
    pub(super) fn is_active(&self, place: usize) -> bool {
        self.complete || self.rank[place] != PASSIVE
    }

    /// The block that has evaluated the pair known to a later neighbour of the particle at a place, and its index there.
    #[inline]
    pub(super) fn pair(&self, earlier: usize, pair: usize) -> (usize, usize) {
        let rank = if self.complete { earlier } else { self.rank[earlier] as usize };
        (rank / BLOCK, pair - self.blocks[rank / BLOCK].first_pair)
    }

    /// Which image of a neighbour is seen.
    #[inline]
    fn image_index(&self, neighbour: Neighbour) -> usize {
        match neighbour.link() {
            Link::Image(image) => image,
            Link::Known(_) | Link::Own => self.cells.identity,
        }
    }

    /// The image of a neighbour that is seen.
    #[inline]
    pub(super) fn image(&self, neighbour: Neighbour) -> &Image<D> {
        &self.cells.images[self.image_index(neighbour)]
    }

    /// What the particle at a place sees of a neighbour: which image, its number, displacement and distance.
    #[inline]
    pub(super) fn see(&self, at: usize, neighbour: Neighbour) -> (usize, usize, Vector<D>, f64) {
        let (image, other) = (self.image_index(neighbour), neighbour.other as usize);
        let position = &self.cells.position;
        let displacement = self.cells.images[image].displacement(&position[at], &position[other]);
        let distance = dot(&displacement, &displacement).sqrt();
        (image, self.cells.order[other] as usize, displacement, distance)
    }

    /// The number of the `k`-th particle of a block.
    #[inline]
    pub(super) fn number(&self, block: &Block, k: usize) -> usize {
        self.cells.order[self.active[block.start + k] as usize] as usize
    }

    /// Values of the active particles, in their order, to all by number.
    pub(super) fn hand_out<T: Copy>(&self, values: &[T], by_number: &mut [T]) {
        for (&at, &value) in self.active.iter().zip(values) {
            by_number[self.cells.order[at as usize] as usize] = value;
        }
    }

    /// `value[i] ← meet(value[i], value[j])` over all neighbours `j`, by number and for everybody at once; whether any
    /// value changed.
    pub(super) fn spread<T: Copy + PartialEq + Send + Sync>(
        &self,
        values: &mut [T],
        meet: impl Fn(T, T) -> T + Sync,
    ) -> bool {
        let order = &self.cells.order;
        let (mut here, mut next) = (Vec::new(), Vec::new());
        {
            let values = &*values;
            fill(&mut here, values.len(), |at| values[order[at] as usize]);
        }
        fill(&mut next, values.len(), |at| {
            let neighbours = self.blocks[at / BLOCK].all(at % BLOCK);
            neighbours.fold(here[at], |own, other| meet(own, here[other.other as usize]))
        });
        for (&number, &value) in order.iter().zip(&next) {
            values[number as usize] = value;
        }
        here != next
    }

    fn activate(&mut self, active: Option<&[u32]>) {
        let count = self.cells.order.len();
        let Some(active) = active else {
            fill(&mut self.active, count, |at| at as u32);
            return;
        };
        // By number first; then by place.
        self.next.clear();
        self.next.resize(count, PASSIVE);
        for &number in active {
            self.next[number as usize] = 0;
        }
        self.active.clear();
        self.rank.clear();
        for (at, &number) in (0..).zip(&self.cells.order) {
            if self.next[number as usize] == PASSIVE {
                self.rank.push(PASSIVE);
            } else {
                self.rank.push(self.active.len() as u32);
                self.active.push(at);
            }
        }
    }

    /// Tells those who come later where those who come first leave the results of pairs.
    ///
    /// Later particles are taken in order, and the lists of earlier ones are in order: each list is walked once.
    fn link(&mut self) {
        let mut pairs = 0;
        self.next.clear();
        for block in &mut self.blocks {
            block.first_pair = pairs;
            pairs += block.after.len();
            let starts = &block.after_starts[..block.len];
            self.next.extend(starts.iter().map(|start| block.first_pair as u32 + start));
        }
        assert!(pairs < OWN as usize, "fewer than 2^31 pairs");
        for index in 0..self.blocks.len() {
            let mut before = std::mem::take(&mut self.blocks[index].before);
            for k in 0..self.blocks[index].len {
                let later = self.active[self.blocks[index].start + k];
                let starts = &self.blocks[index].before_starts;
                for neighbour in &mut before[starts[k] as usize..starts[k + 1] as usize] {
                    if neighbour.link != OWN || !self.is_active(neighbour.other as usize) {
                        continue;
                    }
                    let earlier = neighbour.other as usize;
                    let rank = if self.complete { earlier } else { self.rank[earlier] as usize };
                    let block = &self.blocks[rank / BLOCK];
                    let next = &mut self.next[rank];
                    while block.after[*next as usize - block.first_pair].other != later {
                        *next += 1;
                    }
                    neighbour.link = *next;
                    *next += 1;
                }
            }
            self.blocks[index].before = before;
        }
    }
}

impl Neighbours<1> {
    /// What each particle of a line sees from left to right: numbers and displacements of those before it, and of those after it.
    pub(crate) fn rows(
        &self,
    ) -> impl Iterator<
        Item = (impl ExactSizeIterator<Item = (u32, f64)>, impl Iterator<Item = (u32, f64)>),
    > {
        let all = self.blocks.iter().flat_map(|block| (0..block.len).map(move |k| (block, k)));
        all.map(move |(block, k)| {
            let at = self.active[block.start + k] as usize;
            let seen = move |&neighbour: &Neighbour| {
                let (_, number, displacement, _) = self.see(at, neighbour);
                (number as u32, displacement[0])
            };
            (block.before(k).iter().map(seen), block.after(k).iter().map(seen))
        })
    }
}

impl Block {
    fn search<const D: usize>(&mut self, cells: &Cells<D>, active: &[u32]) {
        self.before.clear();
        self.after.clear();
        self.before_starts.clear();
        self.after_starts.clear();
        for &at in &active[self.start..self.start + self.len] {
            let at = at as usize;
            let starts = [self.before.len(), self.after.len()];
            self.before_starts.push(starts[0] as u32);
            self.after_starts.push(starts[1] as u32);
            let mut images = false;
            cells.around(at, |other, image| {
                let inside = image == cells.identity;
                images |= !inside;
                let link = if inside { OWN } else { IMAGE | image as u32 };
                let neighbour = Neighbour { other: other as u32, link };
                if (image, other) < (cells.identity, at) {
                    self.before.push(neighbour);
                } else {
                    self.after.push(neighbour);
                }
            });
            if D == 1 && images {
                // In a mirror the order is the other way round.
                let place = |neighbour: &Neighbour| match neighbour.link() {
                    Link::Image(image) => {
                        cells.images[image].position(&cells.position[neighbour.other as usize])[0]
                    }
                    // Between the images on the left and those on the right.
                    Link::Known(_) | Link::Own => cells.position[at][0],
                };
                let by_place = |a: &Neighbour, b: &Neighbour| place(a).total_cmp(&place(b));
                self.before[starts[0]..].sort_by(by_place);
                self.after[starts[1]..].sort_by(by_place);
            }
        }
        self.before_starts.push(self.before.len() as u32);
        self.after_starts.push(self.after.len() as u32);
    }
}
