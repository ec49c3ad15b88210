//! Section 4 of the paper: dispersion relations, their Figures 2 to 5, and what a time step makes of them.

mod error_maps;
mod godunov_forms;

use super::text;
use crate::part::Part;
use crate::report::Detail;
use crate::study::plan::lattice;
use crate::study::{kernel_waves, stable_steps, step_maps};
use courant_analysis::exact::rational::{Rational, ratio};
use courant_analysis::kernel::{Density, Kernel};
use courant_analysis::scheme::LatticeMethod;
use courant_analysis::waves::sweep::SweepError;

/// The parts on waves: Figures 2 to 5, the two Godunov relations, kernels, integrators.
pub fn parts(detail: Detail) -> Vec<Part> {
    let section = |title, items| Ok(vec![text().section(title, items)]);
    vec![
        Part::new("Figures 2 to 5", move || section("title_errors", error_maps::items(detail)?)),
        Part::new("Godunov relations", move || section("title_forms", godunov_forms::items()?)),
        Part::new("waves by kernel", move || {
            section("title_kernels", vec![kernel_waves::item(text())?])
        }),
        Part::new("time steps", move || {
            section("title_integrators", stable_steps::items(text(), detail)?)
        }),
        Part::new("maps of time steps", move || {
            section("title_step_maps", vec![step_maps::item(text(), detail)?])
        }),
    ]
}

/// `h/Δ = 6/5`: inside the range of the paper, where its own runs are.
fn usual_ratio() -> Rational {
    ratio(6, 5)
}

/// A method with the cubic spline and `ρ0 = M/Δ`, as the paper draws its figures.
fn paper_lattice(name: &str, at: &Rational) -> Result<LatticeMethod, SweepError> {
    Ok(lattice(name, Kernel::CubicSpline, at)?.with_density(Density::MassPerSpacing))
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
        let tables = stable_steps::items(text(), Detail::Standard).unwrap();
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
