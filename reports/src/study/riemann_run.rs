//! Runs of Riemann problems of ideal gases beside their exact solutions.

use courant_simulation::comparison::{Comparison, WaveKind};
use courant_simulation::lagrangian::flux::{ContactViscosity, Flux};
use courant_simulation::method::Method;
use courant_simulation::riemann::{IdealGas, Solution, State};
use courant_simulation::run::Run;
use courant_simulation::scene::Scene;

/// The gas of a tube.
///
/// # Panics
/// Like all functions here, when the scene is no Riemann problem of an ideal gas.
pub fn gas(tube: &Scene) -> IdealGas {
    tube.material.ideal().expect("the gas of the tubes is ideal")
}

/// Its two states.
pub fn states(tube: &Scene) -> [State; 2] {
    let (left, right, _) = tube.two_states().expect("a tube has two states");
    [left, right]
}

/// Its exact solution.
pub fn exact(tube: &Scene, x: f64, time: f64) -> State {
    tube.exact(x, time).expect("a tube is a Riemann problem")
}

/// The solution along rays from the diaphragm, and where that is.
pub fn solution(tube: &Scene) -> (Solution, f64) {
    tube.riemann().expect("a tube is a Riemann problem")
}

/// A run against it.
pub fn compare(tube: &Scene, run: &Run) -> Comparison {
    Comparison::new(tube, run).expect("a tube is a Riemann problem")
}

/// `max C` of the star states over `max C` of the initial ones, `C = ρc` the Lagrangian speed of sound: how much shorter
/// steps must become.
pub fn sound_growth(tube: &Scene) -> f64 {
    let gas = gas(tube);
    let (solution, _) = solution(tube);
    let (left, right) = solution.densities();
    let sound = |density, pressure| gas.lagrangian_sound_speed(density, pressure);
    let first = states(tube).map(|state| sound(state.density(), state.pressure()));
    let star = sound(left, solution.pressure()).max(sound(right, solution.pressure()));
    star / first[0].max(first[1])
}

/// A tube, a method and what came of them.
#[derive(Debug, Clone)]
pub struct RiemannRun {
    /// What the tube is called.
    pub test: String,
    /// The scene.
    pub tube: Scene,
    /// The method.
    pub method: Method,
    /// What came out.
    pub run: Run,
    /// Against the exact solution at the time reached.
    pub comparison: Comparison,
}

impl RiemannRun {
    /// Runs a method with valid options.
    pub fn new(test: &str, tube: Scene, method: Method, particles: usize) -> Self {
        let run = method.run(&tube, particles).expect("the options are valid");
        let comparison = compare(&tube, &run);
        Self { test: test.into(), tube, method, run, comparison }
    }

    /// How many particles that started in the domain are still there. Those that came in do not count.
    pub fn left_in_domain(&self) -> usize {
        let [from, to] = self.tube.domain;
        let profile = &self.run.profile;
        let [before, behind] = self.run.waiting;
        let inside = before..profile.len() - behind;
        profile.x[inside].iter().filter(|x| (from..=to).contains(*x)).count()
    }

    /// The distance of the contact from its exact place; `None` if it is not found.
    pub fn contact_error(&self) -> Option<f64> {
        let mut waves = self.comparison.waves.iter();
        waves.find(|wave| wave.kind == WaveKind::Contact)?.error().map(f64::abs)
    }
}

/// A Lagrangian method with one option set: `cfl=0.01`, or for the modified Roe flux the contact viscosity `alpha=0.4`.
pub fn with_option(method: Method, option: &str) -> Option<Method> {
    let (key, value) = option.split_once('=')?;
    let value = value.parse().ok()?;
    let Method::Lagrangian(mut options) = method else { return None };
    match (key, &mut options.flux) {
        ("cfl", _) => options.cfl = value,
        ("alpha", Flux::ModifiedRoe(roe)) => roe.contact = ContactViscosity::Printed(value),
        _ => return None,
    }
    Some(Method::Lagrangian(options))
}
