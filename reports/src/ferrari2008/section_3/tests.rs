//! The parts that can be checked without making the whole report.

use super::convergence::order;
use super::runs::Runs;
use super::{errors, figures, measures, table_2, text};
use crate::page::Item;

#[test]
fn an_order_is_the_slope_of_the_logarithms() {
    let points: Vec<(f64, f64)> =
        [50.0, 100.0, 200.0].iter().map(|&n: &f64| (n, 3.0 * n.powf(-0.7))).collect();
    assert!((order(&points).expect("three points") - 0.7).abs() < 1e-12);
    assert_eq!(order(&points[..1]), None);
}

#[test]
fn the_sound_of_test_4_grows_as_stated() {
    assert!((table_2::sound_growth(4) - 4.358).abs() < 1e-3);
    // Rarefactions only: C falls.
    assert!(table_2::sound_growth(2) < 1.0);
}

#[test]
fn figures_have_the_numbers_of_the_paper() {
    let runs = Runs::at_100_particles();
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
    let Item::Table { table, .. } = errors::table(&runs) else { panic!("a table") };
    assert_eq!(table.rows().count(), 20);
    let Item::Table { table, .. } = measures::claims(&runs) else { panic!("a table") };
    assert!(table.rows().count() >= 20);
    let section = table_2::section();
    for item in section
        .items
        .iter()
        .chain(&[errors::table(&runs), errors::waves(&runs)])
        .chain(&[measures::claims(&runs)])
    {
        if let Item::Table { name, table, .. } = item {
            assert!(table.to_latex().is_ascii(), "{name}: {}", table.to_latex());
        }
    }
}
