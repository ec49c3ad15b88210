//! Scenes of gas dynamics in one dimension, as data: gas, domain, ends, initial state, end time, exact solution.
//!
//! The named scenes are files in the format a user writes; one definition serves tests, benches, examples and
//! reports, whatever the method.

mod exact;
mod file;
mod mass_lattice;
mod named;
mod quantity;
mod simple_wave;

pub use exact::ExactSolution;
pub use file::{InvalidFile, KEYS};
pub(crate) use mass_lattice::MassLattice;
pub use quantity::Quantity;

use crate::boundary::Boundary;
use crate::particles::{Gas, IsothermalGas};
use crate::riemann::{IdealGas, State};
use quantity::GAUSS;

/// The gas of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Material {
    /// No energy equation.
    Isothermal(IsothermalGas),
    /// An ideal gas.
    Ideal(IdealGas),
}

impl Material {
    /// The speed of sound in a state.
    pub fn sound_speed(self, state: &State) -> f64 {
        match self {
            Self::Isothermal(gas) => gas.sound_speed,
            Self::Ideal(gas) => gas.sound_speed(state.density(), state.pressure()),
        }
    }

    /// The ideal gas, if it is one.
    pub fn ideal(self) -> Option<IdealGas> {
        match self {
            Self::Isothermal(_) => None,
            Self::Ideal(gas) => Some(gas),
        }
    }

    /// The specific internal energy of a state; `None` for an isothermal gas and in a vacuum.
    pub fn internal_energy(self, state: &State) -> Option<f64> {
        let gas = self.ideal().filter(|_| !state.is_vacuum())?;
        Some(gas.internal_energy(state.density(), state.pressure()))
    }
}

/// Gas up to an edge. Where the density is 0 there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// The right edge.
    pub to: f64,
    /// Density.
    pub density: Quantity,
    /// Velocity.
    pub velocity: Quantity,
    /// Pressure; of an isothermal gas it follows from the density and this is not looked at.
    pub pressure: Quantity,
}

impl Layer {
    /// One state.
    pub fn uniform(to: f64, state: &State) -> Self {
        let [density, velocity, pressure] =
            [state.density(), state.velocity(), state.pressure()].map(Quantity::Constant);
        Self { to, density, velocity, pressure }
    }

    /// The state, if it is one.
    pub fn state(&self) -> Option<State> {
        let (density, velocity) = (self.density.constant()?, self.velocity.constant()?);
        Some(State::trusted(density, velocity, self.pressure.constant()?))
    }

    fn is_vacuum(&self) -> bool {
        self.density.constant() == Some(0.0)
    }
}

/// The gas at the start.
#[derive(Debug, Clone, PartialEq)]
pub enum Flow {
    /// Layers side by side, from left to right.
    Layers(Vec<Layer>),
    /// A sound wave that runs to the right: `ρ = 1 + A sin 2πx`, homentropic, with period 1.
    SimpleWave {
        /// `A`.
        amplitude: f64,
    },
}

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

/// Why numbers are not a scene: the key of the file, and what is wrong with its value.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key}: {problem}")]
pub struct InvalidScene {
    /// The key: `gamma`, `domain`, `left.density`, …
    pub key: &'static str,
    /// What is wrong.
    pub problem: String,
}

