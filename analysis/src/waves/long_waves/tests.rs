use super::*;
use crate::exact::rational::ratio;
use crate::kernel::Kernel;
use crate::scheme::{KernelLattice, catalogue};
use proptest::prelude::*;

fn series(text: &str, exact: Option<&str>, order: usize) -> Result<LongWaves, NoSeries> {
    Step::from_text(text).unwrap().long_waves(exact, order)
}

fn coefficients(text: &str, exact: Option<&str>, order: usize) -> Vec<String> {
    let series = series(text, exact, order).unwrap();
    (1..=order).map(|power| series.coefficient_text(power)).collect()
}

#[test]
fn modified_equations_of_the_literature() {
    let advection = Some("-I*C*phi");
    // Warming & Hyett 1974.
    let upwind = coefficients("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])", advection, 4);
    assert_eq!(upwind[..3], ["-C", "C (1 - C)/2", "-C (1 - C) (1 - 2 C)/6"]);
    assert_eq!(upwind[3], "C (1 - C) (1 - 6 C + 6 C^2)/24");
    let leapfrog = coefficients("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])", advection, 5);
    assert_eq!(leapfrog[1..4], ["0", "-C (1 - C) (1 + C)/6", "0"]);
    // arsinh(C sinh x) to the fifth power.
    assert_eq!(leapfrog[4], "-C (1 - C) (1 - 3 C) (1 + C) (1 + 3 C)/120");
    let implicit = "u[n+1,j] + C/4*(u[n+1,j+1] - u[n+1,j-1]) = u[n,j] - C/4*(u[n,j+1] - u[n,j-1])";
    assert_eq!(coefficients(implicit, advection, 4)[1..], ["0", "-C (2 + C^2)/12", "0"]);
    let heat = "u[n+1,j] = u[n,j] + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    let heat = coefficients(heat, Some("-r*phi^2"), 6);
    assert_eq!(heat[1..], ["r", "0", "r (1 - 6 r)/12", "0", "r (1 - 30 r + 120 r^2)/360"]);
}

#[test]
fn waves_begin_with_a_square_root() {
    let wave =
        |r: &str| format!("u[n+1,j] = 2*u[n,j] - u[n-1,j] + {r}*(u[n,j+1] - 2*u[n,j] + u[n,j-1])");
    let stated = coefficients(&wave("C^2"), Some("±I*C*phi"), 3);
    assert_eq!(stated, ["-C", "0", "-C (1 - C) (1 + C)/24"]);
    // What nobody states follows from χ: λ² = C² x², and λ² = r x².
    assert_eq!(coefficients(&wave("C^2"), None, 3), stated);
    let root = coefficients(&wave("r"), None, 3);
    assert_eq!(root, ["-sqrt(r)", "0", "-sqrt(r) (1 - r)/24"]);
    // Δt and Δx exchanged: exact at C = 1.
    let one = Step::from_text(&wave("C^2")).unwrap().with("C", &ratio(1, 1)).unwrap();
    let exact = one.long_waves(Some("±I*C*phi"), 9).unwrap();
    assert!((2..=9).all(|power| exact.error(power).is_zero()));
    // i λ for a vibrating beam.
    let beam = "u[n+1,j] = 2*u[n,j] - u[n-1,j] - r^2*(u[n,j+2] - 4*u[n,j+1] + 6*u[n,j] - 4*u[n,j-1] + u[n,j-2])";
    assert_eq!(coefficients(beam, Some("±I*r*phi^2"), 4), ["0", "i r", "0", "i r/12"]);
}

#[test]
fn why_there_is_no_series() {
    let none = |text: &str, exact: Option<&str>| series(text, exact, 4).unwrap_err();
    let drifts = none("u[n+1,j] = 2*u[n,j] - C*(u[n,j] - u[n,j-1])", None);
    assert_eq!(drifts, NoSeries::Drift);
    let two = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]); v[n+1,j] = v[n,j] + r*(v[n,j+1] - 2*v[n,j] + v[n,j-1])";
    assert_eq!(none(two, None), NoSeries::Several);
    assert!(series(two, Some("-I*C*phi"), 4).unwrap().error(2) != RationalFunction::zero());
    assert_eq!(series(two, Some("-r*phi^2"), 4).unwrap().coefficient_text(4), "r (1 - 6 r)/12");
    // Two of a kind are one.
    let twins = two
        .replace("r*(v[n,j+1] - 2*v[n,j] + v[n,j-1])", "-C*(v[n,j] - v[n,j-1])")
        .replace("+ -C", "- C");
    assert_eq!(series(&twins, Some("-I*C*phi"), 3).unwrap().coefficient_text(2), "C (1 - C)/2");
    assert!(matches!(
        none("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])", Some("-I*a*phi")),
        NoSeries::Exact(..)
    ));
    assert!(matches!(
        none("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])", Some("-I*C*")),
        NoSeries::Exact(..)
    ));
}

