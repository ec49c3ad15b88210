//! Figures 3 to 21, one for each method and test.

use super::{text, tubes};
use crate::gas_run;
use crate::number::significant;
use crate::page::{Item, Section};
use crate::particle_profile::{profile_csv, profile_figure};
use crate::study::riemann_run::RiemannRun;
use crate::words;
use courant_simulation::run::Run;

/// One section for each test. The paper has no figure of a run that fails; neither is there one here.
pub fn sections(runs: &[RiemannRun]) -> Vec<Section> {
    let mut number = 3;
    let of_tests = runs.chunk_by(|one, next| one.test == next.test);
    of_tests
        .map(|of_test| {
            let mut items = Vec::new();
            for run in of_test {
                match run.run.failure {
                    None => {
                        items.push(figure(run, number));
                        number += 1;
                    }
                    Some(failure) => items.push(text().paragraph(
                        "run_failed",
                        words![
                            "method" = run.method.title(),
                            "test" = run.test,
                            "particles" = run.run.profile.len(),
                            "settings" = gas_run::settings(&run.method),
                            "failure" = failure,
                        ],
                    )),
                }
            }
            Section { title: format!("Test {}", of_test[0].test), items }
        })
        .collect()
}

fn figure(run: &RiemannRun, number: usize) -> Item {
    let RiemannRun { test, method, tube, run, comparison } = run;
    let title = format!("Figure {number}. Test {test}: {}", method.title());
    let kind = if !run.profile.mass.is_empty() { "particles" } else { "cells" };
    let name = format!("figure_{number:02}");
    let caption = text().text(
        "figure_caption",
        words![
            "title" = title,
            "time" = tube.end_time,
            "particles" = tubes().particles,
            "kind" = kind,
            "settings" = gas_run::settings(method),
            "steps" = run.steps,
            "followed" = followed(run),
            "inside" = comparison.inside,
            "error" = significant(comparison.l1.density, 3),
        ],
    );
    let data = vec![(format!("{name}.csv"), profile_csv(tube, run, true))];
    let figure = profile_figure(tube, run, true).title(&title);
    let command = format!("courant run ferrari{test} --method {}", method.name());
    text().figure(&name, words!["caption" = caption], figure, data).made_by(command)
}

/// Where gas flows in, particles wait outside and follow: there are more in the end than in the domain at the start.
fn followed(run: &Run) -> String {
    match run.waiting.iter().sum::<usize>() {
        0 => String::new(),
        waiting => text().text("figure_followed", words!["waiting" = waiting]),
    }
}
