//! How far the lattice theory carries when the particles are not on a lattice.

use super::plan::{ByDetail, Case, letter};
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::{PaperText, csv};
use crate::report::Detail;
use crate::{cells, words};
use courant_simulation::advection::{AdvectionScheme, DisorderStudy, gain_against_disorder};
use rayon::prelude::*;
use serde::Deserialize;

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    /// The schemes, a column of panels each.
    cases: Vec<Case>,
    particles: usize,
    /// Waves of a single step.
    modes: Vec<usize>,
    /// Largest displacements over the spacing.
    disorders: Vec<f64>,
    /// Two of them, for the text.
    quoted: [f64; 2],
    /// The Courant number of single steps.
    courant: f64,
    /// Courant numbers of long runs beside that one, over the lattice's limit.
    shares: Vec<f64>,
    /// Sets of positions.
    sets: ByDetail<u64>,
}

/// One scheme at one Courant number.
struct Study {
    scheme: AdvectionScheme,
    courant_number: f64,
    found: DisorderStudy,
}

/// By scheme, then by Courant number, that of the single steps first.
fn studies(plan: &Plan, sets: u64) -> Vec<Study> {
    let cases = plan.cases.iter().flat_map(|case| {
        let discretisation = case.discretisation();
        let limit = discretisation.stable_set().limit().value();
        let shares = plan.shares.iter().map(move |share| share * limit);
        let courant_numbers = std::iter::once(plan.courant).chain(shares);
        courant_numbers.map(move |courant| (discretisation.clone(), courant))
    });
    let cases: Vec<_> = cases.collect();
    cases
        .into_par_iter()
        .map(|(discretisation, courant_number)| Study {
            scheme: discretisation.scheme(),
            courant_number,
            found: gain_against_disorder(
                &discretisation,
                courant_number,
                plan.particles,
                &plan.modes,
                &plan.disorders,
                sets,
            )
            .expect("the disorders are below one half"),
        })
        .collect()
}

/// The section.
pub fn section(text: &PaperText, detail: Detail) -> Section {
    let plan: Plan = text.plan("disorder");
    let sets = *plan.sets.at(detail);
    let studies = studies(&plan, sets);
    let by_scheme: Vec<&[Study]> = studies.chunks(1 + plan.shares.len()).collect();
    let settings = words!["courant" = plan.courant, "sets" = sets, "particles" = plan.particles];
    let data = vec![("figure_disorder.csv".into(), data(&studies))];
    let items = vec![
        explanation(text, &plan, &by_scheme),
        text.figure("figure_disorder", settings, figure(&plan, &by_scheme), data),
    ];
    text.section("title_disorder", items)
}

fn explanation(text: &PaperText, plan: &Plan, by_scheme: &[&[Study]]) -> Item {
    let deviation = |study: &Study, disorder: f64| {
        let rows = study.found.modes.iter().filter(|row| row.disorder == disorder);
        rows.map(|row| (row.mean.norm() - row.lattice.norm()).abs()).fold(0.0, f64::max)
    };
    let at_end = |study: &Study, disorder: f64| {
        let row = study.found.growth.iter().find(|growth| growth.disorder == disorder);
        format!("{:.6}", row.expect("it is one of the disorders").mean_gain)
    };
    let [small, large] = plan.quoted;
    let sentences = by_scheme.iter().map(|of_scheme| {
        let ends = of_scheme.iter().map(|study| {
            let courant = significant(study.courant_number, 4);
            let (displaced, lattice) = (at_end(study, small), at_end(study, 0.0));
            format!("{displaced} at C = {courant} ({lattice} on the lattice)")
        });
        text.text(
            "disorder_scheme",
            words![
                "scheme" = of_scheme[0].scheme.title(),
                "small" = significant(deviation(&of_scheme[0], small), 2),
                "large" = significant(deviation(&of_scheme[0], large), 2),
                "ends" = ends.collect::<Vec<_>>().join(", "),
            ],
        )
    });
    let sentences = sentences.collect::<Vec<_>>().join(" ");
    text.paragraph("disorder_text", words!["schemes" = sentences])
}

/// Displacement, mean, and the ends of its bar.
type Point = (f64, f64, [f64; 2]);
type Curve = Vec<Point>;

/// A share of a limit, in words.
fn about_limit(share: f64) -> String {
    let percent = 100.0 * (share - 1.0);
    let side = if percent < 0.0 { "below the limit" } else { "above it" };
    format!("{:.0} % {side}", percent.abs())
}

