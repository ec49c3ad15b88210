//! The Riemann problem of an isothermal gas, `P = c²ρ`: the closed form that takes both waves for
//! shocks, and the exact solution.

use super::State;
use super::star::{StarSolver, StarState};

/// How a solver treats a wave that expands the gas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Expansion {
    /// By the relations of a shock, Cha & Whitworth 2003 (24)–(27) after Balsara 1994.
    AsShock,
    /// As the rarefaction that it is.
    Exact,
}

/// An isothermal solver.
///
/// Across a shock `Δv = c·2 sinh(y/2)` with `y = ln(ρ*/ρ)`, across a rarefaction `Δv = c·y`.
/// [`Expansion::AsShock`] has the closed form (27); [`Expansion::Exact`] has one for two
/// rarefactions and for two shocks, and a convex Newton iteration in `ln ρ*` otherwise. `P*` is
/// positive for every input whose exponentials do not underflow: an isothermal gas opens no vacuum.
///
/// ```
/// use courant_simulation::riemann::{State, StarSolver};
/// use courant_simulation::riemann::isothermal::{Expansion, Isothermal};
/// let (left, right) = (State::new(1.0, 0.0, 1.0)?, State::new(0.25, 0.0, 0.25)?);
/// let star = |expansion| Isothermal { sound_speed: 1.0, expansion }.star(&left, &right).pressure;
/// assert!((star(Expansion::AsShock) - 0.5).abs() < 1e-15);
/// assert!((star(Expansion::Exact) - 0.49662).abs() < 5e-6);
/// # Ok::<(), courant_simulation::riemann::InvalidState>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Isothermal {
    /// `c`, constant in space and time.
    pub sound_speed: f64,
    /// What an expanding wave is taken for.
    pub expansion: Expansion,
}

/// Newton converges from above in a handful of steps for all but absurd Mach numbers.
const MOST_ITERATIONS: u32 = 60;

impl Isothermal {
    /// Density and velocity between the waves, and the iterations it took.
    fn middle(&self, left: &State, right: &State) -> (f64, f64, u32) {
        let c = self.sound_speed;
        let (low, high) =
            (left.density().min(right.density()), left.density().max(right.density()));
        let approach = left.velocity() - right.velocity();
        let shocks = two_shocks(left, right, c, approach);
        if self.expansion == Expansion::AsShock || shocks >= high {
            return (shocks, self.velocity(left, right, shocks), 0);
        }
        let rarefactions = (left.density() * right.density()).sqrt() * (0.5 * approach / c).exp();
        if rarefactions <= low {
            return (rarefactions, self.velocity(left, right, rarefactions), 0);
        }
        // One of each. The residual is convex and increasing, and not negative at the upper
        // density: Newton descends to the root without overshooting.
        let ratio = (high / low).ln();
        let mut y = 0.0_f64; // ln(ρ*/ρ_high)
        let mut iterations = 0;
        while iterations < MOST_ITERATIONS {
            iterations += 1;
            let half = 0.5 * (y + ratio);
            let residual = y + 2.0 * half.sinh() - approach / c;
            let step = residual / (1.0 + half.cosh());
            y -= step;
            if step.abs() <= 4.0 * f64::EPSILON * (1.0 + y.abs()) {
                break;
            }
        }
        let density = high * y.exp();
        (density, self.velocity(left, right, density), iterations)
    }

    /// `Δv` across the wave from `density` to `star`, positive for a compression.
    fn jump(&self, density: f64, star: f64) -> f64 {
        if star >= density || self.expansion == Expansion::AsShock {
            self.sound_speed * (star - density) / (star * density).sqrt()
        } else {
            self.sound_speed * (star / density).ln()
        }
    }

    /// The mean of what the two waves say, so that neither side is favoured in round-off.
    fn velocity(&self, left: &State, right: &State, star: f64) -> f64 {
        let from_left = left.velocity() - self.jump(left.density(), star);
        let from_right = right.velocity() + self.jump(right.density(), star);
        0.5 * (from_left + from_right)
    }

    /// The state at `x/t = ray`. A rarefaction is a fan, or with [`Expansion::AsShock`] a jump.
    ///
    /// ```
    /// use courant_simulation::riemann::State;
    /// use courant_simulation::riemann::isothermal::{Expansion, Isothermal};
    /// let solver = Isothermal { sound_speed: 1.0, expansion: Expansion::Exact };
    /// let (left, right) = (State::new(1.0, 0.6, 1.0)?, State::new(1.0, -0.6, 1.0)?);
    /// let middle = solver.sample(&left, &right, 0.0);
    /// assert_eq!(middle.velocity(), 0.0);
    /// // 0.6 = (ρ* − 1)/√ρ*
    /// assert!((middle.density() - (0.3 + 1.09_f64.sqrt()).powi(2)).abs() < 1e-14);
    /// # Ok::<(), courant_simulation::riemann::InvalidState>(())
    /// ```
    pub fn sample(&self, left: &State, right: &State, ray: f64) -> State {
        let (star, velocity, _) = self.middle(left, right);
        // A problem seen in a mirror has its left wave on the right.
        let (own, sign) = if ray < velocity { (left, -1.0) } else { (right, 1.0) };
        let (density, speed) =
            self.side(own.density(), sign * own.velocity(), star, sign * velocity, sign * ray);
        State::trusted(density, sign * speed, self.sound_speed * self.sound_speed * density)
    }

    /// Density and velocity on a ray right of the contact.
    fn side(&self, density: f64, velocity: f64, star: f64, behind: f64, ray: f64) -> (f64, f64) {
        let c = self.sound_speed;
        if star > density || self.expansion == Expansion::AsShock {
            let shock = velocity + c * (star / density).sqrt();
            if ray < shock { (star, behind) } else { (density, velocity) }
        } else if ray >= velocity + c {
            (density, velocity)
        } else if ray <= behind + c {
            (star, behind)
        } else {
            (density * ((ray - c - velocity) / c).exp(), ray - c)
        }
    }
}

/// (27), written without the cancellation it has for two strong rarefactions.
fn two_shocks(left: &State, right: &State, c: f64, approach: f64) -> f64 {
    let (a, b) = (left.density().sqrt(), right.density().sqrt());
    let x = a * b / (a + b);
    let linear = x * approach / c;
    let constant = 4.0 * a * b;
    let root = (linear * linear + constant).sqrt();
    let twice = if linear >= 0.0 { linear + root } else { constant / (root - linear) };
    0.25 * twice * twice
}

impl StarSolver for Isothermal {
    fn star(&self, left: &State, right: &State) -> StarState {
        let (density, velocity, iterations) = self.middle(left, right);
        StarState { pressure: self.sound_speed * self.sound_speed * density, velocity, iterations }
    }
}
