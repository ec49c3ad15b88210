//! Block steps: what is recomputed of whom, what is conserved, and what is saved.

use super::pairs::{air, disordered};
use crate::boundary::Boundary;
use crate::march::march;
use crate::particles::*;
use crate::riemann::ExactIdeal;
use courant_analysis::kernel::Kernel;
use std::ops::ControlFlow;

const FORCE: Smoothed = Smoothed { form: PressureForm::Sum, viscosity: Viscosity::STANDARD };

/// At one time the active particles get what they would get if everybody were active, and the passive ones exactly
/// the opposite of what they give.
fn check_active<const D: usize>(boundary: Boundary) {
    let count = 1500;
    let mut all = disordered::<D>(air(), boundary, count, 3, &FORCE, Kernel::CubicSpline);
    all.update_fields().expect("a physical state");
    let mut some = all.clone();
    let active: Vec<u32> = (0..count as u32).filter(|i| i % 7 < 2).collect();
    some.update_active(&active).expect("a physical state");
    let [mut whole, mut part] = [Rates::default(), Rates::default()];
    all.evaluate(&FORCE, &mut whole, None);
    some.evaluate(&FORCE, &mut part, None);
    for &i in &active {
        let i = i as usize;
        assert!((some.density()[i] / all.density()[i] - 1.0).abs() < 1e-12);
        let scale: f64 = whole.acceleration[i].iter().map(|a| a.abs()).sum();
        for axis in 0..D {
            let change = part.acceleration[i][axis] - whole.acceleration[i][axis];
            assert!(change.abs() <= 1e-6 * scale, "{D} {boundary:?} {i}: {change:e} of {scale:e}");
        }
    }
    let mut total = part.wall_force.map(|force| -force);
    let (mut scale, mut power) = (0.0, 0.0);
    for &i in &part.touched {
        let i = i as usize;
        let mass = some.particles.mass[i];
        for (sum, component) in total.iter_mut().zip(&part.acceleration[i]) {
            *sum += mass * component;
            scale += (mass * component).abs();
        }
        power += mass * part.energy[i];
    }
    assert!(total.iter().all(|sum| sum.abs() < 1e-13 * scale), "{total:?} of {scale:e}");
    assert!(power.abs() < 1e-12 * scale, "{power:e}");
    assert!(part.touched.len() > active.len() && part.touched.len() <= count);
    let all_pairs = all.counters.interactions;
    assert!(some.counters.interactions < all_pairs && some.counters.interactions * 4 > all_pairs);
}

#[test]
fn active_particles_get_what_all_would_get() {
    for boundary in [Boundary::Open, Boundary::Periodic, Boundary::Mirror] {
        check_active::<1>(boundary);
        check_active::<2>(boundary);
        check_active::<3>(boundary);
    }
}

/// A hot spot in cold gas: most particles take long steps.
fn hot_spot(force: &dyn PairForce) -> ParticleSystem<2, crate::riemann::IdealGas> {
    let side = 64;
    let spacing = 1.0 / f64::from(side);
    let at = |k: i32| (f64::from(k) + 0.5) * spacing - 0.5;
    let position: Vec<[f64; 2]> = (0..side * side).map(|i| [at(i / side), at(i % side)]).collect();
    let hot = |x: &[f64; 2]| 1.0 + 400.0 * (-(x[0] * x[0] + x[1] * x[1]) / 0.001).exp();
    let count = position.len();
    let particles = Particles {
        velocity: vec![[0.0; 2]; count],
        mass: vec![spacing * spacing; count],
        thermal: position.iter().map(hot).collect(),
        smoothing: vec![1.2 * spacing; count],
        position,
    };
    let domain = Domain::new([-0.5; 2], [0.5; 2], Boundary::Periodic);
    let kernel = SmoothingKernel::new(Kernel::CubicSpline);
    ParticleSystem::new(air(), particles, domain, kernel, Smoothing::adaptive(1.2), force)
}

#[test]
fn blocks_conserve_in_a_plane_and_save_densities_searches_and_pairs() {
    let force = Godunov { weight: OwnKernels, solver: ExactIdeal(air()), work: PairWork::Star };
    let table = super::explicit("centred-euler");
    let run = |levels: Option<u32>| {
        let system = hot_spot(&force);
        let energy = system.energy();
        let mut evolution = match levels {
            None => ParticleEvolution::global(system, Box::new(force), &table, 0.3),
            Some(levels) => ParticleEvolution::blocks(system, Box::new(force), levels, 0.3),
        };
        let end = march(&mut evolution, 0.008, 10_000, |_, _| ControlFlow::Continue(()));
        assert_eq!(end.failure, None);
        let system = evolution.system();
        assert!(system.momentum().iter().all(|sum| sum.abs() < 1e-13));
        let drift = system.energy().zip(energy).map(|(after, before)| after / before - 1.0);
        assert!(drift.is_some_and(|drift| drift.abs() < 1e-12), "{levels:?}: {drift:?}");
        system.clone()
    };
    let (global, block) = (run(None), run(Some(4)));
    let (a, b) = (global.counters, block.counters);
    assert!(5 * b.interactions < 3 * a.interactions, "{a:?} {b:?}");
    assert!(5 * b.densities < 3 * a.densities, "{a:?} {b:?}");
    // A global step finds its lists long enough for several steps.
    assert!(2 * a.searches < a.densities && b.searches == b.densities, "{a:?} {b:?}");
    let error: f64 =
        (global.density().iter().zip(block.density())).map(|(a, b)| (a - b).abs()).sum::<f64>()
            / global.density().len() as f64;
    assert!(error < 0.01, "{error}");
}

/// Gas nearly at rest: the lists of the first evaluation serve until somebody has moved too far, and the answers
/// are those of new ones.
#[test]
fn lists_are_used_again_until_they_are_too_short() {
    let mut system =
        disordered::<2>(air(), Boundary::Periodic, 1000, 21, &FORCE, Kernel::CubicSpline);
    system.update_fields().expect("a physical state");
    let first = system.counters.searches;
    for distance in [1e-4, 3e-4] {
        for (k, x) in system.particles.position.iter_mut().enumerate() {
            x[k % 2] += distance;
        }
        system.update_fields().expect("a physical state");
    }
    assert_eq!(system.counters.searches, first);
    let mut fresh =
        disordered::<2>(air(), Boundary::Periodic, 1000, 21, &FORCE, Kernel::CubicSpline);
    fresh.particles.position.clone_from(&system.particles.position);
    let [mut old, mut new] = [Rates::default(), Rates::default()];
    system.rates(&FORCE, &mut old).expect("a physical state");
    fresh.rates(&FORCE, &mut new).expect("a physical state");
    for (a, b) in old.acceleration.iter().zip(&new.acceleration) {
        let scale = a[0].abs() + a[1].abs();
        assert!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() <= 1e-6 * scale, "{a:?} {b:?}");
    }
    for x in &mut system.particles.position {
        x[0] += 0.05;
    }
    system.update_fields().expect("a physical state");
    assert!(system.counters.searches > first);
}
