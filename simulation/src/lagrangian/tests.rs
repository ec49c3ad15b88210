//! The scheme against a plain double sum, its conservation, its order, its work.

use super::flux::{ContactViscosity, Flux, LagrangianFlux, ModifiedRoe, RoeMean};
use super::{LagrangianOptions, LagrangianScheme, LagrangianState, Lattice, StepRule};
use crate::comparison::Comparison;
use crate::march::Evolution;
use crate::method::Method;
use crate::riemann::IdealGas;
use crate::riemann::State;
use crate::run::Run;
use crate::scene::{Flow, Layer, Scene};
use courant_analysis::kernel::Kernel;

fn tube(name: &str) -> Scene {
    Scene::named(name).expect("it is in the list")
}

fn wave(end_time: f64) -> Scene {
    Scene { end_time, ..tube("simple-wave") }
}

fn gas(scene: &Scene) -> IdealGas {
    scene.material.ideal().expect("an ideal gas")
}

fn fluxes() -> [Flux; 4] {
    let consistent =
        ModifiedRoe { mean: RoeMean::Volume, contact: ContactViscosity::MassFlux(0.2) };
    [
        Flux::Exact,
        Flux::Rusanov,
        Flux::ModifiedRoe(ModifiedRoe::default()),
        Flux::ModifiedRoe(consistent),
    ]
}

fn run(scene: &Scene, particles: usize, options: LagrangianOptions) -> Run {
    Method::Lagrangian(options).run(scene, particles).expect("the options are valid")
}

/// (3.9) as a sum over all `j` with the kernel's gradient, the pair oriented by the mass
/// coordinate, ghosts by index: no lattice, no shared flux, no order.
fn plain_step(
    gas: IdealGas,
    states: &[LagrangianState],
    spacing: f64,
    step: f64,
    options: &LagrangianOptions,
) -> Vec<[f64; 3]> {
    let length = options.ratio * spacing;
    let count = states.len() as i64;
    let at = |j: i64| &states[j.clamp(0, count - 1) as usize];
    (0..count)
        .map(|i| {
            let mut u = at(i).conserved();
            for j in i - 50..=i + 50 {
                let distance = (i - j) as f64 * spacing;
                let q = distance.abs() / length;
                // ∂W/∂ξ_i: the sign of ξ_i − ξ_j times w'(q)/l².
                let gradient = distance.signum() * options.kernel.slope(q) / (length * length);
                if i == j || gradient == 0.0 {
                    continue;
                }
                let flux = if i < j {
                    options.flux.flux(gas, at(i), at(j))
                } else {
                    options.flux.flux(gas, at(j), at(i))
                };
                for c in 0..3 {
                    u[c] -= 2.0 * step * spacing * flux[c] * gradient;
                }
            }
            u
        })
        .collect()
}

#[test]
fn a_step_is_the_plain_double_sum() {
    let tube = tube("ferrari1");
    for kernel in Kernel::ALL {
        for (ratio, flux) in [1.3, 2.0, 2.7, 4.0].into_iter().zip(fluxes()) {
            let options = LagrangianOptions { kernel, ratio, ..LagrangianOptions::new(flux) };
            let mut scheme =
                LagrangianScheme::new(&tube, 60, &options).expect("the options are valid");
            for _ in 0..3 {
                let step = 0.3 * scheme.courant_step();
                let before = scheme.states().to_vec();
                let positions = scheme.positions().to_vec();
                let wanted = plain_step(gas(&tube), &before, scheme.spacing(), step, &options);
                scheme.advance(step).expect("a small step stays physical");
                for (i, (state, wanted)) in scheme.states().iter().zip(&wanted).enumerate() {
                    for (found, wanted) in state.conserved().iter().zip(wanted) {
                        // Round-off of a sum of some twenty terms; the largest V is 8.
                        assert!((found - wanted).abs() < 1e-13);
                    }
                    // (3.16) as printed.
                    let v = before[i].velocity;
                    let acceleration = (wanted[1] - v) / step;
                    let x = positions[i] + v * step + 0.5 * acceleration * step * step;
                    assert!((scheme.positions()[i] - x).abs() < 1e-14);
                }
            }
        }
    }
}

