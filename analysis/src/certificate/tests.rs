use super::*;
use crate::exact::rational::{Rational, integer, ratio};
use crate::kernel::Kernel;
use crate::scheme::{Integrator, KernelLattice, Step, catalogue};
use crate::stability::SearchPlan;
use serde_json::Value;

mod several_dimensions;

/// Stability and, where the question is asked, monotonicity.
fn certificates(
    file: &catalogue::SchemeFile,
    kernel: Option<(Kernel, Rational)>,
    integrator: Option<&str>,
    plan: &SearchPlan,
) -> Vec<Certificate> {
    let lattice = kernel.map(|(kernel, ratio)| KernelLattice::new(kernel, &ratio).unwrap());
    let integrator = integrator.map(|name| Integrator::for_particles(name).unwrap());
    let parameter = file.parameter.as_deref().unwrap();
    let step = file.step(lattice.as_ref(), integrator, &[], Some(parameter)).unwrap();
    let text = &file.equations.text;
    let subject = Subject::new(text, lattice.as_ref(), integrator, &step, parameter).unwrap();
    let mut all = certify(&subject, &step, plan)
        .unwrap_or_else(|error| panic!("{}, {:?}: {error}", file.name, subject.integrator));
    if let Some(set) = step.monotone_set(parameter, plan).unwrap() {
        all.extend(certify_monotonicity(&subject, &set, &plan.max).unwrap());
    }
    all
}

fn statements(certificates: &[Certificate]) -> Vec<String> {
    let statement = |one: &Certificate| {
        let verified =
            verify(one).unwrap_or_else(|error| panic!("{}: {error}", one.subject.name()));
        verified.statement.rsplit_once(": ").unwrap().1.to_owned()
    };
    certificates.iter().map(statement).collect()
}

fn of_text(text: &str, parameter: &str) -> Vec<Certificate> {
    let step = Step::from_text(text).unwrap();
    let subject = Subject::new(text, None, None, &step, parameter).unwrap();
    certify(&subject, &step, &SearchPlan::default()).unwrap()
}

fn line(certificate: &Certificate) -> LineProof {
    match &certificate.proof {
        Proof::Line(line) => line.clone(),
        Proof::Torus(_) => panic!("several phases"),
    }
}

#[test]
fn every_limit_of_table_1_is_certified() {
    let godunov = catalogue::scheme("godunov-sph").unwrap();
    let plan = SearchPlan::default().up_to(integer(50));
    for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
        for l in [1, 2, 3, 4, 5, 10] {
            let all = certificates(godunov, Some((kernel, integer(l))), None, &plan);
            let found = statements(&all);
            assert_eq!(found.len(), 2, "{found:?}");
            if (kernel, l) == (Kernel::CubicSpline, 2) {
                let stable = "|z| <= 1 + 0 for all waves up to C = 15/8 and not just above";
                let monotone = "no coefficient is negative up to C = 8/5 and not just above";
                assert_eq!(found, [stable, monotone]);
            }
        }
    }
}

#[test]
fn every_scheme_of_the_catalogue_is_certified() {
    let plan = SearchPlan::default();
    for scheme in catalogue::schemes() {
        let kernels = match scheme.needs_kernel() {
            false => vec![None],
            true => Kernel::ALL.into_iter().map(|kernel| Some((kernel, ratio(3, 2)))).collect(),
        };
        for kernel in kernels {
            assert!(!statements(&certificates(scheme, kernel, None, &plan)).is_empty());
        }
    }
}

#[test]
fn spaces_with_integrators_are_certified() {
    let plan = SearchPlan::default();
    let spaces =
        ["upwind-3", "central-4", "compact-4", "diffusion-2", "acoustics-staggered-2", "dg-1"];
    for space in spaces.map(|name| catalogue::space(name).unwrap()) {
        for integrator in ["rk3-ssp", "ab3", "bdf2", "sdirk2", "crank-nicolson"] {
            assert!(!statements(&certificates(space, None, Some(integrator), &plan)).is_empty());
        }
    }
}

#[test]
fn particle_methods_are_certified() {
    let plan = SearchPlan::default().up_to(integer(10));
    for method in catalogue::methods() {
        for integrator in
            ["leapfrog-kdk", "leapfrog-kdk-predicted", "rk2-heun", "predictor-corrector"]
        {
            for kernel in [(Kernel::CubicSpline, ratio(13, 10)), (Kernel::Gaussian, integer(2))] {
                let all = certificates(method, Some(kernel), Some(integrator), &plan);
                assert!(!statements(&all).is_empty());
            }
        }
    }
}

