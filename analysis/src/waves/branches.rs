//! The multipliers of a scheme as branches: each followed from long waves on, the physical ones found by the exact step.

use super::exact_wave::ExactWave;
use super::wave_terms::{difference_terms, primitive_characteristic};
use super::{CompiledStep, follow::Follower};
use crate::exact::laurent::{Variable, greatest_common_divisor};
use crate::scheme::{Integrator, Lines, SchemeError, Step};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Where branches begin: waves so long that they do what the equation says.
pub(super) const LONG: f64 = 1e-4;

/// A multiplier of this size is a rounding error.
const NOTHING: f64 = 1e-13;

/// A scheme with values for all its parameters, ready to be followed wave by wave, with what its equation does to them.
///
/// ```
/// use courant_analysis::exact::rational::ratio;
/// use courant_analysis::scheme::Step;
/// use courant_analysis::waves::branches::Branches;
/// use courant_analysis::waves::exact_wave::ExactWave;
/// use std::f64::consts::PI;
/// let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")?.with("C", &ratio(1, 2))?;
/// let exact = ExactWave::stated("-I*C*phi", &leapfrog)?;
/// let branches = Branches::of_step(&leapfrog, exact)?.along(&[1.0], &[0.5, 3.0, PI]);
/// let (physical, computational) = (&branches[0], &branches[1]);
/// assert_eq!((physical.physical, computational.physical), (Some(0), None));
/// // At the sawtooth the physical branch stands still, and its group travels backwards at the speed of the equation.
/// let sawtooth = &physical.waves[2];
/// assert!(sawtooth.phase_speed().unwrap().abs() < 1e-12);
/// assert!((sawtooth.group_speed().unwrap() + 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Branches {
    pub(super) step: CompiledStep,
    pub(super) exact: Vec<ExactWave>,
    /// Whether `z = 1 + μ` stands for a rate `μ`: time is continuous.
    is_rate: bool,
}

/// One branch at the waves that were asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Which wave of the equation it is at long waves, if any: of two the first travels to the right.
    pub physical: Option<usize>,
    /// In the order that was asked for.
    pub waves: Vec<BranchWave>,
}

/// What a branch does to one wave, and what the equation does to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchWave {
    /// The modulus of the phase, in radians per cell.
    pub phase: f64,
    /// The multiplier of one step.
    pub multiplier: Complex64,
    /// Its logarithm, the imaginary part continuous along the branch.
    pub exponent: Complex64,
    /// The derivative of that by the modulus of the phase.
    pub slope: Complex64,
    /// The exponent of the equation and its derivative; of a branch that is not physical the first one.
    pub exact: Option<(Complex64, Complex64)>,
}

impl Branches {
    /// Of a scheme that steps, with values for all parameters.
    ///
    /// # Errors
    /// When there is no characteristic polynomial, or a parameter has no value.
    pub fn of_step(step: &Step, exact: Vec<ExactWave>) -> Result<Self, SchemeError> {
        let open = step.free_parameters();
        if !open.is_empty() {
            return Err(SchemeError::NotSet(open));
        }
        // A multiplier that several unknowns share on every wave is one branch.
        let chi = primitive_characteristic(step)?;
        let repeated = greatest_common_divisor(&chi, &chi.derivative(Variable::TIME));
        let chi = match repeated.contains(Variable::TIME) {
            true => chi.divide_exactly(&repeated).expect("a divisor divides"),
            false => chi,
        };
        let step = CompiledStep::new(step, &difference_terms(&chi));
        Ok(Self { step, exact, is_rate: false })
    }

    /// Of equations in space, exact in time: the modified wave number (Lele 1992). Gain and argument are those after the time of one step.
    ///
    /// # Errors
    /// As [`of_step`](Self::of_step).
    pub fn of_lines(lines: &Lines, exact: Vec<ExactWave>) -> Result<Self, SchemeError> {
        Ok(Self { is_rate: true, ..Self::of_step(&rates_as_step(lines)?, exact)? })
    }