fn figure(plan: &Plan, by_scheme: &[&[Study]]) -> Figure {
    let steps: Vec<Vec<Curve>> =
        by_scheme.iter().map(|of| single_steps(&plan.modes, &of[0])).collect();
    let runs: Vec<Vec<Curve>> =
        by_scheme.iter().map(|of| of.iter().map(long_run).collect()).collect();
    let columns = by_scheme.len();
    let panels = |row: usize| {
        let letters = (0..columns).map(|column| char::from(b'a' + (row * columns + column) as u8));
        letters.map(String::from).collect::<Vec<_>>().join(", ")
    };
    let (of_steps, of_runs) = (panels(0), panels(1));
    let phases = plan.modes.iter().map(|mode| match plan.particles / 2 / mode {
        1 => format!("{of_steps}: φ = π"),
        part => format!("{of_steps}: φ = π/{part}"),
    });
    let shares = plan.shares.iter().map(|share| about_limit(*share));
    let courant_numbers = std::iter::once(format!("C = {}", plan.courant)).chain(shares);
    let courant_numbers = courant_numbers.map(|c| format!("{of_runs}: {c}"));
    let rows: [(Vec<Vec<Curve>>, Vec<String>); 2] =
        [(steps, phases.collect()), (runs, courant_numbers.collect())];
    let widest = plan.disorders.iter().copied().fold(0.0, f64::max);
    let mut figure = Figure::grid(2, columns).size(7.2, 6.2);
    for (row, (curves, names)) in rows.iter().enumerate() {
        // The panels of a row are to be compared: one scale, from the bars of both.
        let ends = || curves.iter().flatten().flatten().flat_map(|point| point.2);
        let (low, high) = (ends().fold(0.0, f64::min), ends().fold(0.0, f64::max));
        let room = 0.05 * (high - low);
        for (column, curves) in curves.iter().enumerate() {
            let scheme = by_scheme[column][0].scheme.title();
            let letter = letter(columns * row + column);
            let (title, label) = match row {
                0 => (format!("{letter}{scheme}, single step"), "|g| less the lattice's"),
                _ => (format!("{letter}{scheme}, long run"), "factor per step less 1"),
            };
            let x = Axis::linear("largest displacement / Δξ").range(-0.05 * widest, 1.05 * widest);
            let y = Axis::linear(label).range(low - room, high + room);
            let mut panel = Panel::new(x, y).title(title).layer(Series::horizontal(0.0));
            for (k, (curve, name)) in curves.iter().zip(names).enumerate() {
                // No look twice in a figure with one legend.
                panel = with_spread(panel, k, k + row * plan.modes.len(), curve, name);
            }
            figure = figure.panel(panel);
        }
    }
    figure
}

/// A curve of a panel: means, and bars around them. Rings of falling size, so that curves that lie on one another can be
/// told apart.
fn with_spread(panel: Panel, k: usize, look: usize, curve: &Curve, name: &str) -> Panel {
    let color = Color::qualitative(look);
    let means = || curve.iter().map(|&(at, mean, _)| (at, mean));
    let bar = |&(at, _, [low, high]): &Point| [(at, low), (at, high), (f64::NAN, f64::NAN)];
    let markers = Series::markers(means(), Marker::nth(look)).color(color).fill(None);
    panel
        .layer(Series::line(means()).color(color))
        .layer(Series::line(curve.iter().flat_map(bar)).color(color).width(0.8))
        .layer(markers.size(7.5 - 1.5 * k as f64).label(name))
}

/// The change of the gain of a single step, mode by mode.
fn single_steps(modes: &[usize], study: &Study) -> Vec<Curve> {
    let curve = |&mode: &usize| {
        let rows = study.found.modes.iter().filter(|row| row.mode == mode);
        let points = rows.map(|row| {
            let change = row.mean.norm() - row.lattice.norm();
            (row.disorder, change, [change - row.spread, change + row.spread])
        });
        points.collect()
    };
    modes.iter().map(curve).collect()
}

fn long_run(study: &Study) -> Curve {
    let rows = study.found.growth.iter();
    let ends = |one: f64, other: f64| [one - 1.0, other - 1.0];
    rows.map(|row| (row.disorder, row.mean_gain - 1.0, ends(row.smallest_gain, row.largest_gain)))
        .collect()
}

fn data(studies: &[Study]) -> Vec<u8> {
    let rows = studies.iter().flat_map(|Study { scheme, courant_number, found }| {
        found.modes.iter().map(move |row| {
            let growth = found.growth.iter().find(|growth| growth.disorder == row.disorder);
            let growth = growth.expect("every disorder has its long run");
            let mut cells = cells![scheme, courant_number, row.disorder, row.mode, row.phase];
            cells.extend(cells![row.lattice.norm(), row.mean.norm(), row.spread, row.scattered]);
            cells.extend(cells![growth.mean_gain, growth.smallest_gain, growth.largest_gain]);
            cells
        })
    });
    let header = "scheme,cfl,disorder,mode,phase,lattice_gain,mean_gain,spread,scattered,long_run_mean,\
                  long_run_smallest,long_run_largest";
    csv(header, rows)
}
