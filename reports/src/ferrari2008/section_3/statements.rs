//! What section 3.3 of the paper says about its figures, each statement beside a number.

mod test_1;
mod test_2;
mod test_3;
mod test_4;

use super::runs::{PARTICLES, Runs, TestRun, tube};
use super::table_item;
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use courant_simulation::comparison::Comparison;
use courant_simulation::lagrangian::LagrangianOptions;
use courant_simulation::lagrangian::flux::{ContactViscosity, Flux, ModifiedRoe};
use courant_simulation::method::Method;

/// What became of a statement. It follows from the numbers, by the conditions written beside them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Confirmed,
    Partly,
    Contradicted,
}

impl Verdict {
    /// All, none or some of the conditions hold.
    fn of(conditions: &[bool]) -> Self {
        match conditions.iter().filter(|&&holds| holds).count() {
            0 => Self::Contradicted,
            n if n == conditions.len() => Self::Confirmed,
            _ => Self::Partly,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Partly => "partly",
            Self::Contradicted => "contradicted",
        }
    }
}

/// Number with three digits.
fn n(value: f64) -> String {
    significant(value, 3)
}

/// Per cent.
fn percent(value: f64) -> String {
    format!("{:.1} %", 100.0 * value)
}

/// `exact …, Rusanov …, Roe …`.
fn three(values: [f64; 3], write: impl Fn(f64) -> String) -> String {
    let [exact, rusanov, roe] = values.map(write);
    format!("exact {exact}, Rusanov {rusanov}, Roe {roe}")
}

fn width(run: &TestRun) -> f64 {
    run.comparison.contact_width.unwrap_or(f64::NAN)
}

/// What is measured of conservation, and whether both drifts are beyond rounding.
fn conservation(run: &TestRun) -> (String, Verdict) {
    let drift = run.run.conservation;
    (
        format!("drift of momentum {}, of energy {}", n(drift.momentum), n(drift.energy)),
        Verdict::of(&[drift.momentum.abs() > 1e-12, drift.energy.abs() > 1e-12]),
    )
}

/// A test with other options than in the figures.
fn compared(test: usize, options: LagrangianOptions) -> Comparison {
    let tube = tube(test);
    let run = Method::Lagrangian(options).run(&tube, PARTICLES).expect("the options are valid");
    Comparison::new(&tube, &run)
}

/// `Σ|e|/N` of the density for the Roe flux with another contact viscosity.
fn density_error_of_roe(test: usize, alpha: f64) -> f64 {
    let contact = ContactViscosity::Printed(alpha);
    let flux = Flux::ModifiedRoe(ModifiedRoe { contact, ..ModifiedRoe::default() });
    compared(test, LagrangianOptions::new(flux)).l1.density
}

/// A statement, what was measured, and what became of it.
type Row = (&'static str, String, Verdict);

/// The table.
pub fn table(runs: &Runs) -> Item {
    let mut table = Table::new(
        "Statements of section 3.3 against numbers: N = 100, settings as in the figures",
        &[
            ("test", Align::Left),
            ("the paper says", Align::Left),
            ("measured", Align::Left),
            ("verdict", Align::Left),
        ],
    );
    let tests = [test_1::rows(runs), test_2::rows(runs), test_3::rows(runs), test_4::rows(runs)];
    for (test, rows) in (1..).zip(tests) {
        for (statement, measured, verdict) in rows {
            table.push([test.to_string(), statement.into(), measured, verdict.name().into()]);
        }
    }
    table_item("section_3_statements", table)
}
