//! Scenes as data: files of one format, the named ones in the tree and those of a user ([`AnyScene`]); and the scenes of gas
//! dynamics in one dimension ([`Scene`]): gas, domain, ends, initial state, end time, exact solution.
//!
//! One definition serves tests, benches, examples and reports, whatever the method.

mod any;
mod exact;
mod file;
mod layer;
mod mass_lattice;
mod material;
mod placement;
mod quantity;
mod simple_wave;

pub use any::{AnyScene, UnknownScene};
pub use exact::ExactSolution;
pub use file::{InvalidFile, KEYS};
pub use layer::{Flow, Layer};
pub(crate) use mass_lattice::MassLattice;
pub use material::Material;
pub use quantity::Quantity;

use crate::boundary::Boundary;
use crate::particles::Gas;
use crate::riemann::{IdealGas, State};
use quantity::GAUSS;

/// A flow of one gas on an interval.
///
/// ```
/// use courant_simulation::scene::Scene;
/// let tube = Scene::named("ferrari1").expect("it is in the list");
/// assert!((tube.mass() - 0.3875).abs() < 1e-15);
/// assert_eq!(tube.exact(0.0, 0.2).expect("a Riemann problem").density(), 1.0);
/// let mine = Scene::parse("
///     gamma = 1.4
///     domain = [0, 1]
///     boundary = [\"mirror\", \"transmissive\"]
///     end_time = 0.1
///     [[layer]]
///     to = 0.5
///     density = { mean = 1, amplitude = 0.1, wave_number = 6.28 }
///     velocity = 0
///     pressure = 1
///     [[layer]]
///     to = 1
///     density = 0.1
///     velocity = 0
///     pressure = 0.1
/// ", "mine").expect("a scene");
/// assert!((mine.initial(0.25).density() - 1.1).abs() < 1e-6 && mine.exact(0.5, 0.1).is_none());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The name used on the command line and in files.
    pub name: String,
    /// What happens, in a line.
    pub description: String,
    /// Where the scene comes from, and what had to be chosen.
    pub source: String,
    /// The gas.
    pub material: Material,
    /// The interval where the flow is.
    pub domain: [f64; 2],
    /// What is beyond its ends.
    pub boundary: [Boundary; 2],
    /// Where the run is compared with the exact solution.
    pub window: [f64; 2],
    /// The initial state.
    pub flow: Flow,
    /// When to stop.
    pub end_time: f64,
    /// The customary number of particles or cells.
    pub particles: usize,
    /// Whether the smoothing lengths of particle methods stay constant.
    pub constant_smoothing: bool,
    /// The customary method, if the file names one.
    pub method: Option<String>,
}

/// Fewer particles than this cannot hold three waves.
pub const MIN_PARTICLES: usize = 10;

impl Scene {
    fn layers(&self) -> &[Layer] {
        match &self.flow {
            Flow::Layers(layers) => layers,
            Flow::SimpleWave { .. } => &[],
        }
    }

    /// The layer of a place; those at the ends go on beyond the domain.
    fn layer(&self, x: f64) -> Option<&Layer> {
        let layers = self.layers();
        layers.iter().find(|layer| x < layer.to).or(layers.last())
    }

    /// The state at `x` before the motion.
    pub fn initial(&self, x: f64) -> State {
        match (&self.flow, self.layer(x)) {
            (Flow::SimpleWave { amplitude }, _) => self.simple_wave(*amplitude, x),
            (_, Some(layer)) if layer.is_vacuum() => State::vacuum(layer.velocity.at(x)),
            (_, Some(layer)) => {
                let density = layer.density.at(x);
                let pressure = match self.material {
                    Material::Isothermal(gas) => gas.pressure(density, ()),
                    Material::Ideal(_) => layer.pressure.at(x),
                };
                State::trusted(density, layer.velocity.at(x), pressure)
            }
            // A scene that was checked has layers.
            (_, None) => State::vacuum(0.0),
        }
    }

    /// The state with the mean mass, momentum and total energy of `[from, to]` at the start, of an ideal gas.
    pub(crate) fn average(&self, gas: IdealGas, from: f64, to: f64) -> State {
        let layers = self.layers();
        let inside = |x: f64| from < x && x < to;
        let edges = &layers[..layers.len().saturating_sub(1)];
        let uniform = |x: f64| self.layer(x).and_then(Layer::state);
        let middle = 0.5 * (from + to);
        if !edges.iter().any(|layer| inside(layer.to))
            && let Some(state) = uniform(middle)
        {
            return state;
        }
        let mut ends = vec![from];
        ends.extend(edges.iter().map(|layer| layer.to).filter(|edge| inside(*edge)));
        ends.push(to);
        let mut mean = [0.0; 3];
        for piece in ends.windows(2) {
            let (middle, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
            let mut add = |x: f64, weight: f64| {
                let value = conserved_density(gas, &self.initial(x));
                for (sum, part) in mean.iter_mut().zip(value) {
                    *sum += weight * part / (to - from);
                }
            };
            if uniform(middle).is_some() {
                add(middle, 2.0 * half);
            } else {
                // The error is of the tenth order in the width.
                for (node, weight) in GAUSS {
                    add(middle + half * node, half * weight);
                }
            }
        }
        mean_state(gas, mean)
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
    if rho == 0.0 {
        return State::vacuum(0.0);
    }
    let v = momentum / rho;
    State::trusted(rho, v, (gas.gamma() - 1.0) * (energy - 0.5 * momentum * v))
}

#[cfg(test)]
mod tests;
