//! Dispersion relations against running particles: the step of every particle method, mode by mode.
//!
//! The prediction is the multipliers of the method's equations completed by the integrator. The
//! measurement is the step of [`courant_simulation::particles`] on a ring, differentiated by finite differences, or a
//! wave of small amplitude followed for many steps. The two share the kernel's shape and nothing else.

use crate::number::significant;
use courant_analysis::exact::rational::{Rational, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{Integrator, LatticeMethod, SchemeError};
use courant_analysis::waves::multipliers::CompiledStep;
use courant_simulation::particles::{
    ActsOn, Amplification, IsothermalGas, MethodOptions, NotExplicit, Nystrom, PairLoops,
    ParticleMethod, Ring, SmoothingKernel, SolverChoice, Viscosity, table,
};
use courant_simulation::run::Reason;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Agreement asked for. Differences are good to 1e-9 by the choice of step; the rest is room.
pub const TOLERANCE: f64 = 1e-6;

/// Rounding of a position on the ring: half a unit in the last place of 16 to 32 spacings.
const ROUNDING: f64 = 2e-15;

/// Amplitude of the finite differences, in spacings and sound speeds, where a step multiplies waves by `gain` at
/// most. At a knot of the kernel the third derivative jumps and leaves an error of first order in the size, which
/// [`amplification`] removes; the second order is 1e-12, rounding 1e-16 over the size. A large gain takes the
/// particles `gain · size` from the lattice: relative to the gain the error is `(gain · size)²` from there and
/// `ROUNDING/size`, least where `size³ = ROUNDING/(2 gain²)`.
fn size(gain: f64) -> f64 {
    (0.5 * ROUNDING / (gain * gain)).cbrt().min(1e-6)
}

/// Agreement asked for where a step multiplies waves by `gain` at most, relative to it: [`TOLERANCE`], or ten times
/// the error that the size of the displacement leaves where that is more, from a gain of about 6000 on.
pub fn tolerance(gain: f64) -> f64 {
    let size = size(gain);
    TOLERANCE.max(10.0 * ((gain * size).powi(2) + ROUNDING / size))
}

/// Why nothing can be compared.
#[derive(Debug, thiserror::Error)]
pub enum ParticleValidationError {
    /// The equations have no waves of positions and velocities.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
    /// Particles are not stepped so.
    #[error(transparent)]
    Integrator(#[from] NotExplicit),
    /// The kernel jumps at a lattice point, where a running code has no derivative.
    #[error(
        "{kernel} at ratio {ratio}: a lattice point stands on the cut at 3h, where the kernel jumps; take another ratio"
    )]
    OnTheCut {
        /// The kernel.
        kernel: Kernel,
        /// `h/Δ`.
        ratio: f64,
    },
    /// The ring is so short that a particle meets an image of its neighbour, or itself.
    #[error("{particles} particles: a ring for this kernel and ratio needs at least {least}")]
    ShortRing {
        /// The particles asked for.
        particles: usize,
        /// The fewest.
        least: usize,
    },
    /// A step failed.
    #[error("a step of the ring failed: {0}")]
    Step(Reason),
}

/// What to compare.
#[derive(Debug, Clone)]
pub struct ParticleCase {
    /// The equations that predict, on their lattice.
    pub method: LatticeMethod,
    /// The integrator of the run.
    pub integrator: &'static Integrator,
    /// `c Δt/h`.
    pub courant: f64,
    /// Particles on the ring.
    pub particles: usize,
}

/// One mode of one running method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParticleModeRow {
    /// The method that ran.
    pub code: ParticleMethod,
    /// The number of waves on the ring.
    pub mode: usize,
    /// `φ`, radians per spacing.
    pub phase: f64,
    /// The two factors of a step by the dispersion relation, the forward wave first.
    pub predicted: [Complex64; 2],
    /// The two factors of the running step, in the order that fits best.
    pub measured: [Complex64; 2],
    /// See [`pair_error`].
    pub error: f64,
}

/// One wave followed for many steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FollowedWave {
    /// The method that ran.
    pub code: ParticleMethod,
    /// The number of waves on the ring.
    pub mode: usize,
    /// `φ`, radians per spacing.
    pub phase: f64,
    /// The frequency of the stepped wave by the dispersion relation, in `c/Δ`.
    pub predicted: Complex64,
    /// The frequency that the run shows.
    pub measured: Complex64,
    /// How many steps were taken.
    pub steps: usize,
}

impl FollowedWave {
    /// `|ω − ω'|` in `c/Δ`.
    pub fn error(&self) -> f64 {
        (self.predicted - self.measured).norm()
    }
}

/// The running methods that equations speak of. Case 4 has no closed relation.
pub fn codes(method: &LatticeMethod) -> &'static [ParticleMethod] {
    match method.file().name.as_str() {
        "sph" | "sph-av" => &[ParticleMethod::Sph1, ParticleMethod::Sph2],
        "gph" => &[ParticleMethod::Gph1, ParticleMethod::Gph2, ParticleMethod::Gph3],
        _ => &[],
    }
}

