//! The parts that can be checked without making the whole report.

use super::{claims, figures, table_2, text, tubes};
use crate::page::Item;
use crate::study::riemann_run::sound_growth;
use crate::study::riemann_tables;

#[test]
fn the_sound_of_test_4_grows_as_stated() {
    assert!((sound_growth(&tubes().scene(3)) - 4.358).abs() < 1e-3);
    // Rarefactions only: C falls.
    assert!(sound_growth(&tubes().scene(1)) < 1.0);
}

#[test]
fn figures_have_the_numbers_of_the_paper() {
    let runs = tubes().runs();
    let sections = figures::sections(&runs);
    let names: Vec<String> = sections
        .iter()
        .flat_map(|section| &section.items)
        .filter_map(|item| match item {
            Item::Figure { name, .. } => Some(name.clone()),
            _ => None,
        })
        .collect();
    let wanted: Vec<String> = (3..=21).map(|number| format!("figure_{number:02}")).collect();
    assert_eq!(names, wanted);
    for name in names {
        assert!(text().catalogue().any(|item| item.name == name));
    }
    // Test 3 has four figures, of which the first is the finite-volume one, and a statement.
    let Item::Figure { caption, .. } = &sections[2].items[0] else {
        panic!("a figure comes first")
    };
    assert!(caption.starts_with("Figure 13. Test 3: First-order"));
    assert!(matches!(&sections[2].items[1], Item::Paragraph(text) if text.contains("fails")));
    // Tables of the same runs have a row for each of them, the failed one included.
    let Item::Table { table, .. } = riemann_tables::errors(text(), "section_3_errors", &runs)
    else {
        panic!("a table")
    };
    assert_eq!(table.rows().count(), 20);
    let Item::Table { table, .. } = claims::table(&runs) else { panic!("a table") };
    assert!(table.rows().count() >= 20);
    let section = table_2::section();
    for item in section
        .items
        .iter()
        .chain(&[
            riemann_tables::errors(text(), "section_3_errors", &runs),
            riemann_tables::waves(text(), "section_3_waves", &runs),
        ])
        .chain(&[claims::table(&runs)])
    {
        if let Item::Table { name, table, .. } = item {
            assert!(table.to_latex().is_ascii(), "{name}: {}", table.to_latex());
        }
    }
}
