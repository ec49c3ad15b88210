//! The measures on profiles whose faults are known.

use super::{Comparison, WaveKind};
use crate::run::{Profile, Run};
use crate::scene::Scene;

fn tube(name: &str) -> Scene {
    Scene::named(name).expect("it is in the list")
}

/// The exact solution on `n` points, displaced by `shift`, as a run.
fn exact_run(scene: &Scene, n: usize, shift: f64) -> Run {
    let time = scene.end_time;
    let mut profile = Profile::default();
    for i in 0..n {
        let x = (i as f64 + 0.5) / n as f64;
        let state = scene.exact(x - shift, time).expect("a Riemann problem");
        profile.x.push(x);
        profile.density.push(state.density());
        profile.velocity.push(state.velocity());
        profile.pressure.push(state.pressure());
        profile.energy.push(scene.material.internal_energy(&state).expect("an ideal gas"));
    }
    Run { profile, time, ..Run::default() }
}

#[test]
fn the_exact_solution_has_no_faults() {
    for name in ["ferrari1", "ferrari2", "ferrari3", "ferrari4"] {
        let tube = tube(name);
        let comparison =
            Comparison::new(&tube, &exact_run(&tube, 1000, 0.0)).expect("a Riemann problem");
        for measure in [comparison.l1, comparison.overshoot, comparison.excess_variation] {
            assert_eq!(
                [measure.density, measure.velocity, measure.pressure, measure.energy],
                [0.0; 4]
            );
        }
        assert_eq!(comparison.glitch.unwrap_or(0.0), 0.0);
        assert_eq!((comparison.inside, comparison.outside), (1000, 0));
        for wave in &comparison.waves {
            // Half a cell where the profile jumps.
            assert!(wave.error().expect("it is in the window").abs() <= 0.0005, "{name} {wave:?}");
        }
        assert!(comparison.contact_width.is_none_or(|width| width <= 0.001));
    }
}

#[test]
fn kinds_and_places_of_the_waves_of_test_1() {
    let tube = tube("ferrari1");
    let waves =
        Comparison::new(&tube, &exact_run(&tube, 2000, 0.01)).expect("a Riemann problem").waves;
    let kinds: Vec<_> = waves.iter().map(|wave| wave.kind).collect();
    assert_eq!(kinds, [WaveKind::Rarefaction, WaveKind::Shock, WaveKind::Contact]);
    for wave in &waves {
        assert!((wave.error().expect("inside") - 0.01).abs() < 0.0003, "{wave:?}");
    }
    // x = 0.3 + 0.2 v*, v* with 40 digits in the tests of the solver.
    assert!((waves[2].exact - (0.3 + 0.2 * 1.3609055190925576)).abs() < 1e-14);
    // Shock speed by the mass jump: ρ_R (s − 0) = ρ* (s − v*).
    let (ahead, behind, v) = (0.125, 0.3397002349019074, 1.3609055190925576);
    let speed = behind * v / (behind - ahead);
    assert!((waves[1].exact - (0.3 + 0.2 * speed)).abs() < 1e-13);
}

#[test]
fn known_faults_are_measured() {
    let tube = tube("sod");
    let mut run = exact_run(&tube, 100, 0.0);
    // A spike of 0.1 above the left density, whose range is 1 − 0.125; up and down.
    run.profile.density[3] += 0.0875;
    let comparison = Comparison::new(&tube, &run).expect("a Riemann problem");
    assert!((comparison.overshoot.density - 0.1).abs() < 1e-14);
    assert!((comparison.excess_variation.density - 0.2).abs() < 1e-14);
    assert!((comparison.l1.density - 0.000875).abs() < 1e-16);
    assert_eq!(comparison.overshoot.velocity, 0.0);
    // Two particles change places: the order is lost, the values are not.
    let mut run = exact_run(&tube, 100, 0.0);
    run.profile.x.swap(40, 41);
    for column in [
        &mut run.profile.density,
        &mut run.profile.velocity,
        &mut run.profile.pressure,
        &mut run.profile.energy,
    ] {
        column.swap(40, 41);
    }
    let comparison = Comparison::new(&tube, &run).expect("a Riemann problem");
    assert!(!comparison.order_preserved);
    assert_eq!(comparison.l1.density, 0.0);
    // A window that holds half of the points.
    let half = Comparison::inside(&tube, &exact_run(&tube, 100, 0.0), [0.0, 0.5])
        .expect("a Riemann problem");
    assert_eq!((half.inside, half.outside), (50, 50));
}

#[test]
fn a_step_in_a_rarefaction_is_a_glitch() {
    let tube = tube("sod");
    let mut run = exact_run(&tube, 100, 0.0);
    let velocity = tube.riemann().expect("a tube").0.velocity();
    // The fan is between 0.2634 and 0.4860; shift the velocities right of its middle.
    for i in 0..100 {
        if run.profile.x[i] > 0.37 {
            run.profile.velocity[i] += 0.2 * velocity;
        }
    }
    let glitch =
        Comparison::new(&tube, &run).expect("a Riemann problem").glitch.expect("there is a fan");
    assert!((glitch - 0.2).abs() < 1e-12, "{glitch}");
}