impl Scene {
    /// Whether the numbers make sense.
    ///
    /// # Errors
    /// [`InvalidScene`] names the first that does not.
    pub fn check(&self) -> Result<(), InvalidScene> {
        let wrong = |key, problem: String| Err(InvalidScene { key, problem });
        let ascending = |[from, to]: [f64; 2]| from.is_finite() && to.is_finite() && from < to;
        let [from, to] = self.domain;
        if !ascending(self.domain) {
            return wrong(
                "domain",
                format!("[{from}, {to}]: two ascending finite numbers are needed"),
            );
        }
        if !ascending(self.window) {
            let [from, to] = self.window;
            return wrong(
                "window",
                format!("[{from}, {to}]: two ascending finite numbers are needed"),
            );
        }
        if !(self.end_time.is_finite() && self.end_time > 0.0) {
            return wrong(
                "end_time",
                format!("{}: a finite number above 0 is needed", self.end_time),
            );
        }
        if self.particles < MIN_PARTICLES {
            let problem = format!("{}: at least {MIN_PARTICLES} are needed", self.particles);
            return wrong("particles", problem);
        }
        let periodic = self.boundary.map(|end| end == Boundary::Periodic);
        if periodic[0] != periodic[1] {
            return wrong("boundary", "an interval is periodic at both ends or at none".into());
        }
        match &self.flow {
            Flow::SimpleWave { amplitude } => {
                if !(*amplitude > 0.0 && *amplitude < 1.0) {
                    let problem = format!("{amplitude}: a number above 0 and below 1 is needed");
                    return wrong("amplitude", problem);
                }
                if self.domain != [0.0, 1.0] || !periodic[0] || self.material.ideal().is_none() {
                    let problem = "a simple wave is that of an ideal gas on the periodic [0, 1]";
                    return wrong("simple_wave", problem.into());
                }
            }
            Flow::Layers(layers) => {
                let mut edge = from;
                for layer in layers {
                    if layer.to.is_nan() || layer.to <= edge {
                        let problem = format!("{}: a number above {edge} is needed", layer.to);
                        return wrong("to", problem);
                    }
                    edge = layer.to;
                }
                if edge != to {
                    return wrong(
                        "to",
                        format!("{edge}: the last layer ends with the domain, at {to}"),
                    );
                }
                if layers.iter().all(Layer::is_vacuum) {
                    return wrong("density", "0 everywhere: there is no gas".into());
                }
            }
        }
        Ok(())
    }

    /// The customary interval compared: the domain, or where it is periodic a period more on each side, for
    /// particles that drift over the ends.
    fn usual_window([from, to]: [f64; 2], boundary: [Boundary; 2]) -> [f64; 2] {
        let more = if boundary[0] == Boundary::Periodic { to - from } else { 0.0 };
        [from - more, to + more]
    }

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

    /// Layers of gas with their left edges; the whole domain where it has none.
    fn pieces(&self) -> Vec<(f64, f64)> {
        let mut from = self.domain[0];
        let mut pieces = Vec::new();
        for layer in self.layers() {
            if !layer.is_vacuum() {
                pieces.push((from, layer.to));
            }
            from = layer.to;
        }
        if pieces.is_empty() { vec![(self.domain[0], self.domain[1])] } else { pieces }
    }

    /// The mass between two places of one piece.
    fn mass_between(&self, from: f64, to: f64) -> f64 {
        match (&self.flow, self.layer(0.5 * (from + to))) {
            (Flow::SimpleWave { amplitude }, _) => Self::simple_wave_mass(*amplitude, from, to),
            (_, Some(layer)) => layer.density.integral(from, to),
            (_, None) => 0.0,
        }
    }

    /// The mass in the domain at the start.
    pub fn mass(&self) -> f64 {
        self.pieces().iter().map(|&(from, to)| self.mass_between(from, to)).sum()
    }

    /// The mass of each layer of gas.
    pub fn layer_masses(&self) -> Vec<f64> {
        self.pieces().iter().map(|&(from, to)| self.mass_between(from, to)).collect()
    }

    /// The place in a piece with a given mass between it and the left end of the piece.
    fn place_of_mass(&self, (from, to): (f64, f64), mass: f64) -> f64 {
        match self.layer(0.5 * (from + to)).and_then(|layer| layer.density.constant()) {
            Some(density) => from + mass / density,
            None => root(from, to, |x| self.mass_between(from, x) - mass),
        }
    }

    /// The point with the mass `mass` between it and the left end, at the start; beyond the ends the gas goes on.
    pub fn position_at_mass(&self, mass: f64) -> f64 {
        let pieces = self.pieces();
        let mut before = 0.0;
        for (index, &(from, to)) in pieces.iter().enumerate() {
            let own = self.mass_between(from, to);
            let last = index + 1 == pieces.len();
            if mass <= before + own || last {
                return match self.boundary {
                    // Beyond the end of a period comes its start.
                    [Boundary::Periodic, _] => self.place_of_mass((from, to), mass - before),
                    _ if mass < 0.0 => from + mass / self.initial(from).density(),
                    _ if mass > before + own => {
                        to + (mass - before - own) / self.initial(to).density()
                    }
                    _ => self.place_of_mass((from, to), mass - before),
                };
            }
            before += own;
        }
        self.domain[1]
    }

