//! Whole runs: conservation as promised, exact solutions met, failures reported.

use super::explicit;
use crate::boundary::Boundary;
use crate::particles::*;
use crate::run::Reason;
use courant_analysis::kernel::Kernel;

fn run(scene: &str, method: ParticleMethod, change: impl Fn(&mut MethodOptions)) -> ParticleRun {
    let scene = ParticleScene::named(scene).expect("it is in the list");
    let mut options = MethodOptions::new(method);
    change(&mut options);
    run_particles(&scene, scene.particles, &options).expect("options that fit")
}

/// The scenes that take long in a test.
const LONG: [&str; 2] = ["noh", "woodward-colella"];

#[test]
fn every_method_finishes_every_scene_of_the_paper_and_keeps_what_it_promises() {
    for scene in ParticleScene::all().iter().filter(|scene| !LONG.contains(&scene.name)) {
        for method in ParticleMethod::ALL {
            let run = run(scene.name, method, |_| {});
            let what = format!("{} {method:?}", scene.name);
            assert!(run.completed(), "{what}: {:?}", run.failure);
            assert_eq!(run.drift.mass, 0.0);
            // Round-off of some thousand steps, relative to the sum of all momenta.
            assert!(run.drift.momentum < 1e-14, "{what}: {:e}", run.drift.momentum);
            assert_eq!(run.penetration.largest, 0, "{what}");
            let isothermal = matches!(scene.material, Material::Isothermal(_));
            assert_eq!(run.drift.energy.is_none(), isothermal);
            assert_eq!(run.profile.energy.is_empty(), isothermal);
            if let Some(energy) = run.drift.energy {
                let bound = match method {
                    // Time-centred: round-off. Old velocities: first order in time. SPH: second.
                    ParticleMethod::Gph3 | ParticleMethod::Gph4 => 1e-14,
                    ParticleMethod::Gph1 | ParticleMethod::Gph2 => 3e-3,
                    ParticleMethod::Sph1 | ParticleMethod::Sph2 => 2e-5,
                };
                assert!(energy < bound, "{what}: {energy:e}");
            }
            assert_eq!(run.counters.riemann_iterations > 0, method.is_godunov() && !isothermal);
        }
    }
}

/// Mean of a column over the particles inside an interval of positions.
fn mean(run: &ParticleRun, column: &[f64], [from, to]: [f64; 2]) -> f64 {
    let inside: Vec<f64> = (run.profile.x.iter().zip(column))
        .filter(|(x, _)| **x > from && **x < to)
        .map(|(_, value)| *value)
        .collect();
    assert!(inside.len() > 3, "an interval with particles");
    inside.iter().sum::<f64>() / inside.len() as f64
}

/// Where the pressure passes a level, by interpolation and counted from the right, and the
/// smoothing length there.
fn front(run: &ParticleRun, level: f64) -> (f64, f64) {
    let (x, pressure) = (&run.profile.x, &run.profile.pressure);
    let at = (0..x.len()).rev().find(|&i| pressure[i] > level).expect("a shock");
    let part = (pressure[at] - level) / (pressure[at] - pressure[at + 1]);
    (x[at] + part * (x[at + 1] - x[at]), run.smoothing[at].max(run.smoothing[at + 1]))
}

#[test]
fn star_state_and_shock_of_the_sod_tube_are_where_they_belong() {
    let scene = ParticleScene::named("sod-sph").expect("it is in the list");
    let Material::Ideal(gas) = scene.material else { panic!("an ideal gas") };
    let solution = crate::riemann::solve(gas, &scene.initial(-0.1), &scene.initial(0.1));
    for method in ParticleMethod::ALL {
        let run = run("sod-sph", method, |_| {});
        let shock = match solution.right_wave() {
            crate::riemann::Wave::Shock { speed } => speed * scene.end_time,
            other => panic!("the right wave is {other:?}"),
        };
        let (position, h) = front(&run, 0.5 * (solution.pressure() + 0.1795));
        assert!((position - shock).abs() < h, "{method:?}: {position} against {shock}");
        // Between contact and shock, two smoothing lengths away from both.
        let contact = solution.velocity() * scene.end_time;
        let inside = [contact + 4.0 * h, shock - 4.0 * h];
        let pressure = mean(&run, &run.profile.pressure, inside);
        let velocity = mean(&run, &run.profile.velocity, inside);
        assert!((pressure / solution.pressure() - 1.0).abs() < 0.01, "{method:?} {pressure}");
        assert!((velocity / solution.velocity() - 1.0).abs() < 0.01, "{method:?} {velocity}");
    }
}

