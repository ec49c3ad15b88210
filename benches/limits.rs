//! What proofs cost: the whole of Table 1, single limits at growing ratios, limits as roots of a discriminant, certificates.
//!
//! Two cores of a virtual machine, one used: Table 1 8 ms; ratio 50 7.5 ms (Godunov SPH) and 0.35 s (Lax–Wendroff SPH); a limit with its
//! polynomial 0.9 ms at ratio 5/2 and 5.8 ms at 41/10.

use courant_analysis::certificate::{Subject, certify, verify};
use courant_analysis::exact::rational::{Rational, integer, ratio};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{KernelLattice, Step, catalogue};
use courant_analysis::stability::SearchPlan;
use criterion::Criterion;
use std::hint::black_box;

fn scheme(scheme: &str, kernel: Kernel, ratio: &Rational) -> Step {
    let file = catalogue::scheme(scheme).expect("it is in the catalogue");
    file.with_kernel(kernel, ratio).expect("ratios up to 50 are accepted")
}

fn limits(criterion: &mut Criterion) {
    let plan = SearchPlan::default();
    let mut group = criterion.benchmark_group("limits");
    group.sample_size(10);
    group.bench_function("table 1", |bencher| {
        bencher.iter(|| {
            for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
                for ratio in [1, 2, 3, 4, 5, 10] {
                    let step = scheme("godunov-sph", kernel, &integer(ratio));
                    black_box(step.stable_set("C", &plan)).expect("C is free");
                    black_box(step.monotone_set("C", &plan)).expect("C is free");
                }
            }
        });
    });
    for ratio in [10, 50] {
        for of in ["godunov-sph", "lax-wendroff-sph"] {
            group.bench_function(format!("{of}, cubic, ratio {ratio}"), |bencher| {
                bencher.iter(|| {
                    scheme(of, Kernel::CubicSpline, &integer(ratio)).stable_set("C", &plan)
                });
            });
        }
    }
    for l in [ratio(5, 2), ratio(41, 10)] {
        let name = format!("lax-wendroff-sph, cubic, ratio {l}, as a root");
        let step = scheme("lax-wendroff-sph", Kernel::CubicSpline, &l);
        assert!(step.limit("C").expect("C is free").equation().is_some());
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(&step).stable_set("C", &plan));
        });
    }
    let lattice = KernelLattice::new(Kernel::CubicSpline, &integer(10)).expect("a ratio of 10");
    let file = catalogue::scheme("lax-wendroff-sph").expect("it is in the catalogue");
    let step = file.step(Some(&lattice), None, &[], Some("C")).expect("a scheme");
    let subject = Subject::new(&file.equations.text, Some(&lattice), None, &step, "C");
    let subject = subject.expect("a known kernel");
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
