//! Figure 2: both tests, both schemes, one and five periods.

use super::super::{COMMAND, Detail, ReportError};
use crate::advection_profile::{exact_line, profile_markers};
use crate::figure::{Axis, Color, Figure, Marker, Panel};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::table::{Align, Table};
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::{
    AdvectionRun, AdvectionScheme, Layout, Method, RunPlan, Scene, run,
};
use std::fmt::Write;

const SCHEMES: [(AdvectionScheme, Marker, Color); 2] = [
    (AdvectionScheme::LaxWendroffSph, Marker::Diamond, Color::VERMILION),
    (AdvectionScheme::GodunovSph, Marker::Circle, Color::BLUE),
];

/// The scene, the periods travelled, and the run of each scheme.
type Case = (Scene, u32, Vec<(RunPlan, AdvectionRun)>);

fn cases() -> Vec<Case> {
    let runs = |scene: &Scene, periods: u32| {
        SCHEMES.map(|(scheme, ..)| {
            let method =
                Method { scheme, kernel: Kernel::CubicSpline, ratio: 2.0, courant_number: 1.0 };
            let plan = RunPlan {
                scene: scene.clone(),
                method,
                particles: 200,
                periods: f64::from(periods),
                layout: Layout::Uniform,
            };
            let result = run(&plan).expect("the numbers of the plan are in range");
            (plan, result)
        })
    };
    let scenes = [Scene::Step, Scene::Gaussian];
    let pairs = scenes.into_iter().flat_map(|scene| [1, 5].map(|periods| (scene.clone(), periods)));
    pairs
        .map(|(scene, periods)| {
            let runs = runs(&scene, periods).into();
            (scene, periods, runs)
        })
        .collect()
}

/// These runs take milliseconds and are the same in a quick report.
pub(super) fn section(_detail: Detail) -> Result<Section, ReportError> {
    let cases = cases();
    let courant = cases[0].2[0].1.courant_number;
    let figure = cases
        .iter()
        .enumerate()
        .fold(Figure::grid(2, 2).size(7.2, 5.6), |figure, (k, case)| figure.panel(panel(k, case)));
    let figure = Item::Figure {
        name: "figure_02".into(),
        figure: Box::new(figure.legend_below()),
        caption: format!(
            "Figure 2. Linear advection of a step (2.28) and of a smooth hump (2.29) over one and five periods \
             of the unit interval: 200 particles, C = {courant}, cubic spline, l/Δξ = 2, neighbours found among the \
             particles. The paper states neither kernel nor ratio nor Courant number for this figure; these are \
             choices, and `courant run advection-step --method godunov-sph --kernel K --ratio R --cfl C \
             --periods P` draws it for others."
        ),
        data: cases.iter().map(data_file).collect(),
        command: COMMAND.into(),
    };
    let table = Item::Table {
        name: "figure_02_norms".into(),
        table: norms(&cases),
        command: COMMAND.into(),
    };
    Ok(Section {
        title: "Figure 2: a step and a smooth hump after one and five periods".into(),
        items: vec![figure, table, Item::Paragraph(explanation(&cases))],
    })
}

fn title(scene: &Scene) -> &'static str {
    if *scene == Scene::Step { "step" } else { "smooth hump" }
}

fn panel(index: usize, (scene, periods, runs): &Case) -> Panel {
    let letter = char::from(b'a' + index as u8);
    let periods_text = if *periods == 1 { "1 period" } else { "5 periods" };
    let mut panel =
        Panel::new(Axis::linear("ξ").range(0.0, 1.0), Axis::linear("u").range(0.0, 1.45))
            .title(format!("({letter}) {}, {periods_text}", title(scene)))
            .layer(exact_line(&runs[0].0, f64::from(*periods)));
    for ((plan, result), (_, marker, color)) in runs.iter().zip(SCHEMES) {
        panel = panel.layer(
            profile_markers(result, marker, color)
                .open()
                .size(2.6)
                .width(0.6)
                .label(plan.method.scheme.title()),
        );
    }
    panel
}

fn data_file((scene, periods, runs): &Case) -> (String, Vec<u8>) {
    let mut text = String::from("position,exact,lax_wendroff_sph,godunov_sph\n");
    let (_, first) = &runs[0];
    for (i, position) in first.positions.iter().enumerate() {
        let values: Vec<String> = runs.iter().map(|(_, run)| run.computed[i].to_string()).collect();
        writeln!(text, "{position},{},{}", first.exact[i], values.join(","))
            .expect("writing to a string succeeds");
    }
    (format!("figure_02_{}_{periods}.csv", scene.name()), text.into_bytes())
}

fn norms(cases: &[Case]) -> Table {
    let mut table = Table::new(
        "Errors of the runs of Figure 2; the exact profiles lie in [0.25, 1] and [0.25, 1.25]",
        &[
            ("test", Align::Left),
            ("periods", Align::Right),
            ("scheme", Align::Left),
            ("L1", Align::Right),
            ("L2", Align::Right),
            ("L∞", Align::Right),
            ("total variation", Align::Right),
            ("exact", Align::Right),
            ("smallest", Align::Right),
            ("largest", Align::Right),
        ],
    );
    for (scene, periods, runs) in cases {
        for (plan, run) in runs {
            let seen = &run.comparison;
            table.push([
                title(scene).to_string(),
                periods.to_string(),
                plan.method.scheme.title().into(),
                significant(seen.l1, 4),
                significant(seen.l2, 4),
                significant(seen.l_infinity, 4),
                significant(seen.total_variation, 4),
                significant(seen.exact_total_variation, 4),
                significant(seen.extrema.min, 4),
                significant(seen.extrema.max, 4),
            ]);
        }
    }
    table
}

fn explanation(cases: &[Case]) -> String {
    let step = |scheme: AdvectionScheme| {
        let (_, _, runs) = &cases[1];
        let found = runs.iter().find(|(plan, _)| plan.method.scheme == scheme);
        &found.expect("both schemes were run").1.comparison
    };
    let (lax_wendroff, godunov) =
        (step(AdvectionScheme::LaxWendroffSph), step(AdvectionScheme::GodunovSph));
    format!(
        "Godunov SPH stays within the data, as a monotone scheme must (its monotonicity limit here is C = 8/5): \
         the step after five periods lies in [{}, {}] and its total variation is {} of the exact one. \
         Lax–Wendroff SPH is sharper and overshoots: [{}, {}], total variation {} times the exact one.",
        significant(godunov.extrema.min, 4),
        significant(godunov.extrema.max, 4),
        significant(godunov.total_variation / godunov.exact_total_variation, 3),
        significant(lax_wendroff.extrema.min, 4),
        significant(lax_wendroff.extrema.max, 4),
        significant(lax_wendroff.total_variation / lax_wendroff.exact_total_variation, 3),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn godunov_is_monotone_and_lax_wendroff_is_not() {
        for (scene, periods, runs) in cases() {
            let [(_, lax_wendroff), (_, godunov)] = &runs[..] else { panic!("two schemes") };
            let (seen, exact) = (godunov.comparison.extrema, godunov.comparison.exact_extrema);
            // A convex combination of the data leaves their range by rounding only.
            assert!(seen.min >= exact.min - 1e-13 && seen.max <= exact.max + 1e-13, "{periods}");
            if scene == Scene::Step {
                assert!(lax_wendroff.comparison.extrema.max > 1.02);
            } else {
                assert!(lax_wendroff.comparison.l1 < godunov.comparison.l1);
            }
        }
    }
}
