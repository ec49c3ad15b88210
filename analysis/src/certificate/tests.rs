use super::*;
use crate::exact::rational::{Rational, integer, ratio};
use crate::exact::stencil::Stencil;
use crate::kernel::Kernel;
use crate::scheme::symbol::{EnclosedSymbol, Symbol};
use crate::scheme::{AdvectionScheme, Discretisation, Scheme};
use serde_json::Value;

fn scheme(scheme: AdvectionScheme, kernel: Kernel, l: Rational) -> Discretisation {
    Discretisation::new(scheme, kernel, l).unwrap()
}

fn stability(of: &Discretisation, growth: &Rational) -> Vec<Certificate> {
    certify_stability(&of.symbol(), Some(of), growth, &integer(30)).unwrap()
}

fn monotonicity(of: &Discretisation) -> Certificate {
    certify_monotonicity(&of.symbol(), Some(of), &integer(30)).unwrap()
}

use AdvectionScheme::{EulerSph, GodunovSph, LaxWendroffSph};

#[test]
fn every_limit_of_table_1_is_certified() {
    for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
        for l in [1, 2, 3, 4, 5, 10] {
            let scheme = scheme(GodunovSph, kernel, integer(l));
            let mut all = stability(&scheme, &integer(0));
            assert_eq!(all.len(), 1);
            all.push(monotonicity(&scheme));
            for certificate in all {
                let verified = verify(&certificate).unwrap_or_else(|error| {
                    panic!("{kernel} {l}: {error}");
                });
                assert!(verified.boxes > 0);
            }
        }
    }
    let verified = verify(&monotonicity(&scheme(GodunovSph, Kernel::CubicSpline, integer(2))));
    assert_eq!(
        verified.unwrap().statement,
        "godunov-sph with cubic-spline at ratio 2: no coefficient is negative up to C = 8/5 and not \
         just above"
    );
}

#[test]
fn every_kernel_and_scheme_is_derived_again_by_the_checker() {
    for kernel in Kernel::ALL {
        for of in AdvectionScheme::ALL {
            for l in [ratio(1, 4), ratio(3, 2), ratio(13, 10), integer(2)] {
                let scheme = scheme(of, kernel, l.clone());
                for certificate in stability(&scheme, &integer(0)) {
                    verify(&certificate)
                        .unwrap_or_else(|error| panic!("{of} {kernel} {l}: {error}"));
                }
                verify(&monotonicity(&scheme)).unwrap();
            }
        }
    }
}

#[test]
fn growth_budgets_are_certified() {
    for growth in ["1e-6", "1e-3"] {
        let growth = crate::exact::rational::parse(growth).unwrap();
        let scheme = scheme(LaxWendroffSph, Kernel::Gaussian, integer(3));
        for certificate in stability(&scheme, &growth) {
            verify(&certificate).unwrap();
        }
    }
}

/// Changes one place of a certificate at a time: every number up and down by one and to its negative,
/// every text and flag to another, every list shortened and every entry removed.
fn mutations(value: &Value) -> Vec<Value> {
    let mut all = Vec::new();
    match value {
        Value::Null => all.push(Value::from("1")),
        Value::Bool(flag) => all.push(Value::from(!flag)),
        Value::Number(number) => {
            let number = number.as_i64().unwrap();
            all.extend([Value::from(number + 1), Value::from(number - 1)]);
        }
        Value::String(text) => match Exact::read(text) {
            Some(Exact(number)) => {
                for other in [&number + integer(1), &number - integer(1), -number] {
                    all.push(serde_json::to_value(Exact(other)).unwrap());
                }
                all.push(Value::from("0/0"));
            }
            None => {
                all.push(Value::from(format!("{text}0")));
                all.push(Value::from(text.replacen('+', "-", 1).replacen('u', "w", 1)));
            }
        },
        Value::Array(entries) => {
            if !entries.is_empty() {
                all.push(Value::from(entries[..entries.len() - 1].to_vec()));
                all.push(Value::from([entries.as_slice(), &entries[..1]].concat()));
            }
            for (index, entry) in entries.iter().enumerate() {
                for mutation in mutations(entry) {
                    let mut changed = entries.clone();
                    changed[index] = mutation;
                    all.push(Value::from(changed));
                }
            }
        }
        Value::Object(entries) => {
            for (key, entry) in entries {
                let mut shortened = entries.clone();
                shortened.remove(key);
                // Only what may be absent has no value.
                if !entry.is_null() {
                    all.push(Value::from(shortened));
                }
                for mutation in mutations(entry) {
                    let mut changed = entries.clone();
                    changed.insert(key.clone(), mutation);
                    all.push(Value::from(changed));
                }
            }
        }
    }
    all.retain(|mutation| mutation != value);
    all
}

#[test]
fn a_certificate_with_any_field_changed_is_refused() {
    let mut originals = Vec::new();
    for (of, kernel, l) in [
        (GodunovSph, Kernel::CubicSpline, integer(2)),
        (LaxWendroffSph, Kernel::CubicSpline, integer(2)),
        (LaxWendroffSph, Kernel::CubicSpline, ratio(13, 10)),
        (EulerSph, Kernel::CubicSpline, integer(1)),
        (GodunovSph, Kernel::Gaussian, integer(1)),
    ] {
        let scheme = scheme(of, kernel, l);
        originals.extend(stability(&scheme, &integer(0)));
        originals.push(monotonicity(&scheme));
    }
    let mut count = 0;
    for original in originals {
        verify(&original).unwrap();
        let value = serde_json::to_value(&original).unwrap();
        for mutation in mutations(&value) {
            count += 1;
            let Ok(certificate) = serde_json::from_value::<Certificate>(mutation.clone()) else {
                continue;
            };
            assert!(
                verify(&certificate).is_err(),
                "accepted {}\ninstead of {}",
                serde_json::to_string_pretty(&mutation).unwrap(),
                serde_json::to_string_pretty(&value).unwrap()
            );
        }
    }
    assert!(count > 1000, "{count} mutations");
}

