//! The sweep behind Figure 1: 400 × 400 points of the (ratio, Courant number) plane, 1000 phases.
//!
//! Work: 1.6e8 grid-point phases. Each costs one multiplication and one addition for each power of `t` beyond
//! the first, one for the scale, and one comparison each for the largest and the smallest value: about 5 operations for
//! the schemes here, 8e8 in all. Baseline x86-64 code has two lanes, so one core at 3 GHz with two vector units
//! peaks at 12e9 multiply–adds without fused instructions; the samples run near the limit of the L1 cache, which holds
//! the tabulated powers (2 × 8 kB) and the excess (8 kB). The refinement evaluates a cosine series of up to 60 terms and
//! a handful of trigonometric functions about six times for each grid point and extremum; every term waits for the one
//! before (Clenshaw's recurrence), so it is bound by latency.
//!
//! Measured on two cores: 0.97 s for Godunov SPH with the cubic spline (165 million grid-point phases per second) and 2.3 s
//! for Lax–Wendroff SPH with the Gaussian (70 million, with exact symbols of 61 long coefficients to build for every ratio).
//! Counting the five operations above only, that is 3 % and 1.5 % of the multiply–add peak of both cores. The rest of the
//! time goes into the refinement and the exact symbols; this bench does not separate the two.

use courant_analysis::exact::rational::{Rational, ratio as ratio_of};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{SchemeError, catalogue};
use courant_analysis::stability::margin::Margin;
use courant_analysis::waves::sweep::{gain_map, no_progress};
use criterion::{Criterion, Throughput};

fn figure_1(criterion: &mut Criterion) {
    let ratios: Vec<Rational> = (0..400).map(|i| ratio_of(400 + 9 * i, 400)).collect();
    let courant_numbers: Vec<f64> = (0..400).map(|i| f64::from(i) * 0.03).collect();
    let mut group = criterion.benchmark_group("figure_1_sweep");
    group.sample_size(10);
    group.throughput(Throughput::Elements(400 * 400 * 1000));
    for (scheme, kernel) in
        [("godunov-sph", Kernel::CubicSpline), ("lax-wendroff-sph", Kernel::Gaussian)]
    {
        let file = catalogue::scheme(scheme).expect("it is in the catalogue");
        let margin = |ratio: &Rational| -> Result<Margin, SchemeError> {
            let margin = file.with_kernel(kernel, ratio)?.gain_margin("C", &ratio_of(0, 1))?;
            Ok(margin.expect("an explicit scheme"))
        };
        group.bench_function(format!("{scheme}/{kernel}"), |bencher| {
            bencher.iter(|| {
                gain_map(margin, &ratios, &courant_numbers, 1000, &no_progress)
                    .expect("the axes are within range")
            });
        });
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    figure_1(&mut criterion);
    criterion.final_summary();
}
