use courant_analysis::exact::rational::{Rational, integer, ratio};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{
    AdvectionScheme, Discretisation, KernelLattice, Scheme, Step, catalogue,
};
use courant_analysis::stability::margin::Margin;
use courant_analysis::stability::{Limit, SearchPlan, stable_set};
use std::time::Instant;

fn new(scheme: AdvectionScheme, kernel: Kernel, l: &Rational) -> Step {
    let lattice = KernelLattice::new(kernel, l).unwrap();
    catalogue::scheme(scheme.name()).unwrap().step(Some(&lattice), None, &[], Some("C")).unwrap()
}

fn near(a: &Limit, b: &Limit) -> bool {
    let close = |x: f64, y: f64| x == y || (x - y).abs() <= 1e-14 * x.abs();
    close(a.lower(), b.lower())
        && close(a.upper(), b.upper())
        && a.exact() == b.exact()
        && a.evidence() == b.evidence()
        && a.critical_phase().is_some() == b.critical_phase().is_some()
        && (a.critical_phase().unwrap_or(0.0) - b.critical_phase().unwrap_or(0.0)).abs() < 1e-6
        && a.equation().map(|e| e.equation("C")) == b.equation().map(|e| e.equation("C"))
}

#[test]
fn limits() {
    for kernel in Kernel::ALL {
        for l in [
            ratio(1, 4),
            ratio(1, 2),
            ratio(3, 5),
            integer(1),
            ratio(13, 10),
            ratio(3, 2),
            integer(2),
            integer(3),
            ratio(41, 10),
        ] {
            for scheme in AdvectionScheme::ALL {
                for growth in [integer(0), ratio(1, 1000)] {
                    let symbol = Discretisation::new(scheme, kernel, l.clone()).unwrap().symbol();
                    let max = integer(10) + &l * integer(4);
                    let old = stable_set(&symbol, &growth, &max);
                    let step = new(scheme, kernel, &l);
                    let plan = SearchPlan::default().up_to(max).growing(growth.clone());
                    let set = step.stable_set("C", &plan).unwrap();
                    let m = Margin::new(&symbol, &growth);
                    let n = step.gain_margin("C", &growth).unwrap().unwrap();
                    let shape = |m: &Margin| {
                        (
                            m.phase_power(),
                            m.complement_power(),
                            m.courant_power(),
                            m.stride(),
                            m.powers(),
                            m.degree(),
                            m.neutral_waves().clone(),
                        )
                    };
                    if shape(&m) != shape(&n) {
                        println!(
                            "shape {scheme} {kernel} {l} {growth}: {:?}\n   {:?}",
                            shape(&m),
                            shape(&n)
                        );
                    }
                    let (c, d) = (m.compile(), n.compile());
                    for i in 0..50 {
                        let p = f64::from(i) * 0.064;
                        let (x, y) = (c.at(0.7, p), d.at(0.7, p));
                        if (x - y).abs() > 1e-13 {
                            println!("value {scheme} {kernel} {l} {growth} {p} {x} {y}");
                        }
                    }
                    let same = old.intervals.len() == set.intervals.len()
                        && old
                            .intervals
                            .iter()
                            .zip(&set.intervals)
                            .all(|(a, b)| near(&a.from, &b.from) && near(&a.to, &b.to))
                        && old.undecided.len() == set.undecided.len()
                        && near(&old.limit(), &set.limit())
                        && old.neutral == set.neutral;
                    if !same {
                        println!("set {scheme} {kernel} {l} {growth}:\n  {old:?}\n  {set:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn speed() {
    let zero = integer(0);
    for (scheme, kernels, ratios) in [
        (
            AdvectionScheme::GodunovSph,
            &[Kernel::CubicSpline, Kernel::Gaussian][..],
            &[1, 2, 3, 4, 5, 10][..],
        ),
        (AdvectionScheme::GodunovSph, &[Kernel::CubicSpline][..], &[50][..]),
        (AdvectionScheme::LaxWendroffSph, &[Kernel::CubicSpline][..], &[50][..]),
        (AdvectionScheme::LaxWendroffSph, &[Kernel::Gaussian][..], &[10][..]),
        (AdvectionScheme::GodunovSph, &[Kernel::Gaussian][..], &[50][..]),
    ] {
        let mut best = [f64::INFINITY; 4];
        for _ in
            0..(if scheme == AdvectionScheme::LaxWendroffSph && ratios == [50] { 6 } else { 25 })
        {
            let mut lap = |i: usize, work: &dyn Fn(Kernel, i64)| {
                let start = Instant::now();
                for &kernel in kernels {
                    for &l in ratios {
                        work(kernel, l);
                    }
                }
                best[i] = best[i].min(start.elapsed().as_secs_f64() * 1e3);
            };
            lap(0, &|kernel, l| {
                let symbol = Discretisation::new(scheme, kernel, integer(l)).unwrap().symbol();
                stable_set(&symbol, &zero, &integer(100));
            });
            lap(1, &|kernel, l| {
                let symbol = Discretisation::new(scheme, kernel, integer(l)).unwrap().symbol();
                stable_set(&symbol, &zero, &integer(100));
                courant_analysis::stability::monotonicity_limit(&symbol, &integer(100));
            });
            lap(2, &|kernel, l| {
                new(scheme, kernel, &integer(l)).stable_set("C", &SearchPlan::default()).unwrap();
            });
            lap(3, &|kernel, l| {
                let step = new(scheme, kernel, &integer(l));
                step.stable_set("C", &SearchPlan::default()).unwrap();
                step.monotone_set("C", &SearchPlan::default()).unwrap();
            });
        }
        println!(
            "{scheme} {ratios:?}: old set {:.2}, with monotone {:.2}; new {:.2}, {:.2} ms",
            best[0], best[1], best[2], best[3]
        );
    }
}

#[test]
fn breakdown() {
    for (kernel, ratios) in [
        (Kernel::CubicSpline, &[1, 2, 3, 4, 5, 10][..]),
        (Kernel::Gaussian, &[1, 2, 3, 4, 5, 10][..]),
        (Kernel::CubicSpline, &[50][..]),
    ] {
        let mut best = [f64::INFINITY; 7];
        for _ in 0..25 {
            let mut times = [0.0f64; 7];
            for &l in ratios {
                let l = integer(l);
                let mut at = Instant::now();
                let mut lap = |i: usize| {
                    times[i] += at.elapsed().as_secs_f64() * 1e3;
                    at = Instant::now();
                };
                courant_analysis::kernel::lattice::LatticeWeights::new(kernel, &l).unwrap();
                lap(0);
                let lattice = KernelLattice::new(kernel, &l).unwrap();
                lap(1);
                let step = catalogue::scheme("godunov-sph")
                    .unwrap()
                    .step(Some(&lattice), None, &[], Some("C"))
                    .unwrap();
                lap(2);
                step.characteristic().unwrap();
                lap(3);
                step.gain_margin("C", &integer(0)).unwrap();
                lap(4);
                step.stable_set("C", &SearchPlan::default()).unwrap();
                lap(5);
                step.monotone_set("C", &SearchPlan::default()).unwrap();
                lap(6);
            }
            println!(
                "{kernel}: weights {:.2} lattice {:.2} step {:.2} chi {:.2} margin {:.2} set {:.2} monotone {:.2}",
                times[0], times[1], times[2], times[3], times[4], times[5], times[6]
            );
        }
    }
}
