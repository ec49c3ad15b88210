//! Van Leer's iteration for the star state of an ideal gas: Cha & Whitworth 2003 (17)–(23).

use super::star::{StarSolver, StarState};
use super::{IdealGas, State};

/// When the iteration ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stopping {
    /// As published: the first guess (23) is kept where it is within 1 per cent of both pressures;
    /// otherwise iterate until `P*` changes by less than 1.5 per cent.
    Published,
    /// Until Newton's quadratic convergence has used up the digits (a last step below 1e-8).
    Converged,
}

/// Van Leer's solver with pressure protection.
///
/// With `W` the Lagrangian shock speed (17) (a mass flux) of each side and `Z = dP*/dv*` (18), each
/// step is Newton's for `v*_R(P) − v*_L(P) = 0`, left and right by position:
/// `P ← P − Z_L Z_R (v*_R − v*_L) / (Z_L + Z_R)`,
/// `v*_L = v_L − (P − P_L)/W_L`, `v*_R = v_R + (P − P_R)/W_R`.
///
/// `P` is never allowed below `P_MIN = 1e-12` times the smaller pressure: guess (23) is negative for two strong
/// rarefactions, and where a vacuum opens the relations have no root at all. Then `P*` is that floor.
///
/// ```
/// use courant_simulation::riemann::{IdealGas, State, StarSolver, Stopping, VanLeer};
/// let solver = VanLeer { gas: IdealGas::new(1.4)?, stopping: Stopping::Converged };
/// let left = State::new(1.0, 0.0, 1.0)?;
/// let right = State::new(0.125, 0.0, 0.1)?;
/// // The right wave is a shock and the left one not: van Leer's W holds for both.
/// let star = solver.star(&left, &right);
/// assert!((star.pressure - 0.30313).abs() < 1e-5);
/// assert!((star.velocity - 0.92745).abs() < 1e-5);
/// # Ok::<(), courant_simulation::riemann::InvalidState>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VanLeer {
    /// The gas on both sides.
    pub gas: IdealGas,
    /// When to stop.
    pub stopping: Stopping,
}

/// The floor of `P*`, in units of the smaller of the two pressures.
pub const PRESSURE_FLOOR: f64 = 1e-12;

/// The next error is of the order of the square of the last step, which is below round-off.
const LAST_STEP: f64 = 1e-8;

/// The worst of 10⁶ random pairs with pressure ratios up to 10¹² takes 8 by the published rule and 10
/// to convergence; the rest is reserve for the floor.
const MOST_ITERATIONS: u32 = 100;

struct Side {
    pressure: f64,
    sound: f64,
}

impl Side {
    /// `(W, Z)` of (17) and (18), both mass fluxes.
    fn slopes(&self, gamma: f64, star: f64) -> (f64, f64) {
        let ratio = star / self.pressure;
        if ratio >= 1.0 {
            let speed = self.sound * (1.0 + (gamma + 1.0) / (2.0 * gamma) * (ratio - 1.0)).sqrt();
            let (w2, c2) = (speed * speed, self.sound * self.sound);
            (speed, 2.0 * speed * w2 / (w2 + c2))
        } else {
            let exponent = (gamma - 1.0) / (2.0 * gamma);
            let logarithm = ratio.ln();
            // expm1 keeps both differences exact as the ratio tends to one.
            let speed =
                exponent * self.sound * logarithm.exp_m1() / (exponent * logarithm).exp_m1();
            (speed, self.sound * ((1.0 - exponent) * logarithm).exp())
        }
    }
}

impl VanLeer {
    /// Guess (23): both waves as sound waves. May be negative.
    pub fn first_guess(&self, left: &State, right: &State) -> f64 {
        let (c_left, c_right) = (self.sound(left), self.sound(right));
        (c_right * left.pressure() + c_left * right.pressure()
            - c_left * c_right * (right.velocity() - left.velocity()))
            / (c_left + c_right)
    }

    /// `C = √(γPρ)`, mass per time and area.
    fn sound(&self, state: &State) -> f64 {
        self.gas.lagrangian_sound_speed(state.density(), state.pressure())
    }
}

impl StarSolver for VanLeer {
    fn star(&self, left: &State, right: &State) -> StarState {
        let sides = [left, right]
            .map(|state| Side { pressure: state.pressure(), sound: self.sound(state) });
        let lowest = left.pressure().min(right.pressure());
        if lowest <= 0.0 {
            // A cold side offers no resistance: the contact is free.
            let (a, b) = (left.density().sqrt(), right.density().sqrt());
            let velocity = (a * left.velocity() + b * right.velocity()) / (a + b);
            return StarState { pressure: 0.0, velocity, iterations: 0 };
        }
        let gamma = self.gas.gamma();
        let floor = PRESSURE_FLOOR * lowest;
        let guess = self.first_guess(left, right);
        let mut pressure = guess.max(floor);
        let close = |side: &Side| (guess - side.pressure).abs() <= 0.01 * side.pressure;
        let keep = self.stopping == Stopping::Published && sides.iter().all(close);
        let tolerance = match self.stopping {
            Stopping::Published => 0.015,
            Stopping::Converged => LAST_STEP,
        };
        let mut iterations = 0;
        let mut done = keep;
        loop {
            let (w_left, z_left) = sides[0].slopes(gamma, pressure);
            let (w_right, z_right) = sides[1].slopes(gamma, pressure);
            let v_left = left.velocity() - (pressure - left.pressure()) / w_left;
            let v_right = right.velocity() + (pressure - right.pressure()) / w_right;
            // (22), at the pressure that is returned.
            let velocity = (z_right * v_right + z_left * v_left) / (z_left + z_right);
            if done || iterations == MOST_ITERATIONS {
                return StarState { pressure, velocity, iterations };
            }
            let step = z_left * z_right * (v_right - v_left) / (z_left + z_right);
            let next = (pressure - step).max(floor);
            done = (next - pressure).abs() <= tolerance * pressure;
            pressure = next;
            iterations += 1;
        }
    }
}