#[test]
fn every_flux_conserves_to_round_off() {
    let tubes = ["ferrari1", "ferrari2", "ferrari3", "ferrari4", "sod", "toro4", "toro5"].map(tube);
    let scenes = [(wave(0.4), 64)].into_iter().chain(tubes.map(|tube| (tube, 100)));
    for (scene, particles) in scenes {
        for flux in fluxes() {
            let run = run(&scene, particles, LagrangianOptions::new(flux));
            assert!(run.completed(), "{} {flux:?}: {:?}", scene.name, run.failure);
            // Every step rounds each of the totals, a sum of about 100 numbers, a few times.
            let bound = f64::EPSILON * (run.steps as f64 + 30.0);
            let drift = run.conservation;
            for (what, value) in [
                ("volume", drift.volume.expect("the scheme advances it")),
                ("momentum", drift.momentum),
                ("energy", drift.energy.expect("an ideal gas")),
            ] {
                assert!(value.abs() < bound, "{} {flux:?}: {what} {value:e}", scene.name);
            }
        }
    }
}

#[test]
fn the_result_does_not_depend_on_the_threads() {
    // About twenty steps.
    let tube = Scene { end_time: 6e-5, ..tube("ferrari3") };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads can be started");
        // Long enough that the loops are shared.
        pool.install(|| run(&tube, 5000, LagrangianOptions::new(Flux::Exact)))
    };
    let alone = with(1);
    assert!(alone.completed() && alone.steps > 10, "{}", alone.steps);
    for threads in [2, 3, 8] {
        assert_eq!(with(threads), alone);
    }
}

#[test]
fn smooth_waves_converge_at_first_order() {
    let wave = wave(0.5);
    for flux in fluxes() {
        let errors: Vec<f64> = [100, 200, 400]
            .into_iter()
            .map(|particles| {
                let run = run(&wave, particles, LagrangianOptions::new(flux));
                // Particles may have drifted over the ends of the period.
                let comparison = Comparison::new(&wave, &run).expect("it has not broken");
                assert_eq!(comparison.inside, particles);
                comparison.l1.density
            })
            .collect();
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            // First order, and from N = 100 on nothing is far from it.
            assert!((0.85..1.15).contains(&order), "{flux:?}: {errors:?}");
        }
    }
}

#[test]
fn halving_the_step_does_not_change_the_limit() {
    // The error of the step is first order too: the fluxes see the state at the start of it.
    let wave = wave(0.5);
    let at = |cfl: f64| {
        let options = LagrangianOptions { cfl, ..LagrangianOptions::new(Flux::Exact) };
        run(&wave, 100, options).profile
    };
    let distance = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f64>() / a.len() as f64
    };
    let (coarse, middle, fine) = (at(0.4), at(0.2), at(0.1));
    let ratio =
        distance(&coarse.density, &middle.density) / distance(&middle.density, &fine.density);
    assert!((1.8..2.2).contains(&ratio), "{ratio}");
}

#[test]
fn test_4_fails_at_a_step_from_the_initial_data() {
    let tube = tube("ferrari4");
    for flux in fluxes() {
        let with = |step| LagrangianOptions { step, ..LagrangianOptions::new(flux) };
        assert!(run(&tube, 100, with(StepRule::Current)).completed());
        let failed = run(&tube, 100, with(StepRule::Initial));
        let failure = failed.failure.expect("the real Courant number is about 4");
        assert!(failure.step <= 5 && failure.time < 0.1 * tube.end_time, "{failure}");
        assert!(failure.reason.particle().is_some());
        // With a quarter of the step it passes.
        let small = LagrangianOptions { cfl: 0.2, ..with(StepRule::Initial) };
        assert!(run(&tube, 100, small).completed());
    }
    // C* of the right star state over the initial maximum, from the exact solution.
    let (solution, _) = tube.riemann().expect("a tube is a Riemann problem");
    let gas = gas(&tube);
    let star = gas.lagrangian_sound_speed(solution.densities().1, solution.pressure());
    let first = gas.lagrangian_sound_speed(5.99924, 460.894);
    assert!((star / first - 4.358).abs() < 1e-3, "{}", star / first);
}

