//! Growth and limits by run.

use super::*;
use courant_analysis::exact::rational::integer;

/// `u ← g u`.
struct Factor(f64, Vec<f64>);

impl Stepper for Factor {
    fn step(&mut self) {
        self.1.iter_mut().for_each(|value| *value *= self.0);
    }
    fn state(&self) -> &[f64] {
        &self.1
    }
    fn set_state(&mut self, values: &[f64]) {
        self.1 = values.to_vec();
    }
    fn interactions_per_step(&self) -> u64 {
        1
    }
}

#[test]
fn growth_is_told_from_what_stays_and_decays() {
    for (factor, verdict) in [
        (0.99, GrowthVerdict::Decaying),
        (0.0, GrowthVerdict::Decaying),
        (1.0, GrowthVerdict::Neutral),
        (1.001, GrowthVerdict::Growing),
        (1e300, GrowthVerdict::Growing),
    ] {
        let mut stepper = Factor(factor, vec![0.3, 1.0, -0.2]);
        let growth = measure_growth(&mut stepper, &GrowthPlan::lattice(100, 20));
        assert_eq!(growth.verdict, verdict, "{factor}");
        let gain = if factor > 1e9 { f64::INFINITY } else { factor };
        assert!(growth.gain_per_step == gain || (growth.gain_per_step - gain).abs() < 1e-14);
    }
}

#[test]
fn limits_by_run_are_those_of_the_ring_and_bound_the_proved_ones() {
    for (scheme, kernel, ratio) in [
        (AdvectionScheme::GodunovSph, Kernel::CubicSpline, "2"),
        (AdvectionScheme::GodunovSph, Kernel::Gaussian, "1"),
        (AdvectionScheme::GodunovSph, Kernel::WendlandC2, "1.3"),
        (AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, "1"),
    ] {
        let discretisation = discretisation(scheme, kernel, ratio);
        let comparison = compare_limits(
            &discretisation,
            32,
            &integer(10),
            1e-7,
            &GrowthPlan::settling(10_000, 64),
        )
        .unwrap();
        let MeasuredLimit { stable, unstable, runs, .. } = comparison.measured;
        assert!(unstable - stable <= 1e-7 && runs < 25);
        // Each run goes on until the fastest mode is alone. One that grows by less than 1e-13 per step counts
        // as stable, which moves the limit by far less than the width.
        assert!(
            stable - 1e-9 <= comparison.ring && comparison.ring <= unstable + 1e-9,
            "{scheme} {kernel} {ratio}: {comparison:?}"
        );
        assert!(comparison.ring >= comparison.proved.lower());
        // The ring misses the lattice's limit by O(φ²) = O(0.04) at most.
        assert!(comparison.ring - comparison.proved.upper() < 0.04 * comparison.proved.upper());
    }
}

#[test]
fn euler_is_unstable_at_once_and_a_bad_bracket_is_told() {
    let euler = discretisation(AdvectionScheme::EulerSph, Kernel::CubicSpline, "2");
    let found =
        compare_limits(&euler, 32, &integer(1), 1e-4, &GrowthPlan::settling(10_000, 64)).unwrap();
    assert_eq!((found.ring, found.measured.stable), (0.0, 0.0));
    let godunov = discretisation(AdvectionScheme::GodunovSph, Kernel::CubicSpline, "2");
    let search = |bracket| {
        measured_stability_limit(&godunov, 32, bracket, 1e-3, &GrowthPlan::lattice(20, 64))
    };
    assert_eq!(search((2.5, 3.0)), Err(NoBracket::LowerGrows(2.5)));
    assert_eq!(search((0.5, 1.0)), Err(NoBracket::UpperDoesNotGrow(1.0)));
}

#[test]
fn a_million_steps_below_and_above_the_limit() {
    let discretisation = discretisation(AdvectionScheme::GodunovSph, Kernel::CubicSpline, "2");
    let plan = GrowthPlan::lattice(1000, 1000);
    let ring =
        compare_limits(&discretisation, 16, &integer(10), 1e-6, &GrowthPlan::settling(10_000, 64));
    let limit = ring.unwrap().ring;
    let below = long_run(&discretisation, limit * (1.0 - 1e-5), 16, &plan);
    let above = long_run(&discretisation, limit * (1.0 + 1e-5), 16, &plan);
    assert_eq!((below.steps, below.fastest_mode, above.fastest_mode), (1_000_000, 1, 1));
    assert_eq!(below.growth.verdict, GrowthVerdict::Decaying);
    assert_eq!(above.growth.verdict, GrowthVerdict::Growing);
    for run in [below, above] {
        // Only one mode is left; a window of 1000 steps gives its rate to 1e-15/1000.
        assert!((run.growth.gain_per_step - run.predicted_gain).abs() < 1e-14, "{run:?}");
    }
}

#[test]
fn a_mean_that_grows_is_growth() {
    // Hard case: Lax–Wendroff SPH with the cubic spline does not keep a constant at ratio 1.3.
    let discretisation =
        discretisation(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, "1.3");
    let run = long_run(&discretisation, 0.5, 32, &GrowthPlan::lattice(20, 50));
    let mean = discretisation.stencil(0.5).at_phase(0.0).re;
    assert!((run.growth.mean_gain - mean).abs() < 1e-14);
    assert_eq!(run.growth.verdict == GrowthVerdict::Growing, run.predicted_gain > 1.0);
    assert!((mean - 1.0).abs() > 1e-3, "{mean}");
}

