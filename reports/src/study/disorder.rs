//! How far the lattice theory carries when the particles are not on a lattice.

use super::plan::{ByDetail, Case, letter};
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::{PaperText, csv};
use crate::report::Detail;
use crate::{cells, words};
use courant_simulation::advection::{AdvectionScheme, Discretisation, ParticlePath, Ring, Stepper};
use courant_simulation::stepping::eigenvalues;
use num_complex::Complex64;
use rayon::prelude::*;
use serde::Deserialize;
use std::f64::consts::TAU;

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
    rows: Vec<Row>,
}

/// One amplitude of disorder, over several sets of positions.
#[derive(Debug)]
struct Row {
    /// The largest displacement of a particle, in spacings.
    disorder: f64,
    /// A single step of each wave.
    waves: Vec<Wave>,
    /// The factor per step of a long run, the mean over the sets of positions: the largest modulus of the
    /// eigenvalues of a step.
    mean_gain: f64,
    /// The largest over the sets.
    largest_gain: f64,
    /// The smallest over the sets.
    smallest_gain: f64,
}

/// A single step of a wave.
#[derive(Debug)]
struct Wave {
    /// Waves on the ring; 0 is a constant.
    mode: usize,
    /// `φ = κ Δξ` with the mean spacing, in radians.
    phase: f64,
    /// The amplification factor on the lattice.
    lattice: Complex64,
    /// What a step leaves of the wave in the wave itself: `Σ_j V_j e^{−iκξ_j} (S e^{iκξ})_j / L`, the mean
    /// over the sets of positions.
    mean: Complex64,
    /// Root mean square of that number's distance from its mean over the sets.
    spread: f64,
    /// What a step puts into other waves: root mean square over particles (weighted with volumes) and sets
    /// of `S e^{iκξ} − g e^{iκξ}`; 0 on the lattice.
    scattered: f64,
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
    cases.into_par_iter().map(|(of, courant)| Study::new(&of, courant, plan, sets)).collect()
}

impl Study {
    /// Steps waves over disordered positions.
    ///
    /// For each amplitude of disorder, `sets` rings are drawn (seeds `0, 1, …`). Each wave is stepped once, its cosine and
    /// its sine apart, and projected on itself. The largest modulus of
    /// the step's eigenvalues is the factor per step of a long run from almost any start; on a lattice it is the
    /// largest `|g|`. A run of thousands of steps would not tell it from 1 where the growth is weak: what merely
    /// stays, as a constant does, swamps what grows.
    fn new(of: &Discretisation, courant_number: f64, plan: &Plan, sets: u64) -> Self {
        let row = |&disorder: &f64| {
            let length = plan.particles as f64;
            let ring = |seed| Ring::disordered(plan.particles, length, disorder, seed);
            let rings = (0..sets).map(ring).collect::<Result<Vec<_>, _>>();
            let rings = rings.expect("there are particles, and the disorders are below one half");
            let step = |ring| (ring, ParticlePath::new(of, courant_number, ring));
            let mut steps: Vec<_> = rings.iter().map(step).collect();
            let gains: Vec<f64> = steps.iter_mut().map(|(_, step)| spectral_radius(step)).collect();
            let stencil = of.stencil(courant_number);
            let wave = |&mode: &usize| {
                let phase = TAU * mode as f64 / length;
                Wave::new(mode, phase, stencil.at_phase(phase), &mut steps)
            };
            Row {
                disorder,
                waves: plan.modes.iter().map(wave).collect(),
                mean_gain: gains.iter().sum::<f64>() / gains.len() as f64,
                largest_gain: gains.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                smallest_gain: gains.iter().copied().fold(f64::INFINITY, f64::min),
            }
        };
        let rows = plan.disorders.iter().map(row).collect();
        Self { scheme: of.scheme(), courant_number, rows }
    }

    fn at(&self, disorder: f64) -> &Row {
        let row = self.rows.iter().find(|row| row.disorder == disorder);
        row.expect("it is one of the disorders")
    }
}

