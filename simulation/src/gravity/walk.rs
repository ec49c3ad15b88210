//! From the tree to the attraction at a place.

use super::octree::{Bodies, Cell, Octree};
use super::softening::{SUPPORT, attraction, potential};
use crate::particles::{Vector, dot, plus_scaled};

/// When a cell may stand for its particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Opening {
    /// If its radius is less than this part of its distance: where nothing is known about the force.
    Geometric(f64),
    /// If the first moment that is left out, of the order `G M b³/r⁵` for the radius `b`, is less than this
    /// acceleration. Springel's criterion (2005, GADGET-2), one order up because quadrupoles are kept.
    Error(f64),
}

/// What a walk finds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Attraction {
    /// The acceleration over `G`.
    pub acceleration: Vector<3>,
    /// Interactions: cells that stood for their particles, and particles.
    pub interactions: u64,
}

/// Cells closer than this many radii are opened whatever their error is thought to be.
const CLOSEST: f64 = 1.2;

impl Octree {
    /// `−Σ m_j (f(r, h) + f(r, h_j))/2 d` at `x` for a body of smoothing length `h`, with `f` of [`attraction`]:
    /// the mean of the two makes the forces of a pair opposite. What is at `x` itself does not attract.
    #[inline]
    pub fn attraction(
        &self,
        bodies: &Bodies<'_>,
        x: &Vector<3>,
        h: f64,
        opening: Opening,
    ) -> Attraction {
        let mut acceleration = [0.0; 3];
        let interactions = self.visit(x, h, opening, |visited| match visited {
            Visited::Cell(cell, d, square) => {
                let inverse = 1.0 / square;
                let cube = inverse * inverse.sqrt();
                let fifth = cube * inverse;
                let turned = cell.quadrupole_times(d);
                let along = cell.mass * cube + 2.5 * dot(d, &turned) * fifth * inverse;
                acceleration = plus_scaled(&acceleration, along, d);
                acceleration = plus_scaled(&acceleration, -fifth, &turned);
            }
            Visited::Body(j) => {
                let d = plus_scaled(&bodies.position[j], -1.0, x);
                let r = dot(&d, &d).sqrt();
                if r > 0.0 {
                    let mean = 0.5 * (attraction(r, h) + attraction(r, bodies.smoothing[j]));
                    acceleration = plus_scaled(&acceleration, bodies.mass[j] * mean, &d);
                }
            }
        });
        Attraction { acceleration, interactions }
    }

    /// The potential over `G` that belongs to [`attraction`](Self::attraction).
    pub fn potential(&self, bodies: &Bodies<'_>, x: &Vector<3>, h: f64, opening: Opening) -> f64 {
        let mut sum = 0.0;
        self.visit(x, h, opening, |visited| match visited {
            Visited::Cell(cell, d, square) => {
                let turned = dot(d, &cell.quadrupole_times(d));
                sum -= (cell.mass + 0.5 * turned / (square * square)) / square.sqrt();
            }
            Visited::Body(j) => {
                let d = plus_scaled(&bodies.position[j], -1.0, x);
                let r = dot(&d, &d).sqrt();
                if r > 0.0 {
                    sum += 0.5
                        * bodies.mass[j]
                        * (potential(r, h) + potential(r, bodies.smoothing[j]));
                }
            }
        });
        sum
    }

    /// Calls `interact` for every cell that may stand for its particles, and for every other particle; how many.
    #[inline]
    fn visit(
        &self,
        x: &Vector<3>,
        h: f64,
        opening: Opening,
        mut interact: impl FnMut(Visited<'_>),
    ) -> u64 {
        let (mut at, mut interactions) = (0, 0);
        while let Some(cell) = self.cells.get(at) {
            let d = plus_scaled(&cell.centre, -1.0, x);
            let square = dot(&d, &d);
            if opening.allows(cell, square, h) {
                interact(Visited::Cell(cell, &d, square));
                interactions += 1;
                at = cell.next as usize;
            } else {
                for &index in &self.order[cell.first as usize..cell.last as usize] {
                    interact(Visited::Body(index as usize));
                }
                interactions += u64::from(cell.last - cell.first);
                at += 1;
            }
        }
        interactions
    }
}

/// What a walk meets.
enum Visited<'a> {
    /// A cell with the displacement to its centre and the square of that.
    Cell(&'a Cell, &'a Vector<3>, f64),
    Body(usize),
}

impl Opening {
    #[inline]
    fn allows(self, cell: &Cell, square: f64, h: f64) -> bool {
        // Softened pairs are no multipole, and inside its radius a cell is none.
        let near = (cell.radius + SUPPORT * h.max(cell.smoothing)).max(CLOSEST * cell.radius);
        if square <= near * near {
            return false;
        }
        match self {
            Self::Geometric(part) => cell.radius * cell.radius < part * part * square,
            Self::Error(most) => {
                cell.mass * cell.radius.powi(3) < most * square * square * square.sqrt()
            }
        }
    }
}
