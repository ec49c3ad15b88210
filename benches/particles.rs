//! Pair interactions per second of every particle method in one, two and three dimensions, one and two threads.
//!
//! One iteration is one evaluation of the forces: neighbours, density with adaptive smoothing lengths, equation of
//! state, every pair once, sums over neighbours. Throughput counts pairs in which a force acts: on a line 1.2 per particle for the
//! cubic spline at `η = 1` and 4 for the Gaussian of case 4; in a plane 9 and in space 29 for `η = 1.2`.
//!
//! What is measured is **processor time of the busiest thread**, which other work on the machine disturbs little; on an idle
//! machine it is the time on the clock. Ratios of one thread and two are only to be had where both get a core.
//!
//! Floating-point operations of the force on one pair, divisions and roots counted as one:
//! SPH about 50 (kernel slope 10, ends 15, pressure and viscosity 25). GPH with van Leer about 50,
//! and for each iteration and side 12 in a compression (one root) or three transcendental functions
//! and 10 in an expansion; a noisy gas needs about half an iteration. Isothermal GPH about 70.
//! Case 4: 40 more for the convolution and an exponential for each kernel.
//! Density: 25 for each neighbour (two per pair) and each of the three or four sums of Newton's iteration, and as
//! much for the search: of five candidates (2-D) or seven (3-D) two or two and a half are neighbours.

use courant_analysis::kernel::Kernel;
use courant_simulation::boundary::Boundary;
use courant_simulation::particles::*;
use courant_simulation::riemann::isothermal::{Expansion, Isothermal};
use courant_simulation::riemann::{ExactIdeal, IdealGas, StarSolver, State, Stopping, VanLeer};
use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use criterion::{BenchmarkId, Criterion, Throughput};
use std::collections::HashMap;
use std::hint::black_box;
use std::time::Duration;

/// Processor time of the thread that has used most, as Linux tells it.
struct BusiestThread;

/// Nanoseconds on a processor by thread.
fn by_thread() -> HashMap<String, u64> {
    let tasks = std::fs::read_dir("/proc/self/task").expect("a system with /proc");
    tasks
        .filter_map(|task| {
            let task = task.ok()?;
            let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
            let time = text.split_whitespace().next()?.parse().ok()?;
            Some((task.file_name().to_string_lossy().into_owned(), time))
        })
        .collect()
}

impl Measurement for BusiestThread {
    type Intermediate = HashMap<String, u64>;
    type Value = Duration;

    fn start(&self) -> Self::Intermediate {
        by_thread()
    }

    fn end(&self, before: Self::Intermediate) -> Duration {
        let used = by_thread().into_iter();
        let used = used.map(|(task, time)| time - before.get(&task).copied().unwrap_or(0));
        Duration::from_nanos(used.max().unwrap_or(0))
    }

    fn add(&self, a: &Duration, b: &Duration) -> Duration {
        *a + *b
    }

    fn zero(&self) -> Duration {
        Duration::ZERO
    }

    fn to_f64(&self, value: &Duration) -> f64 {
        WallTime.to_f64(value)
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        WallTime.formatter()
    }
}

