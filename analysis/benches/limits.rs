//! What proofs cost: the whole of Table 1, single limits at growing ratios, limits as roots of a discriminant, certificates.
//!
//! Two cores of a virtual machine, one used: Table 1 8 ms; ratio 50 7.5 ms (Godunov SPH) and 0.35 s (Lax–Wendroff SPH); a limit with its
//! polynomial 0.9 ms at ratio 5/2 and 5.8 ms at 41/10.

use courant_analysis::certificate::{Subject, certify, verify};
use courant_analysis::exact::rational::{integer, ratio};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{AdvectionScheme, Discretisation, KernelLattice, Scheme, catalogue};
use courant_analysis::stability::{SearchPlan, monotonicity_limit, stable_set};
use criterion::Criterion;
use std::hint::black_box;

fn scheme(scheme: AdvectionScheme, kernel: Kernel, ratio: i64) -> Discretisation {
    Discretisation::new(scheme, kernel, integer(ratio)).expect("ratios up to 50 are accepted")
}

fn limits(criterion: &mut Criterion) {
    let (zero, max) = (integer(0), integer(100));
    let mut group = criterion.benchmark_group("limits");
    group.sample_size(10);
    group.bench_function("table 1", |bencher| {
        bencher.iter(|| {
            for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
                for ratio in [1, 2, 3, 4, 5, 10] {
                    let symbol = scheme(AdvectionScheme::GodunovSph, kernel, ratio).symbol();
                    black_box(stable_set(&symbol, &zero, &max));
                    black_box(monotonicity_limit(&symbol, &max));
                }
            }
        });
    });
    for ratio in [10, 50] {
        for of in [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph] {
            group.bench_function(format!("{of}, cubic, ratio {ratio}"), |bencher| {
                bencher.iter(|| {
                    let symbol = scheme(of, Kernel::CubicSpline, ratio).symbol();
                    stable_set(black_box(&symbol), &zero, &max)
                });
            });
        }
    }
    for l in [ratio(5, 2), ratio(41, 10)] {
        let name = format!("lax-wendroff-sph, cubic, ratio {l}, as a root");
        let of = Discretisation::new(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, l);
        let symbol = of.expect("ratios up to 50 are accepted").symbol();
        assert!(stable_set(&symbol, &zero, &max).limit().equation().is_some());
        group.bench_function(name, |bencher| {
            bencher.iter(|| stable_set(black_box(&symbol), &zero, &max));
        });
    }
    let lattice = KernelLattice::new(Kernel::CubicSpline, &integer(10)).expect("a ratio of 10");
    let file = catalogue::scheme("lax-wendroff-sph").expect("it is in the catalogue");
    let step = file.step(Some(&lattice), None, &[], Some("C")).expect("a scheme");
    let subject = Subject::new(&file.equations.text, Some(&lattice), None, &step, "C");
    let (subject, plan) = (subject.expect("a known kernel"), SearchPlan::default());
    group.bench_function("certify, lax-wendroff-sph, cubic, ratio 10", |bencher| {
        bencher.iter(|| certify(black_box(&subject), &step, &plan));
    });
    let certificates = certify(&subject, &step, &plan).expect("decided");
    group.bench_function("verify, lax-wendroff-sph, cubic, ratio 10", |bencher| {
        bencher.iter(|| certificates.iter().map(verify).collect::<Vec<_>>());
    });
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    limits(&mut criterion);
    criterion.final_summary();
}
