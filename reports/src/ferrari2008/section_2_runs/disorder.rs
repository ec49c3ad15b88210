//! How far the lattice theory carries when the particles are not on a lattice.

use super::{Detail, discretisation, text};
use crate::figure::{
    Axis, Color, Corner, Dash, ErrorBars, Figure, Line, Marker, Markers, Panel, Rule,
};
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

fn figure(studies: &[Study]) -> Figure {
    let mut figure = Figure::grid(2, 2).size(7.2, 5.8);
    for (k, of_scheme) in studies.chunks(1 + SHARES_OF_LIMIT.len()).enumerate() {
        figure = figure.panel(step_panel(char::from(b'a' + k as u8), &of_scheme[0]));
    }
    for (k, of_scheme) in studies.chunks(1 + SHARES_OF_LIMIT.len()).enumerate() {
        figure = figure.panel(long_run_panel(char::from(b'c' + k as u8), of_scheme));
    }
    figure
}

fn disorder_axis() -> Axis {
    Axis::linear("largest displacement / Δξ").range(-0.01, 0.41)
}

/// A point of a curve: displacement, mean, and the ends of its bar.
type Point = (f64, f64, [f64; 2]);

/// The `k`-th curve of a panel: means, and bars around them. Rings of falling size, so that curves that lie on one
/// another can be told apart.
fn with_spread(panel: Panel, k: usize, points: &[Point], label: String) -> Panel {
    let color = Color::qualitative(k);
    let means = || points.iter().map(|&(at, mean, _)| (at, mean));
    let markers = Markers::new(means(), Marker::nth(k)).color(color).open();
    panel
        .layer(Line::new(means()).color(color))
        .layer(
            ErrorBars::new(points.iter().map(|&(at, _, [low, high])| (at, low, high))).color(color),
        )
        .layer(markers.size(7.5 - 1.5 * k as f64).label(label))
}

/// A panel around a line at zero, its legend in the corner that the curves leave free.
fn panel_about_zero(title: String, label: &str, curves: Vec<(Vec<Point>, String)>) -> Panel {
    let all = || curves.iter().flat_map(|(points, _)| points);
    let lowest = all().map(|point| point.1).fold(0.0, f64::min);
    let highest = all().map(|point| point.1).fold(0.0, f64::max);
    let starts = curves.iter().filter_map(|(points, _)| points.first());
    let start = starts.map(|point| point.1).fold(0.0, f64::max);
    let corner = if -lowest > highest {
        Corner::BottomLeft
    } else if start < 0.5 * highest {
        Corner::TopLeft
    } else {
        Corner::TopRight
    };
    let zero = Rule::horizontal(0.0).color(Color::GREY).dash(Dash::Dotted);
    let mut panel =
        Panel::new(disorder_axis(), Axis::linear(label)).title(title).layer(zero).legend(corner);
    for (k, (points, label)) in curves.into_iter().enumerate() {
        panel = with_spread(panel, k, &points, label);
    }
    panel
}

fn step_panel(letter: char, study: &Study) -> Panel {
    let curves = MODES.into_iter().map(|mode| {
        let rows = study.found.modes.iter().filter(|row| row.mode == mode);
        let points = rows.map(|row| {
            let change = row.mean.norm() - row.lattice.norm();
            (row.disorder, change, [change - row.spread, change + row.spread])
        });
        let label = match PARTICLES / 2 / mode {
            1 => "φ = π".into(),
            part => format!("φ = π/{part}"),
        };
        (points.collect(), label)
    });
    let title = format!("({letter}) {}", study.scheme.title());
    panel_about_zero(title, "|g| of one step less the lattice's", curves.collect())
}

fn long_run_panel(letter: char, studies: &[Study]) -> Panel {
    let curves = studies.iter().map(|study| {
        let points: Vec<Point> = study
            .found
            .growth
            .iter()
            .map(|row| {
                let ends = [row.smallest_gain - 1.0, row.largest_gain - 1.0];
                (row.disorder, row.mean_gain - 1.0, ends)
            })
            .collect();
        let mut label = format!("C = {}", significant(study.courant_number, 4));
        // Weak growth is no more than a point on the axis: the number says it.
        if points[0].1 > 1e-9 {
            label.push_str(&format!(" (+{})", significant(points[0].1, 2)));
        }
        (points, label)
    });
    let title = format!("({letter}) {}, long run", studies[0].scheme.title());
    panel_about_zero(title, "factor per step of a long run less 1", curves.collect())
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
