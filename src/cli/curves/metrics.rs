//! Points per wavelength and resolving efficiency: a row for each curve.

use super::{Arguments, Curve};
use crate::cli::columns::{empty, number, subject_cells, subject_columns};
use crate::cli::output::Format;
use crate::cli::subject::Label;
use courant::analysis::waves::resolution::{ERRORS, Resolution, points_per_wavelength};
use courant::reports::number::{finite, significant};
use courant::reports::record::SubjectRecord;
use courant::reports::table::{Align, Table};
use serde::Serialize;

/// One curve's metrics.
#[derive(Debug, Serialize)]
pub struct Metrics<'a> {
    #[serde(flatten)]
    subject: &'a SubjectRecord,
    #[serde(skip_serializing_if = "Option::is_none")]
    direction: Option<&'a str>,
    /// What the errors are of.
    measure: Option<&'static str>,
    resolution: Vec<Resolved>,
    dispersion_to_dissipation: Option<f64>,
    dispersion_to_dissipation_phase: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

/// What an error costs.
#[derive(Debug, Serialize)]
struct Resolved {
    error: f64,
    wavelengths: f64,
    phase: Option<f64>,
    points_per_wavelength: Option<f64>,
    resolving_efficiency: Option<f64>,
}

pub fn metrics<'a>(arguments: &Arguments, curve: &'a Curve) -> Metrics<'a> {
    let found = curve.resolution.as_ref();
    let resolved = |wavelengths: f64, of: fn(&Resolution) -> [Option<f64>; 3]| {
        let phases = found.map_or([None; 3], of);
        let one = move |(error, phase): (f64, Option<f64>)| Resolved {
            error,
            wavelengths,
            phase,
            points_per_wavelength: phase.map(points_per_wavelength),
            resolving_efficiency: found.zip(phase).map(|(found, phase)| found.efficiency(phase)),
        };
        ERRORS.into_iter().zip(phases).map(one)
    };
    let mut resolution: Vec<Resolved> = resolved(1.0, |found| found.phases).collect();
    if let Some(wavelengths) = arguments.wavelengths() {
        resolution.extend(resolved(wavelengths, |found| found.phases_after));
    }
    let ratio = found.and_then(|found| found.dispersion_to_dissipation);
    Metrics {
        subject: &curve.record,
        direction: (curve.direction.vector.len() > 1).then_some(&curve.direction.name),
        measure: found.map(|found| found.measure.name()),
        resolution,
        dispersion_to_dissipation: ratio.and_then(|(ratio, _)| finite(ratio)),
        dispersion_to_dissipation_phase: ratio.map(|(_, phase)| phase),
        reason: match found {
            None => Some("no branch follows an equation that moves or damps this wave"),
            Some(found) if found.phases.contains(&None) => {
                Some("a resolution that is null: the longest waves err by more")
            }
            Some(_) if ratio.is_none() => Some(
                "a wave grows, or the equation moves none: no quotient of dispersion and dissipation",
            ),
            Some(_) => None,
        },
    }
}

/// For people.
pub fn table(arguments: &Arguments, curves: &[Curve], varying: &[String]) -> Table {
    let after = arguments.wavelengths();
    let plane = curves[0].direction.vector.len() > 1;
    let mut columns: Vec<(String, Align)> = varying
        .iter()
        .map(|heading| {
            let all = curves.iter().flat_map(|curve| &curve.labels);
            (heading.clone(), Label::align(all.into_iter().find(|l| l.heading == *heading)))
        })
        .collect();
    if plane {
        columns.push(("direction".into(), Align::Right));
    }
    let percent = |error: f64| format!("{} %", significant(100.0 * error, 1));
    columns.extend(ERRORS.map(|error| (percent(error), Align::Right)));
    // A page has room for one of the two.
    columns.extend(ERRORS.map(|error| match after {
        Some(after) => (format!("{}/{after}", percent(error)), Align::Right),
        None => (format!("e({error})"), Align::Right),
    }));
    columns.push(("disp/diss".into(), Align::Right));
    let columns: Vec<(&str, Align)> =
        columns.iter().map(|(c, align)| (c.as_str(), *align)).collect();
    let second = match after {
        Some(after) => format!("the same after {after} wavelengths"),
        None => "resolving efficiency e".into(),
    };
    let caption = format!(
        "Points per wavelength for an error of 10 %, 1 %, 0.1 % of a wavelength per wavelength travelled, {second}, and the largest \
         quotient of dispersion and dissipation"
    );
    let mut table = Table::new(caption, &columns);
    for curve in curves {
        let found = metrics(arguments, curve);
        let mut cells: Vec<String> = varying
            .iter()
            .map(|heading| {
                let label = curve.labels.iter().find(|label| label.heading == *heading);
                label.map_or_else(|| "–".into(), |label| label.cell.clone())
            })
            .collect();
        cells.extend(found.direction.map(String::from));
        let points = |one: &Resolved| match one.points_per_wavelength {
            Some(points) => significant(points, 3),
            None => "–".into(),
        };
        let efficiency = |one: &Resolved| match one.resolving_efficiency {
            Some(value) => format!("{value:.3}"),
            None => "0".into(),
        };
        let (first, later) = found.resolution.split_at(ERRORS.len());
        cells.extend(first.iter().map(points));
        match after {
            Some(_) => cells.extend(later.iter().map(points)),
            None => cells.extend(first.iter().map(efficiency)),
        }
        cells.push(found.dispersion_to_dissipation.map_or("–".into(), |r| significant(r, 3)));
        table.push(cells);
    }
    table
}

/// For machines.
pub fn csv(arguments: &Arguments, curves: &[Curve]) -> Table {
    let named = ["direction", "measure"].map(String::from);
    let resolution = ["phase", "points_per_wavelength", "resolving_efficiency"];
    let of = |prefix: &str| -> Vec<String> {
        let each = |error: &f64| {
            let error = error.to_string().replace('.', "_");
            resolution.map(|name| format!("{prefix}{name}_{error}"))
        };
        ERRORS.iter().flat_map(each).collect()
    };
    let mut columns: Vec<String> = subject_columns().chain(named).chain(of("")).collect();
    if arguments.wavelengths().is_some() {
        columns.push("wavelengths".into());
        columns.extend(of("after_"));
    }
    columns
        .extend(["dispersion_to_dissipation", "dispersion_to_dissipation_phase"].map(String::from));
    let mut table = empty(&columns);
    for curve in curves {
        let found = metrics(arguments, curve);
        let mut cells = subject_cells(found.subject);
        let degrees = curve.direction.degrees.map(|degrees| degrees.to_string());
        cells.push(degrees.unwrap_or_else(|| curve.direction.name.clone()));
        cells.push(found.measure.unwrap_or_default().into());
        for (index, one) in found.resolution.iter().enumerate() {
            if index == ERRORS.len() {
                cells.push(one.wavelengths.to_string());
            }
            let numbers = [one.phase, one.points_per_wavelength, one.resolving_efficiency];
            cells.extend(numbers.map(number));
        }
        cells.push(number(found.dispersion_to_dissipation));
        cells.push(number(found.dispersion_to_dissipation_phase));
        table.push(cells);
    }
    table
}

/// The table of a format.
pub fn of_format(
    arguments: &Arguments,
    curves: &[Curve],
    varying: &[String],
    format: Format,
) -> Table {
    match format {
        Format::Csv => csv(arguments, curves),
        _ => table(arguments, curves, varying),
    }
}
