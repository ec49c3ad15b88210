//! The runs behind the figures: four tests, five methods, 100 particles or cells.

use courant_simulation::comparison::{Comparison, WaveKind};
use courant_simulation::lagrangian::flux::{ContactViscosity, Flux};
use courant_simulation::method::Method;
use courant_simulation::run::Run;
use courant_simulation::scene::{Scene, ShockTube};
use rayon::prelude::*;

/// The paper's number of points.
pub const PARTICLES: usize = 100;

/// The three Lagrangian methods.
pub const LAGRANGIAN: [&str; 3] = ["lagrangian-exact", "lagrangian-rusanov", "lagrangian-roe"];

/// A test of Table 2.
pub fn tube(test: usize) -> ShockTube {
    ShockTube::standard(&format!("ferrari{test}")).expect("tests 1 to 4 are standard tubes")
}

/// A method of the paper with the default options.
pub fn method(name: &str) -> Method {
    Method::named(name).expect("it is one of the five")
}

/// One run of one test.
#[derive(Debug, Clone)]
pub struct TestRun {
    /// 1 to 4.
    pub test: usize,
    /// The method.
    pub method: Method,
    /// The scene.
    pub tube: ShockTube,
    /// What came out.
    pub run: Run,
    /// Against the exact solution at the time reached.
    pub comparison: Comparison,
}

impl TestRun {
    fn new(test: usize, method: Method) -> Self {
        let tube = tube(test);
        let run = method.run(&tube, PARTICLES).expect("the default options are valid");
        let comparison = Comparison::new(&tube, &run);
        Self { test, method, tube, run, comparison }
    }

    /// A Lagrangian method with one option set: `cfl=0.01`, or for the modified Roe flux the contact viscosity
    /// `alpha=0.4`.
    pub fn with_option(test: usize, name: &str, option: &str) -> Option<Self> {
        let (key, value) = option.split_once('=')?;
        let value = value.parse().ok()?;
        let Method::Lagrangian(mut options) = method(name) else { return None };
        match (key, &mut options.flux) {
            ("cfl", _) => options.cfl = value,
            ("alpha", Flux::ModifiedRoe(roe)) => roe.contact = ContactViscosity::Printed(value),
            _ => return None,
        }
        Some(Self::new(test, Method::Lagrangian(options)))
    }

    /// How many particles that started in the domain are still there. Those that came in do not count.
    pub fn left_in_domain(&self) -> usize {
        let [from, to] = self.tube.domain();
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

/// All of them.
pub struct Runs(Vec<TestRun>);

impl Runs {
    /// Runs everything.
    pub fn at_100_particles() -> Self {
        let cases: Vec<(usize, &str)> =
            (1..=4).flat_map(|test| Method::NAMES.map(|name| (test, name))).collect();
        Self(cases.into_par_iter().map(|(test, name)| TestRun::new(test, method(name))).collect())
    }

    /// All, test by test, in the order of the figures.
    pub fn all(&self) -> &[TestRun] {
        &self.0
    }

    /// One of them.
    pub fn get(&self, test: usize, name: &str) -> &TestRun {
        let mut all = self.0.iter();
        all.find(|run| run.test == test && run.method.name() == name)
            .expect("every test was run with every method")
    }
}
