//! What is grammatical and no linear scheme is refused in the words of `docs/language.md`.

use courant_analysis::scheme::Step;

#[test]
fn every_refusal_of_the_document_is_given() {
    let document = include_str!("../../docs/language.md");
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
