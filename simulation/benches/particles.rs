//! Pair interactions per second of every particle method: 10⁵ particles on a line, one and two threads.
//!
//! One iteration is one evaluation of the forces: search of pairs, density with adaptive smoothing
//! lengths, equation of state, every pair once, sums over neighbours. Throughput counts pairs in
//! which a force acts: about 1.2 per particle for the cubic spline at `η = 1`, 4 for the Gaussian of
//! case 4.
//!
//! Floating-point operations of the force on one pair, divisions and roots counted as one:
//! SPH about 50 (kernel slope 10, ends 15, pressure and viscosity 25). GPH with van Leer about 50,
//! and for each iteration and side 12 in a compression (one root) or three transcendental functions
//! and 10 in an expansion; a noisy gas needs about half an iteration. Isothermal GPH about 70.
//! Case 4: 40 more for the convolution and an exponential for each kernel.
//!
//! At some 4·10⁹ scalar operations a second a core could do 8·10⁷ SPH pairs: the force is not what
//! costs. Sampling an evaluation of SPH finds half of the time in the search (sorting into cells, writing
//! pairs of 40 bytes and neighbours of 32 bytes twice, sorting neighbours by distance), a quarter in the two
//! or three density sums of Newton's iteration, and a tenth in the forces. The search
//! is partly serial, which bounds the gain from threads.

use courant_analysis::kernel::Kernel;
use courant_simulation::boundary::Boundary;
use courant_simulation::particles::*;
use courant_simulation::riemann::isothermal::{Expansion, Isothermal};
use courant_simulation::riemann::{ExactIdeal, IdealGas, StarSolver, State, Stopping, VanLeer};
use criterion::{BenchmarkId, Criterion, Throughput};
use std::hint::black_box;

const PARTICLES: usize = 100_000;

fn noise(i: usize) -> f64 {
    ((i as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
}

/// A noisy gas on a ring.
fn system<G: Gas>(
    gas: G,
    kernel: Kernel,
    eta: f64,
    force: &impl PairForce,
) -> ParticleSystem<1, G> {
    let spacing = 1.0 / PARTICLES as f64;
    let particles = Particles {
        position: (0..PARTICLES).map(|i| [(i as f64 + 0.3 * noise(i)) * spacing]).collect(),
        velocity: (0..PARTICLES).map(|i| [0.4 * noise(i + 7)]).collect(),
        mass: vec![spacing; PARTICLES],
        thermal: (0..PARTICLES).map(|i| gas.thermal(1.0, 1.0 + 0.5 * noise(i + 3))).collect(),
        smoothing: vec![eta * spacing; PARTICLES],
    };
    let domain = Domain::new([0.0], [1.0], Boundary::Periodic);
    let kernel = SmoothingKernel::new(kernel);
    ParticleSystem::new(gas, particles, domain, kernel, Smoothing::adaptive(eta), force)
}

fn measure<G: Gas>(c: &mut Criterion, name: &str, gas: G, kernel: Kernel, force: &impl PairForce) {
    let eta = if kernel == Kernel::Gaussian { 1.05 } else { 1.0 };
    let mut group = c.benchmark_group("forces");
    let mut first = system(gas, kernel, eta, force);
    first.rates(force, &mut Rates::default()).expect("a physical state");
    group.sample_size(10).throughput(Throughput::Elements(first.counters.interactions));
    for threads in [1, 2] {
        let pool =
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
        let mut system = system(gas, kernel, eta, force);
        let mut rates = Rates::default();
        let mut evaluate = || pool.install(|| system.rates(force, &mut rates));
        evaluate().expect("a physical state");
        group.bench_function(BenchmarkId::new(name, format!("{threads} threads")), |bencher| {
            bencher.iter(|| evaluate().expect("a physical state"));
        });
    }
    group.finish();
}

fn forces(c: &mut Criterion) {
    let gas = IdealGas::new(1.4).expect("gamma > 1");
    let cubic = Kernel::CubicSpline;
    let solver = VanLeer { gas, stopping: Stopping::Published };
    measure(c, "gph1", gas, cubic, &Godunov { weight: SumOfSquares, solver });
    measure(c, "gph2", gas, cubic, &Godunov { weight: Product, solver });
    measure(c, "gph3", gas, cubic, &Godunov { weight: OwnKernels, solver });
    measure(c, "gph3-exact", gas, cubic, &Godunov { weight: OwnKernels, solver: ExactIdeal(gas) });
    let case4 = Godunov { weight: Convolution(VolumeInterpolation::Cubic), solver };
    measure(c, "gph4", gas, Kernel::Gaussian, &case4);
    let isothermal = IsothermalGas { sound_speed: 1.0 };
    let solver = Isothermal { sound_speed: 1.0, expansion: Expansion::AsShock };
    measure(c, "gph3-isothermal", isothermal, cubic, &Godunov { weight: OwnKernels, solver });
    let viscosity = Viscosity::STANDARD;
    measure(c, "sph1", gas, cubic, &Smoothed { form: PressureForm::Sum, viscosity });
    measure(c, "sph2", gas, cubic, &Smoothed { form: PressureForm::Geometric, viscosity });
}

/// A million random pairs of states, pressure ratios up to 10¹².
fn solvers(c: &mut Criterion) {
    const PAIRS: usize = 1_000_000;
    let gas = IdealGas::new(1.4).expect("gamma > 1");
    let state = |i: usize| {
        let density = 10f64.powf(6.0 * noise(3 * i));
        let pressure = 10f64.powf(12.0 * noise(3 * i + 1));
        State::new(density, 20.0 * noise(3 * i + 2), pressure).expect("physical")
    };
    let states: Vec<State> = (0..=PAIRS).map(state).collect();
    let mut group = c.benchmark_group("solvers");
    group.sample_size(10).throughput(Throughput::Elements(PAIRS as u64));
    let mut run = |name: &str, solver: &dyn StarSolver| {
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let mut most = 0;
                for pair in states.windows(2) {
                    let star = solver.star(&pair[0], &pair[1]);
                    assert!(star.pressure >= 0.0 && star.velocity.is_finite(), "{pair:?}");
                    most = most.max(star.iterations);
                }
                black_box(most)
            });
        });
    };
    run("van-leer-published", &VanLeer { gas, stopping: Stopping::Published });
    run("van-leer-converged", &VanLeer { gas, stopping: Stopping::Converged });
    run("exact", &ExactIdeal(gas));
    run("isothermal-two-shock", &Isothermal { sound_speed: 1.0, expansion: Expansion::AsShock });
    run("isothermal-exact", &Isothermal { sound_speed: 1.0, expansion: Expansion::Exact });
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    forces(&mut criterion);
    solvers(&mut criterion);
    criterion.final_summary();
}