#[test]
fn strong_blast_has_its_shock_and_its_thin_shell() {
    for method in [ParticleMethod::Gph3, ParticleMethod::Gph4, ParticleMethod::Sph1] {
        let run = run("strong-blast", method, |_| {});
        let densest = run.profile.density.iter().fold(0.0_f64, |a, &b| a.max(b));
        // (γ+1)/(γ−1) = 6 behind a strong shock; the start leaves a cold, dense blip at the contact.
        assert!((5.5..7.5).contains(&densest), "{method:?}: {densest}");
        let scene = ParticleScene::named("strong-blast").expect("it is in the list");
        let exact = (0..4000)
            .rev()
            .map(|k| f64::from(k) * 1e-4)
            .find(|&x| scene.exact(x, scene.end_time).is_some_and(|s| s.pressure() > 1.0))
            .expect("a shock");
        let (position, h) = front(&run, 700.0);
        // The shell's particles are packed six times: the undisturbed smoothing length is the resolution.
        assert!(
            (position - exact).abs() < 2.0 * h.max(1.0 / 250.0),
            "{method:?} {position} {exact}"
        );
    }
}

#[test]
fn errors_fall_with_the_number_of_particles() {
    for (scene, method) in [
        ("sod-sph", ParticleMethod::Gph3),
        ("isothermal-tube", ParticleMethod::Gph1),
        ("sound-wave", ParticleMethod::Gph2),
        ("collision-supersonic", ParticleMethod::Sph1),
    ] {
        let scene = ParticleScene::named(scene).expect("it is in the list");
        let error = |count| {
            let run = run_particles(&scene, count, &MethodOptions::new(method));
            run.expect("default options").errors.expect("an exact solution").velocity
        };
        let (coarse, fine) = (error(100), error(400));
        // Order between 1/2 and 1 across discontinuities: four times the particles at least halve it.
        assert!(fine < 0.5 * coarse, "{} {method:?}: {coarse} {fine}", scene.name);
    }
}

#[test]
fn exact_isothermal_solver_and_two_shocks_differ_as_their_star_states_do() {
    let star = |solver| {
        let run = run("isothermal-tube", ParticleMethod::Gph3, |options| options.solver = solver);
        mean(&run, &run.profile.pressure, [0.02, 0.2])
    };
    // The pair's waves are weak after the start, so both runs find the exact 0.49662.
    for solver in [SolverChoice::Published, SolverChoice::Exact] {
        assert!((star(solver) - 0.49662).abs() < 2e-3, "{}", star(solver));
    }
}

#[test]
fn blocks_of_steps_conserve_and_save_pairs() {
    for method in [ParticleMethod::Gph3, ParticleMethod::Gph4] {
        let global = run("strong-blast", method, |_| {});
        let block = run("strong-blast", method, |options| {
            options.sharing = StepSharing::Block { levels: 4 };
        });
        assert!(block.completed(), "{:?}", block.failure);
        assert!(block.drift.momentum < 1e-14);
        assert!(block.drift.energy.expect("an energy equation") < 1e-13);
        assert!(block.counters.interactions < global.counters.interactions);
        let error = |run: &ParticleRun| run.errors.expect("an exact solution").velocity;
        assert!(error(&block) < 1.5 * error(&global), "{} {}", error(&block), error(&global));
    }
}

/// What the count of penetration is for. With constant smoothing lengths the streams of the paper's supersonic
/// collision pass through each other unless something dissipates; at three times the sound speed each, the
/// first-order Riemann solver is not enough any more, and the quadratic viscosity is. Smoothing lengths
/// that follow the density keep the order by themselves: `h` shrinks with the last gap.
#[test]
fn streams_penetrate_where_dissipation_is_weak() {
    let mut scene = ParticleScene::named("collision-supersonic").expect("it is in the list");
    scene.constant_smoothing = true;
    let largest = |scene: &ParticleScene, method, viscosity| {
        let options = MethodOptions { viscosity, ..MethodOptions::new(method) };
        run_particles(scene, 200, &options).expect("options that fit").penetration.largest
    };
    let bare = Viscosity { alpha: 0.0, beta: 0.0, acts_on: ActsOn::Approaching, softening: 0.01 };
    assert!(largest(&scene, ParticleMethod::Sph1, bare) > 0);
    // Case 4 is left out: its kernel is wider by √2, so its particles feel the last gap least.
    for method in ParticleMethod::ALL.into_iter().filter(|&m| m != ParticleMethod::Gph4) {
        assert_eq!(largest(&scene, method, Viscosity::STANDARD), 0, "{method:?}");
    }
    let stream = |v| crate::riemann::State::new(1.0, v, 1.0).expect("physical");
    scene.flow = Flow::Layers(vec![(0.0, stream(3.0)), (0.5, stream(-3.0))]);
    scene.end_time = 0.03;
    assert!(largest(&scene, ParticleMethod::Gph1, Viscosity::STANDARD) > 0);
    assert_eq!(largest(&scene, ParticleMethod::Sph1, Viscosity::STANDARD), 0);
}

