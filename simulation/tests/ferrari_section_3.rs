//! What section 3.3 of Ferrari et al. 2008 says about its figures, each statement held against a
//! number: 100 points, `l/Δξ = 2`, default options. Where the paper is contradicted, the
//! name of the test says so.

use courant_simulation::comparison::{Comparison, WaveKind};
use courant_simulation::lagrangian::LagrangianOptions;
use courant_simulation::lagrangian::flux::{ContactViscosity, Flux, ModifiedRoe, RoeMean};
use courant_simulation::method::Method;
use courant_simulation::run::Run;
use courant_simulation::scene::{Scene, ShockTube};

fn tube(number: u8) -> ShockTube {
    ShockTube::standard(&format!("ferrari{number}")).expect("it is in the list")
}

fn run(number: u8, method: &str) -> (Run, Comparison) {
    let tube = tube(number);
    let method = Method::named(method).expect("it is in the list");
    let run = method.run(&tube, 100).expect("the defaults are valid");
    let comparison = Comparison::new(&tube, &run);
    (run, comparison)
}

const LAGRANGIAN: [&str; 3] = ["lagrangian-exact", "lagrangian-rusanov", "lagrangian-roe"];

#[test]
fn all_tests_run_by_all_methods_with_small_errors() {
    for number in 1..=4 {
        let tube = tube(number);
        // The range of the exact solution, from which the errors are counted.
        let (solution, _) = tube.riemann().expect("a tube is a Riemann problem");
        let states = [*tube.left(), *tube.right(), solution.sample(solution.velocity())];
        let range = |value: fn(&courant_simulation::riemann::State) -> f64| {
            let values = states.each_ref().map(value);
            values.iter().fold(f64::MIN, |a, &b| a.max(b))
                - values.iter().fold(f64::MAX, |a, &b| a.min(b))
        };
        for name in Method::NAMES {
            let (run, comparison) = run(number, name);
            assert_eq!(run.completed(), (number, name) != (3, "sph-adke"), "{number} {name}");
            if run.completed() {
                assert_eq!(run.time, tube.end_time());
                // First-order methods with 100 points smear each wave over a tenth of the domain.
                let density = comparison.l1.density / range(|state| state.density());
                let velocity = comparison.l1.velocity / range(|state| state.velocity());
                let pressure = comparison.l1.pressure / range(|state| state.pressure());
                for error in [density, velocity, pressure] {
                    assert!(error > 1e-3 && error < 0.15, "{number} {name}: {error}");
                }
            }
        }
    }
}

#[test]
fn test_1_finite_volumes_have_an_entropy_glitch_and_lagrangian_schemes_do_not() {
    let glitch = |name| run(1, name).1.glitch.expect("there is a rarefaction");
    // At the sonic point two cells differ by 14 % of the whole velocity too much.
    assert!(glitch("finite-volume") > 0.1);
    for name in LAGRANGIAN {
        assert!(glitch(name) < 0.02, "{name}");
    }
}

#[test]
fn test_1_the_exact_flux_places_the_contact_best_and_oscillates() {
    let contact = |name| {
        let (_, comparison) = run(1, name);
        let wave = comparison.waves.iter().find(|wave| wave.kind == WaveKind::Contact);
        wave.and_then(|wave| wave.error()).expect("the contact is found").abs()
    };
    let [exact, rusanov, roe] = LAGRANGIAN.map(contact);
    assert!(exact < 0.005 && exact < roe && roe < rusanov, "{exact} {roe} {rusanov}");
    let overshoot = |name| run(1, name).1.overshoot.energy;
    let [exact, rusanov, roe] = LAGRANGIAN.map(overshoot);
    assert!(exact > 0.2 && roe < 0.05 && rusanov < 1e-3, "{exact} {roe} {rusanov}");
}

#[test]
fn contacts_are_sharper_than_in_finite_volumes_but_not_with_rusanov_in_test_1() {
    let width = |number, name| run(number, name).1.contact_width;
    for number in [1, 4] {
        let volumes = width(number, "finite-volume").expect("resolved");
        for name in ["lagrangian-exact", "lagrangian-roe"] {
            assert!(width(number, name).expect("resolved") < 0.7 * volumes, "{number} {name}");
        }
    }
    let volumes = width(1, "finite-volume").expect("resolved");
    assert!(width(1, "lagrangian-rusanov").expect("resolved") > volumes);
}

#[test]
fn shocks_are_sharper_in_finite_volumes() {
    // Velocity and pressure do not jump at the contact: their error is that of the shocks.
    for name in LAGRANGIAN {
        for number in [1, 4] {
            let volumes = run(number, "finite-volume").1.l1;
            let here = run(number, name).1.l1;
            assert!(here.velocity > volumes.velocity && here.pressure > volumes.pressure, "{name}");
        }
    }
}

