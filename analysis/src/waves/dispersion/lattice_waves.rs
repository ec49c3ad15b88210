//! The waves of positions and velocities on a lattice, exact in time: `x' = v`, `v' = −ω0² x − b v`.

use super::mode::Mode;
use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::laurent::Laurent;
use crate::exact::rational::{Rational, integer, to_f64};
use crate::scheme::{COURANT, LatticeMethod, Lines, SchemeError};
use crate::stability::even_series;
use num_traits::Zero;

/// `ω0²` and `b` of every wave, both over `s = (1 − cos φ)/2`.
///
/// ```
/// use courant_analysis::{exact::rational::ratio, kernel::Kernel};
/// use courant_analysis::scheme::{LatticeMethod, catalogue};
/// let gph = catalogue::method("gph").unwrap();
/// let lattice = LatticeMethod::new(gph, Kernel::CubicSpline, &ratio(6, 5))?;
/// let waves = lattice.waves()?.compile().mode(0.5).frequencies();
/// assert!(waves.forward.re > 0.0 && waves.forward.im < 0.0);   // to the right, and damped
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct LatticeWaves {
    restoring: EnclosedSeries,
    damping: EnclosedSeries,
}

impl LatticeWaves {
    /// Of equations of lines whose parameters all have their values.
    ///
    /// # Errors
    /// When they are not of two unknowns `x[j]' = v[j]` and `v[j]' = …` with forces that vanish for long waves and drags that damp.
    pub fn new(lines: &Lines) -> Result<Self, SchemeError> {
        let found = lines.motion().and_then(|motion| {
            let inertia = Rational::from(motion.inertia.as_constant()?);
            let over_s = |polynomial: &Laurent| {
                if polynomial.is_zero() {
                    return Some(EnclosedSeries::constant(Rational::zero()));
                }
                let (mut series, phase_power, complement_power) =
                    even_series(polynomial, lines.names())?;
                let s = EnclosedSeries::half_versine();
                let complement = EnclosedSeries::constant(integer(1)).plus(&s.scaled(&integer(-1)));
                for _ in 1..phase_power {
                    series = series.times(&s);
                }
                for _ in 0..complement_power {
                    series = series.times(&complement);
                }
                (phase_power > 0).then(|| series.scaled(&-inertia.recip()))
            };
            Some(Self { restoring: over_s(motion.restoring)?, damping: over_s(motion.damping)? })
        });
        found.ok_or_else(|| {
            SchemeError::Integrator(
                "frequencies are found of two equations, x[j]' = v[j] and one for v[j]' with a force that vanishes for long waves"
                    .into(),
            )
        })
    }

    /// `ω0²/s`.
    pub fn restoring(&self) -> &EnclosedSeries {
        &self.restoring
    }

    /// The damping rate over `s`.
    pub fn damping(&self) -> &EnclosedSeries {
        &self.damping
    }

    /// The numeric form.
    pub fn compile(&self) -> CompiledWaves {
        let (mut center, mut complement_power) = (self.restoring.center(), 0);
        if self.restoring.is_exact() {
            // An exact zero of the shortest wave must not become a tiny negative number.
            while let Some(quotient) =
                (!center.is_zero()).then(|| center.divide_by_complement()).flatten()
            {
                center = quotient;
                complement_power += 1;
            }
        }
        let center = center.map(to_f64);
        // Clenshaw's recurrence and the rounding of the coefficients.
        let size: f64 = center.coefficients().iter().map(|value| value.abs()).sum();
        let rounding = 2.0 * f64::EPSILON * (center.coefficients().len() + 2) as f64 * size;
        CompiledWaves {
            restoring: center,
            complement_power,
            rounding,
            damping: self.damping.compile(),
        }
    }
}

impl LatticeMethod {
    /// Its waves, exact in time, in units of the spacing `Δ` and the sound speed `c`.
    ///
    /// # Errors
    /// As [`LatticeWaves::new`].
    pub fn waves(&self) -> Result<LatticeWaves, SchemeError> {
        // One step of c Δt/h = Δ/h is the unit of time.
        LatticeWaves::new(&self.lines()?.with(COURANT, &self.ratio().recip())?)
    }
}

