//! Scenes, runs, errors and costs.

use super::*;
use crate::scene::Quantity;
use std::f64::consts::PI;

fn named(name: &str) -> AdvectionScene {
    AdvectionScene::named(name).unwrap()
}

fn step() -> AdvectionScene {
    named("advection-step")
}

/// `cos 2πmx`.
fn wave(m: f64) -> AdvectionScene {
    let text = "equation = \"advection\"\ndomain = [0, 1]\nend_time = 1\n[[layer]]\nto = 1\n";
    let (k, phase) = (2.0 * PI * m, 0.5 * PI);
    let value = format!("mean = 0, amplitude = 1, wave_number = {k:?}, phase = {phase:?}");
    AdvectionScene::parse(&format!("{text}value = {{ {value} }}"), "wave").unwrap()
}

fn plan(
    scheme: AdvectionScheme,
    scene: AdvectionScene,
    particles: usize,
    layout: Layout,
) -> RunPlan {
    let discretisation = discretisation(scheme, Kernel::CubicSpline, "2");
    RunPlan { scene, discretisation, courant_number: 0.8, particles, layout }
}

#[test]
fn the_scenes_of_the_paper() {
    let step = step();
    for (position, value) in
        [(0.0, 1.0), (0.25, 1.0), (0.499999, 1.0), (0.500001, 0.25), (0.9, 0.25)]
    {
        assert_eq!(step.initial(position), value);
        assert_eq!(step.initial(position + 3.0), value);
    }
    assert_eq!(step.exact(0.1, 0.25), 0.25);
    let smooth = named("advection-gaussian");
    assert_eq!(smooth.initial(0.5), 1.25);
    // 8·4²·0.1² = 1.28.
    assert!((smooth.initial(0.4) - (0.25 + (-1.28f64).exp())).abs() < 1e-15);
    assert_eq!(AdvectionScene::named("sod"), None);
}

#[test]
fn waves_are_waves() {
    let single = wave(3.0);
    assert!((single.initial(1.0 / 12.0)).abs() < 1e-15);
    assert!((single.exact(0.5, 0.5) - 1.0).abs() < 1e-15);
    // Every mode has modulus 1/2 in the transform of the samples, whatever its phase.
    let ring = Ring::uniform(64, 1.0).unwrap();
    let noise = Quantity::Noise { mean: 0.0, amplitude: 1.0, waves: 20, seed: 4, period: 1.0 };
    let values: Vec<f64> = ring.positions().iter().map(|&x| noise.at(x)).collect();
    // The integral against the midpoint rule, which is exact for waves this long up to their second difference.
    let sum: f64 =
        (0..10_000).map(|i| noise.at(0.3 * (f64::from(i) + 0.5) / 1e4) * 0.3 / 1e4).sum();
    assert!((noise.integral(0.0, 0.3) - sum).abs() < 1e-5);
    let modes = RingModes::new(64);
    for mode in 0..=32 {
        let expected = if (1..=20).contains(&mode) { 0.5 } else { 0.0 };
        assert!((modes.amplitude(mode, &values).norm() - expected).abs() < 1e-13);
    }
}

/// Mirrored and scaled, the flow is the same.
#[test]
fn a_flow_to_the_left_on_another_period_is_the_mirror_image() {
    let run = |scene| run(&plan(AdvectionScheme::GodunovSph, scene, 100, Layout::Uniform)).unwrap();
    let scene = |domain: &str, velocity: f64, layers: [(f64, f64); 2]| {
        let head =
            format!("equation = \"advection\"\ndomain = {domain}\nvelocity = {velocity:?}\n");
        let layers = layers.map(|(to, value)| format!("[[layer]]\nto = {to}\nvalue = {value}\n"));
        let text = format!("{head}end_time = 0.4\n{}", layers.concat());
        AdvectionScene::parse(&text, "mine").unwrap()
    };
    let right = run(scene("[0, 1]", 1.0, [(0.25, 2.0), (1.0, 1.0)]));
    let left = run(scene("[3, 5]", -2.0, [(4.5, 1.0), (5.0, 2.0)]));
    assert_eq!((right.run.steps, right.run.time), (left.run.steps, left.run.time));
    for (i, x) in left.positions.iter().enumerate() {
        let j = 99 - i;
        assert!((5.0 - x - 2.0 * right.positions[j]).abs() < 1e-13);
        assert!((left.computed[i] - right.computed[j]).abs() < 1e-13);
        assert_eq!(left.exact[i], right.exact[j]);
    }
}

#[test]
fn norms_by_hand() {
    let found =
        Comparison::new(&[0.0, 0.0, 0.0], &[1.0, 2.0, -1.0], &[1.0, 1.0, 1.0], &[1.0, 2.0, 1.0]);
    assert_eq!((found.l1, found.l_infinity), (1.0, 2.0)); // (0 + 2·1 + 2)/4
    assert_eq!(found.l2, 1.5f64.sqrt()); // (0 + 2·1 + 4)/4
    assert_eq!((found.total_variation, found.exact_total_variation), (6.0, 0.0));
    assert_eq!(found.extrema, Extrema { min: -1.0, max: 2.0 });
    assert_eq!(found.mean_drift, 1.0); // (1 + 4 − 1)/4
}

