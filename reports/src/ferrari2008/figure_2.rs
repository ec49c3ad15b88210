//! Figure 2: both tests, both schemes, one and five periods.

use super::text;
use crate::advection_profile::{exact_line, profile_markers};
use crate::figure::{Axis, Color, Figure, Marker, Panel};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::csv;
use crate::study::plan::discretisation;
use crate::{cells, words};
use courant_analysis::exact::rational::integer;
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::{
    AdvectionRun, AdvectionScene, AdvectionScheme, Layout, RunPlan, run,
};

const SCHEMES: [(AdvectionScheme, Marker, Color); 2] = [
    (AdvectionScheme::LaxWendroffSph, Marker::Diamond, Color::VERMILION),
    (AdvectionScheme::GodunovSph, Marker::Circle, Color::BLUE),
];

/// The scene, the periods travelled, and the run of each scheme.
type Case = (AdvectionScene, u32, Vec<(RunPlan, AdvectionRun)>);

fn cases() -> Vec<Case> {
    let runs = |scene: &AdvectionScene, periods: u32| {
        SCHEMES.map(|(scheme, ..)| {
            let plan = RunPlan {
                scene: AdvectionScene { end_time: f64::from(periods), ..scene.clone() },
                discretisation: discretisation(scheme, Kernel::CubicSpline, &integer(2)),
                courant_number: 1.0,
                particles: 200,
                layout: Layout::Uniform,
            };
            let result = run(&plan).expect("the numbers of the plan are in range");
            (plan, result)
        })
    };
    let scenes = ["advection-step", "advection-gaussian"]
        .map(|name| AdvectionScene::named(name).expect("it is in the list"));
    let pairs = scenes.into_iter().flat_map(|scene| [1, 5].map(|periods| (scene.clone(), periods)));
    pairs
        .map(|(scene, periods)| {
            let runs = runs(&scene, periods).into();
            (scene, periods, runs)
        })
        .collect()
}

/// These runs take milliseconds and are the same in a quick report.
pub fn section() -> Section {
    let cases = cases();
    let courant = cases[0].2[0].1.courant_number;
    let figure = cases
        .iter()
        .enumerate()
        .fold(Figure::grid(2, 2).size(7.2, 5.6), |figure, (k, case)| figure.panel(panel(k, case)));
    let data = cases.iter().map(data_file).collect();
    let items = vec![
        text().figure("figure_02", words!["courant" = courant], figure, data),
        norms(&cases),
        explanation(&cases),
    ];
    text().section("title_figure_2", items)
}

fn title(scene: &AdvectionScene) -> &'static str {
    if scene.name == "advection-step" { "step" } else { "smooth hump" }
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
                .fill(None)
                .size(2.6)
                .width(0.6)
                .label(plan.discretisation.scheme().title()),
        );
    }
    panel
}

fn data_file((scene, periods, runs): &Case) -> (String, Vec<u8>) {
    let (_, first) = &runs[0];
    let rows = first.positions.iter().enumerate().map(|(i, position)| {
        let mut row = cells![position, first.exact[i]];
        row.extend(runs.iter().map(|(_, run)| run.computed[i].to_string()));
        row
    });
    let header = "position,exact,lax_wendroff_sph,godunov_sph";
    (format!("figure_02_{}_{periods}.csv", scene.name), csv(header, rows))
}

fn norms(cases: &[Case]) -> Item {
    let runs = cases.iter().flat_map(|(scene, periods, runs)| {
        runs.iter().map(move |(plan, run)| (scene, periods, plan, &run.comparison))
    });
    let rows = runs.map(|(scene, periods, plan, seen)| {
        let mut row = cells![title(scene), periods, plan.discretisation.scheme().title()];
        let numbers = [
            seen.l1,
            seen.l2,
            seen.l_infinity,
            seen.total_variation,
            seen.exact_total_variation,
            seen.extrema.min,
            seen.extrema.max,
        ];
        row.extend(numbers.map(|number| significant(number, 4)));
        row
    });
    text().table("figure_02_norms", &[], rows)
}

fn explanation(cases: &[Case]) -> Item {
    let [l, g] = SCHEMES.map(|(scheme, ..)| {
        let mut runs = cases[1].2.iter();
        let found = runs.find(|(plan, _)| plan.discretisation.scheme() == scheme);
        &found.expect("both schemes were run").1.comparison
    });
    text().paragraph(
        "figure_02_explanation",
        words![
            "g-least" = significant(g.extrema.min, 4),
            "g-most" = significant(g.extrema.max, 4),
            "g-variation" = significant(g.total_variation / g.exact_total_variation, 3),
            "l-least" = significant(l.extrema.min, 4),
            "l-most" = significant(l.extrema.max, 4),
            "l-variation" = significant(l.total_variation / l.exact_total_variation, 3),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_simulation::advection::Extrema;

    #[test]
    fn godunov_is_monotone_and_lax_wendroff_is_not() {
        for (scene, periods, runs) in cases() {
            let [(_, lax_wendroff), (_, godunov)] = &runs[..] else { panic!("two schemes") };
            let (seen, exact) = (godunov.comparison.extrema, Extrema::of(&godunov.exact));
            // A convex combination of the data leaves their range by rounding only.
            assert!(seen.min >= exact.min - 1e-13 && seen.max <= exact.max + 1e-13, "{periods}");
            if scene.name == "advection-step" {
                assert!(lax_wendroff.comparison.extrema.max > 1.02);
            } else {
                assert!(lax_wendroff.comparison.l1 < godunov.comparison.l1);
            }
        }
    }
}
