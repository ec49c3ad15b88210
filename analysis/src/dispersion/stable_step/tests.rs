use super::*;
use crate::dispersion::method::{Form, WaveMethod};
use crate::kernel::Kernel;
use crate::rational::ratio;

fn scheme(method: WaveMethod, kernel: Kernel, h: Rational) -> WaveScheme {
    WaveScheme::new(method, kernel, &h).unwrap()
}

fn gph() -> WaveMethod {
    WaveMethod::Gph { form: Form::Resolved }
}

#[test]
fn explore() {
    for kernel in [Kernel::CubicSpline, Kernel::Gaussian, Kernel::WendlandC2] {
        for (a, b) in [(1, 1), (6, 5), (3, 2), (2, 1)] {
            for method in [WaveMethod::Sph, WaveMethod::SphAv { alpha: ratio(1, 1) }, gph()] {
                let s = scheme(method.clone(), kernel, ratio(a, b));
                for integrator in Integrator::ALL {
                    let start = std::time::Instant::now();
                    let step = stable_step(&s, integrator, &integer(8)).unwrap();
                    println!(
                        "{kernel} {a}/{b} {}: {}={:.6} {:?} {:?} {:?} {}",
                        method.name(),
                        integrator,
                        step.limit().value(),
                        step.binding(),
                        step.limit().critical_phase(),
                        start.elapsed(),
                        if step.undecided().is_empty() { "" } else { "!" },
                    );
                }
            }
        }
    }
}
