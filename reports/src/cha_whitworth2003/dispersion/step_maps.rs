//! The largest stable step of every integrator over the (h, α) plane.

use super::super::{Detail, ReportError};
use super::{integrator, lattice, text};
use crate::figure::Figure;
use crate::page::Item;
use crate::step_map::{StepMap, step_map};
use courant_analysis::exact::rational::integer;
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue::PARTICLE_INTEGRATORS;
use courant_analysis::waves::dispersion::sweep::even_axis;
use courant_analysis::waves::sweep::no_progress;

pub fn item(detail: Detail) -> Result<Item, ReportError> {
    let count = match detail {
        Detail::Quick => 21,
        Detail::Standard => 51,
        // Along a crest, where a condition on oscillations gives way to one on alternating signs, the limit falls off
        // within hundredths of h and α: a coarser grid breaks the tongue of a level there into specks.
        Detail::Full => 101,
    };
    let ratios = even_axis(&integer(1), &integer(2), count);
    let alphas: Vec<f64> = (0..count).map(|i| 3.0 * i as f64 / (count - 1) as f64).collect();
    let viscous = lattice("sph-av", Kernel::CubicSpline, &integer(1))?;
    let mut figure = Figure::grid(PARTICLE_INTEGRATORS.len().div_ceil(2), 2).size(8.0, 13.2);
    let mut data = Vec::new();
    let mut maps = Vec::new();
    for (index, integrator) in PARTICLE_INTEGRATORS.map(integrator).into_iter().enumerate() {
        let map = step_map(&viscous, integrator, &ratios, &alphas, &no_progress)?;
        let letter = char::from(b'a' + index as u8);
        // Too long for a panel otherwise.
        let title = integrator.title.trim_start_matches("leapfrog ");
        figure = figure.panel(map.panel(&format!("({letter}) {title}"))?);
        data.extend(map.data_files(&format!("stable_step_{}", integrator.name)));
        maps.push(map);
    }
    let figure = figure.color_bar(StepMap::color_bar(&maps)?);
    Ok(text().figure("stable_step_maps", &[], figure, data))
}