/// Of a scheme in several dimensions.
fn of_scheme(name: &str) -> Vec<Certificate> {
    let file = catalogue::scheme(name).unwrap();
    let parameter = file.parameter.as_deref().unwrap();
    let step = file.step(None, None, &[], Some(parameter)).unwrap();
    let subject = Subject::new(&file.equations.text, None, None, &step, parameter).unwrap();
    certify(&subject, &step, &SearchPlan::default()).unwrap()
}

#[test]
fn growth_budgets_are_certified() {
    let file = catalogue::scheme("lax-wendroff-sph").unwrap();
    for growth in [ratio(1, 1_000_000), ratio(1, 1000)] {
        let plan = SearchPlan::default().growing(growth);
        statements(&certificates(file, Some((Kernel::Gaussian, integer(3))), None, &plan));
    }
    let leapfrog = catalogue::scheme("leapfrog").unwrap();
    let plan = SearchPlan::default().growing(ratio(1, 10));
    let found = statements(&certificates(leapfrog, None, None, &plan));
    assert!(found[0].starts_with("|z| <= 1 + 1/10 for all waves up to C = "), "{found:?}");
}

#[test]
fn factors_on_the_circle_are_stated_and_multiplied_out() {
    // Leapfrog beside a damped unknown: χ = (z² + … − 1)(z − 1/2).
    let text = "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1]); v[n+1,j] = v[n,j]/2 + u[n,j]";
    let all = of_text(text, "C");
    let split = all[0].levels[0].split.as_ref().unwrap();
    assert_eq!(split.inside, "-1 + 2*z");
    assert_eq!(statements(&all), ["|z| <= 1 + 0 for all waves up to C = 1 and not just above"]);
    let mut wrong = all[0].clone();
    wrong.levels[0].split =
        Some(Split { inside: "1 - 2*z^2".into(), circle: split.circle.clone() });
    assert!(verify(&wrong).is_err());
}

#[test]
fn squares_and_weights_are_taken_out_and_stated() {
    // g = 1 − C s (1 − 2s)², so 1 − g² = s (s − 1/2)² C (8 − 16 C s (s − 1/2)²).
    let d = "(2*u[n,j] - u[n,j-1] - u[n,j+1])";
    let text = format!(
        "s[n,j] = {d}/4; m[n,j] = s[n,j] - 2*{}; w[n,j] = m[n,j] - 2*{}; u[n+1,j] = u[n,j] - C*w[n,j]",
        d.replace('u', "s") + "/4",
        d.replace('u', "m") + "/4"
    );
    let all = of_text(&text, "C");
    assert_eq!(line(&all[0]).inequalities[0].square, [[ratio(-1, 2).into(), integer(1).into()]]);
    assert_eq!(statements(&all), ["|z| <= 1 + 0 for all waves up to C = 2 and not just above"]);
}

#[test]
fn every_interval_of_a_disconnected_set_has_its_certificate() {
    let found = statements(&of_text("u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j]) = u[n,j]", "C"));
    let all = "|z| <= 1 + 0 for all waves";
    assert_eq!(
        found,
        [format!("{all} up to C = 0 and not just above"), format!("{all} from C = 1 without end")]
    );
}

#[test]
fn a_wrong_limit_cannot_be_certified() {
    // The published 1.90 instead of 15/8.
    let file = catalogue::scheme("godunov-sph").unwrap();
    let plan = SearchPlan::default();
    let mut wrong =
        certificates(file, Some((Kernel::CubicSpline, integer(2))), None, &plan).remove(0);
    let end = End::Fraction(ratio(19, 10));
    wrong.interval = Interval { lower: end.clone(), upper: Some(end.clone()), ..wrong.interval };
    let mut proof = line(&wrong);
    proof.covers[0].pieces[0].end = end;
    proof.above.as_mut().unwrap().wave.value = Exact(ratio(19, 10) * ratio((1 << 20) + 1, 1 << 20));
    wrong.proof = Proof::Line(proof);
    assert_eq!(verify(&wrong).unwrap_err().0, "a box is not decided");
}

/// Everything a certificate is read from.
fn judged(value: &Value) -> Result<Certificate, String> {
    let certificate: Certificate =
        serde_json::from_str(&value.to_string()).map_err(|error| error.to_string())?;
    // As files are read: lists do not do for records.
    let written = serde_json::to_value(&certificate).unwrap();
    if written != *value {
        return Err("it is not written in the one way there is".into());
    }
    verify(&certificate).map(|_| certificate).map_err(|error| error.0)
}

