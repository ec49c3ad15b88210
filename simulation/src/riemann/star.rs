//! What a Lagrangian particle method asks of a Riemann solver: pressure and velocity of the contact.

use super::{IdealGas, State, solve};

/// The resolved state at the contact and what it cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StarState {
    /// `P*`, never negative.
    pub pressure: f64,
    /// `v*`, along the line of centres, positive to the right.
    pub velocity: f64,
    /// Iterations after the first guess; 0 for a closed form or a guess that was kept.
    pub iterations: u32,
}

/// A solver that always has an answer: particle methods meet vacuum and round-off, and must go on.
pub trait StarSolver: std::fmt::Debug + Send + Sync + 'static {
    /// `P*` and `v*` between a left and a right state, left and right by position.
    fn star(&self, left: &State, right: &State) -> StarState;
}

/// The exact solver of the ideal gas, [`solve`]. Where a vacuum opens, `P* = 0`.
///
/// ```
/// use courant_simulation::riemann::{ExactIdeal, IdealGas, StarSolver, State};
/// let solver = ExactIdeal(IdealGas::new(1.4)?);
/// let (left, right) = (State::new(1.0, -9.0, 0.4)?, State::new(1.0, 9.0, 0.4)?);
/// assert_eq!(solver.star(&left, &right).pressure, 0.0);
/// # Ok::<(), courant_simulation::riemann::InvalidState>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactIdeal(pub IdealGas);

impl StarSolver for ExactIdeal {
    fn star(&self, left: &State, right: &State) -> StarState {
        let solution = solve(self.0, left, right);
        StarState {
            pressure: solution.pressure(),
            velocity: solution.velocity(),
            iterations: solution.iterations(),
        }
    }
}
