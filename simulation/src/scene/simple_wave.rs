//! A smooth periodic sound wave of finite amplitude, before it breaks.

use super::{Scene, conserved_density, mean_state};
use crate::boundary::Boundary;
use crate::riemann::{IdealGas, State};
use std::f64::consts::TAU;

/// The plain numbers of a [`SimpleWave`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveData {
    /// The part `A` by which the density differs from its mean: `ρ = 1 + A sin 2πx`.
    pub amplitude: f64,
    /// The ratio of specific heats.
    pub gamma: f64,
    /// When to compare.
    pub end_time: f64,
    /// The customary number of particles or cells.
    pub particles: usize,
}

/// Why numbers are not a smooth wave.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum InvalidWave {
    /// The heat ratio is not one.
    #[error(transparent)]
    Gas(#[from] crate::riemann::InvalidState),
    /// The amplitude is not between 0 and 1.
    #[error("amplitude = {0}: a number above 0 and below 1 is needed")]
    Amplitude(f64),
    /// The wave breaks before the end, or the end is not after the start.
    #[error(
        "end time = {end_time}: a number above 0 and below {breaking} is needed, when the wave may break"
    )]
    EndTime {
        /// What was asked for.
        end_time: f64,
        /// A time before which the wave surely does not break.
        breaking: f64,
    },
    /// Too few particles.
    #[error("particles = {0}: at least 10 are needed")]
    Particles(usize),
}

/// A simple wave that runs to the right on the periodic unit interval: `ρ = 1 + A sin 2πx`,
/// `p = ρ^γ/γ` (so that `c = 1` where `ρ = 1`), `v = 2(c − 1)/(γ − 1)`.
///
/// Each value travels with its own `v + c` until two meet, so the exact nonlinear solution is
/// the root of one equation: the reference for orders of accuracy.
///
/// ```
/// use courant_simulation::scene::{Scene, SimpleWave, WaveData};
/// let wave = SimpleWave::new(WaveData { amplitude: 0.1, gamma: 1.4, end_time: 0.5, particles: 100 })?;
/// // The point of mean density travels at the speed of sound.
/// assert!((wave.exact(0.7, 0.7).density() - 1.0).abs() < 1e-12);
/// # Ok::<(), courant_simulation::scene::InvalidWave>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimpleWave {
    data: WaveData,
    gas: IdealGas,
}

impl SimpleWave {
    /// A wave from its numbers.
    ///
    /// # Errors
    /// [`InvalidWave`] names the first number that does not make sense.
    pub fn new(data: WaveData) -> Result<Self, InvalidWave> {
        let gas = IdealGas::new(data.gamma)?;
        if !(data.amplitude > 0.0 && data.amplitude < 1.0) {
            return Err(InvalidWave::Amplitude(data.amplitude));
        }
        // −d(v + c)/dx = (γ+1)/2 c |ρ'|/ρ, at most this with each factor at its worst.
        let crest = (1.0 + data.amplitude).powf(0.5 * (data.gamma - 1.0));
        let steepest =
            0.5 * (data.gamma + 1.0) * crest * TAU * data.amplitude / (1.0 - data.amplitude);
        let breaking = steepest.recip();
        if !(data.end_time > 0.0 && data.end_time < breaking) {
            return Err(InvalidWave::EndTime { end_time: data.end_time, breaking });
        }
        if data.particles < 10 {
            return Err(InvalidWave::Particles(data.particles));
        }
        Ok(Self { data, gas })
    }

    /// The initial state at `x`.
    fn initial(&self, x: f64) -> State {
        let gamma = self.data.gamma;
        let density = 1.0 + self.data.amplitude * (TAU * x).sin();
        let sound = density.powf(0.5 * (gamma - 1.0));
        State::trusted(density, 2.0 / (gamma - 1.0) * (sound - 1.0), density.powf(gamma) / gamma)
    }

    /// `v + c` of the initial state at `x`.
    fn speed(&self, x: f64) -> f64 {
        let state = self.initial(x);
        state.velocity() + self.gas.sound_speed(state.density(), state.pressure())
    }
}

/// The root of a growing function between `low` and `high`, to the last bit.
fn root(mut low: f64, mut high: f64, growing: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        // Also where a bound is no number: that must not loop.
        if middle <= low || middle >= high || middle.is_nan() {
            return middle;
        }
        if growing(middle) < 0.0 { low = middle } else { high = middle }
    }
}

impl Scene for SimpleWave {
    fn name(&self) -> &str {
        "simple-wave"
    }

    fn source(&self) -> &str {
        "Courant & Friedrichs 1948, simple waves"
    }

    fn gas(&self) -> IdealGas {
        self.gas
    }

    fn domain(&self) -> [f64; 2] {
        [0.0, 1.0]
    }

    fn boundary(&self) -> Boundary {
        Boundary::Periodic
    }

    fn end_time(&self) -> f64 {
        self.data.end_time
    }

    fn particles(&self) -> usize {
        self.data.particles
    }

    fn mass(&self) -> f64 {
        1.0
    }

    fn position_at_mass(&self, mass: f64) -> f64 {
        // ∫ρ = x + A (1 − cos 2πx)/2π = x + A sin²(πx)/π
        let amplitude = self.data.amplitude;
        let before = |x: f64| {
            let sine = (0.5 * TAU * x).sin();
            x + amplitude * sine * sine / (0.5 * TAU)
        };
        root(0.0, 1.0, |x| before(x) - mass)
    }

    /// By the five-point rule of Gauss, whose error is of the tenth order in the width.
    fn average(&self, from: f64, to: f64) -> State {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut mean = [0.0; 3];
        for (node, weight) in [
            (0.0, 128.0 / 225.0),
            (GAUSS_NODES[0], GAUSS_WEIGHTS[0]),
            (-GAUSS_NODES[0], GAUSS_WEIGHTS[0]),
            (GAUSS_NODES[1], GAUSS_WEIGHTS[1]),
            (-GAUSS_NODES[1], GAUSS_WEIGHTS[1]),
        ] {
            let value = conserved_density(self.gas, &self.initial(middle + node * half));
            for (sum, part) in mean.iter_mut().zip(value) {
                *sum += 0.5 * weight * part;
            }
        }
        mean_state(self.gas, mean)
    }

    fn exact(&self, x: f64, time: f64) -> State {
        // All speeds are within 1 ± 3 for amplitudes below 1 and γ < 3; a wider bracket costs nothing.
        let reach = 1.0 + 100.0 * time;
        self.initial(root(x - reach, x + reach, |from| from + time * self.speed(from) - x))
    }
}

/// `√(5 ∓ 2√(10/7))/3`.
const GAUSS_NODES: [f64; 2] = [0.538_469_310_105_683, 0.906_179_845_938_664];
/// `(322 ± 13√70)/900`.
const GAUSS_WEIGHTS: [f64; 2] = [0.478_628_670_499_366_5, 0.236_926_885_056_189_1];
