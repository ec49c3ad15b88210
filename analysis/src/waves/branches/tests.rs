use super::*;
use crate::exact::rational::{Rational, ratio};
use crate::scheme::catalogue;
use proptest::prelude::*;

fn named(name: &str, values: &[(&str, Rational)]) -> Branches {
    let file = catalogue::scheme(name).unwrap();
    let values: Vec<_> = values.iter().map(|(n, v)| (n.to_string(), v.clone())).collect();
    let step = file.step(None, None, &values, None).unwrap();
    let exact = ExactWave::stated(file.exact.as_deref().unwrap(), &step).unwrap();
    Branches::of_step(&step, exact).unwrap()
}

fn phases(count: u32) -> Vec<f64> {
    (1..=count).map(|k| PI * f64::from(k) / f64::from(count)).collect()
}

#[test]
fn leapfrog_has_two_branches_with_opposite_groups() {
    for c in [(1, 2), (9, 10), (999, 1000), (9999, 10000)] {
        let all = named("leapfrog", &[("C", ratio(c.0, c.1))]).along(&[1.0], &phases(64));
        let c = f64::from(c.0 as i32) / f64::from(c.1 as i32);
        let [physical, computational] = &all[..] else { panic!("two branches") };
        assert_eq!((physical.physical, computational.physical), (Some(0), None));
        for (p, q) in physical.waves.iter().zip(&computational.waves) {
            // sin ωΔt = C sin φ, ω Δt in [−π/2, π/2], and π minus that.
            let omega = (c * p.phase.sin()).asin();
            assert!((p.exponent.im + omega).abs() < 1e-12, "{c} {}", p.phase);
            assert!((q.multiplier + Complex64::cis(omega)).norm() < 1e-12);
            let group = p.phase.cos() / (1.0 - (c * p.phase.sin()).powi(2)).sqrt();
            assert!((p.group_speed().unwrap() - group).abs() < 1e-9);
            assert!((q.group_speed().unwrap() + group).abs() < 1e-9);
        }
        let sawtooth = physical.waves.last().unwrap();
        assert!((sawtooth.group_speed().unwrap() + 1.0).abs() < 1e-12);
        assert!((computational.waves[0].group_speed().unwrap() + 1.0).abs() < 1e-2);
    }
}

#[test]
fn branches_that_cross_go_straight_on() {
    // At C = 1 two multipliers cross at four cells, and the physical one is exact.
    let all = named("leapfrog", &[("C", ratio(1, 1))]).along(&[1.0], &phases(60));
    for wave in &all[0].waves {
        assert!((wave.phase_speed().unwrap() - 1.0).abs() < 1e-7, "{}", wave.phase);
        let crossing = (wave.phase - PI / 2.0).abs() < 1e-12;
        assert!(crossing || (wave.group_speed().unwrap() - 1.0).abs() < 1e-7);
    }
}