#[test]
fn a_growth_of_a_millionth_is_measured() {
    // Hard case: Lax–Wendroff SPH with the cut Gaussian grows by about 1e-6 per step where it looks stable.
    let discretisation = discretisation(AdvectionScheme::LaxWendroffSph, Kernel::Gaussian, "2.5");
    let run = long_run(&discretisation, 1.0, 24, &GrowthPlan::settling(10_000, 64));
    assert!((1e-8..1e-4).contains(&(run.predicted_gain - 1.0)), "{run:?}");
    assert_eq!(run.growth.verdict, GrowthVerdict::Growing);
    // Settled to a hundredth of the rate.
    let measured = run.growth.gain_per_step - 1.0;
    assert!((measured / (run.predicted_gain - 1.0) - 1.0).abs() < 0.01, "{measured}");
}

#[test]
fn the_printed_limits_of_table_1_grow_at_the_predicted_rate() {
    for (kernel, ratio, printed) in [
        (Kernel::Gaussian, "1", 1.20),
        (Kernel::Gaussian, "2", 2.30),
        (Kernel::Gaussian, "3", 3.40),
        (Kernel::Gaussian, "4", 4.55),
        (Kernel::Gaussian, "5", 5.70),
        (Kernel::Gaussian, "10", 11.50),
        (Kernel::CubicSpline, "1", 1.00),
        (Kernel::CubicSpline, "2", 1.90),
        (Kernel::CubicSpline, "3", 2.85),
        (Kernel::CubicSpline, "4", 3.75),
        (Kernel::CubicSpline, "5", 4.70),
        (Kernel::CubicSpline, "10", 9.45),
    ] {
        let discretisation = discretisation(AdvectionScheme::GodunovSph, kernel, ratio);
        let row = growth_at(&discretisation, printed, 32..=256, 1000);
        // 1000 steps of rounding in a wave of amplitude 1, spread over 1000 steps.
        let measured = row.measured_gain.unwrap();
        assert!((measured - row.predicted_gain).abs() < 1e-14, "{row:?}");
        // The ring's mode reaches the growth of the lattice but for a few per cent.
        assert!(row.largest_gain >= row.predicted_gain - 1e-14);
        let shortfall =
            (row.largest_gain - row.predicted_gain) / (row.largest_gain - 1.0).max(1e-12);
        assert!(shortfall < 0.02, "{row:?}");
        // Only the exact shift (cubic, ratio 1, C = 1) is truly neutral; the rest were printed too high.
        assert_eq!(row.predicted_gain > 1.0 + 1e-6, (kernel, ratio) != (Kernel::CubicSpline, "1"));
        assert!(measured < 1.02);
    }
}

#[test]
fn disorder_starts_from_the_lattice() {
    let discretisation = discretisation(AdvectionScheme::GodunovSph, Kernel::CubicSpline, "2");
    let study =
        gain_against_disorder(&discretisation, 1.0, 48, &[0, 1, 6, 24], &[0.0, 0.01, 0.02, 0.2], 6)
            .unwrap();
    let at = |disorder: f64| study.modes.iter().filter(move |row| row.disorder == disorder);
    for row in at(0.0) {
        assert!((row.mean - row.lattice).norm() < 1e-13 && row.scattered < 1e-13, "{row:?}");
        assert!(row.spread < 1e-13);
    }
    for ((small, double), large) in at(0.01).zip(at(0.02)).zip(at(0.2)) {
        // What is scattered is of first order in the displacements, which scale with the same seeds.
        assert!((double.scattered / small.scattered - 2.0).abs() < 0.1, "{small:?} {double:?}");
        assert!(large.scattered > double.scattered);
        // What a wave keeps changes in second order only, but for the luck of the draw in few sets.
        assert!((small.mean - small.lattice).norm() < small.scattered);
    }
    for row in &study.growth {
        // Godunov SPH conserves on any positions, so 1 is an eigenvalue; here none is larger.
        assert!(row.smallest_gain <= row.largest_gain, "{row:?}");
        assert!((row.mean_gain - 1.0).abs() < 1e-9, "{row:?}");
    }
}

#[test]
fn the_long_run_of_a_lattice_is_its_fastest_wave() {
    let discretisation = discretisation(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, "2");
    // 2 % above the limit √3: the growth is 5e-5, which thousands of steps hardly show.
    let (courant, particles) = (1.02 * 3f64.sqrt(), 64);
    let study =
        gain_against_disorder(&discretisation, courant, particles, &[1], &[0.0], 1).unwrap();
    let stencil = discretisation.stencil(courant);
    let fastest = (0..particles)
        .map(|mode| std::f64::consts::TAU * mode as f64 / particles as f64)
        .map(|phase| stencil.at_phase(phase).norm())
        .fold(0.0, f64::max);
    assert!(fastest > 1.00005);
    // Copies of an eigenvalue lengthen the norm by at most √64: its root of order 2^36 is 1 + 3e-11.
    assert!((study.growth[0].mean_gain - fastest).abs() < 1e-10, "{:?}", study.growth[0]);
}
