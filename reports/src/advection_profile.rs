//! One advection run as files: the profile as CSV and picture, the numbers as JSON.

use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::{finite, significant};
use crate::run_record::{BROKEN, ConservationRecord, RunRecord, RunReport, method_title};
use courant_analysis::exact::rational::to_text;
use courant_simulation::advection::{AdvectionRun, Layout, RunPlan};
use std::fmt::Write;

/// Markers in a picture at most; more cannot be told apart.
const MARKERS: usize = 2000;

/// The record, the profile and its picture.
pub fn report(plan: &RunPlan, result: &AdvectionRun, seconds: f64) -> RunReport {
    let (seen, scene, of) = (&result.comparison, &plan.scene, &plan.discretisation);
    let scheme = of.scheme();
    let note = "one quantity is advected: its norm is `value`";
    let names = [scene.name.as_str(), scheme.name()];
    let mut record = RunRecord::new(names, plan.particles, &result.run, note, seconds);
    let completed = record.completed;
    record.advise(Some(&format!(
        "the scheme is unstable at C = {}: a smaller --cfl helps, if one is stable",
        significant(result.courant_number, 6)
    )));
    record.warnings.extend(courant_warning(plan, result));
    let known = |value: f64| finite(value).filter(|_| completed);
    record.l1.value = known(seen.l1);
    // A relative change of a mean that is rounding says nothing.
    let relative = (seen.mean_drift / result.run.conservation.mass).abs() > 1e-12;
    record.conservation = ConservationRecord {
        mass: known(result.run.conservation.mass).filter(|_| relative || seen.mean_drift == 0.0),
        ..ConservationRecord::default()
    };
    record.conservation_note = Some(match (completed, record.conservation.mass) {
        (false, _) => BROKEN.into(),
        (true, Some(_)) => "one quantity is advected: the drift of its mean is `mass`".into(),
        (true, None) => "the mean is zero and has no relative drift: see `mean_drift`".into(),
    });
    record.set("kernel", of.kernel().name());
    record.set("ratio", to_text(of.ratio()));
    record.set("cfl", result.courant_number);
    record.set(
        "layout",
        match plan.layout {
            Layout::Lattice => "lattice",
            Layout::Uniform => "uniform",
            Layout::Disordered { .. } => "disordered",
        },
    );
    for (key, value) in [
        ("l2", seen.l2),
        ("l_infinity", seen.l_infinity),
        ("total_variation", seen.total_variation),
        ("exact_total_variation", seen.exact_total_variation),
        ("minimum", seen.extrema.min),
        ("maximum", seen.extrema.max),
        ("mean_drift", seen.mean_drift),
    ] {
        record.set(key, known(value));
    }
    record.set("interactions", result.run.counters.interactions);
    RunReport {
        caption: format!("{}, {}", scene.name, method_title(scheme.name())),
        files: vec![(".csv", profile_csv(result).into_bytes())],
        // Where values overflowed there is no profile to draw.
        figure: completed.then(|| profile_figure(plan, result)),
        record,
    }
}

/// What is to be said where equal steps to the end have another Courant number than the one asked for.
fn courant_warning(plan: &RunPlan, result: &AdvectionRun) -> Option<String> {
    let (asked, used) = (plan.courant_number, result.courant_number);
    // Rounding of the quotient is no change.
    ((asked - used).abs() > 1e-12 * asked).then(|| {
        format!(
            "C = {} does not divide the way: equal steps to t = {} have C = {}",
            short(asked),
            short(plan.scene.end_time),
            significant(used, 8)
        )
    })
}

/// `position,initial,computed,exact`, one row per particle.
pub fn profile_csv(result: &AdvectionRun) -> String {
    let mut text = String::from("position,initial,computed,exact\n");
    for (i, position) in result.positions.iter().enumerate() {
        writeln!(
            text,
            "{position},{},{},{}",
            result.initial[i], result.computed[i], result.exact[i]
        )
        .expect("writing to a string succeeds");
    }
    text
}