fn place<'v>(value: &'v mut Value, path: &[Value]) -> &'v mut Value {
    path.iter().fold(value, |value, key| match key.as_u64() {
        Some(index) => &mut value[index as usize],
        None => &mut value[key.as_str().unwrap()],
    })
}

#[test]
fn what_is_malformed_is_refused() {
    let file = catalogue::scheme("godunov-sph").unwrap();
    let kernel = Some((Kernel::CubicSpline, integer(2)));
    let line = certificates(file, kernel, None, &SearchPlan::default()).remove(0);
    let torus = of_scheme("donor-cell-2d").remove(0);
    let [line, torus] = [line, torus].map(|valid| serde_json::to_value(&valid).unwrap());
    judged(&line).unwrap();
    judged(&torus).unwrap();
    let changes: Vec<Value> = serde_json::from_str(include_str!("malformed.json")).unwrap();
    for change in changes {
        let path = change["path"].as_array().unwrap();
        let on_torus = path.get(1).is_some_and(|key| key == "torus");
        let mut changed = if on_torus { torus.clone() } else { line.clone() };
        *place(&mut changed, path) = match &change["repeated"] {
            // Parts of a long text, each with how often it stands there.
            Value::Array(parts) => parts
                .iter()
                .map(|part| part[0].as_str().unwrap().repeat(part[1].as_u64().unwrap() as usize))
                .collect::<String>()
                .into(),
            _ => change["value"].clone(),
        };
        assert!(judged(&changed).is_err(), "{}", change["name"]);
    }
    let valid = line;
    let text = valid.to_string();
    let twice = text.replacen("\"growth\":\"0\"", "\"growth\":\"0\",\"growth\":\"0\"", 1);
    assert!(twice != text && serde_json::from_str::<Certificate>(&twice).is_err());
    let named = text.replacen("\"values\":{}", "\"values\":{\"D\":\"1\",\"D\":\"1\"}", 1);
    assert!(named != text && serde_json::from_str::<Certificate>(&named).is_err());
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
                all.push(Value::from(text.replacen('+', "-", 1).replacen('C', "D", 1)));
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
                all.push(Value::from(shortened));
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

/// A change is refused, or what is left proves the same: a cover may be cut in another way.
fn refused_or_the_same(original: &Certificate, mutation: &Value) {
    let Ok(accepted) = judged(mutation) else { return };
    let claim = |one: &Certificate| {
        (
            one.subject.clone(),
            one.question,
            one.growth.clone(),
            one.evidence.clone(),
            one.interval.clone(),
        )
    };
    assert_eq!(
        claim(original),
        claim(&accepted),
        "{}",
        serde_json::to_string_pretty(mutation).unwrap()
    );
}

fn examples() -> Vec<Certificate> {
    let plan = SearchPlan::default();
    let sph = |name: &str, kernel| {
        certificates(catalogue::scheme(name).unwrap(), Some((kernel, integer(2))), None, &plan)
    };
    let mut all = sph("godunov-sph", Kernel::CubicSpline);
    all.extend(sph("lax-wendroff-sph", Kernel::CubicSpline));
    all.extend(sph("godunov-sph", Kernel::Gaussian));
    for name in ["leapfrog", "implicit-downwind", "leapfrog-asselin", "lagrange-upwind-3"] {
        all.extend(certificates(catalogue::scheme(name).unwrap(), None, None, &plan));
    }
    let space = catalogue::space("diffusion-2").unwrap();
    all.extend(certificates(space, None, Some("rk2-heun"), &plan));
    all.extend(["lax-wendroff-2d", "heat-ftcs-3d"].into_iter().flat_map(of_scheme));
    all
}

#[test]
fn a_certificate_with_any_field_changed_is_refused_or_proves_the_same() {
    let mut count = 0;
    for original in examples() {
        verify(&original).unwrap();
        let value = serde_json::to_value(&original).unwrap();
        for mutation in mutations(&value) {
            count += 1;
            refused_or_the_same(&original, &mutation);
        }
    }
    assert!(count > 1000, "{count} mutations");
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(64))]
    #[test]
    fn several_changes_at_once_are_refused_or_prove_the_same(
        which in 0usize..12, picks in proptest::collection::vec(0usize..1_000_000, 2..4)
    ) {
        static EXAMPLES: std::sync::LazyLock<Vec<Certificate>> = std::sync::LazyLock::new(examples);
        let original = &EXAMPLES[which % EXAMPLES.len()];
        let mut value = serde_json::to_value(original).unwrap();
        for pick in picks {
            let all = mutations(&value);
            value = all[pick % all.len()].clone();
        }
        refused_or_the_same(original, &value);
    }
}
