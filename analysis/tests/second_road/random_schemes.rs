//! Stable sets of random schemes, explicit and implicit, of several levels and unknowns, against Sturm's theorem at single
//! values and against the multipliers themselves on many waves.

use courant_analysis::exact::rational::{integer, ratio, to_f64};
use courant_analysis::scheme::Step;
use courant_analysis::stability::{PointVerdict, SearchPlan, StableSet, decide_step_at};
use num_complex::Complex64;
use proptest::prelude::*;

/// `a C + b` with small coefficients, in the language of schemes.
fn coefficient() -> impl Strategy<Value = String> {
    (-4i64..5, -4i64..5).prop_map(|(a, b)| format!("({a}*C/4 + {b}/4)"))
}

fn scheme() -> impl Strategy<Value = String> {
    let values = prop::collection::vec(coefficient(), 8);
    (values, 0usize..4).prop_map(|(c, form)| match form {
        0 => format!("u[n+1,j] = {}*u[n,j-1] + {}*u[n,j] + {}*u[n,j+1]", c[0], c[1], c[2]),
        1 => format!(
            "u[n+1,j] = {}*u[n,j-1] + {}*u[n,j+1] + {}*u[n-1,j] + {}*u[n-1,j+1]",
            c[0], c[1], c[2], c[3]
        ),
        2 => format!(
            "2*u[n+1,j] + {}*(u[n+1,j+1] - u[n+1,j]) = u[n,j] + {}*u[n,j-1] + {}*u[n,j]",
            c[0], c[1], c[2]
        ),
        _ => format!(
            "u[n+1,j] = {}*u[n,j] + {}*v[n,j-1]; v[n+1,j] = {}*v[n,j] + {}*u[n+1,j+1]",
            c[0], c[1], c[2], c[3]
        ),
    })
}

/// The largest multiplier over many waves, from the coefficients of the characteristic polynomial by Durand and Kerner's iteration.
fn largest_multiplier(step: &Step) -> f64 {
    use courant_analysis::exact::laurent::Variable;
    let chi = step.characteristic().unwrap();
    let coefficients = chi.coefficients(Variable::TIME);
    let mut largest: f64 = 0.0;
    for k in 0..=240 {
        let e = Complex64::from_polar(1.0, std::f64::consts::PI * f64::from(k) / 240.0);
        let values: Vec<Complex64> = coefficients
            .iter()
            .map(|c| {
                c.terms()
                    .iter()
                    .map(|(x, v)| e.powi(x[1].into()) * v.to_string().parse::<f64>().unwrap())
                    .sum()
            })
            .collect();
        let degree = values.len() - 1;
        let lead = values[degree];
        let value =
            |z: Complex64| values.iter().rev().fold(Complex64::ZERO, |s, c| s * z + c / lead);
        let mut z: Vec<Complex64> =
            (0..degree as i32).map(|i| Complex64::new(0.4, 0.9).powi(i)).collect();
        for _ in 0..200 {
            for i in 0..degree {
                let others: Complex64 =
                    (0..degree).filter(|&j| j != i).map(|j| z[i] - z[j]).product();
                let step = value(z[i]) / others;
                z[i] -= step;
            }
        }
        largest = z.iter().map(|z| z.norm()).filter(|r| r.is_finite()).fold(largest, f64::max);
    }
    largest
}

fn inside(set: &StableSet, value: f64) -> Option<bool> {
    let near = |end: f64| (value - end).abs() < 1e-9 * (1.0 + value);
    let ends = set.intervals.iter().flat_map(|i| [i.from.lower(), i.to.upper()]);
    if ends.into_iter().any(near) || set.undecided.iter().any(|&(a, b)| a <= value && value <= b) {
        return None;
    }
    Some(set.intervals.iter().any(|i| {
        i.from.upper() < value
            && value < i.to.lower().max(if i.to.is_unbounded() { f64::INFINITY } else { 0.0 })
    }))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn three_roads_agree(text in scheme()) {
        let step = Step::from_text(&text).unwrap();
        prop_assume!(step.characteristic().is_ok() && step.free_parameters() == ["C"]);
        let plan = SearchPlan::default().up_to(integer(8));
        let set = step.stable_set("C", &plan).unwrap();
        for k in 1..24 {
            let value = ratio(k, 3);
            let at = step.with("C", &value).unwrap();
            if at.characteristic().is_err() {
                continue;
            }
            let Some(claimed) = inside(&set, to_f64(&value)) else { continue };
            let decided = decide_step_at(&at, &integer(0)).unwrap();
            let largest = largest_multiplier(&at);
            if claimed {
                prop_assert_eq!(&decided, &PointVerdict::Stable, "{} at {}: {:?}", text, value, set);
                // Double roots on the circle are known to half the digits.
                prop_assert!(largest < 1.0 + 1e-5, "{text} at {value}: {largest}, {set:?}");
            } else {
                // Single stable values between unstable ones are no interval.
                if decided == PointVerdict::Stable {
                    prop_assert!(largest < 1.0 + 1e-5, "{text} at {value}: {largest}");
                    let beside = step.with("C", &(&value + ratio(1, 1_000_000))).unwrap();
                    prop_assert!(decide_step_at(&beside, &integer(0)).unwrap() != PointVerdict::Stable, "{text} at {value}: {set:?}");
                }
            }
        }
    }
}
