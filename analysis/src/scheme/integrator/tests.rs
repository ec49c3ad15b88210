use super::*;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, ratio, to_f64};
use num_complex::Complex64;
use proptest::prelude::*;

#[test]
fn the_order_of_declaration_is_the_order_of_the_list() {
    for (index, integrator) in Integrator::ALL.into_iter().enumerate() {
        assert_eq!(integrator as usize, index);
        assert_eq!(integrator.name().parse(), Ok(integrator));
        for alias in integrator.aliases() {
            assert_eq!(alias.parse(), Ok(integrator));
        }
    }
    assert!("verlet2".parse::<Integrator>().is_err());
}

/// `Σ_{k ≤ order} L^k / k!` with `L = [[0, 1], [f, g]]`, multiplied out: what Runge–Kutta methods of
/// that many stages and that order must do to a linear system.
fn exponential_series(order: i64, f: &Rational, g: &Rational) -> [[Rational; 2]; 2] {
    let zero = integer(0);
    let mut power = [[integer(1), zero.clone()], [zero, integer(1)]];
    let mut sum = power.clone();
    for k in 1..=order {
        // L^k = L · L^(k−1), with 1/k on the way.
        let [top, bottom] = power;
        let next: [Rational; 2] = [0, 1].map(|j| (f * &top[j] + g * &bottom[j]) * ratio(1, k));
        power = [bottom.map(|value| value * ratio(1, k)), next];
        for (target, row) in sum.iter_mut().zip(&power) {
            for (target, value) in target.iter_mut().zip(row) {
                *target += value;
            }
        }
    }
    sum
}

fn fractions() -> impl Strategy<Value = (Rational, Rational)> {
    (-60i64..20, -60i64..20).prop_map(|(f, g)| (ratio(f, 13), ratio(g, 13)))
}

proptest! {
    #[test]
    fn runge_kutta_methods_are_exponential_series((f, g) in fractions()) {
        for (integrator, order) in [
            (Integrator::ForwardEuler, 1),
            (Integrator::Rk2Midpoint, 2),
            (Integrator::Rk2Heun, 2),
            (Integrator::Rk3Ssp, 3),
            (Integrator::Rk4, 4),
        ] {
            prop_assert_eq!(integrator.matrix(&f, &g), exponential_series(order, &f, &g));
        }
    }

    #[test]
    fn every_step_is_consistent_to_its_order((f, g) in fractions()) {
        // Along f = F h², g = G h the matrix on (X, V h) must agree with the exponential series through
        // its order: h a polynomial variable.
        let h = |power: usize, value: &Rational| Polynomial::monomial(value.clone(), power);
        for integrator in Integrator::ALL {
            let [[a, b], [c, d]] = integrator.matrix(&h(2, &f), &h(1, &g));
            let half = ratio(1, 2);
            prop_assert_eq!(a.coefficient(0), integer(1));
            prop_assert_eq!(b.coefficient(0), integer(1));
            prop_assert_eq!(c.coefficient(2), f.clone());
            prop_assert_eq!([d.coefficient(0), d.coefficient(1)], [integer(1), g.clone()]);
            let first_order = [
                Integrator::ForwardEuler,
                Integrator::SymplecticEuler,
                Integrator::CentredEuler,
                Integrator::LeapfrogKdk,
            ];
            if !first_order.contains(&integrator) {
                // X: f/2 at h², coupling g/2 at h·h; V: (f + g²)/2 at h², fg/2 at h³.
                prop_assert_eq!(a.coefficient(2), &f * &half);
                prop_assert_eq!(b.coefficient(1), &g * &half);
                prop_assert_eq!(d.coefficient(2), (&f + &g * &g) * &half);
                prop_assert_eq!(c.coefficient(3), &f * &g * &half);
            }
        }
    }

    #[test]
    fn multipliers_solve_the_characteristic_equation(f in -8.0f64..2.0, g in -4.0f64..1.0) {
        for integrator in Integrator::ALL {
            let [[a, b], [c, d]] = integrator.matrix(&f, &g);
            let found = integrator.multipliers(f, g);
            let size = 1.0 + a.abs() + d.abs() + (b * c).abs();
            prop_assert!((found.forward + found.backward - (a + d)).norm() < 1e-12 * size);
            prop_assert!((found.forward * found.backward - (a * d - b * c)).norm() < 1e-12 * size * size);
            let largest = found.forward.norm().max(found.backward.norm());
            prop_assert!((found.growth - (largest - 1.0)).abs() < 1e-7 * size);
            prop_assert!(found.forward.im <= 0.0);
            let complex = integrator.complex_multipliers(f, g.into(), found.forward);
            prop_assert!((complex.forward - found.forward).norm() < 1e-6 * size);
            prop_assert!((complex.backward - found.backward).norm() < 1e-6 * size);
        }
    }

    #[test]
    fn the_conditions_hold_exactly_when_no_multiplier_exceeds_the_budget(
        f in -400i64..40, g in -250i64..40, budget in 0i64..3
    ) {
        let (f, g, budget) = (ratio(f, 60), ratio(g, 60), ratio(budget, 10));
        for integrator in Integrator::ALL {
            let conditions = integrator.polynomials().conditions(&budget);
            let values = conditions.map(|c| to_f64(&c.evaluate(&f, &g, Rational::clone)));
            let found = integrator.multipliers(to_f64(&f), to_f64(&g));
            let excess = found.growth - to_f64(&budget);
            // Right at the boundary floats cannot tell.
            if excess.abs() > 1e-9 {
                prop_assert_eq!(values.iter().all(|&v| v >= 0.0), excess < 0.0, "{} {:?}", integrator, values);
            }
        }
    }
}

