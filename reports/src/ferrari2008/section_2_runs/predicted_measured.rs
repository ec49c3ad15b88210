//! Predicted against measured: symbol and running scheme, mode by mode.

use super::super::{COMMAND, Detail, ReportError};
use super::discretisation;
use crate::advection_validation::{Settings, ValidatedCase, ValidationCase, run_cases};
use crate::figure::{Axis, Color, Dash, Figure, Line, Marker, Markers, Panel};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::table::{Align, Table};
use courant_analysis::exact::rational::integer;
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::AdvectionScheme;
use std::f64::consts::PI;
use std::fmt::Write;

pub(super) fn section(detail: Detail) -> Result<Section, ReportError> {
    let settings = Settings {
        steps: match detail {
            Detail::Full => 100,
            Detail::Quick => 10,
        },
        ..Settings::default()
    };
    let mut cases = Vec::new();
    for scheme in AdvectionScheme::ALL {
        for kernel in Kernel::ALL {
            let discretisation = discretisation(scheme, kernel, integer(2));
            cases.extend(ValidationCase::about_the_limit(&discretisation, settings));
        }
    }
    let cases = run_cases(cases, &|_, _| ()).expect("the numbers of the plans are in range");
    let worst = cases.iter().map(|case| case.validation.max_error).fold(0.0, f64::max);
    let agree = cases.iter().filter(|case| case.validation.passed()).count();
    let modes: usize = cases.iter().map(|case| case.validation.rows.len()).sum();
    let text = format!(
        "The symbol and the stepping code share the kernel and nothing else. All modes of a ring of {} \
         particles are excited at once and stepped {} times over neighbours found among the particles; their \
         factors per step are set beside the amplification factor. {agree} of {} cases agree within their \
         tolerance, {modes} factors in all; the largest error is {}. `courant validate` prints the same comparison, \
         case by case or mode by mode, for schemes, kernels, ratios and Courant numbers of one's own.",
        settings.particles,
        settings.steps,
        cases.len(),
        significant(worst, 2),
    );
    let chosen: Vec<&ValidatedCase> = cases
        .iter()
        .filter(|case| case.case.plan.discretisation.kernel() == Kernel::CubicSpline)
        .collect();
    Ok(Section {
        title: "Predicted against measured".into(),
        items: vec![
            Item::Paragraph(text),
            Item::Table {
                name: "predicted_measured".into(),
                table: table(&cases, settings),
                command: COMMAND.into(),
            },
            Item::Figure {
                name: "figure_predicted_measured".into(),
                figure: Box::new(figure(&chosen)),
                caption: format!(
                    "Amplification of every mode, predicted (lines) and measured on the running scheme \
                     (markers, every fourth mode), and the distance of the two complex factors below, with what \
                     is allowed (dotted: the largest tolerance of the panel). Cubic spline, l/Δξ = 2, N = {}, \
                     {} steps; each scheme at half its stability limit, at the limit and at one and a half \
                     times the limit (Euler-SPH, which has none, at C = 1/2, 1, 3/2).",
                    settings.particles, settings.steps
                ),
                data: vec![("figure_predicted_measured.csv".into(), data(&chosen))],
                command: COMMAND.into(),
            },
        ],
    })
}

fn table(cases: &[ValidatedCase], settings: Settings) -> Table {
    let mut table = Table::new(
        format!(
            "Largest error of a factor per step over three Courant numbers, and what is allowed in that case; \
             l/Δξ = 2, N = {}, {} steps",
            settings.particles, settings.steps
        ),
        &[
            ("scheme", Align::Left),
            ("kernel", Align::Left),
            ("C (regime)", Align::Left),
            ("largest |g|", Align::Left),
            ("max error", Align::Right),
            ("allowed", Align::Right),
            ("agrees", Align::Left),
        ],
    );
    for three in cases.chunks(3) {
        let discretisation = &three[0].case.plan.discretisation;
        let each = |text: &dyn Fn(&ValidatedCase) -> String| {
            three.iter().map(text).collect::<Vec<_>>().join(", ")
        };
        let worst = three
            .iter()
            .max_by(|a, b| a.validation.max_error.total_cmp(&b.validation.max_error))
            .expect("there are three cases");
        let passed = three.iter().all(|case| case.validation.passed());
        table.push([
            discretisation.scheme().title().to_string(),
            discretisation.kernel().title().into(),
            each(&|case| {
                let courant = case.case.plan.courant_number;
                format!("{courant:.4} ({})", case.case.regime.name())
            }),
            each(&|case| format!("{:.4}", case.largest_gain())),
            significant(worst.validation.max_error, 2),
            significant(worst.validation.tolerance, 2),
            if passed { "yes" } else { "NO" }.into(),
        ]);
    }
    table
}

fn figure(cases: &[&ValidatedCase]) -> Figure {
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
    let labels = [
        "half the limit (Euler-SPH: C = 1/2)",
        "at the limit (C = 1)",
        "one and a half times the limit (C = 3/2)",
    ];
    let mut figure = Figure::grid(2, 3).size(7.4, 5.2).legend_below();
    for scheme in AdvectionScheme::ALL {
        let mut panel = Panel::new(phase_axis(), Axis::linear("|g|").range(0.0, 1.8))
            .title(scheme.title())
            .layer(Line::horizontal(1.0));
        for (k, case) in of(scheme).enumerate() {
            let color = Color::qualitative(k);
            let rows = &case.validation.rows;
            panel = panel
                .layer(
                    Line::new(rows.iter().map(|row| (row.phase, row.predicted.norm())))
                        .color(color)
                        .dash(Dash::nth(k))
                        .label(labels[k]),
                )
                .layer(
                    Markers::new(
                        rows.iter().step_by(4).map(|row| (row.phase, row.measured.norm())),
                        Marker::nth(k),
                    )
                    .color(color)
                    .fill(Color::WHITE)
                    .size(3.4)
                    .label(labels[k]),
                );
        }
        figure = figure.panel(panel);
    }
    for scheme in AdvectionScheme::ALL {
        let allowed = of(scheme).map(|case| case.validation.tolerance).fold(0.0, f64::max);
        let mut panel =
            Panel::new(phase_axis(), Axis::log("|measured − predicted|").range(1e-18, 1e-12))
                .layer(Line::horizontal(allowed).dash(Dash::Dashed).label("allowed"));
        for (k, case) in of(scheme).enumerate() {
            // An exact agreement has no place on a logarithmic axis.
            let points = case.validation.rows.iter().filter(|row| row.error > 0.0);
            panel = panel.layer(
                Markers::new(points.map(|row| (row.phase, row.error)), Marker::nth(k))
                    .color(Color::qualitative(k))
                    .size(2.2),
            );
        }
        figure = figure.panel(panel);
    }
    figure
}

fn data(cases: &[&ValidatedCase]) -> Vec<u8> {
    let mut text = String::from(
        "scheme,cfl,mode,phase,predicted_gain,predicted_phase,measured_gain,measured_phase,error\n",
    );
    for case in cases {
        let plan = &case.case.plan;
        for row in &case.validation.rows {
            writeln!(
                text,
                "{},{},{},{},{},{},{},{},{}",
                plan.discretisation.scheme(),
                plan.courant_number,
                row.mode,
                row.phase,
                row.predicted.norm(),
                row.predicted.arg(),
                row.measured.norm(),
                row.measured.arg(),
                row.error
            )
            .expect("writing to a string succeeds");
        }
    }
    text.into_bytes()
}
