//! How far the lattice theory carries when the particles are not on a lattice.

use super::{Detail, discretisation, text};
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::csv;
use crate::{cells, words};
use courant_analysis::exact::rational::integer;
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::{AdvectionScheme, DisorderStudy, gain_against_disorder};
use rayon::prelude::*;

const PARTICLES: usize = 64;
const MODES: [usize; 4] = [2, 8, 16, 32];
const DISORDERS: [f64; 7] = [0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4];
/// The Courant number of single steps; long runs are also made about the lattice's limit.
const COURANT_NUMBER: f64 = 1.0;
const SHARES_OF_LIMIT: [f64; 2] = [0.98, 1.02];
const SCHEMES: [AdvectionScheme; 2] =
    [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph];

/// One scheme at one Courant number.
struct Study {
    scheme: AdvectionScheme,
    courant_number: f64,
    found: DisorderStudy,
}

/// By scheme, then by Courant number, that of the single steps first.
fn studies(sets: u64) -> Vec<Study> {
    let plans = SCHEMES.into_iter().flat_map(|scheme| {
        let discretisation = discretisation(scheme, Kernel::CubicSpline, integer(2));
        let limit = discretisation.stable_set().limit().value();
        let [below, above] = SHARES_OF_LIMIT.map(|share| share * limit);
        [COURANT_NUMBER, below, above].map(|courant| (discretisation.clone(), courant))
    });
    let plans: Vec<_> = plans.collect();
    plans
        .into_par_iter()
        .map(|(discretisation, courant_number)| Study {
            scheme: discretisation.scheme(),
            courant_number,
            found: gain_against_disorder(
                &discretisation,
                courant_number,
                PARTICLES,
                &MODES,
                &DISORDERS,
                sets,
            )
            .expect("the disorders are below one half"),
        })
        .collect()
}

pub(super) fn section(detail: Detail) -> Section {
    let sets = if detail == Detail::Quick { 4 } else { 16 };
    let studies = studies(sets);
    let settings = words!["courant" = COURANT_NUMBER, "sets" = sets, "particles" = PARTICLES];
    let data = vec![("figure_disorder.csv".into(), data(&studies))];
    let items = vec![
        explanation(&studies),
        text().figure("figure_disorder", settings, figure(&studies), data),
    ];
    text().section("title_disorder", items)
}

fn explanation(studies: &[Study]) -> Item {
    let deviation = |study: &Study, disorder: f64| {
        let rows = study.found.modes.iter().filter(|row| row.disorder == disorder);
        rows.map(|row| (row.mean.norm() - row.lattice.norm()).abs()).fold(0.0, f64::max)
    };
    let at_end = |study: &Study, disorder: f64| {
        let row = study.found.growth.iter().find(|growth| growth.disorder == disorder);
        format!("{:.6}", row.expect("it is one of the disorders").mean_gain)
    };
    let sentences = studies.chunks(1 + SHARES_OF_LIMIT.len()).map(|of_scheme| {
        let ends = of_scheme.iter().map(|study| {
            let courant = significant(study.courant_number, 4);
            let (tenth, lattice) = (at_end(study, 0.1), at_end(study, 0.0));
            format!("{tenth} at C = {courant} ({lattice} on the lattice)")
        });
        text().text(
            "disorder_scheme",
            words![
                "scheme" = of_scheme[0].scheme.title(),
                "tenth" = significant(deviation(&of_scheme[0], 0.1), 2),
                "four-tenths" = significant(deviation(&of_scheme[0], 0.4), 2),
                "ends" = ends.collect::<Vec<_>>().join(", "),
            ],
        )
    });
    let sentences = sentences.collect::<Vec<_>>().join(" ");
    text().paragraph("disorder_text", words!["schemes" = sentences])
}

/// Displacement, mean, and the ends of its bar.
type Point = (f64, f64, [f64; 2]);
type Curve = Vec<Point>;

fn figure(studies: &[Study]) -> Figure {
    let by_scheme: Vec<&[Study]> = studies.chunks(1 + SHARES_OF_LIMIT.len()).collect();
    let steps: Vec<Vec<Curve>> = by_scheme.iter().map(|of| single_steps(&of[0])).collect();
    let runs: Vec<Vec<Curve>> =
        by_scheme.iter().map(|of| of.iter().map(long_run).collect()).collect();
    let phases = MODES.map(|mode| match PARTICLES / 2 / mode {
        1 => "a, b: φ = π".to_string(),
        part => format!("a, b: φ = π/{part}"),
    });
    let courant_numbers =
        ["C = 1", "2 % below the limit", "2 % above it"].map(|c| format!("c, d: {c}"));
    let mut figure = Figure::grid(2, 2).size(7.2, 6.2);
    for (row, (curves, names)) in
        [(steps, phases.to_vec()), (runs, courant_numbers.to_vec())].iter().enumerate()
    {
        // The panels of a row are to be compared: one scale, from the bars of both.
        let ends = || curves.iter().flatten().flatten().flat_map(|point| point.2);
        let (low, high) = (ends().fold(0.0, f64::min), ends().fold(0.0, f64::max));
        let room = 0.05 * (high - low);
        for (column, curves) in curves.iter().enumerate() {
            let scheme = by_scheme[column][0].scheme.title();
            let letter = char::from(b'a' + (2 * row + column) as u8);
            let (title, label) = match row {
                0 => (format!("({letter}) {scheme}, single step"), "|g| less the lattice's"),
                _ => (format!("({letter}) {scheme}, long run"), "factor per step less 1"),
            };
            let x = Axis::linear("largest displacement / Δξ").range(-0.02, 0.42);
            let y = Axis::linear(label).range(low - room, high + room);
            let mut panel = Panel::new(x, y).title(title).layer(Series::horizontal(0.0));
            for (k, (curve, name)) in curves.iter().zip(names).enumerate() {
                // No look twice in a figure with one legend.
                panel = with_spread(panel, k, k + row * MODES.len(), curve, name);
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
    let markers = Series::markers(means(), Marker::nth(look)).color(color).open();
    panel
        .layer(Series::line(means()).color(color))
        .layer(Series::line(curve.iter().flat_map(bar)).color(color).width(0.8))
        .layer(markers.size(7.5 - 1.5 * k as f64).label(name))
}

/// The change of the gain of a single step, mode by mode.
fn single_steps(study: &Study) -> Vec<Curve> {
    let curve = |mode| {
        let rows = study.found.modes.iter().filter(|row| row.mode == mode);
        let points = rows.map(|row| {
            let change = row.mean.norm() - row.lattice.norm();
            (row.disorder, change, [change - row.spread, change + row.spread])
        });
        points.collect()
    };
    MODES.into_iter().map(curve).collect()
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
