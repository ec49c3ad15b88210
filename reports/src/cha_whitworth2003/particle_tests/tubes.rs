//! Figures 11–26: four Riemann problems with each Godunov case.

use super::runs::{Runs, Solved};
use super::{CASES, text};
use crate::page::Section;
use crate::particle_profile::{profile_csv, profile_figure};
use crate::words;

/// The scene of four figures, one for each case: the number of the first, and the states on both sides.
pub(super) type Tube = (&'static str, usize, &'static str);

pub(super) const ALL: [Tube; 4] = [
    ("sod-sph", 11, "(ρ, v, P) = (1, 0, 1 | 0.25, 0, 0.1795), γ = 1.4"),
    (
        "strong-blast",
        15,
        "(ρ, v, P) = (1, 0, 3e3 | 1, 0, 1e-7), γ = 1.4; density, pressure and energy on logarithmic axes",
    ),
    ("isothermal-tube", 19, "(ρ, v) = (1, 0 | 0.25, 0), c = 1"),
    ("sjogreen", 23, "(ρ, v, P) = (1, ∓2, 0.4), γ = 1.4"),
];

pub(super) fn section(runs: &Runs, (scene, first, initial): Tube) -> Section {
    let title = format!("title_tube_{first}");
    // The title less its number in the paper.
    let of = text().text(&title, &[])[4..].to_string();
    let figures = CASES.iter().enumerate().map(|(k, &method)| {
        let number = first + k;
        let solved = runs.get(scene, method);
        let Solved { scene, options, run, .. } = solved;
        let outcome = match run.failure {
            None => format!("t = {}", run.time),
            Some(failure) => format!("the run broke down ({failure})"),
        };
        let name = format!("figure_{number:02}");
        let caption = text().text(
            "tube_caption",
            words![
                "number" = number,
                "title" = of,
                "case" = k + 1,
                "initial" = initial,
                "outcome" = outcome,
                "particles" = run.profile.len(),
                "settings" = Solved::settings(options),
            ],
        );
        let data = vec![(format!("{name}.csv"), profile_csv(scene, run, solved.has_exact()))];
        let figure = profile_figure(scene, run, solved.has_exact())
            .title(format!("{of}, {}, {outcome}", method.title()));
        text().figure(&name, words!["caption" = caption], figure, data)
    });
    text().section(&title, figures.collect())
}
