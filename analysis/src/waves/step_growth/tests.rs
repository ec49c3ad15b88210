use super::*;
use crate::exact::rational::{parse, ratio};
use crate::kernel::Kernel;
use crate::scheme::{Integrator, KernelLattice, catalogue};
use proptest::prelude::*;

/// A particle method or a scheme of the catalogue on a kernel lattice, all set but `C`.
fn subject(name: &str, integrator: &str, kernel: Kernel, h: Rational) -> Step {
    let lattice = KernelLattice::new(kernel, &h).unwrap();
    let (file, integrator) = match catalogue::method(name) {
        Some(method) => (method, Integrator::for_particles(integrator)),
        None => (catalogue::scheme(name).unwrap(), None),
    };
    file.step(Some(&lattice), integrator, &[], Some("C")).unwrap()
}

fn growth(step: &Step, courant: &str) -> Growth {
    growth_at(&step.with("C", &parse(courant).unwrap()).unwrap()).unwrap()
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{found:e}, not {expected:e}");
}

#[test]
fn narrow_bands_just_above_a_limit_are_found() {
    let kdk = subject("sph", "leapfrog-kdk", Kernel::CubicSpline, ratio(3, 2));
    let found = growth(&kdk, "1.1866");
    // Two million phases about the binding wave, z + 1/z = 2 − (ω Δt)² from the kernel's own formulas (numpy).
    near(found.per_step, 0.012_968_564_814_03, 1e-11);
    assert_eq!(found.steps_to_double().unwrap().round(), 54.0);
    let wide = subject("sph", "leapfrog-kdk", Kernel::WendlandC2, ratio(4, 1));
    near(growth(&wide, "1.1637").per_step, 0.0257, 2e-3);
    let pc = subject("sph", "predictor-corrector", Kernel::CubicSpline, ratio(13, 10));
    near(growth(&pc, "1.1411").per_step, 0.0220, 3e-3);
}

/// `|g| − 1` of Godunov's scheme on the cubic spline at ratio 5/3 for the longest waves: with `C = (1 + δ) C_max` the largest growth is
/// `κ δ²` up to terms `δ³`, whatever `δ`.
#[test]
fn growth_a_hair_above_a_limit() {
    let godunov = subject("godunov-sph", "", Kernel::CubicSpline, ratio(5, 3));
    let exact = godunov.limit("C").unwrap().exact().unwrap().as_fraction().unwrap().clone();
    let at = |power: i32| {
        let value = &exact * (integer(1) + ratio(1, 10).pow(power));
        growth_at(&godunov.with("C", &value).unwrap()).unwrap()
    };
    // The margin is known in closed form: |g|² − 1 = s C (a − b s) to second order, its maximum by a parabola.
    let margin = godunov.gain_margin("C", &integer(0)).unwrap().unwrap();
    let value = |s: &Rational, t: &Rational| {
        let powers = (0..margin.powers()).rev();
        powers
            .fold(integer(0), |sum, j| sum * t + margin.coefficient(j).in_powers_of_s().evaluate(s))
    };
    for power in [12, 30] {
        let delta = ratio(1, 10).pow(power);
        let t = &exact * (integer(1) + &delta);
        let at_zero = value(&integer(0), &t);
        let slope = (value(&delta, &t) - &at_zero) / &delta;
        // 1 − |g|² = C s (at_zero + slope s): least at s = −at_zero/(2 slope).
        let excess = &t * &at_zero * &at_zero / (integer(4) * slope);
        near(at(power).per_step, to_f64(&(excess / integer(2))), 1e-10);
        assert!(at(power).steps_to_double().unwrap() > 1e20);
    }
}