#[test]
fn work_is_counted() {
    // Cubic, ratio 2: offsets ±1 … ±3 have weights, ±4 lies on the edge; Lax–Wendroff adds v_k there: 0.
    for (scheme, layout, per_particle) in [
        (AdvectionScheme::GodunovSph, Layout::Lattice, 3),
        (AdvectionScheme::EulerSph, Layout::Lattice, 6),
        (AdvectionScheme::LaxWendroffSph, Layout::Lattice, 6),
        (AdvectionScheme::GodunovSph, Layout::Uniform, 4),
        (AdvectionScheme::EulerSph, Layout::Uniform, 8),
        (AdvectionScheme::LaxWendroffSph, Layout::Uniform, 8),
    ] {
        let result = run(&plan(scheme, step(), 100, layout)).unwrap();
        assert_eq!((result.run.steps, result.run.failure), (125, None));
        assert_eq!(result.courant_number, 0.8);
        assert_eq!(
            result.run.counters.interactions,
            125 * 100 * per_particle,
            "{scheme} {layout:?}"
        );
    }
}

#[test]
fn godunov_is_monotone_and_lax_wendroff_is_not() {
    let run = |scheme| run(&plan(scheme, step(), 200, Layout::Lattice)).unwrap().comparison;
    let godunov = run(AdvectionScheme::GodunovSph);
    assert!(godunov.extrema.max <= 1.0 + 1e-13 && godunov.extrema.min >= 0.25 - 1e-13);
    assert!(godunov.total_variation <= 1.5 + 1e-12 && godunov.exact_total_variation == 1.5);
    let lax_wendroff = run(AdvectionScheme::LaxWendroffSph);
    assert!(lax_wendroff.extrema.max > 1.05 && lax_wendroff.total_variation > 2.0);
    for comparison in [godunov, lax_wendroff] {
        assert!(comparison.mean_drift.abs() < 1e-13);
    }
}

#[test]
fn orders_of_convergence() {
    // Ratio fixed: the smoothing error of Lax–Wendroff SPH is O(l²), Godunov SPH is of first order.
    for (scheme, order) in
        [(AdvectionScheme::GodunovSph, 1.0), (AdvectionScheme::LaxWendroffSph, 2.0)]
    {
        let error = |particles| {
            let mut plan = plan(scheme, wave(1.0), particles, Layout::Lattice);
            plan.scene.end_time = 0.25;
            run(&plan).unwrap().comparison.l2
        };
        let observed = (error(400) / error(800)).log2();
        assert!((observed - order).abs() < 0.03, "{scheme}: {observed}");
    }
}

#[test]
fn a_run_without_end_does_not_start() {
    let mut plan =
        plan(AdvectionScheme::GodunovSph, named("advection-square"), 10, Layout::Lattice);
    plan.scene.end_time = 1e300;
    let error = run(&plan).unwrap_err();
    // Ten particles at the plan's Courant number.
    let InvalidOptions::TooMuch { what: "steps", needed, .. } = error else { panic!("{error}") };
    assert!((needed * plan.courant_number / 1e301 - 1.0).abs() < 1e-12);
    assert!(error.to_string().contains("steps: 1.250e301 would be needed"), "{error}");
}

#[test]
fn steps_divide_the_way_evenly() {
    for (courant_number, steps) in [(0.1, 2000), (0.3, 667), (1.9, 106), (200.0, 1), (500.0, 1)] {
        let mut plan = plan(AdvectionScheme::GodunovSph, step(), 200, Layout::Lattice);
        plan.courant_number = courant_number;
        let result = run(&plan).unwrap();
        assert_eq!(result.run.steps, steps);
        assert!(result.courant_number <= courant_number * (1.0 + 1e-15));
        assert!((result.courant_number * steps as f64 - 200.0).abs() < 1e-10);
    }
    // A Courant number short by a rounding takes no step more.
    let mut plan = plan(AdvectionScheme::GodunovSph, step(), 300, Layout::Lattice);
    plan.courant_number = 0.3f64.next_down();
    assert!(300.0 / plan.courant_number > 1000.0);
    assert_eq!(run(&plan).unwrap().run.steps, 1000);
}

#[test]
fn plans_out_of_range_are_refused() {
    let good = plan(AdvectionScheme::GodunovSph, step(), 10, Layout::Uniform);
    let with = |change: fn(&mut RunPlan)| {
        let mut plan = good.clone();
        change(&mut plan);
        run(&plan).unwrap_err()
    };
    let not_positive = |name, value| InvalidOptions::NotPositive { name, value };
    assert_eq!(with(|p| p.courant_number = -1.0), not_positive("cfl", -1.0));
    assert_eq!(with(|p| p.scene.end_time = 0.0), not_positive("time", 0.0));
    let nobody = InvalidOptions::Particles { particles: 0, least: 1 };
    assert_eq!(with(|p| p.particles = 0), nobody);
}
