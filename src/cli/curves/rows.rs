//! One row a wave: JSON, CSV and an array.

use super::Curve;
use crate::cli::columns::{empty, number, subject_cells, subject_columns};
use courant::analysis::waves::branches::BranchWave;
use courant::reports::npy;
use courant::reports::number::finite;
use courant::reports::record::SubjectRecord;
use serde::Serialize;
use std::collections::BTreeMap;

/// One wave of one branch.
#[derive(Debug, Serialize)]
pub struct Row<'a> {
    scheme: &'a str,
    integrator: Option<&'a str>,
    kernel: Option<&'static str>,
    ratio: Option<&'a str>,
    parameters: &'a BTreeMap<String, String>,
    /// Degrees, or the name of the direction; absent in one dimension.
    #[serde(skip_serializing_if = "Option::is_none")]
    direction: Option<&'a str>,
    /// In radians per cell: a number, or one for each axis.
    phase: Phase,
    /// From 1, the physical ones first.
    branch: usize,
    physical: bool,
    gain: Option<f64>,
    argument: Option<f64>,
    phase_error: Option<f64>,
    phase_speed: Option<f64>,
    group_speed: Option<f64>,
    exact_gain: Option<f64>,
    exact_argument: Option<f64>,
    /// Why a number is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Phase {
    Line(f64),
    Plane(Vec<f64>),
}

fn row<'a>(
    curve: &'a Curve,
    record: &'a SubjectRecord,
    branch: usize,
    wave: &BranchWave,
) -> Row<'a> {
    let physical = curve.branches[branch].physical.is_some();
    let vector = &curve.direction.vector;
    let speeds = (wave.phase_speed(), wave.group_speed());
    let reason = match (wave.exact, speeds) {
        (None, _) => Some("nothing is known of the equation"),
        (Some((exact, _)), (None, _)) if exact.im == 0.0 => Some("the equation moves no wave"),
        _ if wave.exponent.im.is_nan() && wave.multiplier.is_finite() => {
            Some("one step takes the whole wave away")
        }
        (_, (Some(_), None)) => Some("two multipliers meet: there is no group speed"),
        (_, (None, _)) => Some("the multiplier is infinite"),
        _ => None,
    };
    Row {
        scheme: &record.scheme,
        integrator: record.integrator.as_deref(),
        kernel: record.kernel,
        ratio: record.ratio.as_deref(),
        parameters: &record.parameters,
        direction: (vector.len() > 1).then_some(&curve.direction.name),
        phase: match vector.len() {
            1 => Phase::Line(wave.phase),
            _ => Phase::Plane(vector.iter().map(|d| d * wave.phase).collect()),
        },
        branch: branch + 1,
        physical,
        gain: finite(wave.gain()),
        argument: finite(wave.exponent.im),
        phase_error: wave.phase_error().and_then(finite),
        phase_speed: speeds.0.and_then(finite),
        group_speed: speeds.1.and_then(finite),
        exact_gain: wave.exact.and_then(|(exact, _)| finite(exact.re.exp())),
        exact_argument: wave.exact.and_then(|(exact, _)| finite(exact.im)),
        reason,
    }
}

/// All rows of all curves.
pub fn rows(curves: &[Curve]) -> impl Iterator<Item = Row<'_>> {
    curves.iter().flat_map(|curve| {
        let branches = curve.branches.iter().enumerate();
        branches.flat_map(move |(index, branch)| {
            branch.waves.iter().map(move |wave| row(curve, &curve.record, index, wave))
        })
    })
}

/// The columns of the array, and those of the table after the subject.
const COLUMNS: [&str; 10] = [
    "phase",
    "branch",
    "physical",
    "gain",
    "argument",
    "phase_error",
    "phase_speed",
    "group_speed",
    "exact_gain",
    "exact_argument",
];

fn numbers(row: &Row, modulus: f64) -> [Option<f64>; COLUMNS.len()] {
    [
        Some(modulus),
        Some(row.branch as f64),
        Some(f64::from(u8::from(row.physical))),
        row.gain,
        row.argument,
        row.phase_error,
        row.phase_speed,
        row.group_speed,
        row.exact_gain,
        row.exact_argument,
    ]
}

/// The files with all rows: a table, an array with a row for each of its rows, and the names of the columns of that.
pub fn files(curves: &[Curve], stem: &str) -> Vec<(String, Vec<u8>)> {
    let columns: Vec<String> =
        subject_columns().chain(["direction".into()]).chain(COLUMNS.map(String::from)).collect();
    let mut table = empty(&columns);
    let mut array = Vec::new();
    for (place, curve) in curves.iter().enumerate() {
        let waves = curve.branches.iter().flat_map(|branch| &branch.waves);
        for (row, wave) in rows(std::slice::from_ref(curve)).zip(waves) {
            let numbers = numbers(&row, wave.phase);
            let mut cells = subject_cells(&curve.record);
            let degrees = curve.direction.degrees.map(|degrees| degrees.to_string());
            cells.push(degrees.unwrap_or_else(|| curve.direction.name.clone()));
            cells.extend(numbers.map(number));
            table.push(cells);
            array.push(place as f64);
            array.extend(numbers.map(|value| value.unwrap_or(f64::NAN)));
        }
    }
    vec![
        (format!("{stem}.csv"), table.to_csv().into_bytes()),
        (format!("{stem}.npy"), npy::encode_rows(array, COLUMNS.len() + 1)),
        (format!("{stem}_columns.txt"), format!("curve\n{}\n", COLUMNS.join("\n")).into_bytes()),
    ]
}
