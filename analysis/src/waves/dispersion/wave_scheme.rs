//! A particle method on a lattice: everything about its waves but the time step.

use super::method::{Form, WaveMethod};
use super::mode::Mode;
use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::rational::{Rational, integer, to_f64};
use crate::kernel::Density;
use crate::kernel::Kernel;
use crate::kernel::LatticeSums;
use crate::kernel::lattice::RatioOutOfRange;
use num_traits::{One, Zero};

/// A particle method with its kernel, smoothing ratio `h/Δ`, density and mean pressure.
///
/// ```
/// use courant_analysis::waves::dispersion::{Form, WaveMethod, WaveScheme};
/// use courant_analysis::{kernel::Kernel, exact::rational::ratio};
/// let gph = WaveMethod::Gph { form: Form::Resolved };
/// let scheme = WaveScheme::new(gph, Kernel::CubicSpline, &ratio(6, 5)).unwrap();
/// let waves = scheme.compile().mode(0.5).frequencies();
/// assert!(waves.forward.re > 0.0 && waves.forward.im < 0.0);   // to the right, and damped
/// ```
#[derive(Debug, Clone)]
pub struct WaveScheme {
    method: WaveMethod,
    sums: LatticeSums,
    pressure: Rational,
}

impl WaveScheme {
    /// The isothermal scheme, `P = ρ0 c²`, with the summation density.
    ///
    /// # Errors
    /// When the ratio is not in `[1/100, 50]`.
    pub fn new(
        method: WaveMethod,
        kernel: Kernel,
        ratio: &Rational,
    ) -> Result<Self, RatioOutOfRange> {
        let sums = LatticeSums::new(kernel, ratio, Density::Summation)?;
        Ok(Self::with_sums(method, sums))
    }

    /// The isothermal scheme on lattice sums computed before.
    pub fn with_sums(method: WaveMethod, sums: LatticeSums) -> Self {
        Self { method, sums, pressure: Rational::one() }
    }

    /// The same with the mean pressure `P/(ρ0 c²)`: 1 is isothermal, `1/γ` a gas of exponent γ, less than
    /// zero is tension.
    pub fn with_pressure(self, pressure: Rational) -> Self {
        Self { pressure, ..self }
    }

    /// The method.
    pub fn method(&self) -> &WaveMethod {
        &self.method
    }

    /// The lattice sums, which know kernel, ratio and density.
    pub fn sums(&self) -> &LatticeSums {
        &self.sums
    }

    /// `P/(ρ0 c²)`.
    pub fn pressure(&self) -> &Rational {
        &self.pressure
    }

    /// `ω_SPH² Δ²/(c² s) = 2Π T/s + (1 − 2Π) S²/s` with `Π = P/(ρ0 c²)` and `s = (1 − cos φ)/2`.
    pub fn restoring(&self) -> EnclosedSeries {
        let doubled = integer(2) * &self.pressure;
        let rest = Rational::one() - &doubled;
        self.sums.curvature().scaled(&doubled).plus(&self.sums.squared_gradient().scaled(&rest))
    }

    /// The damping rate over `s`: `−G Δ/(c s)` for real `G`, that is `α h B/s` or `D/s`. `None` for the
    /// published form, whose `G` is imaginary.
    pub fn damping(&self) -> Option<EnclosedSeries> {
        match &self.method {
            WaveMethod::Sph => Some(EnclosedSeries::constant(Rational::zero())),
            WaveMethod::SphAv { alpha } => {
                Some(self.sums.slope_per_distance().scaled(&(alpha * self.sums.ratio())))
            }
            WaveMethod::Gph { form: Form::Resolved } => Some(self.sums.slope().clone()),
            WaveMethod::Gph { form: Form::Published } => None,
        }
    }

    /// The numeric form.
    pub fn compile(&self) -> CompiledWaves {
        let restoring = self.restoring();
        let (mut center, mut complement_power) = (restoring.center(), 0);
        if restoring.is_exact() {
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
        let skew = match self.method {
            WaveMethod::Gph { form: Form::Published } => self.sums.gradient().compile(),
            _ => CosineSeries::new(Vec::new()),
        };
        CompiledWaves {
            ratio: to_f64(self.sums.ratio()),
            restoring: center,
            complement_power,
            rounding,
            damping: self
                .damping()
                .map_or_else(|| CosineSeries::new(Vec::new()), |series| series.compile()),
            skew,
        }
    }
}

/// [`WaveScheme`] in `f64`: at most two Clenshaw sums per phase.
#[derive(Debug, Clone)]
pub struct CompiledWaves {
    ratio: f64,
    restoring: CosineSeries<f64>,
    complement_power: i32,
    rounding: f64,
    damping: CosineSeries<f64>,
    skew: CosineSeries<f64>,
}

impl CompiledWaves {
    /// `h/Δ`.
    pub fn ratio(&self) -> f64 {
        self.ratio
    }

    /// The mode of phase `φ = κΔ`, in radians.
    ///
    /// A restoring force that cannot be told from zero is zero: it then neither oscillates nor grows.
    pub fn mode(&self, phase: f64) -> Mode {
        let (sine, cosine) = phase.sin_cos();
        let half_sine = (0.5 * phase).sin();
        let s = half_sine * half_sine;
        let mut restoring = self.restoring.at_cosine(cosine);
        if restoring.abs() <= self.rounding {
            restoring = 0.0;
        }
        if self.complement_power > 0 {
            // cos(φ/2) is 6e-17 at the nearest float to π, where it stands for zero.
            let complement =
                if phase >= std::f64::consts::PI { 0.0 } else { (0.5 * phase).cos().powi(2) };
            restoring *= complement.powi(self.complement_power);
        }
        Mode {
            phase,
            restoring: s * restoring,
            damping: s * self.damping.at_cosine(cosine),
            skew: sine * self.skew.at_cosine(cosine),
        }
    }

    /// The damping rate of every mode multiplied by `factor`: a viscosity swept without new sums.
    #[must_use]
    pub fn with_damping_scaled(mut self, factor: f64) -> Self {
        self.damping = self.damping.map(|value| value * factor);
        self
    }

    /// How many terms the series have together: the work of one phase.
    pub fn terms(&self) -> usize {
        [&self.restoring, &self.damping, &self.skew]
            .into_iter()
            .map(|series| series.coefficients().len())
            .sum()
    }
}
