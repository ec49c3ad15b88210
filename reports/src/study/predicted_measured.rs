//! Predicted against measured: symbol and running scheme, mode by mode.

use super::plan::{ByDetail, Named, discretisation};
use crate::advection_validation::{Settings, ValidatedCase, ValidationCase, run_cases};
use crate::figure::{Axis, Color, Dash, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Section;
use crate::paper_text::{PaperText, csv};
use crate::report::Detail;
use crate::{cells, words};
use courant_analysis::exact::rational::Rational;
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::AdvectionScheme;
use serde::Deserialize;
use std::f64::consts::PI;

/// What is looked at: each scheme with each kernel at three Courant numbers about its limit.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    schemes: Vec<Named<AdvectionScheme>>,
    kernels: Vec<Named<Kernel>>,
    ratio: Named<Rational>,
    steps: ByDetail<u64>,
    /// The kernel of the figure.
    shown: Named<Kernel>,
    /// What the three Courant numbers are.
    regimes: [String; 3],
}

/// The section.
pub fn section(text: &PaperText, detail: Detail) -> Section {
    let plan: Plan = text.plan("predicted_measured");
    let settings = Settings { steps: *plan.steps.at(detail), ..Settings::default() };
    let discretisations = plan.schemes.iter().flat_map(|scheme| {
        let of = |kernel: &Named<_>| discretisation(scheme.0, kernel.0, &plan.ratio.0);
        plan.kernels.iter().map(of)
    });
    let cases: Vec<ValidationCase> = discretisations
        .flat_map(|discretisation| ValidationCase::about_the_limit(&discretisation, settings))
        .collect();
    let cases = run_cases(cases, &|_, _| ()).expect("the numbers of the plans are in range");
    let worst = cases.iter().map(|case| case.validation.max_error).fold(0.0, f64::max);
    let chosen: Vec<&ValidatedCase> = cases
        .iter()
        .filter(|case| case.case.plan.discretisation.kernel() == plan.shown.0)
        .collect();
    let paragraph = words![
        "particles" = settings.particles,
        "steps" = settings.steps,
        "agree" = cases.iter().filter(|case| case.validation.passed()).count(),
        "cases" = cases.len(),
        "modes" = cases.iter().map(|case| case.validation.rows.len()).sum::<usize>(),
        "worst" = significant(worst, 2),
    ];
    let settings = words!["particles" = settings.particles, "steps" = settings.steps];
    let data = vec![("figure_predicted_measured.csv".into(), data(&chosen))];
    let items = vec![
        text.paragraph("predicted_measured_text", paragraph),
        text.table("predicted_measured", settings, cases.chunks(3).map(row)),
        text.figure("figure_predicted_measured", settings, figure(&plan, &chosen), data),
    ];
    text.section("title_predicted_measured", items)
}

/// One scheme with one kernel at three Courant numbers.
fn row(three: &[ValidatedCase]) -> Vec<String> {
    let discretisation = &three[0].case.plan.discretisation;
    let each = |text: &dyn Fn(&ValidatedCase) -> String| {
        three.iter().map(text).collect::<Vec<_>>().join(", ")
    };
    let worst = three
        .iter()
        .max_by(|a, b| a.validation.max_error.total_cmp(&b.validation.max_error))
        .expect("there are three cases");
    let passed = three.iter().all(|case| case.validation.passed());
    cells![
        discretisation.scheme().title(),
        discretisation.kernel().title(),
        each(&|case| {
            let courant = case.case.plan.courant_number;
            format!("{courant:.4} ({})", case.case.regime.name())
        }),
        each(&|case| format!("{:.4}", case.largest_gain())),
        significant(worst.validation.max_error, 2),
        significant(worst.validation.tolerance, 2),
        if passed { "yes" } else { "NO" },
    ]
}

fn figure(plan: &Plan, cases: &[&ValidatedCase]) -> Figure {
    let phase_axis = || {
        Axis::linear("phase φ = κΔξ").range(0.0, PI).ticks([
            (0.0, "0"),
            (0.5 * PI, "π/2"),
            (PI, "π"),
        ])
    };
    let of = |scheme: AdvectionScheme| {
        cases.iter().filter(move |case| case.case.plan.discretisation.scheme() == scheme)
    };
    let schemes: Vec<AdvectionScheme> = plan.schemes.iter().map(|scheme| scheme.0).collect();
    let mut figure = Figure::grid(2, schemes.len()).size(7.4, 5.2);
    for &scheme in &schemes {
        let mut panel = Panel::new(phase_axis(), Axis::linear("|g|").range(0.0, 1.8))
            .title(scheme.title())
            .layer(Series::horizontal(1.0));
        for (k, case) in of(scheme).enumerate() {
            let color = Color::qualitative(k);
            let rows = &case.validation.rows;
            panel = panel
                .layer(
                    Series::line(rows.iter().map(|row| (row.phase, row.predicted.norm())))
                        .color(color)
                        .dash(Dash::nth(k))
                        .label(&plan.regimes[k]),
                )
                .layer(
                    Series::markers(
                        rows.iter().step_by(4).map(|row| (row.phase, row.measured.norm())),
                        Marker::nth(k),
                    )
                    .color(color)
                    .fill(Color::WHITE)
                    .size(3.4)
                    .label(&plan.regimes[k]),
                );
        }
        figure = figure.panel(panel);
    }
    for &scheme in &schemes {
        let allowed = of(scheme).map(|case| case.validation.tolerance).fold(0.0, f64::max);
        let mut panel =
            Panel::new(phase_axis(), Axis::log("|measured − predicted|").range(1e-18, 1e-12))
                .layer(Series::horizontal(allowed).dash(Dash::Dashed).label("allowed"));
        for (k, case) in of(scheme).enumerate() {
            // An exact agreement has no place on a logarithmic axis.
            let points = case.validation.rows.iter().filter(|row| row.error > 0.0);
            panel = panel.layer(
                Series::markers(points.map(|row| (row.phase, row.error)), Marker::nth(k))
                    .color(Color::qualitative(k))
                    .size(2.2),
            );
        }
        figure = figure.panel(panel);
    }
    figure
}

fn data(cases: &[&ValidatedCase]) -> Vec<u8> {
    let rows = cases.iter().flat_map(|case| {
        let (plan, rows) = (&case.case.plan, &case.validation.rows);
        rows.iter().map(|row| {
            let (predicted, measured) = (row.predicted, row.measured);
            let mut cells =
                cells![plan.discretisation.scheme(), plan.courant_number, row.mode, row.phase];
            cells.extend(cells![predicted.norm(), predicted.arg(), measured.norm()]);
            cells.extend(cells![measured.arg(), row.error]);
            cells
        })
    });
    csv(
        "scheme,cfl,mode,phase,predicted_gain,predicted_phase,measured_gain,measured_phase,error",
        rows,
    )
}
