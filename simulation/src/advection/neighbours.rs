//! Who is near whom on a ring.

use super::ring::Ring;

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
#[derive(Debug, Clone, PartialEq)]
pub struct Neighbours {
    starts: Vec<usize>,
    own: Vec<usize>,
    indices: Vec<u32>,
    displacements: Vec<f64>,
}

impl Neighbours {
    /// The neighbours within `reach` on the ring: positions are sorted, so each search walks outwards
    /// from the particle and stops at the first one too far.
    pub fn find(ring: &Ring, reach: f64) -> Self {
        let positions = ring.positions();
        let count = positions.len();
        let limit = reach + 4.0 * f64::EPSILON * (ring.length() + reach);
        let mut found =
            Self { starts: vec![0], own: Vec::new(), indices: Vec::new(), displacements: vec![] };
        let mut left = Vec::new();
        for (i, &position) in positions.iter().enumerate() {
            // The offset of a periodic image is added to the difference, not to a position: that keeps
            // equal gaps equal.
            left.clear();
            for steps in 1.. {
                let (j, periods) = wrapped(i as i64 - steps, count);
                let displacement = positions[j] - position + periods * ring.length();
                if -displacement > limit {
                    break;
                }
                left.push((j, displacement.max(-reach)));
            }
            for &(j, displacement) in left.iter().rev() {
                found.push(j, displacement);
            }
            found.own.push(found.indices.len());
            found.push(i, 0.0);
            for steps in 1.. {
                let (j, periods) = wrapped(i as i64 + steps, count);
                let displacement = positions[j] - position + periods * ring.length();
                if displacement > limit {
                    break;
                }
                found.push(j, displacement.min(reach));
            }
            found.starts.push(found.indices.len());
        }
        found
    }

    fn push(&mut self, index: usize, displacement: f64) {
        self.indices.push(u32::try_from(index).expect("a ring holds fewer than 2^32 particles"));
        self.displacements.push(displacement);
    }

    /// How many particles there are.
    pub fn particles(&self) -> usize {
        self.own.len()
    }

    /// Ordered pairs of neighbours, a particle with itself not counted.
    pub fn pairs(&self) -> u64 {
        (self.indices.len() - self.own.len()) as u64
    }

    /// The entries that belong to particle `i`: `(first, the particle itself, one past the last)`.
    pub fn row(&self, i: usize) -> (usize, usize, usize) {
        (self.starts[i], self.own[i], self.starts[i + 1])
    }

    /// Which particle each entry is.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// `ξ_j − ξ_i` of each entry, through the period where that is the way.
    pub fn displacements(&self) -> &[f64] {
        &self.displacements
    }
}

/// The particle with this unwrapped index, and how many periods away.
fn wrapped(index: i64, count: usize) -> (usize, f64) {
    let count = count as i64;
    (index.rem_euclid(count) as usize, index.div_euclid(count) as f64)
}
