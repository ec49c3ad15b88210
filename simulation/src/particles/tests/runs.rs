//! Whole runs: conservation as promised, exact solutions met, failures reported.

use super::explicit;
use crate::boundary::Boundary;
use crate::comparison::Comparison;
use crate::method::Method;
use crate::particles::*;
use crate::run::{Reason, Run};
use crate::scene::{Flow, Layer, Scene};
use courant_analysis::kernel::Kernel;

fn run_scene(scene: &Scene, count: usize, options: MethodOptions) -> Run {
    Method::Particles(options).run(scene, count).expect("options that fit")
}

fn run(scene: &str, method: ParticleMethod, change: impl Fn(&mut MethodOptions)) -> Run {
    let scene = Scene::named(scene).expect("it is in the list");
    let mut options = MethodOptions::new(method);
    change(&mut options);
    run_scene(&scene, scene.particles, options)
}

/// The error of the velocity.
fn error(scene: &Scene, run: &Run) -> f64 {
    Comparison::new(scene, run).expect("an exact solution").l1.velocity
}

/// The scenes of the paper.
const PAPER: [&str; 7] = [
    "sound-wave",
    "sod-sph",
    "strong-blast",
    "isothermal-tube",
    "sjogreen",
    "collision-subsonic",
    "collision-supersonic",
];

#[test]
fn every_method_finishes_every_scene_of_the_paper_and_keeps_what_it_promises() {
    for scene in PAPER {
        for method in ParticleMethod::ALL {
            let run = run(scene, method, |_| {});
            let what = format!("{scene} {method:?}");
            assert!(run.completed(), "{what}: {:?}", run.failure);
            assert_eq!(run.conservation.mass, 0.0);
            // Round-off of some thousand steps, relative to the sum of all momenta.
            let momentum = run.conservation.momentum;
            assert!(momentum.abs() < 1e-14, "{what}: {momentum:e}");
            assert_eq!(run.penetration.largest, 0, "{what}");
            let material = Scene::named(scene).expect("it is in the list").material;
            let isothermal = material.ideal().is_none();
            assert_eq!(run.conservation.energy.is_none(), isothermal);
            assert_eq!(run.profile.energy.is_empty(), isothermal);
            if let Some(energy) = run.conservation.energy {
                let bound = match method {
                    // Time-centred: round-off. SPH: second order in time.
                    ParticleMethod::Sph1 | ParticleMethod::Sph2 => 2e-5,
                    _ => 1e-14,
                };
                assert!(energy.abs() < bound, "{what}: {energy:e}");
            }
            assert_eq!(run.counters.riemann_iterations > 0, method.is_godunov() && !isothermal);
        }
    }
}

/// Mean of a column over the particles inside an interval of positions.
fn mean(run: &Run, column: &[f64], [from, to]: [f64; 2]) -> f64 {
    let inside: Vec<f64> = (run.profile.x.iter().zip(column))
        .filter(|(x, _)| **x > from && **x < to)
        .map(|(_, value)| *value)
        .collect();
    assert!(inside.len() > 3, "an interval with particles");
    inside.iter().sum::<f64>() / inside.len() as f64
}

/// Where the pressure passes a level, by interpolation and counted from the right, and the
/// smoothing length there.
fn front(run: &Run, level: f64) -> (f64, f64) {
    let (x, pressure) = (&run.profile.x, &run.profile.pressure);
    let at = (0..x.len()).rev().find(|&i| pressure[i] > level).expect("a shock");
    let part = (pressure[at] - level) / (pressure[at] - pressure[at + 1]);
    (
        x[at] + part * (x[at + 1] - x[at]),
        run.profile.smoothing[at].max(run.profile.smoothing[at + 1]),
    )
}

#[test]
fn star_state_and_shock_of_the_sod_tube_are_where_they_belong() {
    let scene = Scene::named("sod-sph").expect("it is in the list");
    let (solution, _) = scene.riemann().expect("a Riemann problem");
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
        let scene = Scene::named("strong-blast").expect("it is in the list");
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
        let scene = Scene::named(scene).expect("it is in the list");
        let error = |count| error(&scene, &run_scene(&scene, count, MethodOptions::new(method)));
        let (coarse, fine) = (error(100), error(400));
        // Order between 1/2 and 1 across discontinuities: four times the particles at least halve it.
        assert!(fine < 0.5 * coarse, "{} {method:?}: {coarse} {fine}", scene.name);
    }
}

