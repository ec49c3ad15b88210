//! The general path: sums over neighbours found among positions.

use super::ring::Ring;
use super::scheme::{AdvectionScheme, Discretisation};
use super::stepper::Stepper;
use crate::boundary::Boundary;
use crate::particles::{Domain, Neighbours};
use courant_analysis::exact::rational::to_f64;
use rayon::prelude::*;

/// Rings below this size are stepped on one thread: a step is shorter than handing it out.
const PARALLEL_FROM: usize = 16_384;

/// Particles per task.
const CHUNK: usize = 4096;

/// The schemes as sums over particles, Ferrari et al. 2008 with the orientation repaired
/// (`∂W/∂ξ_i` for `∂W/∂ξ_j`, upwind for downwind):
///
/// - Euler-SPH (2.9): `u_i − aΔt Σ_j V_j u_j ∂W_ij/∂ξ_i`;
/// - Lax–Wendroff SPH (2.17): that `+ (aΔt)²/2 Σ_j V_j u_j ∂²W_ij/∂ξ²`, with `j = i` in the second sum;
/// - Godunov SPH (2.18): `u_i − Δt Σ_j 2 V_j f_ij ∂W_ij/∂ξ_i` with `f_ij = a` times the value of whichever
///   of the two lies to the left (2.19).
///
/// The particles stay where they are (`ξ` is a Lagrangian coordinate), so neighbours and kernel values
/// are found once, and a step is a sparse matrix, `u_i ← Σ_j w_ij u_j`. Nothing about the positions is assumed; on uneven
/// ones the sums are the plain, uncorrected ones and keep constants only roughly.
///
/// A step reads 16 bytes per interaction besides the values, does 2 operations with them, and gathers values that lie close
/// together. A sum is one chain of dependent additions, so that its bits depend on nothing; the processor overlaps those of
/// several particles. Measured on one core of a busy two-core virtual machine: 3·10⁸ updates a second with 8 neighbours
/// where the rows stay in the second-level cache, 2·10⁸ where they do not.
#[derive(Debug, Clone)]
pub struct ParticlePath {
    /// Where the row of each particle begins, and where the last one ends.
    starts: Vec<usize>,
    /// Whose value each entry takes and `w_ij`, from the farthest on the left to the farthest on the right.
    entries: Vec<(u32, f64)>,
    values: Vec<f64>,
    next: Vec<f64>,
}

impl ParticlePath {
    /// The scheme on the ring, all values zero. The smoothing length is `l/Δξ` mean spacings and the
    /// time step moves a wave by `courant_number` mean spacings.
    ///
    /// A point exactly on the edge of the support is a neighbour, as `q = 3` belongs to the Gaussian of Ferrari et al.
    /// 2008 (2.8). Positions up to `L` are rounded by `L·ε/2`, so a point meant to be on the edge may come
    /// out a few such roundings beyond it: distances up to `4 ε (L + reach)` beyond the reach count as on the
    /// edge. The analysis decides the edge exactly; for lattice points the two decisions agree as long as no
    /// lattice point lies off the edge by less than that.
    ///
    /// Where the reach exceeds the period a particle is its neighbours' neighbour more than once.
    pub fn new(of: &Discretisation, courant_number: f64, ring: &Ring) -> Self {
        let (scheme, kernel) = (of.scheme(), of.kernel());
        let length = to_f64(of.ratio()) * ring.spacing();
        let way = courant_number * ring.spacing();
        let reach = kernel.support() * length;
        let positions: Vec<[f64; 1]> = ring.positions().iter().map(|&x| [x]).collect();
        let limit = reach + 4.0 * f64::EPSILON * (ring.length() + reach);
        let domain = Domain::new([0.0], [ring.length()], Boundary::Periodic);
        let mut near = Neighbours::default();
        near.search(&domain, &positions, &vec![limit; positions.len()]);
        // What `u_j` adds to `u_i`, for Godunov SPH what the value on the left does; `j = i` adds no slope, `W'(0) = 0`.
        let weight = |(j, displacement): (u32, f64)| {
            // A point on the edge must not fall off it by the rounding of this division.
            let q = (displacement.abs() / length).min(kernel.support());
            // −aΔt ∂W/∂ξ_i, where ∂W/∂ξ_i = W'(|ξ_i − ξ_j|) sign(ξ_i − ξ_j).
            let slope = displacement.signum() * kernel.slope(q) * way / (length * length);
            let curvature = || kernel.curvature(q) * way * way / length.powi(3);
            let volume = ring.volumes()[j as usize];
            volume
                * match scheme {
                    AdvectionScheme::EulerSph => slope,
                    AdvectionScheme::LaxWendroffSph => slope + 0.5 * curvature(),
                    AdvectionScheme::GodunovSph => 2.0 * slope,
                }
        };
        let (mut starts, mut entries) = (vec![0], Vec::new());
        for (i, (before, after)) in (0..).zip(near.rows()) {
            let entry = |seen: (u32, f64)| (seen.0, weight(seen));
            entries.extend(before.map(entry));
            if scheme == AdvectionScheme::GodunovSph {
                // It lies to the left of those after it.
                entries.push((i, 1.0 + after.map(weight).sum::<f64>()));
            } else {
                entries.push((i, 1.0 + weight((i, 0.0))));
                entries.extend(after.map(entry));
            }
            starts.push(entries.len());
        }
        let zeros = vec![0.0; positions.len()];
        Self { starts, entries, values: zeros.clone(), next: zeros }
    }
}

impl Stepper for ParticlePath {
    fn step(&mut self) {
        let (starts, entries, values) = (&self.starts, &self.entries, &self.values);
        // The order of summation is that of the neighbours, whatever the threads.
        let advance = |first: usize, part: &mut [f64]| {
            for (row, value) in starts[first..].windows(2).zip(part) {
                let row = entries[row[0]..row[1]].iter();
                *value = row.map(|&(j, weight)| weight * values[j as usize]).sum();
            }
        };
        if values.len() < PARALLEL_FROM {
            advance(0, &mut self.next);
        } else {
            let parts = self.next.par_chunks_mut(CHUNK).enumerate();
            parts.for_each(|(index, part)| advance(index * CHUNK, part));
        }
        std::mem::swap(&mut self.values, &mut self.next);
    }

    fn state(&self) -> &[f64] {
        &self.values
    }

    fn set_state(&mut self, values: &[f64]) {
        self.values.copy_from_slice(values);
    }

    fn interactions_per_step(&self) -> u64 {
        (self.entries.len() - self.values.len()) as u64
    }
}