/// The exact solution as a line with jumps, drawn between the particles.
///
/// The rows run over cell edges `ξ = j/n` and stay constant within a cell, so that a jump is upright.
pub fn exact_line(plan: &RunPlan, time: f64) -> Series {
    const CELLS: usize = 2000;
    let points = (0..CELLS).flat_map(|cell| {
        let [from, to] = plan.scene.domain;
        let at = |offset: f64| from + (to - from) * (cell as f64 + offset) / CELLS as f64;
        // The middle of the cell decides, so that no rounding of a jump's place shows.
        let value = plan.scene.exact(at(0.5), time);
        [(at(0.0), value), (at(1.0), value)]
    });
    Series::line(points).color(Color::GREY).width(1.0).label("exact")
}

/// The computed values as markers; of many particles every few.
pub fn profile_markers(result: &AdvectionRun, marker: Marker, color: Color) -> Series {
    let every = result.positions.len().div_ceil(MARKERS);
    let points = result.positions.iter().copied().zip(result.computed.iter().copied());
    Series::markers(points.step_by(every), marker).color(color)
}

/// Five digits at most, without zeros at the end.
fn short(value: f64) -> f64 {
    format!("{value:.4e}").parse().expect("a number that was printed can be read")
}

/// Computed and exact profile.
pub fn profile_figure(plan: &RunPlan, result: &AdvectionRun) -> Figure {
    let of = &plan.discretisation;
    let title = format!(
        "{}, {}, l/Δξ = {}, C = {}, N = {}, t = {}",
        of.scheme().title(),
        of.kernel().title(),
        to_text(of.ratio()),
        short(result.courant_number),
        plan.particles,
        short(result.run.time)
    );
    let [from, to] = plan.scene.domain;
    let panel = Panel::new(Axis::linear("ξ").range(from, to), Axis::linear("u"))
        .layer(exact_line(plan, result.run.time))
        .layer(
            profile_markers(result, Marker::Circle, Color::BLUE)
                .fill(Color::WHITE)
                .size(3.0)
                .label("computed"),
        );
    Figure::single(panel).title(title).size(6.0, 3.9)
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::exact::rational::integer;
    use courant_analysis::kernel::Kernel;
    use courant_simulation::advection::{AdvectionScene, AdvectionScheme, Discretisation, run};

    fn plan(scheme: AdvectionScheme, courant_number: f64, end_time: f64) -> RunPlan {
        let scene = AdvectionScene { end_time, ..AdvectionScene::named("advection-step").unwrap() };
        let of = Discretisation::new(scheme, Kernel::CubicSpline, integer(2)).unwrap();
        let layout = Layout::Uniform;
        RunPlan { scene, discretisation: of, courant_number, particles: 40, layout }
    }

    #[test]
    fn an_overflow_is_a_failure_without_numbers() {
        let plan = plan(AdvectionScheme::EulerSph, 4.0, 1e4);
        let result = run(&plan).unwrap();
        let record = report(&plan, &result, 0.1).record;
        assert!(!record.completed && record.l1.value.is_none() && record.more["l2"].is_null());
        assert!(record.failure.as_ref().unwrap().contains("the scheme is unstable at C = 4"));
        assert!(serde_json::to_value(&record).unwrap()["total_variation"].is_null());
    }

    #[test]
    fn the_csv_has_a_row_for_every_particle() {
        let plan = plan(AdvectionScheme::GodunovSph, 1.0, 1.0);
        let result = run(&plan).unwrap();
        let text = profile_csv(&result);
        assert_eq!(text.lines().count(), 41);
        // The norm from the file's own columns, by the definition.
        let sum: f64 = text
            .lines()
            .skip(1)
            .map(|line| {
                let fields: Vec<f64> = line.split(',').map(|f| f.parse().unwrap()).collect();
                (fields[2] - fields[3]).abs()
            })
            .sum();
        let record = report(&plan, &result, 0.1).record;
        assert!((sum / 40.0 - record.l1.value.unwrap()).abs() < 1e-15);
        assert!(record.conservation.mass.unwrap().abs() < 1e-13);
    }
}
