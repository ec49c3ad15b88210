//! The two multipliers of a step: eigenvalues of the amplification matrix, by a closed form without
//! cancellation, with their multiplicity.

use super::Integrator;
use num_complex::Complex64;

/// How the two multipliers of one step lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PairKind {
    /// Two different ones, not both real: a wave that oscillates.
    Oscillating,
    /// Two different real ones.
    Real,
    /// One multiplier twice (to rounding). With a single eigenvector — `defective` — the amplitude grows
    /// like `n zⁿ`: linearly in the number of steps when `|z| = 1`.
    Double {
        /// Whether there is only one eigenvector.
        defective: bool,
    },
}

/// The multipliers of the two waves of one mode over one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Multipliers {
    /// The wave that travels forward, `z ≈ e^{−iωΔt}` with `Re ω ≥ 0`, so `Im z ≤ 0`; of two real ones
    /// the larger in modulus, the one that is left in the end.
    pub forward: Complex64,
    /// The other one.
    pub backward: Complex64,
    /// How they lie.
    pub kind: PairKind,
    /// `|z| − 1` of the larger one, without cancellation near 1.
    pub growth: f64,
}

impl Multipliers {
    /// Whether one multiplier sits twice on the unit circle with a single eigenvector, to rounding.
    pub fn is_double_on_circle(&self) -> bool {
        self.kind == PairKind::Double { defective: true }
            && self.growth.abs() <= 64.0 * f64::EPSILON.sqrt()
    }
}

/// `√(1 + x) − 1` without cancellation.
fn root_excess(x: f64) -> f64 {
    x / (1.0 + (1.0 + x).max(0.0).sqrt())
}

impl Integrator {
    /// The multipliers for a real `f = FΔt²` and `g = GΔt`.
    ///
    /// ```
    /// use courant_analysis::scheme::integrator::{Integrator, PairKind};
    /// // Leapfrog at ωΔt = 2: −1 twice, one eigenvector: the amplitude grows linearly.
    /// let edge = Integrator::LeapfrogKdk.multipliers(-4.0, 0.0);
    /// assert_eq!(edge.forward.re, -1.0);
    /// assert_eq!(edge.kind, PairKind::Double { defective: true });
    /// ```
    pub fn multipliers(self, f: f64, g: f64) -> Multipliers {
        let [excess_trace, difference, loss] = &self.polynomials().compiled;
        let (e, d, loss) = (excess_trace.at(f, g), difference.at(f, g), loss.at(f, g));
        // y² − e y + d = 0 for y = z − 1.
        let discriminant = 0.25 * e * e - d;
        let rounding = 8.0 * f64::EPSILON * (0.25 * e * e + d.abs());
        if discriminant.abs() <= rounding {
            let z = Complex64::from(1.0 + 0.5 * e);
            let [[a, b], [c, d]] = self.matrix(&f, &g);
            let defective = b != 0.0 || c != 0.0 || a != d;
            let growth = if z.re >= 0.0 { 0.5 * e } else { -2.0 - 0.5 * e };
            return Multipliers {
                forward: z,
                backward: z,
                kind: PairKind::Double { defective },
                growth,
            };
        }
        if discriminant < 0.0 {
            let forward = Complex64::new(1.0 + 0.5 * e, -(-discriminant).sqrt());
            return Multipliers {
                forward,
                backward: forward.conj(),
                kind: PairKind::Oscillating,
                growth: root_excess(-loss),
            };
        }
        let far = 0.5 * e + discriminant.sqrt().copysign(e);
        let near = if far == 0.0 { 0.0 } else { d / far };
        // |1 + y| − 1 is y, or −2 − y on the negative side.
        let excess = |y: f64| if y >= -1.0 { y } else { -2.0 - y };
        let (first, second) = if excess(near) >= excess(far) { (near, far) } else { (far, near) };
        Multipliers {
            forward: (1.0 + first).into(),
            backward: (1.0 + second).into(),
            kind: PairKind::Real,
            growth: excess(first),
        }
    }

    /// The multipliers for a complex `g`, which only the relation printed for Godunov particle
    /// hydrodynamics has. `forward` is the one nearer to `expected`.
    pub fn complex_multipliers(self, f: f64, g: Complex64, expected: Complex64) -> Multipliers {
        let [excess_trace, difference, _] = &self.polynomials().compiled;
        let f = Complex64::from(f);
        let (e, d) = (excess_trace.at(f, g), difference.at(f, g));
        let root = (e * e * 0.25 - d).sqrt();
        let middle = e * 0.5;
        let far = if (middle.conj() * root).re >= 0.0 { middle + root } else { middle - root };
        let near = if far == Complex64::ZERO { far } else { d / far };
        let nearer = |y: Complex64| (y + 1.0 - expected).norm();
        let (first, second) = if nearer(near) <= nearer(far) { (near, far) } else { (far, near) };
        // |1 + y|² − 1 = 2 Re y + |y|².
        let growth = |y: Complex64| root_excess(2.0 * y.re + y.norm_sqr());
        let double = (near - far).norm_sqr() <= 8.0 * f64::EPSILON * (e.norm_sqr() + d.norm());
        Multipliers {
            forward: first + 1.0,
            backward: second + 1.0,
            kind: if double {
                PairKind::Double {
                    defective: f != Complex64::ZERO || g != Complex64::ZERO || near == far,
                }
            } else {
                PairKind::Oscillating
            },
            growth: growth(first).max(growth(second)),
        }
    }
}