/// What the count of penetration is for. With constant smoothing lengths the streams of the paper's supersonic
/// collision pass through each other unless something dissipates; at three times the sound speed each, the
/// first-order Riemann solver is not enough any more, and the quadratic viscosity is. Smoothing lengths
/// that follow the density keep the order by themselves: `h` shrinks with the last gap.
#[test]
fn streams_penetrate_where_dissipation_is_weak() {
    let mut scene = Scene::named("collision-supersonic").expect("it is in the list");
    scene.constant_smoothing = true;
    let largest = |scene: &Scene, method, viscosity| {
        let options = MethodOptions { viscosity, ..MethodOptions::new(method) };
        run_scene(scene, 200, options).penetration.largest
    };
    let bare = Viscosity { alpha: 0.0, beta: 0.0, acts_on: ActsOn::Approaching, softening: 0.01 };
    assert!(largest(&scene, ParticleMethod::Sph1, bare) > 0);
    // Case 4 is left out: its kernel is wider by √2, so its particles feel the last gap least.
    for method in ParticleMethod::ALL.into_iter().filter(|&m| m != ParticleMethod::Gph4) {
        assert_eq!(largest(&scene, method, Viscosity::STANDARD), 0, "{method:?}");
    }
    let stream = |v| crate::riemann::State::new(1.0, v, 1.0).expect("physical");
    scene.flow =
        Flow::Layers(vec![Layer::uniform(0.0, &stream(3.0)), Layer::uniform(0.5, &stream(-3.0))]);
    scene.end_time = 0.03;
    assert!(largest(&scene, ParticleMethod::Gph1, Viscosity::STANDARD) > 0);
    assert_eq!(largest(&scene, ParticleMethod::Sph1, Viscosity::STANDARD), 0);
}

/// As published, with work done at the velocities of the old step, cases 1 and 2 gain energy in strong shocks,
/// however many particles there are; the plateau behind Noh's shock, 4, is missed by as much.
#[test]
fn centred_work_keeps_the_energy_of_cases_1_and_2() {
    let plateau = |method, work| {
        let run = run("noh", method, |options| options.work = work);
        assert!(run.completed(), "{:?}", run.failure);
        let near = |x: &f64| (0.06..0.14).contains(&x.abs());
        let inside: Vec<f64> = (run.profile.x.iter().zip(&run.profile.density))
            .filter(|(x, _)| near(x))
            .map(|(_, density)| *density)
            .collect();
        (inside.iter().sum::<f64>() / inside.len() as f64, run.conservation.energy.expect("ideal"))
    };
    for method in [ParticleMethod::Gph1, ParticleMethod::Gph2] {
        let (density, drift) = plateau(method, Work::TimeCentred);
        assert!(
            (density - 4.0).abs() < 0.03 && drift.abs() < 1e-13,
            "{method:?} {density} {drift:e}"
        );
        let (density, drift) = plateau(method, Work::Instantaneous);
        assert!(density < 3.85 && drift.abs() > 0.05, "{method:?} {density} {drift}");
    }
}

/// Cold gas far from the shock would take long steps by its own signal velocity, and be run over.
#[test]
fn cold_gas_is_warned_of_a_shock_within_a_block() {
    let block = run("noh", ParticleMethod::Gph3, |options| {
        options.sharing = StepSharing::Block { levels: 4 };
    });
    assert!(block.completed(), "{:?}", block.failure);
    assert!(block.conservation.energy.expect("an energy equation").abs() < 1e-13);
    assert!(error(&Scene::named("noh").expect("it is in the list"), &block) < 0.02);
}

#[test]
fn failures_are_results() {
    // The symmetrised energy equation cools the first cold particle below nothing.
    let broken = run("strong-blast", ParticleMethod::Sph1, |options| options.eta = 1.2);
    let failure = broken.failure.expect("a breakdown");
    assert!(matches!(failure.reason, Reason::InternalEnergy { particle: 125, .. }), "{failure}");
    assert!(failure.time < 1e-3 && broken.time < 1e-3);
    let scene = Scene::named("sod-sph").expect("it is in the list");
    let mut options = MethodOptions::new(ParticleMethod::Gph4);
    options.kernel = Kernel::CubicSpline;
    assert!(Method::Particles(options).run(&scene, 100).is_err());
}

