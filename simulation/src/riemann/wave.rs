//! One acoustic wave: how a gas gets from its own pressure to another.

use super::{IdealGas, State};

/// An acoustic wave of a Riemann solution. Speeds are `dx/dt` in the frame of the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wave {
    /// A shock.
    Shock {
        /// Its speed.
        speed: f64,
    },
    /// A centred rarefaction.
    Rarefaction {
        /// The speed of the edge towards the undisturbed gas.
        head: f64,
        /// The speed of the edge towards the star region (or the vacuum).
        tail: f64,
    },
    /// No wave: there is no gas on that side, or it is at rest beside the star region.
    Absent,
}

impl Wave {
    /// The speeds of the outer and of the inner edge; `None` for an absent wave.
    pub fn edges(self) -> Option<(f64, f64)> {
        match self {
            Self::Shock { speed } => Some((speed, speed)),
            Self::Rarefaction { head, tail } => Some((head, tail)),
            Self::Absent => None,
        }
    }
}

/// The gas on one side with what the wave functions of that side need.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    pub density: f64,
    pub pressure: f64,
    pub sound: f64,
    gamma: f64,
    /// `z = (γ − 1)/(2γ)`.
    exponent: f64,
}

impl Side {
    #[inline]
    pub fn new(gas: IdealGas, state: &State) -> Self {
        let gamma = gas.gamma();
        Self {
            density: state.density(),
            pressure: state.pressure(),
            sound: gas.sound_speed(state.density(), state.pressure()),
            gamma,
            exponent: (gamma - 1.0) / (2.0 * gamma),
        }
    }

    /// `2c/(γ − 1)`: the speed a gas gains by expanding into a vacuum.
    #[inline]
    pub fn escape_speed(&self) -> f64 {
        2.0 * self.sound / (self.gamma - 1.0)
    }

    /// `A/(p + B)` with `A = 2/((γ+1)ρ)`, `B = p_K (γ−1)/(γ+1)`: the squared inverse of the mass
    /// flux through a shock to pressure `p`. Toro 1999 (4.8), (4.20).
    #[inline]
    fn inverse_mass_flux_squared(&self, pressure: f64) -> f64 {
        2.0 / (self.density * ((self.gamma + 1.0) * pressure + (self.gamma - 1.0) * self.pressure))
    }

    /// `√(A/(p + B))`: the inverse of the mass flux through a shock to pressure `p`.
    #[inline]
    pub fn inverse_mass_flux(&self, pressure: f64) -> f64 {
        self.inverse_mass_flux_squared(pressure).sqrt()
    }

    /// `z ln(p/p_K)`, accurate also where the pressures nearly agree.
    #[inline]
    fn isentrope(&self, pressure: f64) -> f64 {
        let ratio = pressure / self.pressure;
        let log = if ratio > 0.5 {
            ((pressure - self.pressure) / self.pressure).ln_1p()
        } else {
            ratio.ln()
        };
        self.exponent * log
    }

    /// `(p/p_K)^z − 1`, accurate also where the pressures nearly agree.
    #[inline]
    fn sound_growth(&self, pressure: f64) -> f64 {
        let excess = (pressure - self.pressure) / self.pressure;
        if excess.abs() < WEAK {
            binomial_growth(excess, self.exponent)
        } else {
            self.isentrope(pressure).exp_m1()
        }
    }

    /// The velocity change across the wave to pressure `p` and its derivative with respect to `p`:
    /// Toro 1999 (4.6), (4.7), (4.37). It grows with `p`, is concave, and vanishes at `p_K`.
    #[inline]
    pub fn velocity_change(&self, pressure: f64) -> (f64, f64) {
        if pressure > self.pressure {
            let jump = pressure - self.pressure;
            let root = self.inverse_mass_flux(pressure);
            // d/dp [jump √(A/(p+B))] = √(A/(p+B)) (1 − jump/(2(p + B)))
            let shifted =
                2.0 * (pressure + self.pressure * (self.gamma - 1.0) / (self.gamma + 1.0));
            (jump * root, root * (1.0 - jump / shifted))
        } else {
            let growth = self.sound_growth(pressure);
            let slope = (1.0 + growth) * self.pressure / (pressure * self.density * self.sound);
            (self.escape_speed() * growth, slope)
        }
    }

    /// The density behind the wave to pressure `p`: Toro 1999 (4.50), (4.53).
    #[inline]
    pub fn density_behind(&self, pressure: f64) -> f64 {
        if pressure > self.pressure {
            let weak = (self.gamma - 1.0) / (self.gamma + 1.0);
            self.density * (pressure + weak * self.pressure) / (weak * pressure + self.pressure)
        } else if pressure == self.pressure {
            self.density
        } else {
            self.density * (2.0 * self.isentrope(pressure) / (self.gamma - 1.0)).exp()
        }
    }

    /// The sound speed behind a rarefaction to pressure `p`: `c_K (p/p_K)^z`.
    #[inline]
    pub fn sound_behind_rarefaction(&self, pressure: f64) -> f64 {
        self.sound * self.sound_ratio(pressure)
    }

    /// The speed of a shock to pressure `p` relative to the gas ahead: Toro 1999 (4.52), (4.59).
    #[inline]
    pub fn shock_speed(&self, pressure: f64) -> f64 {
        1.0 / (self.density * self.inverse_mass_flux(pressure))
    }

    /// The factor by which `c` shrinks for `p_K → p`, namely `(p/p_K)^z`.
    #[inline]
    pub fn sound_ratio(&self, pressure: f64) -> f64 {
        1.0 + self.sound_growth(pressure)
    }
}

/// Pressure changes below this part take the series instead of a logarithm and an exponential:
/// most pairs of neighbours in a smooth flow.
const WEAK: f64 = 1.0 / 64.0;

/// `1/n` for `n` from 2 to 9.
const RECIPROCALS: [f64; 8] =
    [1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0, 1.0 / 7.0, 1.0 / 8.0, 1.0 / 9.0];

/// `(1 + x)^z − 1 = zx (1 + (z−1)/2 x (1 + (z−2)/3 x (…)))` up to `x⁹`. For `0 < z < 1` the
/// coefficients of the bracket are below 1, so that the rest is below `x⁹ = 2⁻⁵⁴` of it.
#[inline]
fn binomial_growth(x: f64, z: f64) -> f64 {
    let mut bracket = 1.0;
    for (n, reciprocal) in RECIPROCALS.iter().enumerate().rev() {
        bracket = 1.0 + (z - (n + 1) as f64) * reciprocal * x * bracket;
    }
    z * x * bracket
}

#[cfg(test)]
mod tests {
    use super::{WEAK, binomial_growth};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_series_is_the_power(part in -1.0..1.0f64, z in 0.001..0.5f64) {
            let x = WEAK * part;
            let wanted = (z * x.ln_1p()).exp_m1();
            // The units in the last place of a logarithm, an exponential and a product.
            prop_assert!((binomial_growth(x, z) - wanted).abs() <= 4.0 * f64::EPSILON * wanted.abs());
        }
    }
}
