//! How fast the fastest wave grows in one step, in two and three dimensions.

use super::multipliers::CompiledStep;
use super::precise::{Place, PreciseStep};
use super::step_growth::{Growth, MOST_BITS, growth_of};
use super::wave_terms::{difference_terms, primitive_characteristic};
use crate::exact::float::{ComplexFloat, Float};
use crate::exact::rational::{Rational, from_f64, integer};
use crate::scheme::{SchemeError, Step};
use crate::stability::{PointVerdict, Wave};
use std::f64::consts::{PI, TAU};

/// Samples along an axis for each order of a cosine; at least and at most, by dimension.
const SAMPLES: usize = 6;
const FEWEST: [usize; 3] = [64, 32, 16];
const MOST: [usize; 3] = [512, 96, 24];

/// Sampled maxima that are refined.
const CANDIDATES: usize = 6;

/// Steps of the refinement end at this share of the first one: the value is then wrong by the square of it.
const FINE: f64 = 1e-7;

/// Phases below this share of the spacing of samples are those of a long wave.
const LONG: f64 = 0.01;

/// Lengths of long waves that are looked at in the direction of one that was proved to grow, each 0.7 of the phase of the last.
const LONG_WAVES: usize = 80;

/// `|z|² − 1` above this is more than roundings.
const SEEN: f64 = 1e-9;

/// Rounds about all neighbours of one refinement at most.
const MOST_PASSES: usize = 80;

/// Bits of the arithmetic of the refinement: 38 digits.
const BITS: u32 = 128;

/// The largest `|z|` over all waves of a step whose parameters have values: sampled on a grid and refined, from the witness of an
/// instability too, so that a narrow band that was proved to grow is not missed. Measured, not proved.
pub(super) fn growth_on_torus(
    step: &Step,
    decided: &PointVerdict<Wave>,
) -> Result<Growth, SchemeError> {
    let witness = match decided {
        PointVerdict::Unstable(wave) => Some(wave),
        _ => None,
    };
    let terms = difference_terms(&primitive_characteristic(step)?);
    let compiled = CompiledStep::new(step, &terms);
    let precise = PreciseStep::new(step, &terms, BITS);
    if *decided == PointVerdict::Stable
        && let Some(neutral) = neutral(&precise, step.dimension())
    {
        return Ok(neutral);
    }
    let at = step.dimension() - 1;
    let steps = (SAMPLES * compiled.span()).clamp(FEWEST[at], MOST[at]) & !1;
    let spacing = TAU / steps as f64;
    let sampled = |phases: &[f64]| {
        let excess = |y: num_complex::Complex64| 2.0 * y.re + y.norm_sqr();
        let all = compiled.differences(&[], phases).into_iter().map(excess);
        all.fold(f64::NEG_INFINITY, f64::max)
    };
    let mut starts: Vec<(f64, Vec<f64>)> = half_of_all_waves(step.dimension(), steps)
        .map(|phases| (sampled(&phases), phases))
        .collect();
    starts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut apart: Vec<Vec<f64>> = Vec::new();
    for (_, phases) in starts {
        let near = |other: &Vec<f64>| {
            other.iter().zip(&phases).all(|(a, b)| (a - b).abs() < 2.5 * spacing)
        };
        if !apart.iter().any(near) {
            apart.push(phases);
        }
        if apart.len() == CANDIDATES {
            break;
        }
    }
    let from_samples = apart.into_iter().map(|phases| (phases, spacing));
    let from_witness =
        witness.map(|wave: &Wave| match wave.phases().iter().all(|p| p.abs() < LONG * spacing) {
            true => fastest_long_wave(&precise, wave.direction(), spacing),
            false => {
                let size = wave.phases().iter().fold(0.0, |most: f64, phase| most.max(phase.abs()));
                (wave.phases().to_vec(), spacing.min(0.5 * size))
            }
        });
    let best = from_samples
        .map(|(phases, size)| refined(&sampled, phases, size))
        .max_by(|a, b| a.0.total_cmp(&b.0));
    // Growth that floating point does not see is looked for about the witness, in as many digits as it takes.
    let precisely = |phases: &[f64]| {
        let found = precise.largest(&place(&precise, phases));
        found.map_or(f64::INFINITY, logarithmic)
    };
    // Where two multipliers meet roundings are as large as their root.
    let seen = best.as_ref().is_some_and(|(_, phases)| precisely(phases) > SEEN);
    let best = match from_witness {
        Some((phases, size)) if !seen => Some(refined(&precisely, phases, size)),
        _ => best,
    };
    let phases = best.map_or_else(|| vec![0.0; step.dimension()], |(_, phases)| phases);
    let mut bits = 2 * BITS;
    loop {
        let (coarse, fine) =
            (PreciseStep::new(step, &terms, bits), PreciseStep::new(step, &terms, 2 * bits));
        let place = |precise: &PreciseStep| place(precise, &phases);
        let Some(found) = fine.largest(&place(&fine)) else {
            return Ok(Growth::singular(Wave::new(phases)));
        };
        let settled = coarse.largest(&place(&coarse)).is_some_and(|(excess, _)| {
            let difference = &excess - &found.0;
            difference.magnitude().is_none_or(|size| Some(size + 40) < found.0.magnitude())
        });
        if settled || bits >= MOST_BITS {
            return Ok(growth_of(Wave::new(phases), &found));
        }
        bits *= 2;
    }
}