/// A thousand phases in `f64`: never above what is found, and near it where nothing is narrow.
#[test]
fn sampled_waves_grow_no_faster() {
    let integrators = ["leapfrog-kdk", "rk2-heun", "rk4", "predictor-corrector", "forward-euler"];
    for method in ["sph", "sph-av", "gph"] {
        for integrator in integrators {
            let step = subject(method, integrator, Kernel::QuinticSpline, ratio(3, 2));
            for courant in ["0.3", "1.1", "1.6"] {
                let step = step.with("C", &parse(courant).unwrap()).unwrap();
                let (found, compiled) = (growth_at(&step).unwrap(), step.compile().unwrap());
                let sampled = (0..=1000)
                    .flat_map(|i| compiled.multipliers(&[], &[f64::from(i) * PI / 1000.0]))
                    .map(|z| z.norm() - 1.0)
                    .fold(f64::NEG_INFINITY, f64::max);
                // A double multiplier is worth the root of a rounding in f64.
                assert!(sampled <= found.per_step + 1e-7, "{method} {integrator} {courant}");
                assert!(
                    sampled >= found.per_step - 1e-3 * found.per_step.max(0.01),
                    "{method} {integrator} {courant}: {found:?}, sampled {sampled}"
                );
                let there = compiled.multipliers(&[], &[found.wave.phases()[0]]);
                let nearest =
                    there.iter().map(|z| (z - found.multiplier).norm()).fold(9.0, f64::min);
                assert!(nearest < 1e-6, "{method} {integrator} {courant}: {found:?} {there:?}");
            }
        }
    }
}

#[test]
fn numbers_out_of_the_range_of_floats() {
    // Lax–Wendroff with C = 10^200: |g(π)| = 2 C² − 1 has a logarithm only.
    let text =
        "u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + C^2/2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    let lax_wendroff = Step::from_text(text).unwrap();
    let found = growth(&lax_wendroff, "1e200");
    assert!(found.per_step.is_infinite());
    near(found.logarithm, 2f64.ln() + 400.0 * 10f64.ln(), 1e-14);
    near(growth(&lax_wendroff, "1e81").per_step, 2e162, 1e-14);
    // Two levels: z² − 2 b z − 1 = 0 with b = −i C sin φ.
    let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])").unwrap();
    near(growth(&leapfrog, "1e200").per_step, 2e200, 1e-14);
    // Implicit downwind at C = 1/2: the shortest wave cannot be stepped.
    let downwind = Step::from_text("u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j]) = u[n,j]").unwrap();
    let singular = growth(&downwind, "0.5");
    assert!(singular.logarithm.is_infinite() && singular.wave.phases()[0] == PI);
}

#[test]
fn without_growth_the_least_damped_wave_is_reported() {
    let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])").unwrap();
    assert_eq!(
        (growth(&upwind, "0.5").per_step, growth(&upwind, "0.5").wave.phases()[0]),
        (0.0, 0.0)
    );
    // No wave is kept: Lax–Wendroff on the cubic spline at ratio 3/2, at half its limit.
    let step = subject("lax-wendroff-sph", "", Kernel::CubicSpline, ratio(3, 2));
    let found = growth(&step, "0.7180308466769216");
    near(found.per_step, -0.040_607_545_538_517_41, 1e-12);
    assert_eq!(found.steps_to_double(), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    /// Random schemes between two and three levels: what is found is what 2000 samples see.
    #[test]
    fn random_schemes(
        new in prop::collection::vec(-6i64..=6, 3), old in prop::collection::vec(-6i64..=6, 3), implicit in 0i64..3
    ) {
        let sum = |level: &str, weights: &[i64]| -> String {
            let terms = weights.iter().zip(-1..).map(|(weight, offset)| {
                format!("+ ({weight})/8*u[{level},j{offset:+}]")
            });
            terms.collect()
        };
        let text = format!(
            "u[n+1,j] + {implicit}/8*(2*u[n+1,j] - u[n+1,j-1] - u[n+1,j+1]) = {} {}",
            sum("n", &new), sum("n-1", &old)
        );
        prop_assume!(old.iter().chain(&new).any(|&w| w != 0));
        let step = Step::from_text(&text).unwrap();
        let (found, compiled) = (growth_at(&step).unwrap(), step.compile().unwrap());
        let sampled = (0..=2000)
            .flat_map(|i| compiled.multipliers(&[], &[f64::from(i) * PI / 2000.0]))
            .map(|z| z.norm() - 1.0)
            .fold(f64::NEG_INFINITY, f64::max);
        prop_assert!(sampled <= found.per_step + 1e-7, "{} {:?} {}", text, found, sampled);
        prop_assert!(sampled >= found.per_step - 1e-4, "{} {:?} {}", text, found, sampled);
    }
}
