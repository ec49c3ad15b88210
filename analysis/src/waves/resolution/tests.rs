use super::*;
use crate::exact::rational::{integer, ratio};
use crate::scheme::{Integrator, Step, catalogue};
use crate::waves::exact_wave::ExactWave;
use std::f64::consts::PI;

/// A space of the catalogue, exact in time, with C = 1.
fn space(name: &str) -> Branches {
    let file = catalogue::space(name).unwrap();
    let lines = file.lines(None, &[("C".into(), integer(1))], None).unwrap();
    let euler = Step::lines(&lines, Integrator::named("forward-euler").unwrap()).unwrap();
    let mut exact = ExactWave::stated(&file.exact.as_deref().unwrap().replace("C", "1"), &euler);
    Branches::of_lines(&lines, exact.as_mut().map(std::mem::take).unwrap()).unwrap()
}

#[test]
fn resolving_efficiencies_are_those_of_modified_wave_numbers() {
    // κ' of Lele 1992, by the formula, scanned from long waves: a second road to the same phase.
    type Modified = fn(f64) -> f64;
    let cases: [(&str, Modified, [f64; 3]); 5] = [
        ("central-2", |k| k.sin(), [0.25, 0.08, 0.02]),
        ("central-4", |k| (8.0 * k.sin() - (2.0 * k).sin()) / 6.0, [0.44, 0.23, 0.13]),
        (
            "central-6",
            |k| (45.0 * k.sin() - 9.0 * (2.0 * k).sin() + (3.0 * k).sin()) / 30.0,
            [0.54, 0.35, 0.23],
        ),
        ("compact-4", |k| 3.0 * k.sin() / (2.0 + k.cos()), [0.59, 0.35, 0.20]),
        (
            "compact-6",
            |k| (28.0 * k.sin() + (2.0 * k).sin()) / (18.0 + 12.0 * k.cos()),
            [0.70, 0.50, 0.35],
        ),
    ];
    for (name, modified, printed) in cases {
        let found = space(name).resolution(&[1.0], 1.0).unwrap();
        for ((phase, error), printed) in found.phases.into_iter().zip(ERRORS).zip(printed) {
            let e = found.efficiency(phase.unwrap());
            let fine = (1..).map(|k| f64::from(k) * 1e-5);
            let off = |k: &f64| (modified(*k) - k).abs() / k > error;
            let scanned = fine.into_iter().find(off).unwrap() / PI;
            assert!((e - scanned).abs() < 1e-5, "{name} {error}: {e} against {scanned}");
            // Printed with two digits, cut for some and rounded for others: 0.2396 stands as 0.23.
            assert!((e - printed).abs() < 0.01, "{name} {error}: {e}, printed {printed}");
        }
    }
}

#[test]
fn errors_add_up_over_wavelengths() {
    let central = space("central-2");
    let found = central.resolution(&[1.0], 10.0).unwrap();
    for (a, b) in [(0, 1), (1, 2)] {
        assert!((found.phases_after[a].unwrap() - found.phases[b].unwrap()).abs() < 1e-12);
    }
    // Neutral: nothing damps what disperses.
    let (ratio, phase) = found.dispersion_to_dissipation.unwrap();
    assert!((ratio - 2.001 / 0.001).abs() < 1e-6 && (phase - PI).abs() < 1e-12);
}

#[test]
fn diffusion_is_measured_by_its_decay() {
    let file = catalogue::scheme("heat-ftcs").unwrap();
    let step = file.step(None, None, &[("r".into(), ratio(1, 6))], None).unwrap();
    let exact = ExactWave::stated("-r*phi^2", &step).unwrap();
    let found = Branches::of_step(&step, exact).unwrap().resolution(&[1.0], 1.0).unwrap();
    assert_eq!(found.measure, Measure::DecayRate);
    let error = |phase: f64| {
        let z = 1.0 - 4.0 / 6.0 * (phase / 2.0).sin().powi(2);
        (z.ln() / (-phase * phase / 6.0) - 1.0).abs()
    };
    for (phase, bound) in found.phases.into_iter().zip(ERRORS) {
        let phase = phase.unwrap();
        assert!(phase == PI || (error(phase) - bound).abs() < 1e-9, "{phase} {bound}");
    }
    assert_eq!(found.dispersion_to_dissipation, None);
}

#[test]
fn an_exact_shift_resolves_everything_and_an_unstable_scheme_has_no_ratio() {
    let at = |name: &str, c: crate::exact::rational::Rational| {
        let step = catalogue::scheme(name).unwrap().step(None, None, &[("C".into(), c)], None);
        let step = step.unwrap();
        let exact = ExactWave::stated("-I*C*phi", &step).unwrap();
        Branches::of_step(&step, exact).unwrap().resolution(&[1.0], 3.0).unwrap()
    };
    assert_eq!(at("upwind", integer(1)).phases_after, [Some(PI); 3]);
    // At C = 1/2 the sawtooth is gone after one step, and all others travel right.
    let half = at("upwind", ratio(1, 2));
    assert_eq!(half.phases_after, [Some(PI); 3]);
    assert_eq!(half.efficiency(half.phases[0].unwrap()), 1.0);
    assert_eq!(at("ftcs-advection", ratio(1, 2)).dispersion_to_dissipation, None);
}
