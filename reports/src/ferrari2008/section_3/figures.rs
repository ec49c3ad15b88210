//! Figures 3 to 21, one for each method and test.

use super::runs::{METHODS, PARTICLES, Runs, TestRun};
use crate::gas_run;
use crate::number::significant;
use crate::page::{Item, Section};
use crate::particle_profile::{profile_csv, profile_figure};
use courant_simulation::run::Run;

/// One section for each test. The paper has no figure of a run that fails; neither is there one here.
pub fn sections(runs: &Runs) -> Vec<Section> {
    let mut number = 3;
    (1..=4)
        .map(|test| {
            let mut items = Vec::new();
            for name in METHODS {
                let run = runs.get(test, name);
                match run.run.failure {
                    None => {
                        items.push(figure(run, number));
                        number += 1;
                    }
                    Some(failure) => items.push(Item::Paragraph(format!(
                        "{} fails on test {test} with N = {} ({}): {failure}. The paper reports the \
                         failure and shows no figure either.",
                        gas_run::method_title(name),
                        run.run.profile.len(),
                        gas_run::settings(&run.method),
                    ))),
                }
            }
            Section { title: format!("Test {test}"), items }
        })
        .collect()
}

fn figure(run: &TestRun, number: usize) -> Item {
    let TestRun { test, method, tube, run, comparison } = run;
    let title = format!("Figure {number}. Test {test}: {}", gas_run::method_title(method.name()));
    let kind = if !run.profile.mass.is_empty() { "particles" } else { "cells" };
    let name = format!("figure_{number:02}");
    Item::Figure {
        figure: Box::new(profile_figure(tube, run, true).title(&title)),
        caption: format!(
            "{title}, t = {}. N = {PARTICLES} {kind}, γ = 1.4; {}; {} steps.{} {} {kind} are inside the \
             domain at the end; Σ|e|/N of the density over these: {}. Symbols: run; line: exact.",
            tube.end_time,
            gas_run::settings(method),
            run.steps,
            followed(run),
            comparison.inside,
            significant(comparison.l1.density, 3),
        ),
        data: vec![(format!("{name}.csv"), profile_csv(tube, run, true))],
        command: format!("courant run ferrari{test} --method {}", method.name()),
        name,
    }
}

/// Where gas flows in, particles wait outside and follow: there are more in the end than in the domain at the start.
fn followed(run: &Run) -> String {
    match run.waiting.iter().sum::<usize>() {
        0 => String::new(),
        waiting => format!(" {waiting} more started outside, to follow where gas flows in."),
    }
}
