//! A quantity along the line at the start of a scene.

use crate::advection::SplitMix64;
use serde::Deserialize;
use std::f64::consts::TAU;

/// A value, or how a value runs along the line.
///
/// ```
/// use courant_simulation::scene::Quantity;
/// let wave = Quantity::Sine { mean: 1.0, amplitude: 0.2, wave_number: 5.0, phase: 0.0 };
/// assert_eq!(wave.at(0.0), 1.0);
/// // ∫ from 0 to π/5 is π/5 + 0.2·2/5.
/// let end = std::f64::consts::PI / 5.0;
/// assert!((wave.integral(0.0, end) - (end + 0.08)).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum Quantity {
    /// The same everywhere.
    Constant(f64),
    /// `mean + amplitude·sin(wave_number·x + phase)`.
    Sine {
        /// The mean.
        mean: f64,
        /// The amplitude.
        amplitude: f64,
        /// Radians per length.
        wave_number: f64,
        /// Radians at `x = 0`.
        #[serde(default)]
        phase: f64,
    },
    /// `mean + amplitude·exp(−((x − centre)/width)²)`.
    Pulse {
        /// Far from the pulse.
        mean: f64,
        /// What the pulse adds at its centre.
        amplitude: f64,
        /// Where that is.
        centre: f64,
        /// The distance at which it has fallen to 1/e.
        width: f64,
    },
    /// `mean + amplitude Σ cos(2πmx/period + φ_m)`, `m = 1, …, waves`: noise with a known spectrum.
    Noise {
        /// The mean.
        #[serde(default)]
        mean: f64,
        /// The amplitude of each wave.
        #[serde(default = "one")]
        amplitude: f64,
        /// How many waves there are.
        waves: usize,
        /// Where the random phases `φ_m` come from.
        #[serde(default)]
        seed: u64,
        /// The length of the longest.
        #[serde(default = "one")]
        period: f64,
    },
    /// Straight lines through `[x, value]`, ascending in `x`; constant beyond the first and the last.
    Points {
        /// The points.
        points: Vec<[f64; 2]>,
    },
}

fn one() -> f64 {
    1.0
}

/// Wave numbers and phases of a noise.
fn waves(count: usize, seed: u64, period: f64) -> impl Iterator<Item = (f64, f64)> {
    let mut random = SplitMix64::new(seed);
    (1..=count).map(move |m| (TAU * m as f64 / period, TAU * random.unit()))
}

/// What a quantity may be, for messages.
pub(super) const ACCEPTED: &str = "a number, { mean, amplitude, wave_number, phase } for a sine, \
     { mean, amplitude, centre, width } for a pulse, { waves, seed, period, mean, amplitude } for a noise, or { points = [[x, value], ...] }";

