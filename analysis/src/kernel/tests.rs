use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;

fn polynomial_kernels() -> impl Iterator<Item = (Kernel, &'static PiecewisePolynomial)> {
    Kernel::ALL.into_iter().filter_map(|kernel| Some((kernel, kernel.polynomial()?)))
}

/// Composite Simpson rule: the plain road to an integral.
fn simpson(function: impl Fn(f64) -> f64, end: f64) -> f64 {
    const CELLS: usize = 3000;
    let width = end / CELLS as f64;
    (0..CELLS)
        .map(|cell| {
            let left = cell as f64 * width;
            // The last abscissa is the end itself: a rounded one could fall outside the support.
            let right = if cell + 1 == CELLS { end } else { left + width };
            width / 6.0 * (function(left) + 4.0 * function(left + width / 2.0) + function(right))
        })
        .sum()
}

#[test]
fn polynomial_kernels_are_normalised_exactly() {
    for (kernel, shape) in polynomial_kernels() {
        assert_eq!(shape.half_moment(0), ratio(1, 2), "{kernel}");
    }
}

#[test]
fn the_cut_gaussian_integrates_to_erf_3() {
    // Simpson's error with 3000 cells on [0, 3] is below 1e-14.
    let integral = 2.0 * simpson(|q| Kernel::Gaussian.value(q), 3.0);
    assert_relative_eq!(integral, 0.999_977_909_503_001_4, epsilon = 1e-13);
}

#[test]
fn standard_deviations_match_quadrature_and_the_literature() {
    for kernel in Kernel::ALL {
        let moment = |power| simpson(|q| q.powi(power) * kernel.value(q), kernel.support());
        // Kinks of the fourth derivative at the knots limit Simpson to about 1e-13.
        assert_relative_eq!(
            kernel.standard_deviation(),
            (moment(2) / moment(0)).sqrt(),
            epsilon = 1e-11
        );
    }
    // A B-spline is a sum of n uniform variables of variance 1/12.
    for (kernel, order) in
        [(Kernel::CubicSpline, 4.0), (Kernel::QuarticSpline, 5.0), (Kernel::QuinticSpline, 6.0)]
    {
        assert_relative_eq!(
            kernel.standard_deviation(),
            (order / 12.0_f64).sqrt(),
            epsilon = 1e-15
        );
    }
}

#[test]
fn knots_are_smooth_and_the_edge_is_zero() {
    for (kernel, shape) in polynomial_kernels() {
        let pieces = shape.pieces();
        for (inner, outer) in pieces.iter().zip(&pieces[1..]) {
            let (mut left, mut right) = (inner.shape.clone(), outer.shape.clone());
            for order in 0..=2 {
                assert_eq!(
                    left.evaluate(&inner.end),
                    right.evaluate(&inner.end),
                    "{kernel}, derivative {order} at {}",
                    inner.end
                );
                (left, right) = (left.derivative(), right.derivative());
            }
        }
        let highest = if kernel == Kernel::WendlandC2 { 2 } else { 1 };
        for order in 0..=highest {
            assert!(shape.exact(shape.support(), order).is_zero(), "{kernel} at its edge");
        }
        assert_eq!(kernel.value(kernel.support()), 0.0);
        // Even functions: no slope at the centre, not even rounding.
        assert_eq!(kernel.slope(0.0), 0.0, "{kernel}");
    }
}

#[test]
fn the_cubic_spline_is_the_one_of_the_paper() {
    let shape = Kernel::CubicSpline.polynomial().unwrap();
    for numerator in 0..=20 {
        let q = ratio(numerator, 10);
        let paper = if q < integer(1) {
            ratio(2, 3) - &q * &q + &q * &q * &q * ratio(1, 2)
        } else {
            let rest = integer(2) - &q;
            &rest * &rest * &rest * ratio(1, 6)
        };
        assert_eq!(shape.exact(&q, 0), paper);
    }
}

#[test]
fn the_gaussian_keeps_the_point_at_its_cut() {
    assert!(Kernel::Gaussian.value(3.0) > 0.0);
    assert_eq!(Kernel::Gaussian.value(3.0_f64.next_up()), 0.0);
}

#[test]
fn names_and_aliases_lead_back() {
    for kernel in Kernel::ALL {
        assert_eq!(kernel.name().parse(), Ok(kernel));
        for alias in kernel.aliases() {
            assert_eq!(alias.parse(), Ok(kernel));
        }
        assert_relative_eq!(kernel.support(), to_f64(&kernel.exact_support()));
    }
    assert!("cubical".parse::<Kernel>().is_err());
}

proptest! {
    #[test]
    fn fast_evaluation_agrees_with_exact_arithmetic(numerator in 0i64..=3000) {
        let q = ratio(numerator, 1000);
        for (_, shape) in polynomial_kernels() {
            let fast = [shape.value(to_f64(&q)), shape.slope(to_f64(&q)), shape.curvature(to_f64(&q))];
            for (order, fast) in fast.into_iter().enumerate() {
                // Horner on at most ten terms below 100 in size.
                prop_assert!((fast - to_f64(&shape.exact(&q, order))).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn derivatives_agree_with_differences(q in 0.01f64..2.99) {
        let step = 1e-4;
        for kernel in Kernel::ALL {
            let (left, right) = (kernel.value(q - step), kernel.value(q + step));
            // Truncation step²·|w'''|/6 plus the jump of w''' (M4) or w'' at a knot or edge.
            prop_assert!(((right - left) / (2.0 * step) - kernel.slope(q)).abs() < 1e-6);
            let (left, right) = (kernel.slope(q - step), kernel.slope(q + step));
            prop_assert!(((right - left) / (2.0 * step) - kernel.curvature(q)).abs() < 2e-3);
        }
    }

    #[test]
    fn kernels_fall_monotonically(q in 0.0f64..3.5) {
        for kernel in Kernel::ALL {
            prop_assert!(kernel.slope(q) <= 0.0);
            prop_assert!(kernel.value(q) >= 0.0);
        }
    }
}
