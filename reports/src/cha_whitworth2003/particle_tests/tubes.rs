//! Figures 11–26: four Riemann problems with each Godunov case.

use super::COMMAND;
use super::runs::{Runs, Solved};
use crate::page::{Item, Section};
use crate::particle_profile::{method_title, profile_csv, profile_figure};
use courant_simulation::particles::ParticleMethod;

/// Four figures, one for each case.
pub(super) struct Tube {
    scene: &'static str,
    first: usize,
    title: &'static str,
    initial: &'static str,
}

pub(super) const SOD: Tube = Tube {
    scene: "sod-sph",
    first: 11,
    title: "5.2 Shock tube",
    initial: "(ρ, v, P) = (1, 0, 1 | 0.25, 0, 0.1795), γ = 1.4",
};

pub(super) const BLAST: Tube = Tube {
    scene: "strong-blast",
    first: 15,
    title: "5.3 Strong blast wave",
    initial: "(ρ, v, P) = (1, 0, 3e3 | 1, 0, 1e-7), γ = 1.4; density, pressure and energy on logarithmic axes",
};

pub(super) const ISOTHERMAL: Tube = Tube {
    scene: "isothermal-tube",
    first: 19,
    title: "5.4 Isothermal shock tube",
    initial: "(ρ, v) = (1, 0 | 0.25, 0), c = 1",
};

pub(super) const SJOGREEN: Tube = Tube {
    scene: "sjogreen",
    first: 23,
    title: "5.5 Sjögreen's test",
    initial: "(ρ, v, P) = (1, ∓2, 0.4), γ = 1.4",
};

const CASES: [ParticleMethod; 4] =
    [ParticleMethod::Gph1, ParticleMethod::Gph2, ParticleMethod::Gph3, ParticleMethod::Gph4];

pub(super) fn section(runs: &Runs, tube: Tube) -> Section {
    let figures = CASES.iter().enumerate().map(|(k, &method)| {
        let number = tube.first + k;
        let solved = runs.get(tube.scene, method);
        let Solved { scene, options, run } = solved;
        let outcome = match run.failure {
            None => format!("t = {}", run.time),
            Some(failure) => format!("the run broke down ({failure})"),
        };
        let name = format!("figure_{number:02}");
        Item::Figure {
            figure: Box::new(
                profile_figure(scene, run, solved.has_exact())
                    .title(format!("{}, {}, {outcome}", &tube.title[4..], method_title(method))),
            ),
            caption: format!(
                "Figure {number}. {}, GPH case {}: {}, {outcome}, {} particles; {}. Line: exact solution.",
                &tube.title[4..],
                k + 1,
                tube.initial,
                run.profile.len(),
                Solved::settings(options),
            ),
            data: vec![(format!("{name}.csv"), profile_csv(scene, run, solved.has_exact()))],
            name,
            command: COMMAND.into(),
        }
    });
    Section { title: tube.title.into(), items: figures.collect() }
}