/// A long wave stands for all long ones in its direction: the one of them that grows most, and how far its neighbours are.
fn fastest_long_wave(precise: &PreciseStep, direction: &[f64], spacing: f64) -> (Vec<f64>, f64) {
    let along = |size: &f64| direction.iter().map(|x| x * size).collect::<Vec<f64>>();
    let sizes = std::iter::successors(Some(spacing), |size| Some(size * 0.7)).take(LONG_WAVES);
    let value = |size: &f64| {
        let found = precise.largest(&place(precise, &along(size)));
        found.map_or(f64::INFINITY, logarithmic)
    };
    let sizes: Vec<(f64, f64)> = sizes.map(|size| (value(&size), size)).collect();
    let best = sizes.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0));
    let size = best.map_or(spacing, |(_, size)| size);
    (along(&size), 0.3 * size)
}

/// Where nothing grows: a wave of phases 0 and π that is neutral to all digits, the longest first.
fn neutral(precise: &PreciseStep, dimension: usize) -> Option<Growth> {
    (0..1usize << dimension).find_map(|corner| {
        let phase = |axis: usize| if corner >> axis & 1 == 1 { PI } else { 0.0 };
        let phases: Vec<f64> = (0..dimension).map(phase).collect();
        let (excess, y) = precise.largest(&place(precise, &phases))?;
        let noise = -i64::from(precise.bits()) / 2;
        let is_neutral = excess.magnitude().is_none_or(|magnitude| magnitude < noise);
        is_neutral.then(|| Growth::neutral(Wave::new(phases), y.to_c64() + 1.0))
    })
}

/// Half of all waves on a grid of so many, an even number, along each axis: the others are their conjugates.
pub(super) fn half_of_all_waves(dimension: usize, steps: usize) -> impl Iterator<Item = Vec<f64>> {
    let phase = move |index: usize| TAU * index as f64 / steps as f64 - PI;
    let count = (steps / 2 + 1) * steps.pow(dimension as u32 - 1);
    (0..count).map(move |mut number| {
        let first = number % (steps / 2 + 1);
        number /= steps / 2 + 1;
        let mut phases = vec![phase(first) + PI];
        for _ in 1..dimension {
            // From −π excluded to π included.
            phases.push(phase(number % steps + 1));
            number /= steps;
        }
        phases
    })
}

/// A wave by phases in `f64`; multiples of π/2 are exact.
pub(crate) fn place(precise: &PreciseStep, phases: &[f64]) -> Place {
    let axis = |phase: &f64| -> (Rational, bool) {
        let phase = if phase.abs() > PI { phase - TAU * phase.signum() } else { *phase };
        let quarters = phase / (0.5 * PI);
        let s = if quarters.round() == quarters {
            integer(quarters.abs() as i64) / integer(2)
        } else {
            from_f64((0.5 * phase).sin().powi(2)).unwrap_or_default()
        };
        (s, phase < 0.0)
    };
    precise.place_on_torus(&phases.iter().map(axis).collect::<Vec<_>>())
}

/// The maximum about a wave, by steps to its neighbours that become ever smaller.
fn refined(value: &impl Fn(&[f64]) -> f64, mut phases: Vec<f64>, size: f64) -> (f64, Vec<f64>) {
    let (mut best, mut step) = (value(&phases), size);
    let count = 3usize.pow(phases.len() as u32);
    // Roundings can be climbed for ever.
    for _ in 0..MOST_PASSES {
        if step <= FINE * size {
            break;
        }
        let mut moved = false;
        for neighbour in 1..count {
            let sign = |axis: usize| (neighbour / 3usize.pow(axis as u32) % 3 + 1) % 3;
            let to = |(axis, phase): (usize, &f64)| phase + (sign(axis) as f64 - 1.0) * step;
            let tried: Vec<f64> = phases.iter().enumerate().map(to).collect();
            let found = value(&tried);
            if found > best {
                (best, phases, moved) = (found, tried, true);
            }
        }
        if !moved {
            step *= 0.4;
        }
    }
    (best, phases)
}

/// `|z|² − 1`, logarithmic beyond 1, so that it does not overflow.
fn logarithmic((excess, _): (Float, ComplexFloat)) -> f64 {
    match excess.magnitude() > Some(0) && !excess.is_negative() {
        true => 1.0 + excess.ln(),
        false => excess.to_f64(),
    }
}
