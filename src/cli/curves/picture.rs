//! The figure of all curves: colours tell schemes apart, dashes the values of one scheme or the directions.

use super::Curve;
use super::cases::Case;
use crate::cli::subject::Label;
use courant::reports::figure::Figure;
use courant::reports::wave_curves::{self, DirectionCurve, WaveCurve, angles, unit_vector};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Waves against the direction, in cells.
const WAVELENGTHS: [f64; 3] = [4.0, 8.0, 16.0];
/// Dash patterns there are.
const DASHES: usize = 4;
/// Schemes in the name of a file.
const NAMED: usize = 3;
/// The longest name of a file.
const LONGEST_STEM: usize = 60;

/// Colour and dash of each subject.
fn looks(labels: &[Vec<Label>], varying: &[String], plane: bool) -> Vec<(usize, usize)> {
    let part = |row: &[Label], text: bool| -> Vec<String> {
        let told = row.iter().filter(|label| varying.contains(&label.heading));
        told.filter(|label| label.is_text() == text).map(|label| label.caption.clone()).collect()
    };
    let mut known: [Vec<Vec<String>>; 2] = Default::default();
    let mut place = |which: usize, key: Vec<String>| {
        let all = &mut known[which];
        all.iter().position(|one| *one == key).unwrap_or_else(|| {
            all.push(key);
            all.len() - 1
        })
    };
    let places: Vec<(usize, usize)> =
        labels.iter().map(|row| (place(0, part(row, true)), place(1, part(row, false)))).collect();
    let [schemes, values] = known.map(|all| all.len());
    let by_order = |index: usize| if plane { (index, 0) } else { (index, index % DASHES) };
    let apart = !plane && schemes > 1 && values <= DASHES;
    let look =
        |(index, place): (usize, &(usize, usize))| if apart { *place } else { by_order(index) };
    places.iter().enumerate().map(look).collect()
}

pub fn figure(
    cases: &[Case],
    curves: &[Curve],
    labels: &[Vec<Label>],
    varying: &[String],
) -> Figure {
    let plane = cases[0].branches.dimension() > 1;
    let looks = looks(labels, varying, plane);
    let each = curves.len() / cases.len();
    let name = |row: &[Label]| -> String {
        let told = row.iter().filter(|label| varying.contains(&label.heading));
        told.map(|label| label.caption.clone()).collect::<Vec<_>>().join(", ")
    };
    let lines: Vec<WaveCurve> = curves
        .iter()
        .enumerate()
        .map(|(index, curve)| {
            let (color, dash) = looks[index / each];
            let mut name = name(&labels[index / each]);
            if plane {
                let comma = if name.is_empty() { "" } else { ", " };
                name = format!("{name}{comma}{}", curve.direction.name);
            }
            let dash = if plane { index % each } else { dash };
            if name.is_empty() {
                name = "physical branch".into();
            }
            WaveCurve { name, color, dash, branches: curve.branches.clone() }
        })
        .collect();
    let shared = |label: &&Label| !varying.contains(&label.heading);
    let title: Vec<String> = labels[0].iter().filter(shared).map(|l| l.caption.clone()).collect();
    wave_curves::figure(&title.join(", "), &lines, &against_direction(cases, &looks))
}

/// In two dimensions: waves of some lengths in all directions.
fn against_direction(cases: &[Case], looks: &[(usize, usize)]) -> Vec<DirectionCurve> {
    if cases[0].branches.dimension() != 2 {
        return Vec::new();
    }
    let mut moduli = WAVELENGTHS.map(|wavelength| TAU / wavelength);
    moduli.reverse();
    let angles: Vec<f64> = angles().collect();
    let curves = cases.iter().zip(looks).flat_map(|(case, look)| {
        let found: Vec<_> = angles
            .par_iter()
            .filter_map(|&angle| {
                let branches = case.branches.along(&unit_vector(angle), &moduli);
                let physical = branches.into_iter().find(|branch| branch.physical == Some(0))?;
                Some((angle, physical.waves))
            })
            .collect();
        let of = move |(rank, wavelength): (usize, f64)| {
            let place = WAVELENGTHS.len() - 1 - rank;
            let waves = found.iter().map(|(angle, waves)| (*angle, waves[place])).collect();
            DirectionCurve { color: look.0, rank, wavelength, waves }
        };
        WAVELENGTHS.into_iter().enumerate().map(of).collect::<Vec<_>>()
    });
    curves.collect()
}

/// A name for the files: one subject with its values, or the schemes, as many as a name has room for.
pub fn stem(labels: &[Vec<Label>]) -> String {
    let mut names: Vec<&str> = Vec::new();
    for row in labels {
        let first = row[0].cell.as_str();
        if !names.contains(&first) {
            names.push(first);
        }
    }
    let more = names.len().saturating_sub(NAMED);
    names.truncate(NAMED);
    let mut text = names.join("_");
    if more > 0 {
        text = format!("{text}_and_{more}_more");
    }
    if let [one] = labels {
        let cell =
            |label: &Label| if label.is_text() { &label.cell } else { &label.caption }.clone();
        text = one.iter().map(cell).collect::<Vec<_>>().join("_");
    }
    let plain = |c: char| if c.is_ascii_alphanumeric() || "-.".contains(c) { c } else { '_' };
    let text: String = text.chars().map(plain).take(LONGEST_STEM).collect();
    let parts: Vec<&str> = text.split('_').filter(|part| !part.is_empty()).collect();
    format!("curves_{}", parts.join("_"))
}
