//! The largest stable step of every integrator over the (h, α) plane.

use super::plan::{ByDetail, Named, integrator, lattice, letter};
use crate::figure::Figure;
use crate::page::Item;
use crate::paper_text::PaperText;
use crate::report::{Detail, ReportError};
use crate::step_map::{StepMap, step_map};
use courant_analysis::exact::rational::{Rational, integer};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue::PARTICLE_INTEGRATORS;
use courant_analysis::waves::dispersion::sweep::even_axis;
use courant_analysis::waves::sweep::no_progress;
use serde::Deserialize;

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    /// A method with the viscosity α.
    method: String,
    kernel: Named<Kernel>,
    /// The ends of the axis of `h/Δ`.
    ratios: [Named<Rational>; 2],
    /// The end of the axis of α.
    most: f64,
    /// Values on each axis. Along a crest, where a condition on oscillations gives way to one on alternating signs, the
    /// limit falls off within hundredths of h and α: a coarse grid breaks the tongue of a level there into specks.
    values: ByDetail<usize>,
}

/// The figure.
///
/// # Errors
/// When a ratio is out of range.
pub fn item(text: &PaperText, detail: Detail) -> Result<Item, ReportError> {
    let plan: Plan = text.plan("step_maps");
    let count = *plan.values.at(detail);
    let [from, to] = &plan.ratios;
    let ratios = even_axis(&from.0, &to.0, count);
    let alphas: Vec<f64> = (0..count).map(|i| plan.most * i as f64 / (count - 1) as f64).collect();
    let viscous = lattice(&plan.method, plan.kernel.0, &integer(1))?;
    let mut figure = Figure::grid(PARTICLE_INTEGRATORS.len().div_ceil(2), 2).size(8.0, 13.2);
    let mut data = Vec::new();
    let mut maps = Vec::new();
    for (index, integrator) in PARTICLE_INTEGRATORS.map(integrator).into_iter().enumerate() {
        let map = step_map(&viscous, integrator, &ratios, &alphas, &no_progress)?;
        // Too long for a panel otherwise.
        let title = integrator.title.trim_start_matches("leapfrog ");
        figure = figure.panel(map.panel(&format!("{}{title}", letter(index)))?);
        data.extend(map.data_files(&format!("stable_step_{}", integrator.name)));
        maps.push(map);
    }
    let figure = figure.color_bar(StepMap::color_bar(&maps));
    Ok(text.figure("stable_step_maps", &[], figure, data))
}