#[test]
fn one_block_level_is_the_global_step() {
    let global = run("sod-sph", ParticleMethod::Gph3, |_| {});
    let block = run("sod-sph", ParticleMethod::Gph3, |options| {
        options.sharing = StepSharing::Block { levels: 0 };
    });
    for (a, b) in global.profile.velocity.iter().zip(&block.profile.velocity) {
        assert!((a - b).abs() < 1e-12);
    }
    assert_eq!(global.steps, block.steps);
}

/// Adaptive SPH with `k = 0.7`, `ε = 1/2`: the smoothing length over the spacing follows the density, like `(ρ/g)^(1/2)`, so
/// that the kernel sums of a rarefied gas are off by the same amount at any resolution. With `k = ε = 1` it is 2 everywhere,
/// the sums are exact, and the error falls.
#[test]
fn adaptive_sph_converges_where_its_kernel_sums_to_one() {
    let scene = Scene::named("ferrari2").expect("it is in the list");
    let order = |scale, sensitivity| {
        let mut options = MethodOptions::new(ParticleMethod::Adke);
        options.estimation = Some(KernelEstimation { scale, sensitivity });
        let error = |count| error(&scene, &run_scene(&scene, count, options));
        (error(100) / error(400)).log2() / 2.0
    };
    assert!(order(0.7, 0.5) < 0.05, "{}", order(0.7, 0.5));
    assert!(order(1.0, 1.0) > 0.5, "{}", order(1.0, 1.0));
}

/// The first cold particle beside a strong jump gets half of the work that its hot neighbours do in parting from it, with the minus
/// sign: at every step and every resolution, unless the kernel reaches hardly beyond the next particle.
#[test]
fn adaptive_sph_breaks_down_on_test_3_at_any_step() {
    for courant in [0.3, 0.03] {
        let run = run("ferrari3", ParticleMethod::Adke, |options| options.courant = courant);
        let failure = run.failure.expect("it breaks down");
        let first_cold = run.waiting[0] + 50;
        assert!(
            matches!(failure.reason, Reason::InternalEnergy { particle, value } if particle == first_cold && value < 0.0),
            "{failure}"
        );
        assert!(failure.time < 1e-4);
    }
    assert!(run("ferrari3", ParticleMethod::Adke, |options| options.eta = 1.5).completed());
}

/// The rates of adaptive SPH are those of SPH 1; its own are smoothing lengths and densities.
#[test]
fn estimated_smoothing_lengths_are_the_plain_sums() {
    let count = 60;
    let scattered = super::scatter(count, 5);
    let x: Vec<f64> = (0..count).map(|i| i as f64 + 0.6 * scattered[i]).collect();
    let force = Smoothed { form: PressureForm::Sum, viscosity: Viscosity::STANDARD };
    let rule =
        Smoothing::Estimated { pilot: 2.0, scale: 0.7, sensitivity: 0.5, counted: [5, count - 3] };
    let mut system = ParticleSystem::new(
        IsothermalGas { sound_speed: 1.0 },
        super::at_rest(&x, 0.7, (), 1.0),
        Domain::new([0.0], [1.0], Boundary::Open),
        SmoothingKernel::new(Kernel::CubicSpline),
        rule,
        &force,
    );
    system.update_fields().expect("a physical state");
    let sum = |i: usize, h: &dyn Fn(usize) -> f64| -> f64 {
        let term = |j: usize| 0.7 * Kernel::CubicSpline.value((x[i] - x[j]).abs() / h(j)) / h(j);
        (0..count).map(term).sum()
    };
    let pilot: Vec<f64> = (0..count).map(|i| sum(i, &|_| 2.0)).collect();
    let mean = pilot[5..count - 3].iter().map(|rho| rho.ln()).sum::<f64>() / (count - 8) as f64;
    let h: Vec<f64> = pilot.iter().map(|rho| 0.7 * (mean.exp() / rho).sqrt() * 2.0).collect();
    for i in 0..count {
        assert!((system.particles.smoothing[i] - h[i]).abs() < 1e-13 * h[i]);
        let density = sum(i, &|j| 0.5 * (h[i] + h[j]));
        assert!((system.density()[i] - density).abs() < 1e-13 * density);
    }
}

#[test]
fn nothing_is_allocated_once_buffers_have_grown() {
    let force = Smoothed { form: PressureForm::Sum, viscosity: Viscosity::STANDARD };
    let count = 200;
    let x: Vec<f64> = (0..count).map(f64::from).collect();
    let mut system = ParticleSystem::new(
        IsothermalGas { sound_speed: 1.0 },
        super::at_rest(&x, 1.0, (), 1.2),
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
