//! Linear theory of Godunov-type SPH in Lagrangian mass coordinates: Ferrari et al. 2008, (3.9).
//!
//! Linearise `U_i += (Δt/Δξ) Σ_k 2w_k (F(U_{i−k}, U_i) − F(U_i, U_{i+k}))` about a uniform state. Every
//! flux there has the form `F = A(U_L + U_R)/2 − |A|(U_R − U_L)/2` with a matrix `|A|` that has the
//! eigenvectors of `A`, whose eigenvalues are `−C, 0, C` with the mass flux `C = √(γρp)`. In the
//! characteristic variables the system therefore falls apart into three scalar schemes, all functions
//! of the one Courant number `C Δt/Δξ`:
//!
//! * the two acoustic waves (eigenvalue ±C, viscosity C for every flux) are advected by Godunov SPH,
//!   `u_i − 2(CΔt/Δξ) Σ_k w_k (u_i − u_{i∓k})`, mirror images of each other;
//! * the contact (eigenvalue 0, viscosity λ₂) is diffused,
//!   `u_i − (λ₂/C)(CΔt/Δξ) Σ_k w_k (2u_i − u_{i−k} − u_{i+k})`.
//!
//! λ₂ is 0 for the exact flux, C for Rusanov's and α̃ max|v| (as printed, (3.15)) for the modified Roe
//! flux. Nothing else tells the fluxes apart in linear theory.

use crate::exact::rational::{Rational, integer};
use crate::exact::stencil::Stencil;
use crate::kernel::Kernel;
use crate::kernel::lattice::{LatticeWeights, RatioOutOfRange};
use crate::scheme::symbol::{EnclosedSymbol, Symbol};
use crate::scheme::{AdvectionScheme, Discretisation, Scheme};
use crate::stability::{Limit, monotonicity_limit, stability_limit};

/// One of the three waves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CharacteristicWave {
    /// The sound waves, which travel both ways with ±C.
    Acoustic,
    /// The contact, which stays with the particles.
    Contact,
}

impl CharacteristicWave {
    /// The word used in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Acoustic => "acoustic",
            Self::Contact => "contact",
        }
    }
}

/// A limit of the system with the wave that sets it.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemLimit {
    /// The limit on `C Δt/Δξ`.
    pub limit: Limit,
    /// Which wave binds; the acoustic ones where both do.
    pub wave: CharacteristicWave,
}

/// The linearised scheme on the uniform mass lattice.
///
/// ```
/// use courant_analysis::scheme::lagrangian::{CharacteristicWave, LinearLagrangianScheme};
/// use courant_analysis::{kernel::Kernel, exact::rational::integer};
/// // Rusanov's flux: the contact sees as much viscosity as the sound.
/// let scheme = LinearLagrangianScheme::new(Kernel::CubicSpline, integer(2), integer(1))?;
/// let stable = scheme.stability_limit(&integer(10));
/// assert_eq!(stable.limit.exact().unwrap().to_string(), "15/8");
/// assert_eq!(stable.wave, CharacteristicWave::Acoustic);
/// assert_eq!(scheme.monotonicity_limit(&integer(10)).limit.exact().unwrap().to_string(), "8/5");
/// # Ok::<(), courant_analysis::kernel::lattice::RatioOutOfRange>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct LinearLagrangianScheme {
    sound: Discretisation,
    contact_viscosity: Rational,
}

impl LinearLagrangianScheme {
    /// The scheme for a kernel, `ratio = l/Δξ` and `contact_viscosity = λ₂/C`.
    ///
    /// # Errors
    /// When the ratio is not in `[1/100, 50]`.
    pub fn new(
        kernel: Kernel,
        ratio: Rational,
        contact_viscosity: Rational,
    ) -> Result<Self, RatioOutOfRange> {
        let sound = Discretisation::new(AdvectionScheme::GodunovSph, kernel, ratio)?;
        Ok(Self { sound, contact_viscosity })
    }

    /// What a step does to `e^{iφj}` of one wave. Of the acoustic waves it is the one that travels to
    /// larger mass coordinates; the other has the complex conjugate.
    pub fn symbol(&self, wave: CharacteristicWave) -> EnclosedSymbol {
        match wave {
            CharacteristicWave::Acoustic => self.sound.symbol(),
            CharacteristicWave::Contact => {
                EnclosedSymbol::from_weights(self.sound.weights(), |weights| {
                    let stencil = second_difference(weights, &self.contact_viscosity);
                    Symbol::identity() - Symbol::courant_power(1, stencil)
                })
            }
        }
    }

    /// The largest stable `C Δt/Δξ` within `[0, max_courant]`.
    pub fn stability_limit(&self, max_courant: &Rational) -> SystemLimit {
        self.smaller(|symbol| stability_limit(symbol, max_courant))
    }

    /// The largest `C Δt/Δξ` within `[0, max_courant]` at which no characteristic variable makes new
    /// extrema.
    pub fn monotonicity_limit(&self, max_courant: &Rational) -> SystemLimit {
        self.smaller(|symbol| monotonicity_limit(symbol, max_courant))
    }

