//! The printed relation of Godunov particle hydrodynamics beside the resolved one.

use super::super::{COMMAND, ReportError};
use super::{figure_item, paper_lattice, phases, usual_ratio};
use crate::cha_whitworth2003::published::PublishedWaves;
use crate::figure::{Axis, Color, Dash, Figure, Line, Panel};
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use crate::wave_map::wave_number_axis;
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
    Ok(vec![Item::Paragraph(explanation()?), figure()?, table()?])
}

fn waves(form: &str, whole: bool) -> Result<Waves, SweepError> {
    let at = if whole { integer(1) } else { usual_ratio() };
    let lattice = paper_lattice("gph", &at)?;
    Ok(match form {
        PUBLISHED => Waves::Published(PublishedWaves::of(&lattice)?),
        _ => Waves::Resolved(lattice.waves()?.compile()),
    })
}

fn explanation() -> Result<String, SweepError> {
    let long = waves(PUBLISHED, true)?.frequencies(1e-4);
    let speed = |branch| significant(long.branch(branch).re / 1e-4, 4);
    let resolved = waves(RESOLVED, false)?.frequencies(1.0).forward;
    Ok(format!(
        "Equations (61) to (64) put each particle on the left of every Riemann problem, whichever side its neighbour is \
         on. The damping terms of the two sides then subtract instead of add: the sum D of |W'| turns into the sum S of \
         W', the coefficient of the velocity turns imaginary, and the relation (64) is without damping. It is not the \
         relation of a sound wave: at h = Δ its long waves travel at {} c and {} c instead of ±c. With left and right \
         chosen by position, as the scheme does, (27), (43) and (44) give ω² + icDω − ω_SPH² = 0: long waves travel both \
         ways with the speed of SPH, and waves are damped, like SPH with a viscosity of signal velocity c; at \
         κΔ = 1 and h/Δ = {} one period leaves {} of the amplitude. The statement that the method has no damping does \
         not hold. An independent linearisation of a plain particle code by finite differences on a ring of 64 \
         particles gives the resolved frequencies mode by mode to 1e-6, and the printed ones when the particle itself is \
         always taken as the left state (analysis/tests/ring_linearisation.rs).",
        speed(Branch::Forward),
        speed(Branch::Backward),
        to_text(&usual_ratio()),
        significant(amplitude(resolved, 1.0, AmplitudeTime::Period), 3)
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
    let mut text = String::from("form,ratio,kappa,branch,omega_re,omega_im\n");
    for (index, (form, whole)) in
        [PUBLISHED, RESOLVED].into_iter().flat_map(|form| [(form, true), (form, false)]).enumerate()
    {
        let waves = waves(form, whole)?;
        let at = if whole { integer(1) } else { usual_ratio() };
        let label = format!("{}, h/Δ = {}", form, significant(to_f64(&at), 2));
        let color = if form == PUBLISHED { Color::VERMILION } else { Color::BLUE };
        let line = |points: Vec<(f64, f64)>| {
            Line::new(points)
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
                let (form, at, branch) = (form, to_text(&at), branch.name());
                text.push_str(&format!("{form},{at},{phase},{branch},{},{}\n", omega.re, omega.im));
            }
        }
        damping = damping.layer(line(
            found
                .iter()
                .map(|(phase, f)| (*phase, damping_per_wavelength(f.forward, *phase)))
                .collect(),
        ));
    }
    let figure = Figure::grid(1, 2).size(7.6, 3.5).panel(speed).panel(damping).legend_below();
    let usual = waves(RESOLVED, false)?;
    let largest = phases
        .iter()
        .map(|&phase| damping_per_wavelength(usual.frequencies(phase).forward, phase))
        .fold(0.0, f64::max);
    let caption = format!(
        "The two relations of Godunov particle hydrodynamics. (a) The printed one is not symmetric: its two waves travel \
         at different speeds, neither of them c. (b) Only the resolved one is damped: in proportion to κ for long waves \
         (first order), by up to {} per wavelength at h/Δ = {}. Cubic B-spline, ρ0 = M/Δ, 0 < κΔ ≤ π, exact in time.",
        significant(largest, 3),
        to_text(&usual_ratio())
    );
    Ok(figure_item(
        "godunov_forms",
        figure,
        caption,
        vec![("godunov_forms.csv".into(), text.into_bytes())],
    ))
}

fn table() -> Result<Item, ReportError> {
    let caption = format!(
        "Published against resolved, cubic B-spline, h/Δ = {}, ρ0 = M/Δ: phase speed and what one period of the exact \
         wave leaves of the amplitude",
        to_text(&usual_ratio())
    );
    let mut table = Table::new(
        caption,
        &[
            ("κΔ", Align::Right),
            ("wavelength/Δ", Align::Right),
            ("published, forward", Align::Right),
            ("published, backward", Align::Right),
            ("amplitude", Align::Right),
            ("resolved, forward", Align::Right),
            ("resolved, backward", Align::Right),
            ("amplitude", Align::Right),
        ],
    );
    let both = [waves(PUBLISHED, false)?, waves(RESOLVED, false)?];
    for phase in [0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0] {
        let mut cells = vec![significant(phase, 3), significant(2.0 * PI / phase, 4)];
        for waves in &both {
            let found = waves.frequencies(phase);
            for branch in Branch::ALL {
                cells.push(significant(found.branch(branch).re / phase, 5));
            }
            cells.push(significant(amplitude(found.forward, phase, AmplitudeTime::Period), 5));
        }
        table.push(cells);
    }
    Ok(Item::Table { name: "godunov_forms_table".into(), table, command: COMMAND.into() })
}