    /// The mass that flows in through each end until the end time. The gas beyond a transmissive end is like that at the end.
    pub fn inflow(&self) -> [f64; 2] {
        let entering = |end: usize, sign: f64| {
            let state = self.initial(self.domain[end]);
            let open = self.boundary[end] == Boundary::Transmissive;
            let speed = if open { (sign * state.velocity()).max(0.0) } else { 0.0 };
            state.density() * speed * self.end_time
        };
        [entering(0, 1.0), entering(1, -1.0)]
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

    /// Positions and masses of about `count` particles in the domain, and how many more stand beyond its left and right end.
    ///
    /// Each layer is filled with a whole number of equal masses, so that no particle straddles an edge. A vacuum
    /// has none. Beyond a transmissive end there is as much gas as can make itself felt until the end time.
    pub fn place(&self, count: usize) -> (Vec<(f64, f64)>, [usize; 2]) {
        let pieces = self.pieces();
        let total = self.mass();
        let share = |mass: f64| (count as f64 * mass / total).round() as usize;
        let (mut placed, mut before) = (Vec::with_capacity(count), 0.0);
        for &(from, to) in &pieces {
            let mass = self.mass_between(from, to);
            let number = (share(before + mass) - share(before)).max(1);
            let own = mass / number as f64;
            placed.extend(
                (0..number).map(|k| (self.place_of_mass((from, to), (k as f64 + 0.5) * own), own)),
            );
            before += mass;
        }
        let mut beyond = [0, 0];
        for (end, beyond) in beyond.iter_mut().enumerate() {
            let (x, mass) = if end == 0 { placed[0] } else { placed[placed.len() - 1] };
            let state = self.initial(self.domain[end]);
            if self.boundary[end] != Boundary::Transmissive || state.is_vacuum() {
                continue;
            }
            let spacing = mass / state.density();
            *beyond = (self.reach_of_end(end) / spacing).ceil() as usize;
            let sign = if end == 0 { -1.0 } else { 1.0 };
            let more = (1..=*beyond).map(|k| (x + sign * k as f64 * spacing, mass));
            if end == 0 {
                placed.splice(0..0, more.rev());
            } else {
                placed.extend(more);
            }
        }
        (placed, beyond)
    }

    /// How many particles [`place`](Self::place) makes, those beyond the ends included.
    pub(crate) fn particles_with_ends(&self, count: usize) -> f64 {
        let beyond = |end: usize| match self.boundary[end] {
            Boundary::Transmissive => {
                self.initial(self.domain[end]).density() * self.reach_of_end(end)
            }
            _ => 0.0,
        };
        count as f64 * (1.0 + (beyond(0) + beyond(1)) / self.mass())
    }

    /// Whether a vacuum lies between two gases.
    pub(crate) fn has_gap(&self) -> bool {
        self.pieces().windows(2).any(|pair| pair[0].1 < pair[1].0)
    }

    /// What the gas meets at its ends: nothing, where a vacuum lies between it and the end.
    pub(crate) fn ends_of_gas(&self) -> [Boundary; 2] {
        [0, 1].map(|end| match self.initial(self.domain[end]).is_vacuum() {
            true => Boundary::Open,
            false => self.boundary[end],
        })
    }

    /// How far beyond an end the gas matters: the way of the fastest signal until the end time.
    fn reach_of_end(&self, end: usize) -> f64 {
        let inward = if end == 0 { 1.0 } else { -1.0 };
        let speed = self
            .sampled_states()
            .iter()
            .map(|state| inward * state.velocity() + self.material.sound_speed(state))
            .fold(0.0, f64::max);
        speed * self.end_time
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

/// The root of a growing function between `low` and `high`, to the last bit.
fn root(mut low: f64, mut high: f64, growing: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        // Also where a bound is no number: that must not loop.
        if middle <= low || middle >= high || middle.is_nan() {
            return middle;
        }
        if growing(middle) < 0.0 { low = middle } else { high = middle }
    }
}

#[cfg(test)]
mod tests;