#[test]
fn which_integrators_conserve_the_phase_area() {
    // det A = 1 without friction: neutral instead of growing or damped.
    for integrator in Integrator::ALL {
        let undamped = integrator.polynomials().loss().terms().all(|(_, j, _)| j > 0);
        let expected = matches!(
            integrator,
            Integrator::SymplecticEuler
                | Integrator::LeapfrogKdk
                | Integrator::LeapfrogKdkPredicted
                | Integrator::PredictorCorrector
        );
        assert_eq!(undamped, expected, "{integrator}");
    }
}

#[test]
fn undamped_losses_are_the_textbook_powers() {
    // 1 − |z|² in powers of f = −(ωΔt)²: Euler f, centred f/2; RK2 −f²/4; RK3 −f²/12·…; RK4 −f³/72·….
    let loss = |integrator: Integrator| {
        let terms = integrator.polynomials().loss().terms();
        let terms: Vec<_> =
            terms.filter(|(_, j, _)| *j == 0).map(|(i, _, c)| (i, c.clone())).collect();
        terms
    };
    assert_eq!(loss(Integrator::ForwardEuler), [(1, ratio(1, 1))]);
    assert_eq!(loss(Integrator::CentredEuler), [(1, ratio(1, 2))]);
    assert_eq!(loss(Integrator::Rk2Heun), [(2, ratio(-1, 4))]);
    assert_eq!(loss(Integrator::Rk3Ssp), [(2, ratio(1, 12)), (3, ratio(1, 36))]);
    assert_eq!(loss(Integrator::Rk4), [(3, ratio(-1, 72)), (4, ratio(-1, 576))]);
}

#[test]
fn a_kept_acceleration_makes_the_leapfrog_symplectic_euler() {
    // KDK with the acceleration of the last step kept and the viscous force from the half-step
    // velocity: iterate both and compare positions, which obey the same two-term recurrence.
    let (f, g) = (ratio(-7, 10), ratio(-3, 10));
    let (mut x, mut half_velocity) = (integer(1), ratio(1, 3));
    let mut acceleration = &f * &x + &g * &half_velocity;
    let mut velocity = &half_velocity + &acceleration * ratio(1, 2);
    let mut state = [x.clone(), half_velocity.clone()];
    for _ in 0..5 {
        half_velocity = &velocity + &acceleration * ratio(1, 2);
        x += &half_velocity;
        acceleration = &f * &x + &g * &half_velocity;
        velocity = &half_velocity + &acceleration * ratio(1, 2);
        state = Integrator::SymplecticEuler.step(&state, &f, &g);
        assert_eq!(state[0], x);
    }
}

#[test]
fn tiny_steps_lose_no_digits() {
    // RK2 without friction at ωΔt = 1e-3: |z| − 1 = (ωΔt)⁴/8, far below the rounding of |z| itself.
    let found = Integrator::Rk2Midpoint.multipliers(-1e-6, 0.0);
    assert!((found.growth / 1.25e-13 - 1.0).abs() < 1e-6);
    assert_eq!(found.kind, PairKind::Oscillating);
    // Growth 1e-9 per step is not damped away by rounding either.
    let friction = Integrator::ForwardEuler.multipliers(-1e-12, -1e-9);
    assert!(friction.growth < 0.0);
}

#[test]
fn double_multipliers_are_recognised() {
    let free = Integrator::Rk4.multipliers(0.0, 0.0);
    assert_eq!(free.kind, PairKind::Double { defective: true });
    assert!(free.is_double_on_circle());
    let critical = Integrator::SymplecticEuler.multipliers(-4.0, 0.0);
    assert!(critical.is_double_on_circle() && critical.forward == Complex64::from(-1.0));
    assert!(!Integrator::SymplecticEuler.multipliers(-3.9, 0.0).is_double_on_circle());
}

#[test]
fn which_integrators_have_the_same_multipliers() {
    // Equal trace and determinant as polynomials. The two second-order Runge–Kutta methods are the same
    // for linear waves; so are, less obviously, the predictor–corrector and the leapfrog with predicted
    // velocity.
    let same = |a: Integrator, b: Integrator| {
        let (a, b) = (a.polynomials(), b.polynomials());
        a.excess_trace() == b.excess_trace() && a.loss() == b.loss()
    };
    for (i, a) in Integrator::ALL.into_iter().enumerate() {
        for b in Integrator::ALL.into_iter().skip(i + 1) {
            let expected = matches!(
                (a, b),
                (Integrator::Rk2Midpoint, Integrator::Rk2Heun)
                    | (Integrator::LeapfrogKdkPredicted, Integrator::PredictorCorrector)
            );
            assert_eq!(same(a, b), expected, "{a} {b}");
        }
    }
}