impl Wave {
    fn new(
        mode: usize,
        phase: f64,
        lattice: Complex64,
        steps: &mut [(&Ring, ParticlePath)],
    ) -> Self {
        let count = steps.len() as f64;
        let seen: Vec<(Complex64, f64)> =
            steps.iter_mut().map(|(ring, step)| step_wave(step, ring, phase)).collect();
        let mean = seen.iter().map(|(kept, _)| kept).sum::<Complex64>() / count;
        let spread = seen.iter().map(|(kept, _)| (kept - mean).norm_sqr()).sum::<f64>() / count;
        let scattered = seen.iter().map(|(_, lost)| lost).sum::<f64>() / count;
        let (spread, scattered) = (spread.sqrt(), scattered.sqrt());
        Self { mode, phase, lattice, mean, spread, scattered }
    }

    /// The change of the gain.
    fn change(&self) -> f64 {
        self.mean.norm() - self.lattice.norm()
    }
}

/// The largest modulus of the eigenvalues of a step, whose columns are what it makes of unit vectors.
fn spectral_radius(stepper: &mut ParticlePath) -> f64 {
    let count = stepper.state().len();
    let mut matrix = vec![vec![Complex64::ZERO; count]; count];
    for k in 0..count {
        let mut unit = vec![0.0; count];
        unit[k] = 1.0;
        stepper.set_state(&unit);
        stepper.step();
        matrix.iter_mut().zip(stepper.state()).for_each(|(row, value)| row[k] = (*value).into());
    }
    eigenvalues(&matrix).iter().map(|value| value.norm()).fold(0.0, f64::max)
}

/// The part of `S e^{iκξ}` in the wave itself, and the mean square of the rest.
fn step_wave(stepper: &mut ParticlePath, ring: &Ring, wave_number: f64) -> (Complex64, f64) {
    let wave: Vec<Complex64> =
        ring.positions().iter().map(|x| Complex64::from_polar(1.0, wave_number * x)).collect();
    let mut stepped = |part: fn(&Complex64) -> f64| -> Vec<f64> {
        stepper.set_state(&wave.iter().map(part).collect::<Vec<_>>());
        stepper.step();
        stepper.state().to_vec()
    };
    let (real, imaginary) = (stepped(|z| z.re), stepped(|z| z.im));
    let after: Vec<Complex64> =
        real.into_iter().zip(imaginary).map(|(re, im)| Complex64::new(re, im)).collect();
    let average = |term: &dyn Fn(usize) -> Complex64| -> Complex64 {
        let volumes = ring.volumes().iter().enumerate();
        volumes.map(|(j, volume)| term(j) * volume).sum::<Complex64>() / ring.length()
    };
    let kept = average(&|j| after[j] * wave[j].conj());
    let lost = average(&|j| (after[j] - kept * wave[j]).norm_sqr().into());
    (kept, lost.re)
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
        study.at(disorder).waves.iter().map(|wave| wave.change().abs()).fold(0.0, f64::max)
    };
    let at_end = |study: &Study, disorder| format!("{:.6}", study.at(disorder).mean_gain);
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
        by_scheme.iter().map(|of| single_steps(&of[0], plan.modes.len())).collect();
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
fn single_steps(study: &Study, modes: usize) -> Vec<Curve> {
    let curve = |mode: usize| {
        let points = study.rows.iter().map(|row| {
            let (change, spread) = (row.waves[mode].change(), row.waves[mode].spread);
            (row.disorder, change, [change - spread, change + spread])
        });
        points.collect()
    };
    (0..modes).map(curve).collect()
}

fn long_run(study: &Study) -> Curve {
    let ends = |row: &Row| [row.smallest_gain - 1.0, row.largest_gain - 1.0];
    study.rows.iter().map(|row| (row.disorder, row.mean_gain - 1.0, ends(row))).collect()
}

