use super::*;
use crate::exact::rational::ratio;
use crate::scheme::{Step, catalogue};

/// Dense samples of the largest multiplier, and golden sections about the best.
fn brute_force(compiled: &CompiledStep, value: f64, sign: f64) -> f64 {
    let f = |phase: f64| {
        let multipliers = compiled.multipliers(&[value], &[phase]);
        sign * multipliers.iter().map(|z| z.norm()).fold(0.0, f64::max)
    };
    let spacing = PI / 2000.0;
    let best = (0..=2000u32)
        .max_by(|&i, &j| f(f64::from(i) * spacing).total_cmp(&f(f64::from(j) * spacing)));
    let middle = f64::from(best.unwrap_or(0)) * spacing;
    let (mut lower, mut upper) = (middle - spacing, middle + spacing);
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    while upper - lower > 1e-12 {
        let left = upper - golden * (upper - lower);
        let right = lower + golden * (upper - lower);
        if f(left) < f(right) { lower = left } else { upper = right }
    }
    sign * f(middle).max(f(lower.midpoint(upper)))
}

fn check(name: &str, step: &Step, values: &[f64]) {
    let compiled = step.compile().unwrap();
    let found = SampledGain::new(&compiled).extremes(values);
    let gains = step.gain_extremes(&compiled.parameters()[0], values).unwrap();
    for (index, pair) in found.iter().enumerate() {
        let value = values[index];
        let gains = [1.0 + gains.growth[index], gains.lowest_gain[index]];
        for ((extreme, gain), sign) in pair.iter().zip(gains).zip([1.0, -1.0]) {
            let direct = brute_force(&compiled, value, sign);
            // Multipliers that meet are good to the root of a rounding, either way.
            let around = [0.0, 1e-7, -1e-7].map(|step| extreme.phase + step);
            let errors = around.map(|phase| {
                let multipliers = compiled.polynomial(&[value], &[phase]).multipliers();
                multipliers.into_iter().map(|(_, error)| error).fold(0.0, f64::max)
            });
            let tolerance = 1e-10 * direct.max(1.0) + errors.into_iter().fold(0.0, f64::max);
            // At corners the brute force may stop short; what is found must be there.
            let there = compiled.multipliers(&[value], &[extreme.phase]);
            let there = there.iter().map(|z| z.norm()).fold(0.0, f64::max);
            let direct = if sign * there > sign * direct { there } else { direct };
            assert!(
                (gain - direct).abs() <= tolerance,
                "{name} at {value}, {sign}: {gain:.14} {direct:.14} at {}, {tolerance}",
                extreme.phase
            );
            // One-step schemes by samples too, which is another road.
            let squared = 1.0 + extreme.value;
            assert!(
                (squared - direct * direct).abs() <= 3.0 * tolerance * direct.max(1.0),
                "{name}"
            );
        }
    }
}

#[test]
fn every_scheme_of_the_catalogue_agrees_with_brute_force() {
    let values: Vec<f64> = (1..20).map(|i| 0.1 * f64::from(i) + 0.003).collect();
    let mut checked = 0;
    for file in catalogue::schemes() {
        let Ok(mut step) = file.step(None, None, &[], None) else { continue };
        let Some(parameter) = file.parameter.clone() else { continue };
        for name in step.free_parameters() {
            if name != parameter {
                let value = file.parameters.get(&name).cloned().unwrap_or_else(|| ratio(1, 2));
                step = step.with(&name, &value).unwrap();
            }
        }
        if step.dimension() > 1 {
            continue;
        }
        check(&file.name, &step, &values);
        checked += 1;
    }
    assert!(checked > 40, "{checked}");
}
