//! The printed relation of Godunov particle hydrodynamics beside the resolved one.

use super::{paper_lattice, text, usual_ratio};
use crate::cha_whitworth2003::published::PublishedWaves;
use crate::figure::{Axis, Color, Dash, Figure, Panel, Series};
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::csv;
use crate::report::ReportError;
use crate::study::plan::phases;
use crate::wave_map::wave_number_axis;
use crate::{cells, words};
use courant_analysis::exact::rational::{integer, to_f64, to_text};
use courant_analysis::waves::dispersion::{
    AmplitudeTime, Branch, CompiledWaves, Frequencies, amplitude, damping_per_wavelength,
};
use courant_analysis::waves::sweep::SweepError;
use std::f64::consts::PI;

const PUBLISHED: &str = "published";
const RESOLVED: &str = "resolved";

/// One of the two relations.
enum Waves {
    Published(PublishedWaves),
    Resolved(CompiledWaves),
}

impl Waves {
    fn frequencies(&self, phase: f64) -> Frequencies {
        match self {
            Self::Published(waves) => waves.frequencies(phase),
            Self::Resolved(waves) => waves.mode(phase).frequencies(),
        }
    }
}

pub fn items() -> Result<Vec<Item>, ReportError> {
    Ok(vec![explanation()?, figure()?, table()?])
}

fn waves(form: &str, whole: bool) -> Result<Waves, SweepError> {
    let at = if whole { integer(1) } else { usual_ratio() };
    let lattice = paper_lattice("gph", &at)?;
    Ok(match form {
        PUBLISHED => Waves::Published(PublishedWaves::of(&lattice)?),
        _ => Waves::Resolved(lattice.waves()?.compile()),
    })
}

fn explanation() -> Result<Item, ReportError> {
    let long = waves(PUBLISHED, true)?.frequencies(1e-4);
    let speed = |branch| significant(long.branch(branch).re / 1e-4, 4);
    let resolved = waves(RESOLVED, false)?.frequencies(1.0).forward;
    let left = amplitude(resolved, 1.0, AmplitudeTime::Period);
    Ok(text().paragraph(
        "godunov_forms_text",
        words![
            "forward" = speed(Branch::Forward),
            "backward" = speed(Branch::Backward),
            "ratio" = to_text(&usual_ratio()),
            "left" = significant(left, 3),
        ],
    ))
}

fn figure() -> Result<Item, ReportError> {
    let phases = phases(240);
    let mut speed = Panel::new(
        wave_number_axis().range(0.0, PI),
        Axis::linear("phase speed Re ω/(cκ)").range(-1.8, 1.4),
    )
    .title("(a) speed of both waves");
    let mut damping = Panel::new(
        wave_number_axis().range(0.0, PI),
        Axis::linear("damping per wavelength −2π Im ω/(cκ)"),
    )
    .title("(b) damping of the forward wave");
    let mut lines = Vec::new();
    for (index, (form, whole)) in
        [PUBLISHED, RESOLVED].into_iter().flat_map(|form| [(form, true), (form, false)]).enumerate()
    {
        let waves = waves(form, whole)?;
        let at = if whole { integer(1) } else { usual_ratio() };
        let label = format!("{}, h/Δ = {}", form, significant(to_f64(&at), 2));
        let color = if form == PUBLISHED { Color::VERMILION } else { Color::BLUE };
        let line = |points: Vec<(f64, f64)>| {
            Series::line(points)
                .color(color)
                .width(1.4)
                .dash(Dash::nth(index % 2))
                .label(label.clone())
        };
        let found: Vec<_> = phases.iter().map(|&phase| (phase, waves.frequencies(phase))).collect();
        for branch in Branch::ALL {
            speed = speed.layer(line(
                found.iter().map(|(phase, f)| (*phase, f.branch(branch).re / phase)).collect(),
            ));
            for (phase, frequencies) in &found {
                let omega = frequencies.branch(branch);
                lines.push(cells![form, to_text(&at), phase, branch.name(), omega.re, omega.im]);
            }
        }
        damping = damping.layer(line(
            found
                .iter()
                .map(|(phase, f)| (*phase, damping_per_wavelength(f.forward, *phase)))
                .collect(),
        ));
    }
    let figure = Figure::grid(1, 2).size(7.6, 3.5).panel(speed).panel(damping);
    let usual = waves(RESOLVED, false)?;
    let largest = phases
        .iter()
        .map(|&phase| damping_per_wavelength(usual.frequencies(phase).forward, phase))
        .fold(0.0, f64::max);
    let data = csv("form,ratio,kappa,branch,omega_re,omega_im", lines);
    let words = words!["largest" = significant(largest, 3), "ratio" = to_text(&usual_ratio())];
    let data = vec![("godunov_forms.csv".into(), data)];
    Ok(text().figure("godunov_forms", words, figure, data))
}

fn table() -> Result<Item, ReportError> {
    let both = [waves(PUBLISHED, false)?, waves(RESOLVED, false)?];
    let rows = [0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0].into_iter().map(|phase| {
        let mut cells = vec![significant(phase, 3), significant(2.0 * PI / phase, 4)];
        for waves in &both {
            let found = waves.frequencies(phase);
            let speeds = Branch::ALL.map(|branch| found.branch(branch).re / phase);
            cells.extend(speeds.map(|speed| significant(speed, 5)));
            cells.push(significant(amplitude(found.forward, phase, AmplitudeTime::Period), 5));
        }
        cells
    });
    Ok(text().table("godunov_forms_table", words!["ratio" = to_text(&usual_ratio())], rows))
}
