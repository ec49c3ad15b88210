//! How far the lattice theory carries when the particles are not on a lattice.

use super::super::{COMMAND, Detail, ReportError};
use super::discretisation;
use crate::figure::{
    Axis, Color, Corner, Dash, ErrorBars, Figure, Line, Marker, Markers, Panel, Rule,
};
use crate::number::significant;
use crate::page::{Item, Section};
use courant_analysis::kernel::Kernel;
use courant_analysis::rational::integer;
use courant_analysis::scheme::AdvectionScheme;
use courant_simulation::advection::{DisorderStudy, GrowthPlan, gain_against_disorder};
use rayon::prelude::*;
use std::fmt::Write;

const PARTICLES: usize = 64;
const MODES: [usize; 4] = [2, 8, 16, 32];
const DISORDERS: [f64; 7] = [0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4];
const COURANT_NUMBER: f64 = 1.0;
const SCHEMES: [AdvectionScheme; 2] =
    [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph];

pub(super) fn section(detail: Detail) -> Result<Section, ReportError> {
    let sets = match detail {
        Detail::Full => 16,
        Detail::Quick => 4,
    };
    let studies: Vec<DisorderStudy> = SCHEMES
        .into_par_iter()
        .map(|scheme| {
            let discretisation = discretisation(scheme, Kernel::CubicSpline, integer(2));
            gain_against_disorder(
                &discretisation,
                COURANT_NUMBER,
                PARTICLES,
                &MODES,
                &DISORDERS,
                sets,
                &GrowthPlan::disordered(40, 50),
            )
            .expect("the disorders are below one half")
        })
        .collect();
    Ok(Section {
        title: "Disordered positions: how far the lattice theory carries".into(),
        items: vec![
            Item::Paragraph(explanation(&studies)),
            Item::Figure {
                name: "figure_disorder".into(),
                figure: Box::new(figure(&studies)),
                caption: format!(
                    "Gain of a wave in one step on positions displaced by up to so many spacings, the mean over \
                     {sets} sets of positions with its spread, and the lattice value (dotted); below, the gain \
                     per step of a constant with noise after 2000 steps (mean, and smallest to largest of the \
                     sets). Cubic spline, l/Δξ = 2, C = {COURANT_NUMBER}, {PARTICLES} particles; plain sums, \
                     volumes by Voronoi cells, no correction."
                ),
                data: vec![("figure_disorder.csv".into(), data(&studies))],
                command: COMMAND.into(),
            },
        ],
    })
}

fn explanation(studies: &[DisorderStudy]) -> String {
    let deviation = |study: &DisorderStudy, disorder: f64| {
        let rows = study.modes.iter().filter(|row| row.disorder == disorder);
        rows.map(|row| (row.mean.norm() - row.lattice.norm()).abs()).fold(0.0, f64::max)
    };
    let sentence = |scheme: AdvectionScheme, study: &DisorderStudy| {
        let end = study.growth.iter().find(|growth| growth.disorder == 0.1);
        let end = end.expect("0.1 is one of the disorders");
        format!(
            "{}: displacements of a tenth of a spacing change the gain of a single step by at most {}, those of \
             four tenths by {}; in the long run a tenth makes the factor per step {} (mean over the sets).",
            scheme.title(),
            significant(deviation(study, 0.1), 2),
            significant(deviation(study, 0.4), 2),
            significant(end.mean_gain, 6),
        )
    };
    let sentences: Vec<String> =
        SCHEMES.into_iter().zip(studies).map(|(scheme, study)| sentence(scheme, study)).collect();
    format!(
        "The amplification factor belongs to a uniform lattice. On uneven positions a step mixes the waves, and \
         the plain sums keep a constant only roughly. {} The lattice value holds for a step; what fails first, \
         in the long run, is the constant.",
        sentences.join(" ")
    )
}

fn figure(studies: &[DisorderStudy]) -> Figure {
    let axis = || Axis::linear("largest displacement / Δξ").range(-0.01, 0.41);
    let mut figure = Figure::grid(2, 2).size(7.2, 5.8);
    for (k, (scheme, study)) in SCHEMES.into_iter().zip(studies).enumerate() {
        let letter = char::from(b'a' + k as u8);
        let mut panel = Panel::new(axis(), Axis::linear("|g| of one step").range(0.0, 1.45))
            .title(format!("({letter}) {}", scheme.title()))
            .legend(Corner::TopLeft);
        for (k, mode) in MODES.into_iter().enumerate() {
            let color = Color::qualitative(k);
            let rows = || study.modes.iter().filter(move |row| row.mode == mode);
            let Some(first) = rows().next() else { continue };
            let label = format!("φ = π/{}", PARTICLES / 2 / mode);
            let label = if mode * 2 == PARTICLES { "φ = π".into() } else { label };
            panel = panel
                .layer(
                    Rule::horizontal(first.lattice.norm())
                        .color(color)
                        .width(0.8)
                        .dash(Dash::Dotted),
                )
                .layer(Line::new(rows().map(|row| (row.disorder, row.mean.norm()))).color(color))
                .layer(
                    ErrorBars::new(rows().map(|row| {
                        let gain = row.mean.norm();
                        (row.disorder, gain - row.spread, gain + row.spread)
                    }))
                    .color(color),
                )
                .layer(
                    Markers::new(rows().map(|row| (row.disorder, row.mean.norm())), Marker::nth(k))
                        .color(color)
                        .size(4.0)
                        .label(label),
                );
        }
        figure = figure.panel(panel);
    }
    for (k, study) in studies.iter().enumerate() {
        let letter = char::from(b'a' + (k + SCHEMES.len()) as u8);
        let color = Color::BLACK;
        let points = || study.growth.iter().map(|row| (row.disorder, row.mean_gain));
        let panel = Panel::new(axis(), Axis::linear("factor per step, long run"))
            .title(format!("({letter}) {}, long run", SCHEMES[k].title()))
            .layer(Rule::horizontal(1.0).color(Color::GREY).dash(Dash::Dotted))
            .layer(Line::new(points()).color(color))
            .layer(
                ErrorBars::new(
                    study
                        .growth
                        .iter()
                        .map(|row| (row.disorder, row.smallest_gain, row.largest_gain)),
                )
                .color(color),
            )
            .layer(Markers::new(points(), Marker::Circle).color(color).size(4.0));
        figure = figure.panel(panel);
    }
    figure
}

fn data(studies: &[DisorderStudy]) -> Vec<u8> {
    let mut text = String::from(
        "scheme,disorder,mode,phase,lattice_gain,mean_gain,spread,scattered,long_run_mean,long_run_smallest,long_run_largest\n",
    );
    for (scheme, study) in SCHEMES.into_iter().zip(studies) {
        for row in &study.modes {
            let growth = study.growth.iter().find(|growth| growth.disorder == row.disorder);
            let growth = growth.expect("every disorder has its long run");
            writeln!(
                text,
                "{scheme},{},{},{},{},{},{},{},{},{},{}",
                row.disorder,
                row.mode,
                row.phase,
                row.lattice.norm(),
                row.mean.norm(),
                row.spread,
                row.scattered,
                growth.mean_gain,
                growth.smallest_gain,
                growth.largest_gain
            )
            .expect("writing to a string succeeds");
        }
    }
    text.into_bytes()
}
