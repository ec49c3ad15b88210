//! Courant number against error and failure, for each Lagrangian method and tube.

use super::linear_theory::{describe, limits_of_sound};
use super::plan::{ByDetail, Named};
use super::riemann_run::sound_growth;
use super::tubes::{Tubes, density_error, error_or_failure, method, tube};
use crate::cells;
use crate::figure::{Axis, Color, Dash, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::{PaperText, csv, or_dash};
use crate::report::Detail;
use courant_analysis::exact::rational::Rational;
use courant_analysis::kernel::Kernel;
use courant_simulation::lagrangian::StepRule;
use courant_simulation::method::Method;
use courant_simulation::run::Failure;
use rayon::prelude::*;
use serde::Deserialize;

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    /// The Lagrangian ones of the methods.
    methods: Vec<String>,
    /// Courant numbers are multiples of this, up to 3.
    step: ByDetail<f64>,
    /// The kernel and the ratio of all runs, for the limits of linear theory.
    kernel: Named<Kernel>,
    ratio: Named<Rational>,
    /// What all runs have in common.
    settings: String,
}

/// The largest Courant number.
const MOST: f64 = 3.0;
/// Halvings of the interval between the last run that ended and the first that failed.
const HALVINGS: usize = 5;

/// One Lagrangian method on one tube with one step rule.
struct Case<'a> {
    tubes: &'a Tubes,
    test: usize,
    /// Its place among all methods.
    method: usize,
    step: StepRule,
}

impl Case<'_> {
    fn run(&self, cfl: f64) -> Result<f64, Failure> {
        let tube = tube(&self.tubes.tests[self.test].1);
        let mut method = method(&self.tubes.methods[self.method]);
        if let Method::Lagrangian(options) = &mut method {
            options.cfl = cfl;
            options.step = self.step;
        }
        let run = method.run(&tube, self.tubes.particles).expect("the options are valid");
        density_error(&tube, &run)
    }
}

/// All runs of a case.
struct Curve<'a> {
    of: Case<'a>,
    /// Courant numbers with errors.
    points: Vec<(f64, Result<f64, Failure>)>,
    /// The first failure from below, and how precisely it is known.
    threshold: Option<(f64, f64, Failure)>,
}

impl<'a> Curve<'a> {
    fn new(of: Case<'a>, grid: &[f64]) -> Self {
        let points: Vec<_> = grid.iter().map(|&cfl| (cfl, of.run(cfl))).collect();
        let first = points.iter().position(|(_, result)| result.is_err());
        let threshold = first.map(|index| {
            let mut low = if index == 0 { 0.0 } else { points[index - 1].0 };
            let (mut high, result) = points[index];
            let mut failure = result.expect_err("this is where it failed");
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                match of.run(middle) {
                    Ok(_) => low = middle,
                    Err(found) => (high, failure) = (middle, found),
                }
            }
            (low, high, failure)
        });
        Self { of, points, threshold }
    }

    /// The smallest error of the runs that ended.
    fn best(&self) -> Option<(f64, f64)> {
        let ended = self.points.iter().filter_map(|(cfl, result)| Some((*cfl, result.ok()?)));
        ended.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The largest Courant number up to which the error stays within 1.2 times that of small steps.
    fn accurate(&self) -> Option<f64> {
        let reference = Case { step: StepRule::Current, ..self.of }.run(0.1).ok()?;
        let good =
            |result: &Result<f64, Failure>| result.is_ok_and(|error| error <= 1.2 * reference);
        let end = self.points.iter().position(|(_, result)| !good(result));
        let count = end.unwrap_or(self.points.len());
        Some(self.points[..count].last()?.0)
    }
}

