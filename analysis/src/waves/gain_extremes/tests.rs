use super::*;
use crate::exact::float::Float;
use crate::exact::rational::{Rational, from_f64, integer, ratio, to_f64};
use crate::exact::stencil::Stencil;
use crate::kernel::Kernel;
use crate::scheme::testing::{SPH, sph, step_of};
use crate::waves::precise::PreciseStep;
use crate::waves::wave_terms::{difference_terms, primitive_characteristic};
use num_traits::{One, Zero};
use proptest::prelude::*;
use std::f64::consts::PI;

/// Bits of 50 digits.
const BITS: u32 = 167;

fn random_step() -> impl Strategy<Value = Step> {
    let stencil = prop::collection::vec(-20i64..21, 1..7);
    let stencils = prop::collection::vec((stencil, -3i64..1), 1..4).prop_map(|stencils| {
        let values = |values: Vec<i64>| values.into_iter().map(|v| ratio(v, 16)).collect();
        let stencils = stencils.into_iter().map(|(v, lowest)| Stencil::new(lowest, values(v)));
        stencils.collect::<Vec<_>>()
    });
    let has_terms = |stencils: &Vec<Stencil<Rational>>| {
        stencils.iter().any(|stencil| stencil.terms().any(|(_, value)| !value.is_zero()))
    };
    // Without a term nothing of level n is left, which the language refuses.
    stencils.prop_filter("has terms", has_terms).prop_map(|stencils| step_of(&stencils))
}

/// Dense samples of `|g|` and golden sections about the best of them, for both extremes.
fn brute_force(step: &Step, courant_number: f64, samples: usize) -> (f64, f64) {
    let value = from_f64(courant_number).unwrap();
    let gain = step.one_step("C").unwrap().stencil_at(&value).map(to_f64);
    let best = |sign: f64| {
        let f = |phase: f64| sign * gain.at_phase(phase).norm();
        let spacing = PI / samples as f64;
        let best =
            (0..=samples).max_by(|&i, &j| f(i as f64 * spacing).total_cmp(&f(j as f64 * spacing)));
        let middle = best.unwrap_or(0) as f64 * spacing;
        let (mut lower, mut upper) = (middle - spacing, middle + spacing);
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        while upper - lower > 1e-13 {
            let left = upper - golden * (upper - lower);
            let right = lower + golden * (upper - lower);
            if f(left) < f(right) { lower = left } else { upper = right }
        }
        sign * f(middle).max(f(lower.midpoint(upper)))
    };
    (best(1.0), best(-1.0))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn kernels_agree_with_brute_force_to_1e_10(
        numerator in 5i64..60, courant_number in 0.01f64..8.0, scheme in 0usize..3
    ) {
        for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
            let step = sph(SPH[scheme], kernel, &ratio(numerator, 10));
            let found = step.gain_extremes("C", &[courant_number]).unwrap();
            let (high, low) = brute_force(&step, courant_number, 4000);
            let scale = 1e-10 * high.max(1.0);
            prop_assert!((1.0 + found.growth[0] - high).abs() < scale, "{found:?} {high}");
            prop_assert!((found.lowest_gain[0] - low).abs() < scale, "{found:?} {low}");
        }
    }

    #[test]
    fn random_schemes_agree_with_brute_force_to_1e_10(step in random_step(), courant_number in -3.0f64..3.0) {
        let found = step.gain_extremes("C", &[courant_number]).unwrap();
        let (high, low) = brute_force(&step, courant_number, 2000);
        let scale = 1e-10 * high.max(1.0);
        prop_assert!((1.0 + found.growth[0] - high).abs() < scale, "{found:?} {high}");
        prop_assert!((found.lowest_gain[0] - low).abs() < scale, "{found:?} {low}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// No wave in 50 digits is beyond the extremes, and those at their phases are the extremes.
    #[test]
    fn random_schemes_agree_with_fifty_digits(step in random_step(), numerator in -40i64..41) {
        let value = ratio(numerator, 16);
        let found = step.gain_extremes("C", &[to_f64(&value)]).unwrap();
        let (high, low) = (1.0 + found.growth[0], found.lowest_gain[0]);
        let at_value = step.with("C", &value).unwrap();
        let terms = difference_terms(&primitive_characteristic(&at_value).unwrap());
        let precise = PreciseStep::new(&at_value, &terms, BITS);
        let gain = |s: f64| {
            let place = precise.place(&Rational::zero(), &Rational::one(), s);
            precise.largest(&place).map_or(0.0, |(excess, _)| {
                (&Float::integer(&1.into(), BITS) + &excess).sqrt().to_f64()
            })
        };
        let scale = 1e-10 * high.max(1.0);
        for index in 0..=200 {
            let sampled = gain((PI * f64::from(index) / 400.0).sin().powi(2));
            prop_assert!(sampled <= high + scale && sampled >= low - scale);
        }
        for (phase, value) in [(found.growth_phase[0], high), (found.lowest_gain_phase[0], low)] {
            // Near π the phase has fewer digits of 1 − s than the gain needs.
            let s = (0.5 * phase).sin().powi(2).min(1.0);
            prop_assert!((gain(s) - value).abs() < 10.0 * scale, "{phase} {value} {}", gain(s));
        }
    }
}

#[test]
fn a_minimum_close_to_the_longest_wave_is_found() {
    // Lax–Wendroff SPH, Gaussian, ratio 1: |g| is smallest at a very small phase.
    let step = sph("lax-wendroff-sph", Kernel::Gaussian, &integer(1));
    for courant_number in [2.917_108_763_299_729_5, 2.965_494_334_501_877_4] {
        let found = step.gain_extremes("C", &[courant_number]).unwrap();
        let (_, low) = brute_force(&step, courant_number, 4000);
        assert!((found.lowest_gain[0] - low).abs() < 1e-10, "{found:?} {low}");
    }
}

#[test]
fn a_row_takes_some_hundred_phases_and_two_cells_for_each_value() {
    let step = sph("godunov-sph", Kernel::CubicSpline, &integer(10));
    let values: Vec<f64> = (0..401).map(|i| 0.03 * f64::from(i)).collect();
    let (_, work) = of_compiled(&step.compile().unwrap(), &values);
    // |g|² is of degree 19: 20 waves to know it, four cells for each half-wave.
    assert!(work.phases <= 39 + 77, "{work:?}");
    // 1143 cells for 802 extremes, one in ten of them halved.
    assert!(work.cells <= 3 * 401 && work.halved <= 150, "{work:?}");
    assert!(work.newton_steps <= 4 * work.cells.div_ceil(8), "{work:?}");
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let step = Step::from_text("u[n+1,j] = u[n,j] - C*r*(u[n,j] - u[n,j-1])").unwrap();
    assert!(
        matches!(step.gain_extremes("C", &[1.0]), Err(SchemeError::NotSet(open)) if open == ["r"])
    );
    assert!(matches!(step.gain_extremes("D", &[1.0]), Err(SchemeError::UnknownParameter { .. })));
}