/// Nodes and weights of Gauss's rule of five points on `[−1, 1]`: `√(5 ∓ 2√(10/7))/3`, `(322 ± 13√70)/900`.
pub(super) const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683, 0.478_628_670_499_366_5),
    (0.0, 128.0 / 225.0),
    (0.538_469_310_105_683, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

impl Quantity {
    /// The value everywhere, if it is one.
    pub fn constant(&self) -> Option<f64> {
        match self {
            Self::Constant(value) => Some(*value),
            _ => None,
        }
    }

    /// The value at a place.
    pub fn at(&self, x: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Sine { mean, amplitude, wave_number, phase } => {
                mean + amplitude * (wave_number * x + phase).sin()
            }
            Self::Pulse { mean, amplitude, centre, width } => {
                let scaled = (x - centre) / width;
                mean + amplitude * (-scaled * scaled).exp()
            }
            Self::Noise { mean, amplitude, waves: count, seed, period } => {
                let all = waves(*count, *seed, *period);
                mean + amplitude * all.map(|(k, phase)| (k * x + phase).cos()).sum::<f64>()
            }
            Self::Points { points } => {
                let after = points.partition_point(|point| point[0] <= x);
                match (after.checked_sub(1).map(|i| points[i]), points.get(after).copied()) {
                    (Some([a, u]), Some([b, v])) => u + (v - u) * (x - a) / (b - a),
                    (Some([_, value]), None) | (None, Some([_, value])) => value,
                    (None, None) => f64::NAN,
                }
            }
        }
    }

    /// `∫` from one place to another.
    pub fn integral(&self, from: f64, to: f64) -> f64 {
        match self {
            Self::Constant(value) => value * (to - from),
            Self::Sine { mean, amplitude, wave_number, phase } => {
                // cos a − cos b as a product: small where the interval is.
                let (a, b) = (wave_number * from + phase, wave_number * to + phase);
                let change = 2.0 * (0.5 * (a + b)).sin() * (0.5 * (b - a)).sin();
                mean * (to - from) + amplitude * change / wave_number
            }
            Self::Noise { mean, amplitude, waves: count, seed, period } => {
                let all = waves(*count, *seed, *period);
                let change = |(k, phase): (f64, f64)| {
                    let (middle, half) = (0.5 * k * (from + to) + phase, 0.5 * k * (to - from));
                    2.0 * middle.cos() * half.sin() / k
                };
                mean * (to - from) + amplitude * all.map(change).sum::<f64>()
            }
            Self::Pulse { width, .. } => self.by_gauss(from, to, 0.25 * width),
            Self::Points { points } => {
                let mut ends = vec![from];
                ends.extend(points.iter().map(|point| point[0]).filter(|x| *x > from && *x < to));
                ends.push(to);
                ends.windows(2)
                    .map(|end| (end[1] - end[0]) * self.at(0.5 * (end[0] + end[1])))
                    .sum()
            }
        }
    }

    /// By Gauss's rule on intervals no longer than `step`, with a bound for their number.
    fn by_gauss(&self, from: f64, to: f64, step: f64) -> f64 {
        let intervals = ((to - from) / step).abs().ceil().clamp(1.0, 1000.0) as usize;
        let half = 0.5 * (to - from) / intervals as f64;
        let middles = (0..intervals).map(|i| from + half * (2 * i + 1) as f64);
        middles
            .flat_map(|middle| GAUSS.map(|(node, weight)| weight * self.at(middle + half * node)))
            .sum::<f64>()
            * half
    }

    /// What is wrong with the numbers, if anything.
    pub(super) fn problem(&self, positive: bool) -> Option<String> {
        let (numbers, least): (Vec<f64>, f64) = match self {
            Self::Constant(value) => (vec![*value], *value),
            Self::Sine { mean, amplitude, wave_number, phase } => {
                if *wave_number == 0.0 {
                    return Some("wave_number = 0: a number other than 0 is needed".into());
                }
                (vec![*mean, *amplitude, *wave_number, *phase], mean - amplitude.abs())
            }
            Self::Pulse { mean, amplitude, centre, width } => {
                if *width <= 0.0 {
                    return Some(format!("width = {width}: a number above 0 is needed"));
                }
                (vec![*mean, *amplitude, *centre, *width], mean.min(mean + amplitude))
            }
            Self::Noise { mean, amplitude, waves, period, .. } => {
                if !(1..=100_000).contains(waves) {
                    return Some(format!(
                        "waves = {waves}: a whole number from 1 to 100000 is needed"
                    ));
                }
                if *period <= 0.0 {
                    return Some(format!("period = {period}: a number above 0 is needed"));
                }
                (vec![*mean, *amplitude, *period], mean - amplitude.abs() * *waves as f64)
            }
            Self::Points { points } => {
                if points.is_empty() || points.windows(2).any(|pair| pair[0][0] >= pair[1][0]) {
                    return Some("points: one or more, ascending in x, are needed".into());
                }
                let least = points.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
                (points.as_flattened().to_vec(), least)
            }
        };
        if let Some(bad) = numbers.iter().find(|number| !number.is_finite()) {
            return Some(format!("{bad}: finite numbers are needed"));
        }
        (positive && least < 0.0)
            .then(|| format!("{least}: a finite number, not negative, is needed"))
    }
}
