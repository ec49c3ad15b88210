//! Scenes, runs, errors and costs.

use super::*;
use proptest::prelude::*;
use std::ops::ControlFlow;

fn plan(scheme: AdvectionScheme, scene: Scene, particles: usize, layout: Layout) -> RunPlan {
    let method = method(scheme, Kernel::CubicSpline, "2", 0.8);
    RunPlan { scene, method, particles, periods: 1.0, layout }
}

#[test]
fn the_scenes_of_the_paper() {
    let step = Scene::Step;
    for (position, value) in [(0.0, 1.0), (0.25, 1.0), (0.5, 1.0), (0.500001, 0.25), (0.9, 0.25)] {
        assert_eq!(step.initial(position), value);
        assert_eq!(step.initial(position + 3.0), value);
    }
    assert_eq!(step.exact(0.1, 0.25), 0.25);
    let smooth = Scene::Gaussian;
    assert_eq!(smooth.initial(0.5), 1.25);
    // 8·4²·0.1² = 1.28.
    assert!((smooth.initial(0.4) - (0.25 + (-1.28f64).exp())).abs() < 1e-15);
    for scene in Scene::NAMED {
        assert_eq!(scene.name().parse(), Ok(scene));
    }
    assert!("advection-ramp".parse::<Scene>().is_err());
}

#[test]
fn waves_are_waves() {
    let single = Scene::mode(3);
    assert!((single.initial(1.0 / 12.0)).abs() < 1e-15);
    assert!((single.exact(0.5, 0.5) - 1.0).abs() < 1e-15);
    // Σ_{m=1}^{M} cos 2πmx = (sin((2M+1)πx)/sin πx − 1)/2.
    let (x, highest) = (0.137, 20);
    let kernel = (std::f64::consts::PI * x * (2 * highest + 1) as f64).sin()
        / (std::f64::consts::PI * x).sin();
    assert!((Scene::all_modes(highest).initial(x) - 0.5 * (kernel - 1.0)).abs() < 1e-12);
    // Every mode has modulus 1/2 in the transform of the samples, whatever its phase.
    let ring = Ring::uniform(64, 1.0).unwrap();
    let scene = Scene::random_phases(20, 4);
    let values: Vec<f64> = ring.positions().iter().map(|&x| scene.initial(x)).collect();
    let modes = RingModes::new(64);
    for mode in 0..=32 {
        let expected = if (1..=20).contains(&mode) { 0.5 } else { 0.0 };
        assert!((modes.amplitude(mode, &values).norm() - expected).abs() < 1e-13);
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
        (AdvectionScheme::GodunovSph, Layout::Uniform, 8),
        (AdvectionScheme::EulerSph, Layout::Uniform, 8),
        (AdvectionScheme::LaxWendroffSph, Layout::Uniform, 8),
    ] {
        let result = run(&plan(scheme, Scene::Step, 100, layout)).unwrap();
        assert_eq!((result.steps, result.outcome), (125, Outcome::Completed));
        assert_eq!(result.courant_number, 0.8);
        assert_eq!(result.interactions, 125 * 100 * per_particle, "{scheme} {layout:?}");
    }
}

#[test]
fn both_layouts_give_the_same_run() {
    for scheme in [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph] {
        let lattice = run(&plan(scheme, Scene::Gaussian, 200, Layout::Lattice)).unwrap();
        let particles = run(&plan(scheme, Scene::Gaussian, 200, Layout::Uniform)).unwrap();
        // Positions up to 1 carry 1e-16, distances of 0.005 a hundred times that, over 250 steps.
        assert!(distance(&lattice.computed, &particles.computed) < 1e-11, "{scheme}");
        let still = Layout::Disordered { disorder: 0.0, seed: 1 };
        let disordered = run(&plan(scheme, Scene::Gaussian, 200, still)).unwrap();
        assert!(distance(&lattice.computed, &disordered.computed) < 1e-11, "{scheme}");
    }
}

#[test]
fn godunov_is_monotone_and_lax_wendroff_is_not() {
    let run = |scheme| run(&plan(scheme, Scene::Step, 200, Layout::Lattice)).unwrap().comparison;
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
            let mut plan = plan(scheme, Scene::mode(1), particles, Layout::Lattice);
            plan.periods = 0.25;
            run(&plan).unwrap().comparison.l2
        };
        let observed = (error(400) / error(800)).log2();
        assert!((observed - order).abs() < 0.03, "{scheme}: {observed}");
    }
}