/// [`LatticeWaves`] in `f64`: two Clenshaw sums per phase.
#[derive(Debug, Clone)]
pub struct CompiledWaves {
    restoring: CosineSeries<f64>,
    complement_power: i32,
    rounding: f64,
    damping: CosineSeries<f64>,
}

impl CompiledWaves {
    /// The mode of phase `φ = κΔ`, in radians.
    ///
    /// A restoring force that cannot be told from zero is zero: it then neither oscillates nor grows.
    pub fn mode(&self, phase: f64) -> Mode {
        let cosine = phase.cos();
        let s = (0.5 * phase).sin().powi(2);
        let mut restoring = self.restoring.at_cosine(cosine);
        if restoring.abs() <= self.rounding {
            restoring = 0.0;
        }
        if self.complement_power > 0 {
            // The nearest float to π stands for π: there 1 − s is zero. Beyond, waves are aliases of shorter phases.
            let complement =
                if phase == std::f64::consts::PI { 0.0 } else { (0.5 * phase).cos().powi(2) };
            restoring *= complement.powi(self.complement_power);
        }
        Mode { phase, restoring: s * restoring, damping: s * self.damping.at_cosine(cosine) }
    }

    /// How many terms the series have together: the work of one phase.
    pub fn terms(&self) -> usize {
        self.restoring.coefficients().len() + self.damping.coefficients().len()
    }

    /// The damping rate of every mode multiplied by `factor`: a viscosity swept without new sums.
    #[must_use]
    pub fn with_damping_scaled(mut self, factor: f64) -> Self {
        self.damping = self.damping.map(|value| value * factor);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use crate::kernel::{Density, Kernel, LatticeSums};
    use crate::scheme::catalogue;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn method(name: &str, kernel: Kernel, ratio: &Rational) -> LatticeMethod {
        LatticeMethod::new(catalogue::method(name).unwrap(), kernel, ratio).unwrap()
    }

    proptest! {
        /// From the text by matrices and letters, and from the four lattice sums of the paper.
        #[test]
        fn text_and_sums_agree(
            hundredths in 60i64..400, phase in 0.0f64..6.3, pressure in -3i64..9, summed: bool
        ) {
            let ratio = ratio(hundredths, 100);
            let density = if summed { Density::Summation } else { Density::MassPerSpacing };
            let pressure = Rational::new(pressure.into(), 4.into());
            for kernel in Kernel::ALL {
                let sums = LatticeSums::new(kernel, &ratio, density).unwrap().compile().at(phase);
                let doubled = 2.0 * to_f64(&pressure);
                let restoring = doubled * sums.curvature + (1.0 - doubled) * sums.gradient.powi(2);
                for (name, damping) in [
                    ("sph", 0.0),
                    ("sph-av", 0.5 * to_f64(&ratio) * sums.slope_per_distance),
                    ("gph", sums.slope),
                ] {
                    let mut lattice =
                        method(name, kernel, &ratio).with_density(density).with("P", &pressure);
                    if name == "sph-av" {
                        lattice = lattice.with("alpha", &Rational::new(1.into(), 2.into()));
                    }
                    let mode = lattice.waves().unwrap().compile().mode(phase);
                    prop_assert!((mode.restoring - restoring).abs() < 1e-12 * (1.0 + doubled.abs()));
                    prop_assert!((mode.damping - damping).abs() < 1e-12);
                }
            }
        }
    }

    /// A wave of phase `2π − φ` is the wave of phase `φ` the other way round, also where nothing restores at π.
    #[test]
    fn waves_beyond_the_shortest_are_aliases() {
        for name in ["sph", "gph"] {
            let waves = method(name, Kernel::CubicSpline, &ratio(3, 2)).waves().unwrap().compile();
            assert_eq!(waves.mode(PI).restoring, 0.0);
            for phase in [4.5, 3.2, 6.0] {
                let (here, alias) = (waves.mode(phase), waves.mode(2.0 * PI - phase));
                assert!((here.restoring - alias.restoring).abs() < 1e-14 && here.restoring > 0.0);
                assert!((here.damping - alias.damping).abs() < 1e-14);
            }
        }
        let sph = method("sph", Kernel::CubicSpline, &ratio(3, 2)).waves().unwrap().compile();
        // κΔ = 4.5, by the sums of 1.5 spacings in NumPy.
        assert!((sph.mode(4.5).frequencies().forward.re - 1.121_602_6).abs() < 1e-7);
    }
}
