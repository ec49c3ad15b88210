//! Particle updates per second of both advection paths.
//!
//! The throughput printed is in particles: updates per second. Beside each case the operations per update
//! and the memory traffic (bytes read and written once, without what a write first reads) are printed, so
//! that the number can be set against the machine's arithmetic and memory.

use courant_analysis::exact::rational::integer;
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::{
    AdvectionScheme, Discretisation, LatticePath, ParticlePath, Ring, Stepper,
};
use criterion::{BenchmarkId, Criterion, Throughput};

const RATIOS: [i64; 2] = [2, 5];

const COURANT: f64 = 0.5;

fn discretisation(scheme: AdvectionScheme, ratio: i64) -> Discretisation {
    Discretisation::new(scheme, Kernel::CubicSpline, integer(ratio)).expect("a valid ratio")
}

fn smooth(particles: usize) -> Vec<f64> {
    (0..particles).map(|j| (j as f64 * 1e-3).sin()).collect()
}

fn lattice(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("advection_lattice");
    for particles in [1_000, 1_000_000] {
        group.throughput(Throughput::Elements(particles as u64));
        for scheme in [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph] {
            for ratio in RATIOS {
                let mut path = LatticePath::new(&discretisation(scheme, ratio), COURANT, particles);
                path.set_state(&smooth(particles));
                let width = path.coefficients().values.len();
                let name = format!("{scheme}, ratio {ratio}, {} flop, 16 B", 2 * width - 1);
                group.bench_function(BenchmarkId::new(name, particles), |bencher| {
                    bencher.iter(|| path.step());
                });
            }
        }
    }
    group.finish();
}

fn particles(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("advection_particles");
    for particles in [1_000, 100_000] {
        group.throughput(Throughput::Elements(particles as u64));
        for scheme in [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph] {
            for ratio in RATIOS {
                let ring = Ring::disordered(particles, 1.0, 0.1, 1).expect("a valid ring");
                let mut path = ParticlePath::new(&discretisation(scheme, ratio), COURANT, &ring);
                path.set_state(&smooth(particles));
                let pairs = path.interactions_per_step() as f64 / particles as f64;
                // Two operations, a weight and an index per pair.
                let (flop, bytes) = (2.0 * pairs, 16.0 * (pairs + 1.0));
                let name = format!("{scheme}, ratio {ratio}, {flop:.0} flop, {bytes:.0} B");
                group.bench_function(BenchmarkId::new(name, particles), |bencher| {
                    bencher.iter(|| path.step());
                });
            }
        }
    }
    group.bench_function("neighbours of 100,000", |bencher| {
        let ring = Ring::disordered(100_000, 1.0, 0.1, 1).expect("a valid ring");
        let of = discretisation(AdvectionScheme::GodunovSph, 2);
        bencher.iter(|| ParticlePath::new(&of, COURANT, &ring));
    });
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    lattice(&mut criterion);
    particles(&mut criterion);
    criterion.final_summary();
}