fn data(studies: &[Study]) -> Vec<u8> {
    let rows = studies.iter().flat_map(|study| study.rows.iter().map(move |row| (study, row)));
    let rows = rows.flat_map(|(Study { scheme, courant_number, .. }, row)| {
        row.waves.iter().map(move |wave| {
            let mut cells = cells![scheme, courant_number, row.disorder, wave.mode, wave.phase];
            cells.extend(cells![
                wave.lattice.norm(),
                wave.mean.norm(),
                wave.spread,
                wave.scattered
            ]);
            cells.extend(cells![row.mean_gain, row.smallest_gain, row.largest_gain]);
            cells
        })
    });
    let header = "scheme,cfl,disorder,mode,phase,lattice_gain,mean_gain,spread,scattered,long_run_mean,\
                  long_run_smallest,long_run_largest";
    csv(header, rows)
}

#[cfg(test)]
mod tests {
    use super::super::plan::discretisation;
    use super::*;
    use courant_analysis::exact::rational::integer;
    use courant_analysis::kernel::Kernel;

    fn study(
        scheme: AdvectionScheme,
        courant_number: f64,
        (particles, modes, disorders): (usize, &[usize], &[f64]),
        sets: u64,
    ) -> (Discretisation, Study) {
        let of = discretisation(scheme, Kernel::CubicSpline, &integer(2));
        let plan = Plan {
            cases: Vec::new(),
            particles,
            modes: modes.to_vec(),
            disorders: disorders.to_vec(),
            quoted: [0.0; 2],
            courant: courant_number,
            shares: Vec::new(),
            sets: toml::from_str("quick = 0\nstandard = 0\nfull = 0").unwrap(),
        };
        let study = Study::new(&of, courant_number, &plan, sets);
        (of, study)
    }

    #[test]
    fn disorder_starts_from_the_lattice() {
        let at: (usize, &[usize], &[f64]) = (48, &[0, 1, 6, 24], &[0.0, 0.01, 0.02, 0.2]);
        let (_, study) = study(AdvectionScheme::GodunovSph, 1.0, at, 6);
        for wave in &study.at(0.0).waves {
            assert!(
                (wave.mean - wave.lattice).norm() < 1e-13 && wave.scattered < 1e-13,
                "{wave:?}"
            );
            assert!(wave.spread < 1e-13);
        }
        let [small, double, large] = [0.01, 0.02, 0.2].map(|disorder| &study.at(disorder).waves);
        for ((small, double), large) in small.iter().zip(double).zip(large) {
            // What is scattered is of first order in the displacements, which scale with the same seeds.
            assert!((double.scattered / small.scattered - 2.0).abs() < 0.1, "{small:?} {double:?}");
            assert!(large.scattered > double.scattered);
            // What a wave keeps changes in second order only, but for the luck of the draw in few sets.
            assert!((small.mean - small.lattice).norm() < small.scattered);
        }
        for row in &study.rows {
            // Godunov SPH conserves on any positions, so 1 is an eigenvalue; here none is larger.
            assert!(row.smallest_gain <= row.largest_gain, "{row:?}");
            assert!((row.mean_gain - 1.0).abs() < 1e-9, "{row:?}");
        }
    }

    #[test]
    fn the_long_run_of_a_lattice_is_its_fastest_wave() {
        // 2 % above the limit √3: the growth is 5e-5, which thousands of steps hardly show.
        let (courant, particles) = (1.02 * 3f64.sqrt(), 64);
        let at: (usize, &[usize], &[f64]) = (particles, &[1], &[0.0]);
        let (of, study) = study(AdvectionScheme::LaxWendroffSph, courant, at, 1);
        let stencil = of.stencil(courant);
        let fastest = (0..particles)
            .map(|mode| stencil.at_phase(TAU * mode as f64 / particles as f64).norm())
            .fold(0.0, f64::max);
        assert!(fastest > 1.00005);
        // Copies of an eigenvalue lengthen the norm by at most √64: its root of order 2^36 is 1 + 3e-11.
        assert!((study.rows[0].mean_gain - fastest).abs() < 1e-10, "{:?}", study.rows[0]);
    }
}
