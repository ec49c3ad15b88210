//! Section 4 of the paper: dispersion relations, their Figures 2 to 5, and what a time step makes of them.

mod error_maps;
mod godunov_forms;
mod integrator_table;
mod kernel_curves;
mod step_maps;

use super::{COMMAND, Detail, ReportError};
use crate::CatalogueItem;
use crate::figure::Figure;
use crate::page::{Item, Publish, Section};
use courant_analysis::exact::rational::{Rational, ratio};
use courant_analysis::kernel::Density;
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{Integrator, LatticeMethod, catalogue};
use courant_analysis::waves::sweep::{Progress, SweepError};
use std::f64::consts::PI;

/// What these sections show.
pub const CATALOGUE: &[CatalogueItem] = &[
    CatalogueItem {
        name: "figure_02",
        description: "phase error of SPH without viscosity over (κ, h)",
        source: "Cha & Whitworth 2003, Figure 2",
    },
    CatalogueItem {
        name: "figure_03",
        description: "phase error of SPH with viscosity, α = 1, over (κ, h)",
        source: "Cha & Whitworth 2003, Figure 3",
    },
    CatalogueItem {
        name: "figure_04",
        description: "amplitude of SPH with viscosity over (κ, α)",
        source: "Cha & Whitworth 2003, Figure 4",
    },
    CatalogueItem {
        name: "figure_05",
        description: "phase error of Godunov particle hydrodynamics over (κ, h), printed and resolved",
        source: "Cha & Whitworth 2003, Figure 5",
    },
    CatalogueItem {
        name: "godunov_forms",
        description: "the printed relation of Godunov particle hydrodynamics against the resolved one",
        source: "Cha & Whitworth 2003, (61)-(64)",
    },
    CatalogueItem {
        name: "kernel_waves",
        description: "speed and damping of waves for every kernel",
        source: "beyond Cha & Whitworth 2003, section 4",
    },
    CatalogueItem {
        name: "integrator_table",
        description: "largest stable c Δt/h of every integrator, proved",
        source: "beyond Cha & Whitworth 2003, section 4",
    },
    CatalogueItem {
        name: "stable_step_maps",
        description: "largest stable c Δt/h of every integrator over (h, α)",
        source: "beyond Cha & Whitworth 2003, section 4",
    },
];

/// Hands over the sections on waves as they are finished: Figures 2 to 5, the two Godunov relations, kernels,
/// integrators.
///
/// # Errors
/// When the callback stops the work, a figure cannot be composed or a section cannot be published.
pub fn publish_sections(
    detail: Detail,
    progress: Progress<'_>,
    publish: &mut Publish<'_>,
) -> Result<(), ReportError> {
    let mut section = |title: &str, items: Vec<Item>| -> Result<(), ReportError> {
        Ok(publish(Section { title: title.into(), items })?)
    };
    section(
        "Figures 2 to 5: phase and amplitude errors of sound waves",
        error_maps::items(detail, progress)?,
    )?;
    section(
        "Published against resolved: the relation of Godunov particle hydrodynamics",
        godunov_forms::items()?,
    )?;
    section("Waves by kernel: speed and damping", vec![kernel_curves::item()?])?;
    section("Stable time steps by integrator", integrator_table::items()?)?;
    section("Stable time steps over the (h, α) plane", vec![step_maps::item(detail, progress)?])
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

fn figure_item(name: &str, figure: Figure, caption: String, data: Vec<(String, Vec<u8>)>) -> Item {
    let figure = Box::new(figure);
    Item::Figure { name: name.into(), figure, caption, data, command: COMMAND.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::waves::sweep::no_progress;

    #[test]
    fn the_sections_show_what_the_catalogue_names_with_the_true_numbers() {
        let mut sections = Vec::new();
        let mut keep = |section| {
            sections.push(section);
            Ok(())
        };
        publish_sections(Detail::Quick, &no_progress, &mut keep).unwrap();
        let items: Vec<&Item> = sections.iter().flat_map(|section| &section.items).collect();
        let named = |wanted: &str| {
            items.iter().find(|item| match item {
                Item::Figure { name, .. } | Item::Table { name, .. } => name == wanted,
                Item::Paragraph(_) => false,
            })
        };
        for entry in CATALOGUE {
            assert!(named(entry.name).is_some(), "{} is missing", entry.name);
        }
        // The speed of long waves with the cubic spline, from the lattice sums by hand.
        let Some(Item::Figure { caption, .. }) = named("figure_02") else { panic!("no Figure 2") };
        for error in ["+6.4 %", "+7.9 %", "-4.3 %", "-22.2 %"] {
            assert!(caption.contains(error), "{caption}");
        }
        let Some(Item::Table { table, .. }) = named("integrator_table") else { panic!("no table") };
        let csv = table.to_csv();
        // At h = Δ: ω0² ≤ 8 c²/Δ², leapfrog 2/√8, RK4 √8/√8; and the fractions at 6/5.
        for value in ["sqrt(1/2)", "779/810", "1.341391", "1.395179", "0.4281353", "1.032397"] {
            assert!(csv.contains(value), "{value} in {csv}");
        }
        let text = sections[1].items.iter().find_map(|item| match item {
            Item::Paragraph(text) => Some(text.as_str()),
            _ => None,
        });
        assert!(text.is_some_and(|text| text.contains("0.6180 c and -1.618 c")));
    }
}