/// Sod's tube with other numbers.
fn hard(
    gamma: f64,
    left: [f64; 3],
    right: [f64; 3],
    domain: [f64; 2],
    x: f64,
    end_time: f64,
) -> Scene {
    let gas = IdealGas::new(gamma).expect("above 1");
    let layer = |to, [density, velocity, pressure]: [f64; 3]| {
        Layer::uniform(to, &State::new(density, velocity, pressure).expect("physical"))
    };
    let flow = Flow::Layers(vec![layer(x, left), layer(domain[1], right)]);
    let material = crate::scene::Material::Ideal(gas);
    Scene { material, domain, window: domain, flow, end_time, ..tube("sod") }
}

/// Tubes of other codes on which one flux or another broke: Noh's cold streams (Athena), LeBlanc's tube, the peak
/// of Liska & Wendroff.
#[test]
fn cold_streams_near_vacua_and_strong_waves_are_run_at_the_default_step() {
    let third = 5.0 / 3.0;
    let noh = hard(third, [1.0, 1.0, 1e-6], [1.0, -1.0, 1e-6], [-1.0, 1.0], 0.0, 1.0);
    let leblanc =
        hard(third, [1.0, 0.0, 0.2 / 3.0], [1e-3, 0.0, 2e-10 / 3.0], [0.0, 10.0], 3.0, 3.0);
    let left = [0.1261192, 8.9047029, 782.92899];
    let right = [6.591493, 2.2654207, 3.1544874];
    let peak = hard(1.4, left, right, [0.1, 0.6], 0.5, 0.0039);
    for (scene, particles) in [(&noh, 100), (&leblanc, 100), (&leblanc, 1000), (&peak, 100)] {
        for flux in fluxes() {
            let run = run(scene, particles, LagrangianOptions::new(flux));
            assert!(run.completed() && run.rejected == 0, "{flux:?} {particles}: {run:?}");
            assert!(run.conservation.energy.expect("an ideal gas").abs() < 1e-12);
        }
    }
    // Behind Noh's shocks the density is (γ+1)/(γ−1) = 4 and the gas is at rest; less in the heated middle.
    let run = run(&noh, 400, LagrangianOptions::new(Flux::Exact));
    let shocked = (run.profile.x.iter().zip(&run.profile.density))
        .filter(|(x, _)| (0.15..0.28).contains(&x.abs()))
        .map(|(_, density)| *density);
    let (sum, count) = shocked.fold((0.0, 0), |(sum, count), density| (sum + density, count + 1));
    assert!((sum / f64::from(count) - 4.0).abs() < 0.02, "{}", sum / f64::from(count));
}

#[test]
fn the_work_is_one_flux_per_pair() {
    let tube = tube("sod");
    let run = run(&tube, 100, LagrangianOptions::new(Flux::Rusanov));
    // Offsets 1, 2, 3 and as many ghosts on one side.
    assert_eq!(run.counters.interactions, run.steps as u64 * (101 + 102 + 103));
    assert_eq!(run.steps, 47);
}

#[test]
fn bad_options_are_errors() {
    let tube = tube("sod");
    let with = |options: LagrangianOptions| Method::Lagrangian(options).run(&tube, 100);
    let good = LagrangianOptions::new(Flux::Exact);
    for bad in [
        LagrangianOptions { cfl: 0.0, ..good },
        LagrangianOptions { ratio: -2.0, ..good },
        LagrangianOptions { ratio: 40.0, ..good },
        LagrangianOptions::new(Flux::ModifiedRoe(ModifiedRoe {
            mean: RoeMean::Density,
            contact: ContactViscosity::Printed(-0.1),
        })),
    ] {
        assert!(with(bad).is_err(), "{bad:?}");
    }
}

#[test]
fn lattices() {
    assert!(Lattice::new(Kernel::CubicSpline, 0.4).is_err());
    assert!(Lattice::new(Kernel::CubicSpline, f64::NAN).is_err());
    assert!(Lattice::new(Kernel::CubicSpline, 1e6).is_err());
    // At ratio 1 the second neighbour is on the edge: the finite-volume stencil.
    let one = Lattice::new(Kernel::CubicSpline, 1.0).expect("it reaches the next");
    assert_eq!(one.offsets(), &[(1, 0.5)]);
}
