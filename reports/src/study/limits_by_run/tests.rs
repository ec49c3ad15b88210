use super::*;
use courant_analysis::exact::rational::parse;

fn case(scheme: AdvectionScheme, kernel: Kernel, ratio: &str) -> Discretisation {
    discretisation(scheme, kernel, &parse(ratio).unwrap())
}

fn plan(resolution: f64) -> Plan {
    let cubic = "{ scheme = \"godunov-sph\", kernel = \"cubic-spline\", ratio = \"2\" }";
    toml::from_str(&format!(
        "particles = 32\nresolution = {resolution}\nwindows = 10000\nsteps_per_window = 64\nsweeps = []\n\
         [long]\nparticles = 16\nsteps = {{ quick = 0, standard = 0, full = 0 }}\n\
         about = [[{cubic}, 1e-5]]\nat = []\ndrifting = {cubic}\nslow = {cubic}\n"
    ))
    .unwrap()
}

#[test]
fn limits_by_run_are_those_of_the_ring_and_bound_the_proved_ones() {
    for (scheme, kernel, ratio) in [
        (AdvectionScheme::GodunovSph, Kernel::CubicSpline, "2"),
        (AdvectionScheme::GodunovSph, Kernel::Gaussian, "1"),
        (AdvectionScheme::GodunovSph, Kernel::WendlandC2, "1.3"),
        (AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, "1"),
    ] {
        let found = compare_limits(&case(scheme, kernel, ratio), &plan(1e-7)).unwrap();
        let MeasuredLimit { stable, unstable, runs, .. } = found.measured;
        assert!(unstable - stable <= 1e-7 && runs < 25);
        // Each run goes on until the fastest mode is alone. One that grows by less than 1e-13 per step counts
        // as stable, which moves the limit by far less than the width.
        assert!(
            stable - 1e-9 <= found.ring && found.ring <= unstable + 1e-9,
            "{scheme} {kernel} {ratio}: {found:?}"
        );
        assert!(found.ring >= found.proved.lower());
        // The ring misses the lattice's limit by O(φ²) = O(0.04) at most.
        assert!(found.ring - found.proved.upper() < 0.04 * found.proved.upper());
    }
}

#[test]
fn euler_is_unstable_at_once_and_a_bad_bracket_is_told() {
    let euler = case(AdvectionScheme::EulerSph, Kernel::CubicSpline, "2");
    let found = compare_limits(&euler, &plan(1e-4)).unwrap();
    assert_eq!((found.ring, found.measured.stable), (0.0, 0.0));
    let godunov = case(AdvectionScheme::GodunovSph, Kernel::CubicSpline, "2");
    let search = |bracket| measured_limit(&godunov, bracket, &plan(1e-3));
    assert_eq!(search((2.5, 3.0)), Err(NoBracket::LowerGrows(2.5)));
    assert_eq!(search((0.5, 1.0)), Err(NoBracket::UpperDoesNotGrow(1.0)));
}

#[test]
fn a_million_steps_below_and_above_the_limit() {
    let runs = long_runs(&plan(1e-6).long, 1_000_000);
    let [below, above] = &runs[..] else { panic!("one case, on both sides") };
    assert!(below.what.contains("below") && above.what.contains("above"));
    assert_eq!((below.growth.steps, below.fastest_mode, above.fastest_mode), (1_000_000, 1, 1));
    assert_eq!(below.growth.verdict, GrowthVerdict::Decaying);
    assert_eq!(above.growth.verdict, GrowthVerdict::Growing);
    for run in &runs {
        // Only one mode is left; a window of 1000 steps gives its rate to 1e-15/1000.
        assert!((run.growth.gain_per_step - run.predicted_gain).abs() < 1e-14, "{run:?}");
    }
}

#[test]
fn a_mean_that_grows_is_growth() {
    // Hard case: Lax–Wendroff SPH with the cubic spline does not keep a constant at ratio 1.3.
    let case = case(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, "1.3");
    let mean = case.stencil(0.5).at_phase(0.0).re;
    let plan = GrowthPlan { windows: 20, steps_per_window: 50, stop_when_settled: false };
    let run = LongRun::new(String::new(), case, 0.5, 32, &plan);
    assert!((run.growth.mean_gain - mean).abs() < 1e-14);
    assert_eq!(run.growth.verdict == GrowthVerdict::Growing, run.predicted_gain > 1.0);
    assert!((mean - 1.0).abs() > 1e-3, "{mean}");
}

#[test]
fn a_growth_of_a_millionth_is_measured() {
    // Hard case: Lax–Wendroff SPH with the cut Gaussian grows by about 1e-6 per step where it looks stable.
    let case = case(AdvectionScheme::LaxWendroffSph, Kernel::Gaussian, "2.5");
    let plan = GrowthPlan { windows: 10_000, steps_per_window: 64, stop_when_settled: true };
    let run = LongRun::new(String::new(), case, 1.0, 24, &plan);
    assert!((1e-8..1e-4).contains(&(run.predicted_gain - 1.0)), "{run:?}");
    assert_eq!(run.growth.verdict, GrowthVerdict::Growing);
    // Settled to a hundredth of the rate.
    let measured = run.growth.gain_per_step - 1.0;
    assert!((measured / (run.predicted_gain - 1.0) - 1.0).abs() < 0.01, "{measured}");
}
