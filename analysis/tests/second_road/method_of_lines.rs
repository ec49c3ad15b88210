//! Limits of spaces completed by integrators against values refined numerically elsewhere.

use courant_analysis::scheme::{Integrator, catalogue};
use courant_analysis::stability::{Evidence, Limit, SearchPlan};

fn limit(space: &str, integrator: &str) -> Limit {
    let space = catalogue::space(space).expect("a space of the catalogue");
    let integrator = Integrator::named(integrator).expect("an integrator of the catalogue");
    let step = space.step(None, Some(integrator), &[], Some("C")).unwrap();
    step.stable_set("C", &SearchPlan::default()).unwrap().limit()
}

#[test]
fn eighty_pairs_agree_with_numerical_refinement() {
    for line in include_str!("method_of_lines.txt").lines().filter(|line| !line.starts_with('#')) {
        let fields: Vec<&str> = line.split_whitespace().collect();
        let [space, integrator, known, ..] = fields.as_slice() else { panic!("{line}") };
        let found = limit(space, integrator);
        let known: f64 = known.parse().unwrap();
        assert_eq!(found.evidence(), Evidence::Proved, "{line}");
        // The list has more digits than an f64; the value is the one below.
        assert!(
            (found.value() - known).abs() <= 4.0 * f64::EPSILON * known,
            "{line}: {}",
            found.value()
        );
    }
}

#[test]
fn closed_forms_are_recognised() {
    let form = |space, integrator| limit(space, integrator).closed_form();
    assert_eq!(form("upwind-3", "rk2").as_deref(), Some("(2/3)^(1/3)"));
    assert_eq!(form("upwind-5", "rk5").as_deref(), Some("12^(1/5)"));
    assert_eq!(form("central-2", "rk3").as_deref(), Some("sqrt(3)"));
    assert_eq!(form("central-2", "rk4").as_deref(), Some("sqrt(8)"));
    assert_eq!(form("central-2", "leapfrog").as_deref(), Some("1"));
}