    /// The number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.step.dimension()
    }

    /// Whether there is an equation to compare with.
    pub fn has_exact(&self) -> bool {
        !self.exact.is_empty()
    }

    /// All branches on the waves `φ = m d` with a unit vector `d` and moduli `m > 0` that ascend: physical ones first.
    ///
    /// # Panics
    /// When there are not as many components as [dimensions](Self::dimension), or the moduli do not ascend.
    pub fn along(&self, direction: &[f64], moduli: &[f64]) -> Vec<Branch> {
        assert!(moduli.windows(2).all(|pair| pair[0] <= pair[1]), "moduli ascend");
        let start = moduli.first().map_or(LONG, |first| first.min(LONG));
        let roots = self.step.differences(&[], &scaled(direction, start));
        let (roots, physical) = self.physical_first(direction, start, roots);
        let mut arguments: Vec<f64> = roots.iter().map(|y| self.exponent(*y).im).collect();
        let mut branches: Vec<Branch> =
            physical.iter().map(|&physical| Branch { physical, waves: Vec::new() }).collect();
        let mut follower = Follower::new(&self.step, direction, start, roots);
        for &modulus in moduli {
            let turn = |before: Complex64, after: Complex64| match self.is_rate {
                true => (after - before).im,
                false => ((after + 1.0) / (before + 1.0)).arg(),
            };
            let mut last = follower.here().to_vec();
            let roots = follower.to(modulus, |roots| {
                for ((argument, before), after) in arguments.iter_mut().zip(&mut last).zip(roots) {
                    let by = turn(*before, *after);
                    *argument += if by.is_finite() { by } else { 0.0 };
                    *before = *after;
                }
            });
            let phases = scaled(direction, modulus);
            let slopes = self.step.slopes(&[], &phases, direction, &roots);
            for (index, (y, slope)) in roots.into_iter().zip(slopes).enumerate() {
                let branch = &mut branches[index];
                // Seen here only: the follower may have stopped just before.
                let by = turn(last[index], y);
                let near = arguments[index] + if by.is_finite() { by } else { 0.0 };
                let exact = self.exact.get(branch.physical.unwrap_or(0));
                let exact = exact.map(|exact| exact.exponent(direction, modulus));
                branch.waves.push(self.wave(modulus, y, slope, near, exact));
            }
        }
        branches
    }

    /// `λ` of a root: the logarithm of `1 + y`, or the rate itself.
    fn exponent(&self, y: Complex64) -> Complex64 {
        if self.is_rate { y } else { logarithm(y) }
    }

    pub(super) fn wave(
        &self,
        phase: f64,
        y: Complex64,
        slope: Complex64,
        argument: f64,
        exact: Option<(Complex64, Complex64)>,
    ) -> BranchWave {
        let mut exponent = self.exponent(y);
        if self.is_rate {
            return BranchWave { phase, multiplier: y.exp(), exponent, slope, exact };
        }
        if (y + 1.0).norm() < NOTHING {
            // Nothing is left that had an argument.
            exponent.im = f64::NAN;
        }
        exponent.im += TAU * ((argument - exponent.im) / TAU).round();
        BranchWave { phase, multiplier: y + 1.0, exponent, slope: slope / (y + 1.0), exact }
    }

    /// The roots at a long wave, those of the equation first, and which is which.
    fn physical_first(
        &self,
        direction: &[f64],
        modulus: f64,
        mut roots: Vec<Complex64>,
    ) -> (Vec<Complex64>, Vec<Option<usize>>) {
        let mut found = Vec::new();
        for (index, exact) in self.exact.iter().enumerate() {
            let (expected, _) = exact.exponent(direction, modulus);
            let off = |y: &Complex64| (self.exponent(*y) - expected).norm();
            let rest = roots.iter().enumerate().skip(found.len());
            let best = rest.min_by(|(_, a), (_, b)| off(a).total_cmp(&off(b)));
            // What an equation does not do may be wrong by a higher power of the phase.
            let allowed = 0.5 * expected.norm() + modulus.powf(1.5);
            if let Some((place, y)) = best
                && off(y) <= allowed
            {
                roots.swap(place, found.len());
                found.push(Some(index));
            }
        }
        found.resize(roots.len(), None);
        (roots, found)
    }

    /// How long the phase vector becomes along a direction before a component passes the shortest wave.
    pub fn shortest(direction: &[f64]) -> f64 {
        PI / direction.iter().fold(0.0, |most: f64, d| most.max(d.abs()))
    }
}

/// The rates `μ` of equations in space as the multipliers `1 + μ` of one explicit Euler step, so that [differences](CompiledStep::differences)
/// are the rates with all their digits.
fn rates_as_step(lines: &Lines) -> Result<Step, SchemeError> {
    let euler = Integrator::named("forward-euler").expect("it is in the catalogue");
    Step::lines(lines, euler)
}

pub(super) fn scaled(direction: &[f64], modulus: f64) -> Vec<f64> {
    // Rounding does not take the shortest wave beyond π.
    direction.iter().map(|d| (d * modulus).clamp(-PI, PI)).collect()
}

/// `log(1 + y)` with the digits that a small `y` has.
fn logarithm(y: Complex64) -> Complex64 {
    // |1 + y|² = 1 + y_r (2 + y_r) + y_i².
    let gain = 0.5 * (y.re * (2.0 + y.re) + y.im * y.im).ln_1p();
    let whole = y + 1.0;
    Complex64::new(if gain.is_nan() { whole.norm().ln() } else { gain }, whole.arg())
}

impl BranchWave {
    /// `|z|`.
    pub fn gain(&self) -> f64 {
        self.multiplier.norm()
    }

    /// Phase speed over that of the equation, `ω/ω_exact` with `z = |z| e^{−iωΔt}`; `None` where nothing travels or nothing is known of
    /// the equation.
    pub fn phase_speed(&self) -> Option<f64> {
        quotient(self.exponent.im, self.exact?.0.im)
    }

    /// Group speed `dω/dm` along the wave vector over that of the equation.
    pub fn group_speed(&self) -> Option<f64> {
        quotient(self.slope.im, self.exact?.1.im)
    }

    /// What the wave is ahead after it has travelled one wavelength, as a fraction of it: positive where it leads, negative where it lags.
    pub fn phase_error(&self) -> Option<f64> {
        Some(self.phase_speed()? - 1.0)
    }

    /// How fast it decays over how fast it does in the equation, where that is what the equation does.
    pub fn decay_ratio(&self) -> Option<f64> {
        let (exact, _) = self.exact?;
        if exact.im == 0.0 { quotient(self.exponent.re, exact.re) } else { None }
    }
}

fn quotient(a: f64, b: f64) -> Option<f64> {
    Some(a / b).filter(|quotient| b != 0.0 && quotient.is_finite())
}

#[cfg(test)]
mod tests;
