//! The runs behind the figures: four tests, five methods, 100 particles or cells.

use courant_simulation::comparison::{Comparison, WaveKind};
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
    fn new(test: usize, name: &str) -> Self {
        let (tube, method) = (tube(test), method(name));
        let run = method.run(&tube, PARTICLES).expect("the default options are valid");
        let comparison = Comparison::new(&tube, &run);
        Self { test, method, tube, run, comparison }
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
        Self(cases.into_par_iter().map(|(test, name)| TestRun::new(test, name)).collect())
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

    /// The finite-volume run of a test.
    pub fn volumes(&self, test: usize) -> &TestRun {
        self.get(test, "finite-volume")
    }

    /// The run of a test with standard SPH.
    pub fn standard(&self, test: usize) -> &TestRun {
        self.get(test, "sph-adke")
    }

    /// A measure of the exact, Rusanov and Roe runs of a test; NaN where there is none.
    pub fn lagrangian(&self, test: usize, measure: impl Fn(&TestRun) -> f64) -> [f64; 3] {
        LAGRANGIAN.map(|name| measure(self.get(test, name)))
    }
}
