//! Section 4 of the paper: dispersion relations, their Figures 2 to 5, and what a time step makes of them.

mod error_maps;
mod godunov_forms;
mod integrator_table;
mod kernel_curves;
mod step_maps;

use super::{Detail, text};
use crate::part::Part;
use courant_analysis::exact::rational::{Rational, ratio};
use courant_analysis::kernel::Density;
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{Integrator, LatticeMethod, catalogue};
use courant_analysis::waves::sweep::SweepError;
use std::f64::consts::PI;

/// The parts on waves: Figures 2 to 5, the two Godunov relations, kernels, integrators.
pub fn parts(detail: Detail) -> Vec<Part> {
    let section = |title, items| Ok(vec![text().section(title, items)]);
    vec![
        Part::new("Figures 2 to 5", move || section("title_errors", error_maps::items(detail)?)),
        Part::new("Godunov relations", move || section("title_forms", godunov_forms::items()?)),
        Part::new("waves by kernel", move || {
            section("title_kernels", vec![kernel_curves::item()?])
        }),
        Part::new("time steps", move || section("title_integrators", integrator_table::items()?)),
        Part::new("maps of time steps", move || {
            section("title_step_maps", vec![step_maps::item(detail)?])
        }),
    ]
}

/// `h/Δ = 6/5`: inside the range of the paper, where its own runs are.
fn usual_ratio() -> Rational {
    ratio(6, 5)
}

fn integrator(name: &str) -> &'static Integrator {
    Integrator::named(name).expect("it is in the catalogue")
}

/// A method of the catalogue with the density that its particles sum.
fn lattice(name: &str, kernel: Kernel, at: &Rational) -> Result<LatticeMethod, SweepError> {
    let method = catalogue::method(name).expect("it is in the catalogue");
    Ok(LatticeMethod::new(method, kernel, at)?)
}

/// A method with the cubic spline and `ρ0 = M/Δ`, as the paper draws its figures.
fn paper_lattice(name: &str, at: &Rational) -> Result<LatticeMethod, SweepError> {
    Ok(lattice(name, Kernel::CubicSpline, at)?.with_density(Density::MassPerSpacing))
}

/// `count` phases up to π, the first a `count`th of it.
fn phases(count: usize) -> Vec<f64> {
    (1..=count).map(|index| index as f64 * PI / count as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::Item;

    #[test]
    fn captions_and_tables_have_the_true_numbers() {
        // The speed of long waves with the cubic spline, from the lattice sums by hand.
        let maps = error_maps::items(Detail::Quick).unwrap();
        let Item::Figure { caption, .. } = &maps[0] else { panic!("no Figure 2") };
        for error in ["+6.4 %", "+7.9 %", "-4.3 %", "-22.2 %"] {
            assert!(caption.contains(error), "{caption}");
        }
        let tables = integrator_table::items().unwrap();
        let Item::Table { table, .. } = &tables[1] else { panic!("no table") };
        let csv = table.to_csv();
        // At h = Δ: ω0² ≤ 8 c²/Δ², leapfrog 2/√8, RK4 √8/√8; and the fractions at 6/5.
        for value in ["sqrt(1/2)", "779/810", "1.341391", "1.395179", "0.4281353", "1.032397"] {
            assert!(csv.contains(value), "{value} in {csv}");
        }
        let forms = godunov_forms::items().unwrap();
        let Item::Paragraph(text) = &forms[0] else { panic!("no text") };
        assert!(text.contains("0.6180 c and -1.618 c"));
    }
}