#[test]
fn every_interval_of_a_disconnected_set_has_its_certificate() {
    // Upwind with a distorted Courant number a(C) = C (C² − 6C + 19/2)/3: see the tests of the limits.
    let backward = Stencil::new(-1, vec![integer(-1), integer(1)]);
    let a = [ratio(19, 6), integer(-2), ratio(1, 3)];
    let symbol = a.into_iter().enumerate().fold(Symbol::identity(), |sum, (power, value)| {
        sum - Symbol::courant_power(power + 1, backward.clone() * Stencil::term(0, value))
    });
    let symbol = EnclosedSymbol::exact(symbol);
    let certificates = certify_stability(&symbol, None, &integer(0), &integer(10)).unwrap();
    assert_eq!(certificates.len(), 2);
    for certificate in &certificates {
        verify(certificate).unwrap();
    }
    let Proof::Stability(second) = &certificates[1].proof else { panic!("a stability proof") };
    assert!(second.below.is_some() && second.from.0 == integer(2));
}

#[test]
fn waves_neutral_at_every_courant_number_are_taken_out_and_certified() {
    // g = 1 − C s (1 − 2s)², so 1 − g² = s (s − 1/2)² C (8 − 16 C s (s − 1/2)²): stable while the last
    // bracket is not negative, that is up to C = 2.
    let s = Stencil::new(-1, vec![ratio(-1, 4), ratio(1, 2), ratio(-1, 4)]);
    let neutral = Stencil::term(0, integer(1)) - s.clone() * Stencil::term(0, integer(2));
    let damped = s * neutral.clone() * neutral;
    let symbol = EnclosedSymbol::exact(Symbol::identity() - Symbol::courant_power(1, damped));
    let certificates = certify_stability(&symbol, None, &integer(0), &integer(10)).unwrap();
    let Proof::Stability(proof) = &certificates[0].proof else { panic!("a stability proof") };
    assert_eq!(proof.margin.neutral_waves, [ratio(-1, 2).into(), integer(1).into()]);
    let statement = verify(&certificates[0]).unwrap().statement;
    assert!(statement.ends_with("up to C = 2 and not just above"), "{statement}");
}

#[test]
fn a_fraction_that_an_interior_wave_sets_is_certified_as_an_enclosure() {
    // g = 1 − C (2 − (2s² − 1)²): damped until C = 1, where the wave s = √(1/2) has g = −1.
    let s = Stencil::new(-1, vec![ratio(-1, 4), ratio(1, 2), ratio(-1, 4)]);
    let square = s.clone() * s;
    let fourth = square.clone() * square.clone();
    let times = |value: i64| Stencil::term(0, integer(value));
    let damping = times(1) + square * times(4) + fourth * times(-4);
    let symbol = EnclosedSymbol::exact(Symbol::identity() - Symbol::courant_power(1, damping));
    let limit = crate::stability::stability_limit(&symbol, &integer(9));
    assert_eq!(limit.exact().unwrap().to_string(), "1");
    assert_eq!(limit.cause(), Some(crate::stability::Cause::Interior));
    let certificates = certify_stability(&symbol, None, &integer(0), &integer(9)).unwrap();
    verify(&certificates[0]).unwrap();
    let Proof::Stability(proof) = &certificates[0].proof else { panic!("a limit of stability") };
    let (lower, upper) = (&proof.limit.lower, proof.limit.upper.as_ref().unwrap());
    assert!(lower.0 < integer(1) && integer(1) < upper.0 && proof.limit.courant_number.is_none());
}

#[test]
fn a_wrong_limit_cannot_be_certified() {
    // The published 1.90 instead of 15/8, with boxes that look the part.
    let scheme = scheme(GodunovSph, Kernel::CubicSpline, integer(2));
    let mut certificate = stability(&scheme, &integer(0)).remove(0);
    let Proof::Stability(proof) = &mut certificate.proof else { panic!("a stability proof") };
    proof.limit = CertifiedLimit {
        lower: ratio(19, 10).into(),
        upper: Some(ratio(19, 10).into()),
        courant_number: Some("19/10".into()),
    };
    proof.pieces[0].to = ratio(19, 10).into();
    let claim = proof.unstable.as_mut().unwrap();
    claim.witness.courant_number = Exact(ratio(19, 10) * ratio((1 << 20) + 1, 1 << 20));
    let error = verify(&certificate).unwrap_err();
    assert!(error.0.contains("signs"), "{error}");
}

#[test]
fn a_scheme_without_a_name_is_given_by_its_coefficients() {
    let backward = Stencil::new(-1, vec![integer(-1), integer(1)]);
    let upwind = EnclosedSymbol::exact(Symbol::identity() - Symbol::courant_power(1, backward));
    let certificates = certify_stability(&upwind, None, &integer(0), &integer(30)).unwrap();
    let statement = verify(&certificates[0]).unwrap().statement;
    assert!(statement.ends_with("up to C = 1 and not just above"), "{statement}");
    let wide = certify_stability(&upwind, None, &integer(0), &ratio(1, 2)).unwrap();
    assert!(verify(&wide[0]).unwrap().statement.ends_with("at least up to C = 1/2"));
}
