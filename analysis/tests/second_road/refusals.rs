//! What is grammatical and no linear scheme is refused in the words of `docs/language.md`.

use courant_analysis::scheme::Step;

#[test]
fn every_refusal_of_the_document_is_given() {
    let document = include_str!("../../../docs/language.md");
    let section = document.split("### Understood, but no scheme").nth(1).expect("the section");
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    let mut count = 0;
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let (text, answer) = (cells[0].trim_matches('`'), cells[1]);
        let problem = match Step::from_text(text) {
            Err(problem) => problem,
            Ok(step) => step.characteristic().expect_err(text),
        };
        assert!(problem.to_string().starts_with(answer), "{text}: {problem}");
        count += 1;
    }
    assert!(count >= 14, "{count} rows");
}

/// Questions with a parameter that has no value are answered by its name, not by a number.
#[test]
fn what_has_no_value_is_named() {
    use courant_analysis::exact::rational::integer;
    use courant_analysis::scheme::SchemeError;
    use courant_analysis::stability::{SearchPlan, decide_step_at, multiplicity_at};
    let text = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]) + D*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    let (step, plan) = (Step::from_text(text).unwrap(), SearchPlan::default());
    let missing = SchemeError::NotSet(vec!["D".into()]);
    assert_eq!(step.stable_set("C", &plan).unwrap_err(), missing);
    assert_eq!(step.monotone_set("C", &plan).unwrap_err(), missing);
    let both = SchemeError::NotSet(vec!["C".into(), "D".into()]);
    assert_eq!(decide_step_at(&step, &integer(0)).unwrap_err(), both);
    assert_eq!(multiplicity_at(&step).unwrap_err(), both);
    let set = step.with("D", &integer(0)).unwrap();
    assert!(set.stable_set("C", &plan).is_ok() && set.monotone_set("C", &plan).is_ok());
}
