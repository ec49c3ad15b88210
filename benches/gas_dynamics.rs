//! Speed of the exact Riemann solver and of the Lagrangian scheme.
//!
//! Operations. The solver costs, per problem: 3 evaluations of both wave functions on average
//! (printed as the mean iteration count; one more pair classifies the waves and another gives the
//! velocity), each a square root and a division (shock) or an `exp_m1`, a logarithm and two
//! divisions (rarefaction). A step of the Lagrangian scheme with the cubic spline at `l/Δξ = 2`
//! computes `3N + 6` fluxes (one Riemann problem each with the exact flux; 12 additions and 12
//! multiplications with Rusanov's), gathers 6 fluxes of 3 components per particle (36
//! additions and multiplications), and finds one maximum of N.

use courant_simulation::lagrangian::flux::{Flux, ModifiedRoe};
use courant_simulation::lagrangian::{LagrangianOptions, LagrangianScheme};
use courant_simulation::march::Evolution;
use courant_simulation::riemann::{IdealGas, State, solve};
use courant_simulation::scene::Scene;
use criterion::{Bencher, Criterion, Throughput};
use std::hint::black_box;

/// Pairs of states over 12 decades of pressure, 8 of density and Mach numbers up to 10, from a
/// multiplicative congruential sequence.
fn random_pairs(count: usize) -> Vec<(State, State)> {
    let mut seed = 0x2545_F491_4F6C_DD1D_u64;
    let mut uniform = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut state = || {
        let density = 10f64.powf(8.0 * uniform() - 4.0);
        let pressure = 10f64.powf(12.0 * uniform() - 6.0);
        let velocity = (20.0 * uniform() - 10.0) * (pressure / density).sqrt();
        State::new(density, velocity, pressure).expect("positive numbers")
    };
    (0..count).map(|_| (state(), state())).collect()
}

fn riemann(criterion: &mut Criterion) {
    let gas = IdealGas::new(1.4).expect("above 1");
    let pairs = random_pairs(1_000_000);
    let counts: Vec<u32> = pairs
        .iter()
        .map(|(l, r)| {
            let solution = solve(gas, l, r);
            assert!(solution.pressure().is_finite() && solution.pressure() >= 0.0);
            assert!(solution.velocity().is_finite());
            solution.iterations()
        })
        .collect();
    let most = counts.iter().max().copied().unwrap_or(0);
    let mean = counts.iter().map(|&n| f64::from(n)).sum::<f64>() / counts.len() as f64;
    eprintln!("exact solver: {mean:.2} iterations on average, {most} at most");
    let mut group = criterion.benchmark_group("riemann");
    group.sample_size(10).throughput(Throughput::Elements(pairs.len() as u64));
    group.bench_function("exact, 1e6 random pairs", |bencher| {
        bencher.iter(|| pairs.iter().map(|(l, r)| solve(gas, l, r).pressure()).sum::<f64>());
    });
    group.finish();
}

fn lagrangian(criterion: &mut Criterion) {
    let particles = 100_000;
    // Every pair of the wave is a Riemann problem of its own; most pairs of a tube are equal states, which
    // cost nothing.
    let scenes = ["simple-wave", "sod"].map(|name| Scene::named(name).expect("it is in the list"));
    let roe = ModifiedRoe::default();
    for scene in &scenes {
        let title = format!("lagrangian, N = {particles}, {}, pair fluxes", scene.name);
        let mut group = criterion.benchmark_group(title);
        group.sample_size(10).throughput(Throughput::Elements(3 * particles as u64 + 6));
        group.bench_function("exact", |b| step(b, scene, particles, Flux::Exact));
        group.bench_function("rusanov", |b| step(b, scene, particles, Flux::Rusanov));
        group.bench_function("roe", |b| step(b, scene, particles, Flux::ModifiedRoe(roe)));
        group.finish();
    }
}

/// One step of a flow that has run for a hundred.
fn step(bencher: &mut Bencher, scene: &Scene, particles: usize, flux: Flux) {
    let options = LagrangianOptions::new(flux);
    let mut scheme = LagrangianScheme::new(scene, particles, &options).expect("valid");
    for _ in 0..100 {
        let step = scheme.courant_step();
        scheme.advance(step).expect("it is stable");
    }
    bencher.iter(|| {
        let step = scheme.courant_step();
        black_box(scheme.advance(step)).expect("it is stable");
    });
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    riemann(&mut criterion);
    lagrangian(&mut criterion);
    criterion.final_summary();
}