    fn smaller(&self, limit: impl Fn(&EnclosedSymbol) -> Limit) -> SystemLimit {
        let [sound, contact] = [CharacteristicWave::Acoustic, CharacteristicWave::Contact]
            .map(|wave| SystemLimit { limit: limit(&self.symbol(wave)), wave });
        if contact.limit.value() < sound.limit.value() { contact } else { sound }
    }
}

/// `viscosity · Σ_k w_k (2 − E^k − E^{−k})`.
fn second_difference(weights: &LatticeWeights, viscosity: &Rational) -> Stencil<Rational> {
    let side: Vec<Rational> = weights.gradient.iter().map(|w| -(w * viscosity)).collect();
    let middle = side.iter().sum::<Rational>() * integer(-2);
    let coefficients = side.iter().rev().cloned().chain([middle]).chain(side.iter().cloned());
    Stencil::new(-(side.len() as i64), coefficients.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{ratio, to_f64};

    fn scheme(kernel: Kernel, l: Rational, viscosity: Rational) -> LinearLagrangianScheme {
        LinearLagrangianScheme::new(kernel, l, viscosity).expect("in range")
    }

    #[test]
    fn the_contact_is_the_sum_of_cosines() {
        for kernel in Kernel::ALL {
            for (l, viscosity) in [(ratio(1, 1), ratio(1, 1)), (ratio(27, 10), ratio(2, 5))] {
                let weights = LatticeWeights::new(kernel, &l).expect("in range");
                let symbol = scheme(kernel, l, viscosity.clone())
                    .symbol(CharacteristicWave::Contact)
                    .center()
                    .compile();
                for i in 0..=8 {
                    let phase = f64::from(i) * std::f64::consts::PI / 8.0;
                    let sum: f64 = (1..)
                        .zip(&weights.gradient)
                        .map(|(k, w)| to_f64(w) * (2.0 - 2.0 * (f64::from(k) * phase).cos()))
                        .sum();
                    let wanted = 1.0 - 1.3 * to_f64(&viscosity) * sum;
                    // A dozen terms below 2, each rounded a few times.
                    let found = symbol.amplification(1.3, phase);
                    assert!((found.re - wanted).abs() < 1e-13 && found.im.abs() < 1e-15);
                }
            }
        }
    }

    #[test]
    fn half_the_sum_of_both_sounds_is_the_contact_of_rusanov() {
        // Without transport the sound waves lose what the contact loses: g(φ) + g(−φ) = 2 g₀(φ).
        let scheme = scheme(Kernel::QuinticSpline, ratio(3, 2), ratio(1, 1));
        let sound = scheme.symbol(CharacteristicWave::Acoustic);
        let contact = scheme.symbol(CharacteristicWave::Contact);
        for offset in -5i64..=5 {
            let sum = sound.center().coefficient(offset) + sound.center().coefficient(-offset);
            let twice = contact.center().coefficient(offset);
            assert_eq!(sum, twice.clone() + twice, "{offset}");
        }
    }

    #[test]
    fn without_viscosity_the_contact_is_kept_at_any_step() {
        let scheme = scheme(Kernel::CubicSpline, ratio(2, 1), integer(0));
        let contact = scheme.symbol(CharacteristicWave::Contact);
        assert_eq!(contact.center(), &Symbol::identity());
        assert_eq!(scheme.stability_limit(&integer(5)).wave, CharacteristicWave::Acoustic);
    }

    #[test]
    fn a_contact_viscosity_above_the_sound_speed_takes_over() {
        // 1 − 2 λ₂/C · CΔt/Δξ · Σw_k ≥ 0: inversely in λ₂/C from 1 on.
        for (viscosity, monotone) in
            [(ratio(1, 2), "8/5"), (ratio(1, 1), "8/5"), (ratio(2, 1), "4/5")]
        {
            let limit = scheme(Kernel::CubicSpline, ratio(2, 1), viscosity.clone())
                .monotonicity_limit(&integer(10));
            assert_eq!(limit.limit.exact().expect("a fraction").to_string(), monotone);
            assert_eq!(limit.wave == CharacteristicWave::Contact, viscosity > ratio(1, 1));
        }
        // Stability: |1 − D s| ≤ 1 with s = Σ w_k(2 − 2cos kφ) at its largest, on a fine grid here.
        let largest = (0..=100_000)
            .map(|i| {
                let phase = f64::from(i) * std::f64::consts::PI / 1e5;
                let term = |k: f64, w: f64| w * (2.0 - 2.0 * (k * phase).cos());
                term(1.0, 5.0 / 32.0) + term(2.0, 0.125) + term(3.0, 1.0 / 32.0)
            })
            .fold(0.0, f64::max);
        let limit =
            scheme(Kernel::CubicSpline, ratio(2, 1), ratio(2, 1)).stability_limit(&integer(10));
        assert_eq!(limit.wave, CharacteristicWave::Contact);
        // The grid misses the top of a parabola by at most its curvature times (π/2e5)².
        assert!((limit.limit.value() - 1.0 / largest).abs() < 1e-8);
    }
}
