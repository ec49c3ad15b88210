//! The sweep behind Figure 1, 401 × 401 points of the (ratio, Courant number) plane, beside the NumPy script `benches/numpy/figure1.py`.
//!
//! Work for Godunov SPH with the cubic spline: `|g|² − 1` has three powers of `C` and a degree of up to `2l/Δξ`, 10 in the mean, so that 43
//! nodes and 12 terms a cell know it. Multiply–adds: samples 9 for each node and point, 62e6 in all (the script: 3.2e8 for 1000 phases); about four cells
//! are put together and bounded for each point, 66 for each, and two of them followed by three Newton steps, 100 for each, 75e6; tables 3e6. Together 1.4e8.
//!
//! Measured by profile on one core of a Zen 5 machine with AVX-512: 14 ms of its time for that, 1e10 multiply–adds per second, 16 % of the
//! peak of 64e9 (two fused ones of eight lanes at 4 GHz). Half of the rest is that no fused instruction is used, so that the bits do
//! not depend on the machine; the other half latency: Horner's rule in a cell is a chain of 11 multiplications and additions with one
//! vector in flight, and so are the divisions and the tests whether any lane reaches. The other 20 ms go into the equations, weights and tables of 401
//! ratios. README has the times beside the script's, which the last line of this bench prints.

use courant_analysis::exact::rational::{Rational, ratio as ratio_of};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue;
use courant_analysis::waves::sweep::{GainMap, gain_map, no_progress};
use criterion::{Criterion, Throughput};
use std::process::Command;
use std::time::Instant;

/// Runs of each of the two that are compared; the fastest counts.
const RUNS: usize = 7;

fn sweep(scheme: &str, kernel: Kernel) -> GainMap {
    let ratios: Vec<Rational> = (0..=400).map(|i| ratio_of(400 + 9 * i, 400)).collect();
    let courant_numbers: Vec<f64> = (0..=400).map(|i| f64::from(i) * 0.03).collect();
    let file = catalogue::scheme(scheme).expect("it is in the catalogue");
    let step = |ratio: &Rational| file.with_kernel(kernel, ratio);
    gain_map(&ratios, step, "C", &courant_numbers, &no_progress).expect("the axes are in range")
}

fn figure_1(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("figure_1_sweep");
    group.sample_size(10);
    group.throughput(Throughput::Elements(401 * 401));
    for (scheme, kernel) in
        [("godunov-sph", Kernel::CubicSpline), ("lax-wendroff-sph", Kernel::Gaussian)]
    {
        group.bench_function(format!("{scheme}/{kernel}"), |bencher| {
            bencher.iter(|| sweep(scheme, kernel));
        });
    }
    group.finish();
}

/// The NumPy script and the sweep in turn, on whatever else the machine does.
fn beside_numpy() {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/numpy/figure1.py");
    let (mut numpy, mut here) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..RUNS {
        let output = Command::new("python3").arg(script).env("OPENBLAS_NUM_THREADS", "1").output();
        let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
        let Some(seconds) = text.ok().and_then(|text| text.trim().parse().ok()) else {
            println!("figure_1_sweep: no python3 with NumPy to compare with");
            return;
        };
        numpy = numpy.min(seconds);
        let start = Instant::now();
        std::hint::black_box(sweep("godunov-sph", Kernel::CubicSpline));
        here = here.min(start.elapsed().as_secs_f64());
    }
    println!(
        "figure_1_sweep: NumPy {numpy:.3} s, here {here:.4} s, {:.1} times faster",
        numpy / here
    );
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    figure_1(&mut criterion);
    criterion.final_summary();
    if std::env::args().any(|argument| argument == "--bench") {
        beside_numpy();
    }
}