#[test]
fn branches_that_meet_and_leave_the_circle_keep_one_each() {
    // sin φ > 1/C: both multipliers at −i, one grows. The branch of the equation is the one that grows.
    let all = named("leapfrog", &[("C", ratio(5, 4))]).along(&[1.0], &phases(100));
    for (p, q) in all[0].waves.iter().zip(&all[1].waves) {
        let reach = 1.25 * p.phase.sin();
        if reach > 1.0 {
            let gain = reach + (reach * reach - 1.0).sqrt();
            assert!((p.gain() - gain).abs() < 1e-9, "{}: {} {gain}", p.phase, p.gain());
            assert!((q.gain() * gain - 1.0).abs() < 1e-9);
        } else {
            assert!((p.gain() - 1.0).abs() < 1e-9 && (q.gain() - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn arguments_do_not_jump() {
    // Upwind at C = 4/5: from 0 to −π without a turn.
    let all = named("upwind", &[("C", ratio(4, 5))]).along(&[1.0], &phases(50));
    let last = all[0].waves.last().unwrap();
    assert!((last.exponent.im + PI).abs() < 1e-12 && (last.gain() - 0.6).abs() < 1e-12);
    // Exact shifts by three cells turn one and a half times.
    let three = named("implicit-upwind", &[("C", ratio(-3, 1))]).along(&[1.0], &[1.0]);
    assert_eq!(three.len(), 1);
}

#[test]
fn waves_to_both_sides_are_physical() {
    let all = named("wave-2", &[("C", ratio(1, 2))]).along(&[1.0], &phases(16));
    assert_eq!(all.iter().map(|b| b.physical).collect::<Vec<_>>(), [Some(0), Some(1)]);
    for branch in &all {
        for wave in &branch.waves {
            let omega = 2.0 * (0.5 * (wave.phase / 2.0).sin()).asin();
            assert!((wave.phase_speed().unwrap() - omega / (0.5 * wave.phase)).abs() < 1e-11);
        }
    }
}

#[test]
fn yee_travels_slowest_along_an_axis_and_polarisations_are_one_branch() {
    let yee = named("yee-3d", &[("C", ratio(1, 2))]);
    let speed = |direction: &[f64]| {
        let all = yee.along(direction, &[0.5, 1.0]);
        assert_eq!(all.iter().filter(|branch| branch.physical.is_some()).count(), 2);
        all[0].waves[1].phase_speed().unwrap()
    };
    let third = (1.0f64 / 3.0).sqrt();
    let (axis, body) = (speed(&[1.0, 0.0, 0.0]), speed(&[third; 3]));
    // sin²(ωΔt/2) = C² Σ_a sin²(φ_a/2).
    let exact = |sum: f64| 2.0 * (0.5 * sum.sqrt()).asin() / 0.5;
    assert!((axis - exact(0.5f64.sin().powi(2))).abs() < 1e-12);
    assert!((body - exact(3.0 * (0.5 * third).sin().powi(2))).abs() < 1e-12);
    assert!(axis < body && body < 1.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    /// Group speeds of followed branches against differences of their phases: a second road to the implicit derivative.
    #[test]
    fn group_speeds_are_differences_of_phases(which in 0usize..400, turn in 0.2f64..1.3, modulus in 0.3f64..2.5) {
        let files: Vec<_> = catalogue::schemes().iter().filter(|f| f.exact.is_some() && !f.needs_kernel()).collect();
        let file = files[which % files.len()];
        let mut step = file.step(None, None, &[], None).unwrap();
        for name in step.free_parameters() {
            step = step.with(&name, &ratio(1, 5)).unwrap();
        }
        let exact = ExactWave::stated(file.exact.as_deref().unwrap(), &step).unwrap();
        let branches = Branches::of_step(&step, exact).unwrap();
        let third = (1.0f64 / 3.0).sqrt();
        let plane = [turn.cos(), turn.sin()];
        let direction: &[f64] = match step.dimension() { 1 => &[1.0], 2 => &plane, _ => &[third; 3] };
        let h = 1e-5;
        for branch in branches.along(direction, &[modulus - h, modulus, modulus + h]) {
            let [before, here, after] = &branch.waves[..] else { panic!("three waves") };
            prop_assume!(here.slope.is_finite() && here.slope.norm() < 1e3 && here.gain() > 1e-3);
            let differ = (after.exponent - before.exponent) / (2.0 * h);
            prop_assert!((differ - here.slope).norm() < 1e-4 * (1.0 + here.slope.norm()), "{} {branch:?}", file.name);
        }
    }

    #[test]
    fn every_scheme_with_an_exact_step_has_a_physical_branch(which in 0usize..400) {
        let files: Vec<_> = catalogue::schemes().iter().filter(|f| f.exact.is_some() && !f.needs_kernel()).collect();
        let file = files[which % files.len()];
        let mut step = file.step(None, None, &[], None).unwrap();
        for name in step.free_parameters() {
            step = step.with(&name, &ratio(1, 5)).unwrap();
        }
        let exact = ExactWave::stated(file.exact.as_deref().unwrap(), &step).unwrap();
        let branches = Branches::of_step(&step, exact).unwrap();
        let direction: &[f64] = match step.dimension() { 1 => &[1.0], 2 => &[0.8, 0.6], _ => &[0.48, 0.6, 0.64] };
        let all = branches.along(direction, &[0.01]);
        prop_assert_eq!(all[0].physical, Some(0), "{}", file.name);
    }
}