fn noise(i: usize) -> f64 {
    ((i as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
}

/// A noisy gas in a periodic box, in the order of its lattice.
fn system<const D: usize, G: Gas>(
    gas: G,
    kernel: Kernel,
    eta: f64,
    force: &dyn PairForce,
) -> ParticleSystem<D, G> {
    let side = [90_000_usize, 224, 37][D - 1];
    let count = side.pow(D as u32);
    let spacing = 1.0 / side as f64;
    let place = |i: usize, axis: usize| {
        let step = i / side.pow((D - 1 - axis) as u32) % side;
        (step as f64 + 0.5 + 0.3 * noise(i + axis * count)) * spacing
    };
    let particles = Particles {
        position: (0..count).map(|i| std::array::from_fn(|axis| place(i, axis))).collect(),
        velocity: (0..count)
            .map(|i| std::array::from_fn(|axis| 0.4 * noise(i + 7 + axis)))
            .collect(),
        mass: vec![1.0 / count as f64; count],
        thermal: (0..count).map(|i| gas.thermal(1.0, 1.0 + 0.5 * noise(i + 3))).collect(),
        smoothing: vec![eta * spacing; count],
    };
    let domain = Domain::new([0.0; D], [1.0; D], Boundary::Periodic);
    let kernel = SmoothingKernel::new(kernel);
    ParticleSystem::new(gas, particles, domain, kernel, Smoothing::adaptive(eta), force)
}

fn measure<const D: usize, G: Gas>(
    c: &mut Criterion<BusiestThread>,
    name: &str,
    gas: G,
    kernel: Kernel,
    force: &dyn PairLoops<D>,
) {
    let eta = match (D, kernel) {
        (_, Kernel::Gaussian) => 1.05,
        (1, _) => 1.0,
        _ => 1.2,
    };
    let mut group = c.benchmark_group(format!("forces-{D}d"));
    let mut first = system::<D, G>(gas, kernel, eta, force);
    first.rates(force, &mut Rates::default()).expect("a physical state");
    group.sample_size(10).throughput(Throughput::Elements(first.counters.interactions));
    for threads in [1, 2] {
        let pool =
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
        let mut system = system::<D, G>(gas, kernel, eta, force);
        let mut rates = Rates::default();
        let mut step = 0.0;
        let mut evaluate = || {
            // There and back, further than lists are good for: every evaluation searches.
            step = if step == 0.0 { 1.0 } else { 0.0 };
            for x in &mut system.particles.position {
                x[0] += 2.0 * step - 1.0;
            }
            pool.install(|| system.rates(force, &mut rates))
        };
        evaluate().expect("a physical state");
        group.bench_function(BenchmarkId::new(name, format!("{threads} threads")), |bencher| {
            bencher.iter(|| evaluate().expect("a physical state"));
        });
    }
    group.finish();
}

fn forces<const D: usize>(c: &mut Criterion<BusiestThread>) {
    let gas = IdealGas::new(1.4).expect("gamma > 1");
    let cubic = Kernel::CubicSpline;
    let solver = VanLeer { gas, stopping: Stopping::Published };
    let work = PairWork::Mean;
    measure::<D, _>(c, "gph1", gas, cubic, &Godunov { weight: SumOfSquares, solver, work });
    measure::<D, _>(c, "gph2", gas, cubic, &Godunov { weight: Product, solver, work });
    let work = PairWork::Star;
    measure::<D, _>(c, "gph3", gas, cubic, &Godunov { weight: OwnKernels, solver, work });
    let exact = Godunov { weight: OwnKernels, solver: ExactIdeal(gas), work };
    measure::<D, _>(c, "gph3-exact", gas, cubic, &exact);
    let case4 = Godunov { weight: Convolution, solver, work };
    measure::<D, _>(c, "gph4", gas, Kernel::Gaussian, &case4);
    let isothermal = IsothermalGas { sound_speed: 1.0 };
    let solver = Isothermal { sound_speed: 1.0, expansion: Expansion::AsShock };
    let case3 = Godunov { weight: OwnKernels, solver, work };
    measure::<D, _>(c, "gph3-isothermal", isothermal, cubic, &case3);
    let viscosity = Viscosity::STANDARD;
    measure::<D, _>(c, "sph1", gas, cubic, &Smoothed { form: PressureForm::Sum, viscosity });
    measure::<D, _>(c, "sph2", gas, cubic, &Smoothed { form: PressureForm::Geometric, viscosity });
}

/// A million random pairs of states, pressure ratios up to 10¹².
fn solvers(c: &mut Criterion<BusiestThread>) {
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
    let mut criterion = Criterion::default().with_measurement(BusiestThread).configure_from_args();
    forces::<1>(&mut criterion);
    forces::<2>(&mut criterion);
    forces::<3>(&mut criterion);
    solvers(&mut criterion);
    criterion.final_summary();
}
