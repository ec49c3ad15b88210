//! Scenes of gas dynamics in one dimension: domain, initial state, end time, exact solution.
//!
//! One definition serves tests, benches, examples and reports, whatever the method.

mod mass_lattice;
mod simple_wave;
mod tube;

pub(crate) use mass_lattice::MassLattice;
pub use simple_wave::{InvalidWave, SimpleWave, WaveData};
pub use tube::{InvalidTube, STANDARD_TUBES, ShockTube, TubeData};

use crate::boundary::Boundary;
use crate::riemann::{IdealGas, Solution, State};

/// A flow of one ideal gas on an interval, with its exact solution.
pub trait Scene: Sync {
    /// The name used on the command line and in files.
    fn name(&self) -> &str;
    /// Where the scene comes from.
    fn source(&self) -> &str;
    /// The gas.
    fn gas(&self) -> IdealGas;
    /// The interval on which the flow starts and is compared.
    fn domain(&self) -> [f64; 2];
    /// What lies beyond the domain.
    fn boundary(&self) -> Boundary;
    /// When to stop.
    fn end_time(&self) -> f64;
    /// The customary number of particles or cells.
    fn particles(&self) -> usize;
    /// The mass in the domain at the start.
    fn mass(&self) -> f64;
    /// The mass that flows in through each end until the end time. The gas beyond the end is like
    /// that at the end.
    fn inflow(&self) -> [f64; 2] {
        [0.0; 2]
    }
    /// The point with the mass `mass` between it and the left end, at the start; negative to the
    /// left of that end.
    fn position_at_mass(&self, mass: f64) -> f64;
    /// The state with the mean mass, momentum and total energy of `[from, to]` at the start.
    fn average(&self, from: f64, to: f64) -> State;
    /// The exact solution at `x` and `time`.
    fn exact(&self, x: f64, time: f64) -> State;
    /// The Riemann solution and its origin, if the scene is one Riemann problem.
    fn riemann(&self) -> Option<(&Solution, f64)> {
        None
    }
}

/// Density, momentum density and energy density `(ρ, ρv, ρE)` of a state.
pub(crate) fn conserved_density(gas: IdealGas, state: &State) -> [f64; 3] {
    let (rho, v) = (state.density(), state.velocity());
    [rho, rho * v, state.pressure() / (gas.gamma() - 1.0) + 0.5 * rho * v * v]
}

/// The state of given densities of mass, momentum and energy. The caller knows that they are a
/// mean of physical states, so that density and pressure are positive.
fn mean_state(gas: IdealGas, [rho, momentum, energy]: [f64; 3]) -> State {
    let v = momentum / rho;
    State::trusted(rho, v, (gas.gamma() - 1.0) * (energy - 0.5 * momentum * v))
}

#[cfg(test)]
mod tests;
