//! Sedov's point explosion in three dimensions.

use crate::bisection::root;
use std::f64::consts::PI;

/// The similarity solution for one `γ`: Landau & Lifshitz, Fluid Mechanics, section 106.
///
/// With `V = v/(2r/5t)` as the parameter, from `2/(γ+1)` at the shock to `1/γ` in the centre, distance, density and sound
/// speed are products of powers.
///
/// ```
/// use courant_simulation::field::SedovBlast;
/// // The shock is at 1.0328 (E t²/ρ)^(1/5) in air, and the gas behind it six times as dense.
/// let air = SedovBlast::new(1.4).expect("a gas");
/// assert!((air.shock_radius(1.0, 1.0, 1.0) - 1.0328).abs() < 5e-5);
/// let [density, ..] = air.state(1.0, 1.0, 1.032, 1.0).expect("just behind the shock");
/// assert!(density > 5.9 && air.state(1.0, 1.0, 1.04, 1.0).is_none());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SedovBlast {
    gamma: f64,
    /// `R/(E t²/ρ)^(1/5)`.
    radius: f64,
}

impl SedovBlast {
    /// For `1 < γ < 7`, `γ ≠ 2`, where the exponents are finite.
    pub fn new(gamma: f64) -> Option<Self> {
        if !(gamma > 1.0 && gamma < 7.0) || gamma == 2.0 {
            return None;
        }
        // (16π/25) β⁵ ∫ G (V²/2 + Z/(γ(γ−1))) ξ⁴ dξ = 1, with ξ⁵ as the variable.
        const CELLS: i32 = 20_000;
        let shape = Self { gamma, radius: 1.0 };
        let at = |k: f64| shape.excess(k / f64::from(CELLS));
        let (mut integral, mut before) = (0.0, 0.0);
        for k in 1..=CELLS {
            let fifth = shape.distance(at(f64::from(k))).powi(5);
            let middle = at(f64::from(k) - 0.5);
            let [density, sound] = shape.density_and_sound(middle);
            let speed = (1.0 + middle) / gamma;
            let energy = 0.5 * speed * speed + sound / (gamma * (gamma - 1.0));
            integral += density * energy * (fifth - before) / 5.0;
            before = fifth;
        }
        Some(Self { gamma, radius: (16.0 * PI / 25.0 * integral).powf(-0.2) })
    }

    /// Where the shock is at a time after the explosion.
    pub fn shock_radius(&self, energy: f64, density: f64, time: f64) -> f64 {
        self.radius * (energy * time * time / density).powf(0.2)
    }

    /// Density, outward velocity and pressure at the distance `r`; `None` outside the shock.
    pub fn state(&self, energy: f64, density: f64, r: f64, time: f64) -> Option<[f64; 3]> {
        let target = r / self.shock_radius(energy, density, time);
        if target > 1.0 {
            return None;
        }
        // ξ grows with V.
        let excess = self.excess(root(0.0, 1.0, |part| self.distance(self.excess(part)) - target));
        let [shape, sound] = self.density_and_sound(excess);
        let unit = 0.4 * r / time;
        let rho = density * shape;
        let pressure = if r > 0.0 && shape > 0.0 {
            rho * unit * unit * sound / self.gamma
        } else {
            // In the centre the density vanishes and the pressure does not: that of a little way off.
            let near = 1e-3 * self.shock_radius(energy, density, time);
            return self.state(energy, density, near, time).map(|[_, _, p]| [0.0, 0.0, p]);
        };
        Some([rho, unit * (1.0 + excess) / self.gamma, pressure])
    }

    /// `γV − 1`, which is zero in the centre, at a part of the way from there to the shock; steps crowd where `ξ` changes fast.
    fn excess(&self, part: f64) -> f64 {
        (self.gamma - 1.0) / (self.gamma + 1.0) * part.powi(8)
    }

    /// `ξ = r/R`.
    fn distance(&self, excess: f64) -> f64 {
        let g = self.gamma;
        let nu1 = -(13.0 * g * g - 7.0 * g + 12.0) / ((3.0 * g - 1.0) * (2.0 * g + 1.0));
        let nu2 = 5.0 * (g - 1.0) / (2.0 * g + 1.0);
        let [fast, inner, _] = self.factors(excess);
        let v = (1.0 + excess) / g;
        ((0.5 * (g + 1.0) * v).powi(-2) * fast.powf(nu1) * inner.powf(nu2)).powf(0.2)
    }

    /// `G = ρ/ρ₀` and `Z = c²/(2r/5t)²`.
    fn density_and_sound(&self, excess: f64) -> [f64; 2] {
        let g = self.gamma;
        let nu1 = -(13.0 * g * g - 7.0 * g + 12.0) / ((3.0 * g - 1.0) * (2.0 * g + 1.0));
        let (nu3, nu4, nu5) = (3.0 / (2.0 * g + 1.0), -nu1 / (2.0 - g), -2.0 / (2.0 - g));
        let [fast, inner, outer] = self.factors(excess);
        let density = (g + 1.0) / (g - 1.0) * inner.powf(nu3) * fast.powf(nu4) * outer.powf(nu5);
        let v = (1.0 + excess) / g;
        [density, g * (g - 1.0) * (1.0 - v) * v * v / (2.0 * excess)]
    }

    /// The three factors that are one at the shock.
    fn factors(&self, excess: f64) -> [f64; 3] {
        let g = self.gamma;
        let v = (1.0 + excess) / g;
        [
            (g + 1.0) / (7.0 - g) * (5.0 - (3.0 * g - 1.0) * v),
            (g + 1.0) / (g - 1.0) * excess,
            (g + 1.0) / (g - 1.0) * (1.0 - v),
        ]
    }
}