#[test]
fn an_unstable_run_ends_with_a_reason() {
    let mut plan = plan(AdvectionScheme::EulerSph, Scene::Step, 100, Layout::Lattice);
    plan.method.courant_number = 1.0;
    plan.periods = 1000.0;
    let result = run(&plan).unwrap();
    let Outcome::Overflowed { steps } = result.outcome else { panic!("{:?}", result.outcome) };
    assert_eq!(steps, result.steps);
    assert!(steps < 20_000 && result.time < 1000.0);
    assert!(!result.comparison.l2.is_finite());
}

#[test]
fn a_run_without_end_does_not_start() {
    let mut plan = plan(AdvectionScheme::GodunovSph, Scene::SquareWave, 10, Layout::Lattice);
    plan.periods = 1e300;
    let error = run(&plan).unwrap_err();
    // Ten particles at the plan's Courant number.
    let PlanError::Steps(steps) = error else { panic!("{error}") };
    assert!((steps * plan.method.courant_number / 1e301 - 1.0).abs() < 1e-12);
    assert!(error.to_string().contains("e301 steps"), "{error}");
}

#[test]
fn an_observer_may_stop_a_run() {
    let mut plan = plan(AdvectionScheme::GodunovSph, Scene::Step, 100, Layout::Lattice);
    plan.periods = 100.0;
    let result = run_with(&plan, |time| {
        if time > 4.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })
    .unwrap();
    // 12,500 equal steps to 100 periods: the 501st passes 4.
    assert_eq!(result.outcome, Outcome::Cancelled { steps: 501 });
    assert!((result.time - 501.0 * 100.0 / 12_500.0).abs() < 1e-12);
}

#[test]
fn steps_divide_the_way_evenly() {
    for (courant_number, steps) in [(0.1, 2000), (0.3, 667), (1.9, 106), (200.0, 1), (500.0, 1)] {
        let mut plan = plan(AdvectionScheme::GodunovSph, Scene::Step, 200, Layout::Lattice);
        plan.method.courant_number = courant_number;
        let result = run(&plan).unwrap();
        assert_eq!(result.steps, steps);
        assert!(result.courant_number <= courant_number * (1.0 + 1e-15));
        assert!((result.courant_number * steps as f64 - 200.0).abs() < 1e-10);
    }
    // A Courant number short by a rounding takes no step more.
    let mut plan = plan(AdvectionScheme::GodunovSph, Scene::Step, 300, Layout::Lattice);
    plan.method.courant_number = 0.3f64.next_down();
    assert!(300.0 / plan.method.courant_number > 1000.0);
    assert_eq!(run(&plan).unwrap().steps, 1000);
}

#[test]
fn plans_out_of_range_are_refused() {
    let good = plan(AdvectionScheme::GodunovSph, Scene::Step, 10, Layout::Uniform);
    let with = |change: fn(&mut RunPlan)| {
        let mut plan = good.clone();
        change(&mut plan);
        run(&plan).unwrap_err()
    };
    assert_eq!(with(|p| p.method.ratio = 0.0), PlanError::Method(MethodError::Ratio(0.0)));
    assert_eq!(
        with(|p| p.method.courant_number = -1.0),
        PlanError::Method(MethodError::CourantNumber(-1.0))
    );
    assert_eq!(with(|p| p.periods = 0.0), PlanError::Periods(0.0));
    assert_eq!(with(|p| p.particles = 0), PlanError::Ring(RingError::Empty));
}

proptest! {
    #[test]
    fn the_front_is_what_nothing_beats(points in prop::collection::vec((0u8..20, 0u8..20), 1..40)) {
        let points: Vec<(f64, f64)> =
            points.into_iter().map(|(a, b)| (f64::from(a), f64::from(b))).collect();
        let front = pareto_front(&points);
        for (index, &(cost, error)) in points.iter().enumerate() {
            let beaten = points.iter().enumerate().any(|(other, &(c, e))| {
                c <= cost && e <= error && ((c, e) != (cost, error) || other < index)
            });
            prop_assert_eq!(front.contains(&index), !beaten);
        }
        for target in [0.0, 5.0, 19.0] {
            let found = recommend(&points, &[target])[0];
            let cheapest = points.iter().filter(|p| p.1 <= target).map(|p| p.0).reduce(f64::min);
            prop_assert_eq!(found.choice.map(|index| points[index].0), cheapest);
        }
    }
}