/// Figure and table.
pub fn items(text: &PaperText, tubes: &Tubes, detail: Detail) -> Vec<Item> {
    let plan: Plan = text.plan("courant");
    let step = *plan.step.at(detail);
    let grid: Vec<f64> = (1..=(MOST / step) as usize).map(|i| i as f64 * step).collect();
    let chosen = |&(_, method): &(usize, usize)| plan.methods.contains(&tubes.methods[method]);
    let cases = tubes.cases().filter(chosen).flat_map(|(test, method)| {
        [StepRule::Current, StepRule::Initial].map(|step| Case { tubes, test, method, step })
    });
    let cases: Vec<Case<'_>> = cases.collect();
    let curves: Vec<Curve<'_>> =
        cases.into_par_iter().map(|case| Curve::new(case, &grid)).collect();
    let [stable, _] = limits_of_sound(plan.kernel.0, &plan.ratio.0);
    let rows = curves.iter().map(|one| row(stable.value(), one));
    vec![figure(text, tubes, &plan, &curves), text.table(&tubes.item("courant_limits"), &[], rows)]
}

fn figure(text: &PaperText, tubes: &Tubes, plan: &Plan, curves: &[Curve<'_>]) -> Item {
    let mut figure =
        Figure::grid(tubes.tests.len().div_ceil(2), 2).size(7.0, 6.0).title(&plan.settings);
    let mut lines = Vec::new();
    let [stable, monotone] = limits_of_sound(plan.kernel.0, &plan.ratio.0);
    for (test, (test_name, _)) in tubes.tests.iter().enumerate() {
        let mut panel = Panel::new(
            Axis::linear("Courant number of sound, ρcΔt/Δξ").range(0.0, MOST + 0.05),
            Axis::log("Σ|e|/N of ρ").range(7e-3, 12.0),
        )
        .title(tubes.panel_title(test))
        .layer(
            Series::vertical(monotone.value())
                .dash(Dash::Dashed)
                .label(format!("monotone up to {}", describe(&monotone))),
        )
        .layer(
            Series::vertical(stable.value())
                .color(Color::BLACK)
                .dash(Dash::Dashed)
                .label(format!("stable up to {}", describe(&stable))),
        );
        let of_test = curves.iter().filter(|one| one.of.test == test);
        for one in of_test.clone() {
            let name = &tubes.methods[one.of.method];
            for (cfl, result) in &one.points {
                let step = format!("{:?}", one.of.step);
                lines.push(cells![test_name, name, step, cfl, error_or_failure(result)]);
            }
        }
        for one in of_test.filter(|one| one.of.step == StepRule::Current) {
            let ended: Vec<(f64, f64)> =
                one.points.iter().map_while(|(cfl, result)| Some((*cfl, result.ok()?))).collect();
            let last = ended.last().copied();
            panel = tubes.curve(panel, one.of.method, ended);
            if let (Some((_, high, _)), Some((_, error))) = (&one.threshold, last) {
                panel = panel.layer(
                    Series::markers([(*high, error)], Marker::Cross)
                        .size(6.0)
                        .width(1.4)
                        .label("fails from here on"),
                );
            }
        }
        figure = figure.panel(panel);
    }
    let data = csv("test,method,step,cfl,l1_density,failure", lines);
    let name = tubes.item("courant");
    text.figure(&name, &[], figure, vec![(format!("{name}.csv"), data)])
}

fn row(stable: f64, one: &Curve<'_>) -> Vec<String> {
    let Case { tubes, test, method, step } = one.of;
    let (rule, limit) = match step {
        StepRule::Current => ("current state", stable),
        StepRule::Initial => ("initial data", stable / sound_growth(&tubes.scene(test)).max(1.0)),
    };
    let end = one.points.last().map_or(0.0, |point| point.0);
    let (from, reason) = match &one.threshold {
        Some((low, high, failure)) => (format!("{low:.3}–{high:.3}"), failure.to_string()),
        None => (format!("above {end:.1}"), String::new()),
    };
    let best = one.best();
    cells![
        tubes.tests[test].0,
        tubes.methods[method],
        rule,
        significant(limit, 3),
        or_dash(one.accurate(), 2),
        from,
        or_dash(best.map(|best| best.1), 3),
        or_dash(best.map(|best| best.0), 2),
        reason,
    ]
}
