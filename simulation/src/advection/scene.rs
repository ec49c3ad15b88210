//! Initial data on the periodic unit interval, and their exact solutions.

use super::random::SplitMix64;
use std::f64::consts::TAU;

/// One wave `amplitude · cos(2π wave_number ξ + phase)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Waves in the period.
    pub wave_number: usize,
    /// The amplitude.
    pub amplitude: f64,
    /// The phase at `ξ = 0`, in radians.
    pub phase: f64,
}

/// What is advected with speed 1 around `[0, 1)`.
#[derive(Debug, Clone, PartialEq)]
pub enum Scene {
    /// 1 up to `ξ = 1/2`, 1/4 beyond: Ferrari et al. 2008 (2.28).
    Step,
    /// `1/4 + exp(−8 (4(ξ − 1/2))²)`: Ferrari et al. 2008 (2.29). Its periodic continuation has a kink of
    /// slope `1e-12` at `ξ = 0`, far below any error here.
    Gaussian,
    /// 1 on `[1/4, 3/4)`, 0 elsewhere.
    SquareWave,
    /// A sum of waves: one mode, all of them, random phases.
    Harmonics(Vec<Harmonic>),
}

/// A name that is no scene's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no advection scene `{0}`")]
pub struct UnknownScene(pub String);

impl Scene {
    /// The scenes that need no parameters.
    pub const NAMED: [Self; 3] = [Self::Step, Self::Gaussian, Self::SquareWave];

    /// `cos 2πmξ`.
    pub fn mode(wave_number: usize) -> Self {
        Self::Harmonics(vec![Harmonic { wave_number, amplitude: 1.0, phase: 0.0 }])
    }

    /// Waves `1, …, highest`, all of amplitude 1 and phase 0: the band-limited spike.
    pub fn all_modes(highest: usize) -> Self {
        let wave = |wave_number| Harmonic { wave_number, amplitude: 1.0, phase: 0.0 };
        Self::Harmonics((1..=highest).map(wave).collect())
    }

    /// Waves `1, …, highest` of amplitude 1 with phases drawn from a seed: noise with a known spectrum.
    pub fn random_phases(highest: usize, seed: u64) -> Self {
        let mut random = SplitMix64::new(seed);
        let wave = |wave_number| {
            let phase = TAU * random.unit();
            Harmonic { wave_number, amplitude: 1.0, phase }
        };
        Self::Harmonics((1..=highest).map(wave).collect())
    }

    /// The name used on the command line and in files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Step => "advection-step",
            Self::Gaussian => "advection-gaussian",
            Self::SquareWave => "advection-square",
            Self::Harmonics(_) => "advection-waves",
        }
    }

    /// Where the scene comes from.
    pub fn source(&self) -> &'static str {
        match self {
            Self::Step => "Ferrari et al. 2008 (2.28)",
            Self::Gaussian => "Ferrari et al. 2008 (2.29)",
            Self::SquareWave | Self::Harmonics(_) => "standard test data",
        }
    }

    /// The data at a position, continued with period 1.
    pub fn initial(&self, position: f64) -> f64 {
        let x = position - position.floor();
        match self {
            // The period starts on the high side of the second jump: (2.28) gives 1 at ξ = 0.
            Self::Step => {
                if x <= 0.5 {
                    1.0
                } else {
                    0.25
                }
            }
            Self::Gaussian => {
                let distance = 4.0 * (x - 0.5);
                0.25 + (-8.0 * distance * distance).exp()
            }
            Self::SquareWave => f64::from(u8::from((0.25..0.75).contains(&x))),
            Self::Harmonics(waves) => waves
                .iter()
                .map(|wave| {
                    // Whole turns are dropped before the cosine, which would lose them to rounding.
                    let turns = wave.wave_number as f64 * x;
                    wave.amplitude * (TAU * (turns - turns.floor()) + wave.phase).cos()
                })
                .sum(),
        }
    }

    /// The exact solution `u_0(ξ − t)` of `u_t + u_ξ = 0`. Within rounding of a jump the side is open.
    pub fn exact(&self, position: f64, time: f64) -> f64 {
        self.initial(position - time)
    }
}

impl std::str::FromStr for Scene {
    type Err = UnknownScene;
    fn from_str(text: &str) -> Result<Self, UnknownScene> {
        let wanted = text.trim().to_ascii_lowercase();
        Self::NAMED
            .into_iter()
            .find(|scene| scene.name() == wanted)
            .ok_or_else(|| UnknownScene(text.into()))
    }
}