#[test]
fn adaptive_sph_conserves_momentum_but_oscillates_at_the_contact() {
    // "Not perfectly conservative": momentum is, to round-off; energy to 1e-4, by the time steps.
    for number in [1, 4] {
        let (run, comparison) = run(number, "sph-adke");
        assert!(run.conservation.momentum.abs() < 1e-14);
        assert!(run.conservation.energy.abs() < 1e-3 && run.conservation.energy.abs() > 1e-6);
        assert!(comparison.excess_variation.pressure > 0.2, "test {number}");
        for name in LAGRANGIAN {
            let variation = self::run(number, name).1.excess_variation.pressure;
            assert!(variation < 0.02, "{name} {variation}");
        }
    }
}

#[test]
fn test_2_points_leave_the_domain_and_the_internal_energy_is_wrong() {
    for name in LAGRANGIAN {
        let (run, comparison) = run(2, name);
        assert!(comparison.inside <= 42 && comparison.inside + comparison.outside == 100, "{name}");
        assert!(run.completed() && comparison.order_preserved);
        // The largest error of e is at least as large as e itself is small.
        let tube = tube(2);
        let worst = (0..100)
            .map(|i| {
                let exact = tube.exact(run.profile.x[i], run.time);
                let e = tube.gas().internal_energy(exact.density(), exact.pressure());
                run.profile.energy[i] / e
            })
            .fold(0.0, f64::max);
        assert!(worst > 1.8, "{name} {worst}");
    }
}

#[test]
fn test_3_the_velocity_overshoots_in_finite_volumes_only() {
    // The paper sees one in both, smaller in the Lagrangian schemes: there it is below 1 %.
    assert!(run(3, "finite-volume").1.overshoot.velocity > 0.02);
    for name in LAGRANGIAN {
        assert!(run(3, name).1.overshoot.velocity < 0.01, "{name}");
    }
}

#[test]
fn test_3_rusanov_is_the_most_diffusive() {
    let density = |name| run(3, name).1.l1.density;
    let [exact, rusanov, roe] = LAGRANGIAN.map(density);
    assert!(rusanov > 3.0 * roe && roe > exact, "{exact} {roe} {rusanov}");
    // And more than finite volumes, whose contact is three times wider than that of the others.
    assert!(rusanov > 3.0 * density("finite-volume"));
}

#[test]
fn test_4_interpenetration_is_not_an_error_of_the_time_integration() {
    let tube = tube(4);
    for flux in [Flux::Exact, Flux::Rusanov, Flux::ModifiedRoe(ModifiedRoe::default())] {
        let at = |cfl| {
            let options = LagrangianOptions { cfl, ..LagrangianOptions::new(flux) };
            let run = Method::Lagrangian(options).run(&tube, 100).expect("valid");
            assert!(run.completed());
            let comparison = Comparison::new(&tube, &run);
            (comparison.order_preserved, comparison.spacing_mismatch.expect("particles"))
        };
        let (order, mismatch) = at(0.9);
        // The paper expects a more accurate integration of the positions to cure it. With 90 times
        // smaller steps the particles at the contact overlap by more, not less.
        let (fine_order, fine_mismatch) = at(0.01);
        assert!(!order && !fine_order, "{flux:?}");
        assert!(fine_mismatch < mismatch && mismatch < -1.0, "{flux:?} {mismatch} {fine_mismatch}");
    }
}

#[test]
fn test_4_the_jump_within_the_contact_is_larger_with_rusanov() {
    let mismatch = |name| run(4, name).1.spacing_mismatch.expect("particles");
    assert!(mismatch("lagrangian-rusanov") < 2.0 * mismatch("lagrangian-exact"));
}

/// The L1 error of the density with the printed Roe flux over that with the exact flux.
fn roe_over_exact(number: u8, alpha: f64) -> f64 {
    let tube = tube(number);
    let roe = ModifiedRoe { mean: RoeMean::Density, contact: ContactViscosity::Printed(alpha) };
    let options = LagrangianOptions::new(Flux::ModifiedRoe(roe));
    let run = Method::Lagrangian(options).run(&tube, 100).expect("valid");
    Comparison::new(&tube, &run).l1.density / run_exact_density(number)
}

fn run_exact_density(number: u8) -> f64 {
    run(number, "lagrangian-exact").1.l1.density
}

#[test]
fn test_3_the_exact_flux_is_more_accurate_than_roe_at_any_contact_viscosity() {
    // The paper finds that the modified Roe flux follows the exact solution best.
    for alpha in [0.0, 0.05, 0.1, 0.2, 0.5, 1.0] {
        assert!(roe_over_exact(3, alpha) > 1.02, "{alpha}");
    }
}

#[test]
fn test_4_roe_is_the_most_accurate_by_a_little_at_the_right_contact_viscosity() {
    assert!(roe_over_exact(4, 0.4) < 0.97);
    assert!(roe_over_exact(4, 0.4) > 0.94);
    assert!(roe_over_exact(4, 0.0) > 1.05);
}