#[test]
fn kernel_sums_are_expanded_or_said_to_be_uncertain() {
    let lattice = |kernel| KernelLattice::new(kernel, &ratio(3, 1)).unwrap();
    let godunov = catalogue::scheme("godunov-sph").unwrap();
    let of = |kernel| {
        let step = godunov.step(Some(&lattice(kernel)), None, &[], Some("C")).unwrap();
        (step.one_step("C").unwrap(), step.long_waves(Some("-I*C*phi"), 6).unwrap())
    };
    let (one, exact) = of(Kernel::CubicSpline);
    assert!(exact.is_exact() && exact.speed_ratio() == Some(ratio(1, 1)));
    let at = |phase: f64| (one.gain(0.5, phase).ln() - exact.evaluate(&[("C", 0.5)], phase)).norm();
    assert!(at(0.01) < 1e-13 && at(0.1) < 1e-4);
    let (_, gaussian) = of(Kernel::Gaussian);
    assert!(!gaussian.is_exact() && gaussian.speed_ratio() != Some(ratio(1, 1)));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Schemes of two levels: `log g` is a cumulant series, whose coefficients follow from the moments of the stencil.
    #[test]
    fn one_step_series_are_cumulants(values in prop::collection::vec(-9i64..10, 2..6)) {
        let sum: i64 = values.iter().sum();
        let terms = (-1..).zip(&values).map(|(k, value)| format!("({value} + C)*(u[n,j+({k})] - u[n,j])"));
        let text = format!("u[n+1,j] = u[n,j] + {}", terms.collect::<Vec<_>>().join(" + "));
        let step = Step::from_text(&text).unwrap().with("C", &ratio(2, 7)).unwrap();
        prop_assume!(sum != 0);
        let Ok(found) = step.long_waves(None, 6) else { return Ok(()) };
        let weights: Vec<Rational> =
            values.iter().map(|value| ratio(*value, 1) + ratio(2, 7)).collect();
        let moment = |m: u32| -> Rational {
            (-1i64..).zip(&weights).map(|(k, w)| w * ratio(k.pow(m), 1)).sum()
        };
        // κ_m = μ_m − Σ_j C(m−1, j−1) κ_j μ_{m−j}.
        let mut cumulants = vec![Rational::zero()];
        let mut factorial = ratio(1, 1);
        for m in 1..=6u32 {
            let mut cumulant = moment(m);
            let mut binomial = 1i64;
            for j in 1..m {
                cumulant -= ratio(binomial, 1) * &cumulants[j as usize] * moment(m - j);
                binomial = binomial * i64::from(m - j) / i64::from(j);
            }
            factorial *= ratio(i64::from(m), 1);
            let expected = &cumulant / &factorial;
            prop_assert_eq!(found.coefficients[m as usize].as_number(), Some(expected));
            cumulants.push(cumulant);
        }
    }

    /// Schemes of three levels against their multipliers.
    #[test]
    fn several_levels_agree_with_their_multipliers(a in 1i64..9, b in 1i64..9, c in 0.1f64..0.9) {
        let text = format!(
            "u[n+1,j] = u[n,j] + {a}/20*(u[n,j] - u[n-1,j]) - C*(u[n,j] - u[n,j-1]) - {b}/10*C*(u[n-1,j] - u[n-1,j-1])"
        );
        let step = Step::from_text(&text).unwrap();
        let series = step.long_waves(None, 10).unwrap();
        let phase = 0.005;
        let lambda = series.evaluate(&[("C", c)], phase);
        let multipliers = step.compile().unwrap().multipliers(&[c], &[phase]);
        let distance = multipliers.iter().map(|z| (z.ln() - lambda).norm()).fold(f64::MAX, f64::min);
        prop_assert!(distance < 1e-13, "{} {}", distance, lambda);
    }
}