/// Cold gas far from the shock would take long steps by its own signal velocity, and be run over.
#[test]
fn cold_gas_is_warned_of_a_shock_within_a_block() {
    let block = run("noh", ParticleMethod::Gph3, |options| {
        options.sharing = StepSharing::Block { levels: 4 };
    });
    assert!(block.completed(), "{:?}", block.failure);
    assert!(block.drift.energy.expect("an energy equation") < 1e-13);
    assert!(block.errors.expect("an exact solution").velocity < 0.02);
}

#[test]
fn one_block_level_is_the_global_step() {
    let global = run("sod-sph", ParticleMethod::Gph3, |_| {});
    let block = run("sod-sph", ParticleMethod::Gph3, |options| {
        options.sharing = StepSharing::Block { levels: 0 };
    });
    // The end is reached by different last steps; the rest is the same to rounding.
    for (a, b) in global.profile.velocity.iter().zip(&block.profile.velocity) {
        assert!((a - b).abs() < 1e-4);
    }
    assert!(global.steps.abs_diff(block.steps) <= 1);
}

#[test]
fn failures_are_results() {
    // The symmetrised energy equation cools the first cold particle below nothing.
    let broken = run("strong-blast", ParticleMethod::Sph1, |options| options.eta = 1.2);
    let failure = broken.failure.expect("a breakdown");
    assert!(matches!(failure.reason, Reason::InternalEnergy { particle: 125, .. }), "{failure}");
    assert!(failure.time < 1e-3 && broken.time < 1e-3);
    let short = run("sod-sph", ParticleMethod::Gph1, |options| options.max_steps = 7);
    assert_eq!(short.failure.map(|failure| failure.reason), Some(Reason::StepLimit { limit: 7 }));
    let scene = ParticleScene::named("sod-sph").expect("it is in the list");
    let mut options = MethodOptions::new(ParticleMethod::Gph4);
    options.kernel = Kernel::CubicSpline;
    assert!(run_particles(&scene, 100, &options).is_err());
}

/// The pulse of d'Alembert: the wave equation by finite differences, and the mirrors.
#[test]
fn exact_sound_wave_solves_the_wave_equation_between_mirrors() {
    let scene = ParticleScene::named("sound-wave").expect("it is in the list");
    let at = |x: f64, t: f64| scene.exact(x, t).expect("always");
    let d = 1e-4;
    for time in [0.2, 0.5, 0.8] {
        for x in [-0.45, -0.21, 0.0, 0.18, 0.3, 0.49] {
            let rate = (at(x, time + d).velocity() - at(x, time - d).velocity()) / (2.0 * d);
            let slope = (at(x + d, time).density() - at(x - d, time).density()) / (2.0 * d);
            assert!((rate + slope).abs() < 1e-5, "momentum at {x} {time}");
            let rate = (at(x, time + d).density() - at(x, time - d).density()) / (2.0 * d);
            let slope = (at(x + d, time).velocity() - at(x - d, time).velocity()) / (2.0 * d);
            assert!((rate + slope).abs() < 1e-5, "mass at {x} {time}");
        }
        assert!(at(0.5, time).velocity().abs() < 1e-15 && at(-0.5, time).velocity().abs() < 1e-15);
    }
}

#[test]
fn nothing_is_allocated_once_buffers_have_grown() {
    let force = Smoothed { form: PressureForm::Sum, viscosity: Viscosity::STANDARD };
    let count = 200;
    let particles = Particles {
        position: (0..count).map(|i| [f64::from(i)]).collect(),
        velocity: vec![[0.0]; count as usize],
        mass: vec![1.0; count as usize],
        thermal: vec![(); count as usize],
        smoothing: vec![1.2; count as usize],
    };
    let mut system = ParticleSystem::new(
        IsothermalGas { sound_speed: 1.0 },
        particles,
        Domain::new([0.0], [f64::from(count)], Boundary::Periodic),
        SmoothingKernel::new(Kernel::CubicSpline),
        Smoothing::adaptive(1.2),
        &force,
    );
    let mut stepper = Stepper::new(explicit("rk2-heun"));
    for _ in 0..3 {
        stepper.step(&mut system, &force, &mut (), 0.1).expect("a physical state");
    }
    let address = |rates: &Rates<1, ()>| rates.acceleration.as_ptr();
    let before = (address(&stepper.rates), stepper.rates.signal.capacity());
    for _ in 0..20 {
        stepper.step(&mut system, &force, &mut (), 0.1).expect("a physical state");
    }
    assert_eq!((address(&stepper.rates), stepper.rates.signal.capacity()), before);
    // Three neighbours a side is the margin of the search at most; each pair once.
    assert_eq!(system.counters.interactions, system.counters.evaluations * 2 * count as u64);
}
