use super::*;
use crate::exact::rational::ratio;
use crate::kernel::Kernel;
use crate::kernel::lattice::LatticeWeights;
use crate::scheme::{Integrator, KernelLattice, Lines, catalogue};
use num_traits::Signed;
use proptest::prelude::*;

fn of_catalogue(name: &str, kernel: Kernel, l: Rational) -> OneStep {
    let lattice = KernelLattice::new(kernel, &l).unwrap();
    let scheme = catalogue::scheme(name).unwrap();
    scheme.step(Some(&lattice), None, &[], Some("C")).unwrap().one_step("C").unwrap()
}

#[test]
fn kernel_sums_are_their_weights() {
    for kernel in Kernel::ALL {
        for l in [ratio(1, 4), ratio(3, 2), integer(3)] {
            let weights = LatticeWeights::new(kernel, &l).unwrap();
            let found = of_catalogue("godunov-sph", kernel, l);
            assert_eq!(found.is_exact(), kernel != Kernel::Gaussian || weights.gradient.is_empty());
            // No weight stands downwind, not even an uncertain one.
            let offsets: Vec<i64> =
                found.coefficients.iter().map(|(offset, _, _)| *offset).collect();
            assert_eq!(offsets, (-(weights.reach() as i64)..=0).collect::<Vec<_>>(), "{kernel}");
            for (k, weight) in (1..).zip(&weights.gradient) {
                assert_eq!(
                    found.coefficient(-k).coefficients(),
                    [Rational::zero(), weight * integer(2)]
                );
            }
            for (_, center, radius) in &found.coefficients {
                assert!(radius.degree() <= center.degree().max(Some(1)));
            }
        }
    }
}

#[test]
fn products_of_sums_stay_as_narrow_as_their_weights() {
    // Two stages of the upwind sum: no weight downwind, and coefficients within the radius of an enclosing exact kernel.
    let l = integer(2);
    let lattice = KernelLattice::new(Kernel::Gaussian, &l).unwrap();
    let text = "u[j]' = -2*C*sum(k, w[k]*(u[j] - u[j-k]))";
    let stepped = |lattice: &KernelLattice| {
        let space = Lines::with_kernel(text, lattice).unwrap();
        let step = Step::lines(&space, Integrator::named("rk2-heun").unwrap()).unwrap();
        step.one_step("C").unwrap()
    };
    let enclosed = stepped(&lattice);
    assert!(enclosed.keeps_constants && !enclosed.is_exact());
    assert!(enclosed.coefficients.iter().all(|(offset, _, _)| *offset <= 0));
    // The same weights moved within their radius, and taken as exact.
    let mut moved = lattice.weights.clone();
    let radius = std::mem::take(&mut moved.radius);
    for (k, weight) in moved.gradient.iter_mut().enumerate() {
        if k % 2 == 0 { *weight += &radius } else { *weight -= &radius }
    }
    let exact = stepped(&KernelLattice::from_weights(l, moved));
    assert!(exact.is_exact());
    for (offset, center, radius) in &enclosed.coefficients {
        let difference = exact.coefficient(*offset) - center.clone();
        for (power, value) in difference.coefficients().iter().enumerate() {
            assert!(value.abs() <= radius.coefficient(power), "{offset} {power}");
        }
    }
}

#[test]
fn only_explicit_steps_of_one_unknown_have_coefficients() {
    let one = |text| Step::from_text(text).unwrap().one_step("C");
    assert!(one("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])").is_none());
    assert!(one("u[n+1,j] + C*(u[n+1,j] - u[n+1,j-1]) = u[n,j]").is_none());
    assert!(one("u[n+1,j] = u[n,j] - C*D*(u[n,j] - u[n,j-1])").is_none());
    assert!(one("u[n+1,j] = u[n,j] - D*(u[n,j] - u[n,j-1])").is_none());
    // An auxiliary is substituted; a letter that is no sum is a number within a radius.
    let predicted = "p[n,j] = u[n,j] - C*(u[n,j+1] - u[n,j]); u[n+1,j] = (u[n,j] + p[n,j] - C*(p[n,j] - p[n,j-1]))/2";
    let lax_wendroff = one(predicted).unwrap();
    assert_eq!(lax_wendroff.coefficient(0).coefficients(), [integer(1), integer(0), integer(-1)]);
    let root = one("u[n+1,j] = u[n,j] - sqrt(2)*C*(u[n,j] - u[n,j-1])").unwrap();
    assert!(root.keeps_constants && !root.is_exact());
    assert!((to_f64(&root.coefficient(-1).coefficient(1)) - 2f64.sqrt()).abs() < 1e-15);
}

proptest! {
    #[test]
    fn the_gain_is_the_multiplier(values in prop::collection::vec(-9i64..9, 1..5), c in -2.0f64..2.0, phase in 0.0f64..3.2) {
        let terms = (0..).zip(&values).map(|(k, value)| format!("({value} - C^2/{})*u[n,j+{k}]", k + 1));
        let text = format!("u[n+1,j] = {}", terms.collect::<Vec<_>>().join(" + "));
        let one_step = Step::from_text(&text).unwrap().one_step("C").unwrap();
        let plain: Complex64 = (0..).zip(&values).map(|(k, value)| {
            let factor = *value as f64 - c * c / f64::from(k + 1);
            factor * Complex64::new(0.0, f64::from(k) * phase).exp()
        }).sum();
        prop_assert!((one_step.gain(c, phase) - plain).norm() < 1e-12);
        prop_assert!((to_f64(&one_step.mean_gain().evaluate(&integer(1))) - one_step.gain(1.0, 0.0).re).abs() < 1e-12);
    }
}