/// The eigenvalues of a matrix of that trace and determinant.
fn roots(trace: Complex64, determinant: Complex64) -> [Complex64; 2] {
    let root = (trace * trace - 4.0 * determinant).sqrt();
    [0.5 * (trace + root), 0.5 * (trace - root)]
}

fn factors([[a, b], [c, d]]: Amplification) -> [Complex64; 2] {
    roots(a + d, a * d - b * c)
}

/// The largest factor, at least 1: what rounding is relative to.
pub fn gain(factors: [Complex64; 2]) -> f64 {
    factors[0].norm().max(factors[1].norm()).max(1.0)
}

/// The larger distance of the two factors from their predictions, paired as fits best, which is also how the
/// measured ones come back; over the largest predicted `|z|` where that is above 1, since the entries of the
/// measured matrix are good to that.
///
/// Where the two factors nearly coincide, a change `ε` of the matrix moves them by `√ε`. Within 1e-3 of each
/// other their distance is therefore weighed with their split, so that it falls with `ε` again.
pub fn pair_error(predicted: [Complex64; 2], measured: [Complex64; 2]) -> ([Complex64; 2], f64) {
    const CLOSE: f64 = 1e-3;
    let size = gain(predicted);
    let distance = |pair: [Complex64; 2]| {
        (pair[0] - predicted[0]).norm().max((pair[1] - predicted[1]).norm()) / size
    };
    let swapped = [measured[1], measured[0]];
    let (direct, crossed) = (distance(measured), distance(swapped));
    let (pair, error) = if crossed < direct { (swapped, crossed) } else { (measured, direct) };
    let split = (predicted[0] - predicted[1]).norm() / size;
    (pair, error * (error.max(split) / CLOSE).min(1.0))
}

/// The pair force of a running method, as the linear analysis has it: both directions, no quadratic term, no softening.
fn force(ring: &Ring, code: ParticleMethod, method: &LatticeMethod) -> Box<dyn PairLoops<1>> {
    let alpha = method.value("alpha").map_or(0.0, to_f64);
    let viscosity = Viscosity { alpha, beta: 0.0, acts_on: ActsOn::All, softening: 0.0 };
    let solver = SolverChoice::Exact;
    ring.force(&MethodOptions { viscosity, solver, ..MethodOptions::new(code) })
}

impl ParticleCase {
    /// "GPH, cubic B-spline, h/Δ = 1.2, rk4, c Δt/h = 0.3".
    pub fn title(&self) -> String {
        format!(
            "{}, {}, h/Δ = {}, {}, c Δt/h = {}",
            self.method.title(),
            self.method.kernel().title(),
            significant(to_f64(self.method.ratio()), 4),
            self.integrator.name,
            significant(self.courant, 4)
        )
    }

    fn prepare(&self) -> Result<Prepared, ParticleValidationError> {
        let (kernel, exact, particles) =
            (self.method.kernel(), self.method.ratio(), self.particles);
        let ratio = to_f64(exact);
        let reach = exact * Rational::from_integer(3.into());
        if kernel == Kernel::Gaussian && reach.is_integer() {
            return Err(ParticleValidationError::OnTheCut { kernel, ratio });
        }
        let least = 2 * (kernel.support() * ratio).ceil() as usize + 2;
        if particles < least {
            return Err(ParticleValidationError::ShortRing { particles, least });
        }
        let (gas, smoothing) = (IsothermalGas { sound_speed: 1.0 }, ratio);
        let kernel = SmoothingKernel::new(kernel);
        Ok(Prepared {
            predicted: self.method.step(self.integrator)?.compile()?,
            table: table(self.integrator)?,
            step: self.courant * ratio,
            ring: Ring { particles, spacing: 1.0, mass: 1.0, gas, kernel, smoothing },
        })
    }

    /// What one step multiplies the two waves of a mode by.
    fn predicted(&self, step: &CompiledStep, mode: usize) -> [Complex64; 2] {
        let found = step.multipliers(&[self.courant], &[self.phase(mode)]);
        [found[0], found[1]]
    }

    fn phase(&self, mode: usize) -> f64 {
        TAU * mode as f64 / self.particles as f64
    }
}

/// What a case compares.
struct Prepared {
    predicted: CompiledStep,
    table: Nystrom<f64>,
    ring: Ring,
    /// `c Δt/Δ`.
    step: f64,
}

impl Prepared {
    /// The matrix of a mode: `2A(s) − A(2s)` has no error of first order in the size `s`.
    fn linearise(
        &self,
        force: &dyn PairLoops<1>,
        mode: usize,
        size: f64,
    ) -> Result<Amplification, Reason> {
        let at = |size| self.ring.amplification(force, &self.table, self.step, mode, size);
        let (fine, coarse) = (at(size)?, at(2.0 * size)?);
        Ok([0, 1].map(|row| [0, 1].map(|column| 2.0 * fine[row][column] - coarse[row][column])))
    }

