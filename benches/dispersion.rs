//! The (κ, h, α) sweep of phase errors, 400 × 400 × 20.
//!
//! Operations: per (κ, h) two Clenshaw sums of together `3K − 1` terms, `K = ⌊2h/Δ⌋ ≤ 3`, at 3 flops
//! each, and a sine and cosine; per (κ, h, α) two square roots, a division and 8 flops. With a square
//! root or division counted as one flop that is 3.2 million × 11 ≈ 35 Mflop, and the exact lattice sums
//! of 400 ratios before it.
//!
//! Measured on two cores of an AMD EPYC (Zen 4, 2.6 GHz) that other work shared: 74 ms, of which 28 ms are
//! the rational lattice sums and the first α (the row with one α). Against a peak of 2 × 2.6 GHz × 16 flop the 35 Mflop in 46 ms are 1 %: the bound here is not
//! the multiply-add units but scalar square roots and divisions (14 cycles of issue per value, 9 ms) and
//! 26 MB of fresh pages.

use courant_analysis::exact::rational::{integer, ratio};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{Integrator, LatticeMethod, catalogue};
use courant_analysis::stability::SearchPlan;
use courant_analysis::waves::dispersion::sweep::{
    Quantity, even_axis, over_phase_ratio_and_viscosity, stable_step_map,
};
use courant_analysis::waves::sweep::no_progress;
use criterion::Criterion;
use std::hint::black_box;

fn scheme() -> LatticeMethod {
    let viscous = catalogue::method("sph-av").expect("it is in the catalogue");
    LatticeMethod::new(viscous, Kernel::CubicSpline, &ratio(6, 5)).expect("the ratio is in range")
}

fn integrator(name: &str) -> &'static Integrator {
    Integrator::named(name).expect("it is in the catalogue")
}

fn sweeps(criterion: &mut Criterion) {
    let phases: Vec<f64> =
        (1..=400).map(|index| f64::from(index) * std::f64::consts::PI / 400.0).collect();
    let ratios = even_axis(&integer(1), &ratio(3, 2), 400);
    let factors: Vec<f64> = (0..20).map(|index| 0.5 * f64::from(index)).collect();
    let mut group = criterion.benchmark_group("dispersion");
    group.sample_size(10);
    group.bench_function("phase error 400 x 400 x 20", |bencher| {
        bencher.iter(|| {
            over_phase_ratio_and_viscosity(
                black_box(&scheme()),
                &phases,
                &ratios,
                &factors,
                Quantity::PhaseError,
                &no_progress,
            )
        });
    });
    group.bench_function("phase error 400 x 400 x 1", |bencher| {
        bencher.iter(|| {
            over_phase_ratio_and_viscosity(
                black_box(&scheme()),
                &phases,
                &ratios,
                &[1.0],
                Quantity::PhaseError,
                &no_progress,
            )
        });
    });
    let few = even_axis(&integer(1), &integer(2), 20);
    group.bench_function("stable step map 20 x 20, rk4", |bencher| {
        bencher.iter(|| {
            let integrator = integrator("rk4");
            stable_step_map(black_box(&scheme()), integrator, &few, &factors, 4.0, &no_progress)
        });
    });
    let plan = SearchPlan::default().up_to(integer(8));
    for name in ["symplectic-euler", "rk4"] {
        group.bench_function(format!("proof of one limit, {name}"), |bencher| {
            bencher.iter(|| {
                let step = black_box(&scheme()).step(integrator(name)).expect("it serves");
                step.stable_set("C", &plan)
            });
        });
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    sweeps(&mut criterion);
    criterion.final_summary();
}
