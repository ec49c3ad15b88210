//! Who is near whom on a ring.

use super::ring::Ring;
use crate::boundary::Boundary;
use crate::particles::{self, Domain};

/// For every particle its neighbours within a distance, from the farthest on the left to the farthest on
/// the right, the particle itself in between.
///
/// A point exactly at the distance is a neighbour, as `q = 3` belongs to the Gaussian of Ferrari et al.
/// 2008 (2.8). Positions up to `L` are rounded by `L·ε/2`, so a point meant to be on the edge may come
/// out a few such roundings beyond it: distances up to `4 ε (L + reach)` beyond the reach count as on the
/// edge. The analysis decides the edge exactly; for lattice points the two decisions agree as long as no
/// lattice point lies off the edge by less than that.
///
/// Where the reach exceeds the period a particle is its neighbours' neighbour more than once.
#[derive(Debug, Clone)]
pub(super) struct Neighbours {
    /// Where the entries of each particle begin, and where the last ones end.
    pub starts: Vec<usize>,
    /// Which entry is the particle itself.
    pub own: Vec<usize>,
    /// Which particle each entry is.
    pub indices: Vec<u32>,
    /// `ξ_j − ξ_i` of each entry, through the period where that is the way.
    pub displacements: Vec<f64>,
}

impl Neighbours {
    /// The neighbours within `reach`.
    pub fn find(ring: &Ring, reach: f64) -> Self {
        let positions: Vec<[f64; 1]> = ring.positions().iter().map(|&x| [x]).collect();
        let limit = reach + 4.0 * f64::EPSILON * (ring.length() + reach);
        let domain = Domain::new([0.0], [ring.length()], Boundary::Periodic);
        let mut near = particles::Neighbours::default();
        near.search(&domain, &positions, &vec![limit; positions.len()]);
        let (own, indices, displacements) = (Vec::new(), Vec::new(), Vec::new());
        let mut found = Self { starts: vec![0], own, indices, displacements };
        for (i, (before, after)) in (0..).zip(near.rows()) {
            found.own.push(found.indices.len() + before.len());
            for (j, displacement) in before.chain([(i, 0.0)]).chain(after) {
                found.indices.push(j);
                found.displacements.push(displacement.clamp(-reach, reach));
            }
            found.starts.push(found.indices.len());
        }
        found
    }

    /// Ordered pairs of neighbours, a particle with itself not counted.
    pub fn pairs(&self) -> u64 {
        (self.indices.len() - self.own.len()) as u64
    }
}