    /// `ln z` of a wave started with `V/X = velocity`, the mean over the steps, its imaginary part followed through every turn.
    fn follow(
        &self,
        force: &dyn PairLoops<1>,
        mode: usize,
        steps: usize,
        velocity: Complex64,
    ) -> Result<Complex64, Reason> {
        let count = self.ring.particles;
        let angle = |j: usize| TAU * ((mode * j) % count) as f64 / count as f64;
        let lattice = self.ring.lattice();
        let amplitude = 0.1 * size(1.0);
        let mut x: Vec<f64> = (0..count).map(|j| lattice[j] + amplitude * angle(j).cos()).collect();
        let mut v: Vec<f64> =
            (0..count).map(|j| amplitude * (velocity * Complex64::cis(angle(j))).re).collect();
        let wave = |x: &[f64]| -> Complex64 {
            (0..count).map(|j| (x[j] - lattice[j]) * Complex64::cis(-angle(j))).sum()
        };
        let start = wave(&x);
        let (mut last, mut turned) = (start, 0.0);
        for _ in 0..steps {
            (x, v) = self.ring.step(force, &self.table, self.step, &x, &v)?;
            let now = wave(&x);
            turned += (now / last).arg();
            last = now;
        }
        let growth = (last.norm() / start.norm()).ln();
        Ok(Complex64::new(growth, turned) / steps as f64)
    }
}

/// Compares the step of every running method with the relation, for all modes up to the shortest wave.
///
/// ```
/// use courant_analysis::scheme::{Integrator, LatticeMethod, catalogue};
/// use courant_analysis::{kernel::Kernel, exact::rational::ratio};
/// use courant_reports::cha_whitworth2003::published;
/// use courant_reports::particle_validation::{ParticleCase, validate_particles};
/// let worst = |equations| -> f64 {
///     let method = LatticeMethod::new(equations, Kernel::CubicSpline, &ratio(6, 5)).unwrap();
///     let integrator = Integrator::named("euler").unwrap();
///     let case = ParticleCase { method, integrator, courant: 0.2, particles: 16 };
///     let rows = validate_particles(&case).expect("a smooth state");
///     rows.iter().map(|row| row.error).fold(0.0, f64::max)
/// };
/// assert!(worst(catalogue::method("gph").unwrap()) < 1e-6);
/// assert!(worst(published::equations()) > 0.1);
/// ```
///
/// # Errors
/// [`ParticleValidationError`].
pub fn validate_particles(
    case: &ParticleCase,
) -> Result<Vec<ParticleModeRow>, ParticleValidationError> {
    let running = case.prepare()?;
    let mut rows = Vec::new();
    for &code in codes(&case.method) {
        let force = force(&running.ring, code, &case.method);
        for mode in 1..=case.particles / 2 {
            let phase = case.phase(mode);
            let predicted = case.predicted(&running.predicted, mode);
            let matrix = running.linearise(&*force, mode, size(gain(predicted)));
            let matrix = matrix.map_err(ParticleValidationError::Step)?;
            let (measured, error) = pair_error(predicted, factors(matrix));
            rows.push(ParticleModeRow { code, mode, phase, predicted, measured, error });
        }
    }
    Ok(rows)
}

/// Starts the forward wave of a mode with an amplitude of 1e-7 spacings and measures the frequency and the damping
/// that the run shows over `steps` steps.
///
/// The shortest wave of an even ring stands and is no travelling wave: `mode` must be below half of the particles.
///
/// # Errors
/// [`ParticleValidationError`].
pub fn follow_wave(
    case: &ParticleCase,
    code: ParticleMethod,
    mode: usize,
    steps: usize,
) -> Result<FollowedWave, ParticleValidationError> {
    let running = case.prepare()?;
    let force = force(&running.ring, code, &case.method);
    let expected = case.predicted(&running.predicted, mode);
    // The eigenvector of the running step: what is measured owes the relation nothing but the choice of the wave.
    let matrix = running.linearise(&*force, mode, size(gain(expected)));
    let matrix = matrix.map_err(ParticleValidationError::Step)?;
    let ([started, _], _) = pair_error(expected, factors(matrix));
    let [[a, b], _] = matrix;
    let velocity = (started - a) / b;
    let logarithm = running.follow(&*force, mode, steps, velocity);
    let logarithm = logarithm.map_err(ParticleValidationError::Step)?;
    // z = e^{−iωΔt}.
    let frequency = |logarithm: Complex64| Complex64::I * logarithm / running.step;
    Ok(FollowedWave {
        code,
        mode,
        phase: case.phase(mode),
        predicted: frequency(expected[0].ln()),
        measured: frequency(logarithm),
        steps,
    })
}
