//! Tubes and methods that figures and tables compare: a panel for each tube, a look for each method.

use super::plan::letter;
use super::riemann_run::{RiemannRun, compare};
use crate::figure::{Color, Marker, Panel, Series};
use courant_simulation::method::Method;
use courant_simulation::run::{Failure, Run};
use courant_simulation::scene::Scene;
use rayon::prelude::*;
use serde::Deserialize;

/// What is compared.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tubes {
    /// The first part of the names of all items.
    pub name: String,
    /// The tubes: what each is called, and its scene.
    pub tests: Vec<(String, String)>,
    /// The methods.
    pub methods: Vec<String>,
    /// Particles of the runs that are shown.
    pub particles: usize,
    /// What figures of all methods have in common.
    pub settings: String,
}

/// A scene by its name.
///
/// # Panics
/// When there is none: a fault of the file that names it.
pub fn tube(name: &str) -> Scene {
    Scene::named(name).unwrap_or_else(|| panic!("there is no scene {name}"))
}

/// A method with its default options by its name.
///
/// # Panics
/// As [`tube`].
pub fn method(name: &str) -> Method {
    Method::named(name).unwrap_or_else(|| panic!("there is no method {name}"))
}

impl Tubes {
    /// Every tube with every method.
    pub fn cases(&self) -> impl Iterator<Item = (usize, usize)> {
        let methods = self.methods.len();
        (0..self.tests.len()).flat_map(move |test| (0..methods).map(move |method| (test, method)))
    }

    /// The scene of a test.
    pub fn scene(&self, test: usize) -> Scene {
        tube(&self.tests[test].1)
    }

    /// Runs everything, test by test.
    pub fn runs(&self) -> Vec<RiemannRun> {
        let run = |(test, name): (usize, usize)| {
            let method = method(&self.methods[name]);
            RiemannRun::new(&self.tests[test].0, self.scene(test), method, self.particles)
        };
        self.cases().collect::<Vec<_>>().into_par_iter().map(run).collect()
    }

    /// The name of an item.
    pub(super) fn item(&self, what: &str) -> String {
        format!("{}_{what}", self.name)
    }

    /// The title of the panel of a test.
    pub(super) fn panel_title(&self, test: usize) -> String {
        format!("{}test {}", letter(test), self.tests[test].0)
    }

    /// A line with markers for one of the methods.
    pub(super) fn curve(&self, panel: Panel, index: usize, points: Vec<(f64, f64)>) -> Panel {
        if points.is_empty() {
            return panel;
        }
        let title = method(&self.methods[index]).title();
        let color = Color::qualitative(index);
        panel
            .layer(Series::line(points.iter().copied()).color(color).width(0.9).label(title))
            .layer(
                Series::markers(points, Marker::nth(index))
                    .color(color)
                    .fill(Color::WHITE)
                    .size(3.6)
                    .label(title),
            )
    }
}

/// `Σ|e|/N` of the density, or why there is none.
pub(super) fn density_error(tube: &Scene, run: &Run) -> Result<f64, Failure> {
    match run.failure {
        Some(failure) => Err(failure),
        None => Ok(compare(tube, run).l1.density),
    }
}

/// The outcome of a run as two comma-separated values, one of them empty.
pub(super) fn error_or_failure(outcome: &Result<f64, Failure>) -> String {
    match outcome {
        Ok(error) => format!("{error:.10e},"),
        Err(failure) => format!(",{failure}"),
    }
}
