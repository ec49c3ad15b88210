//! The largest stable step of every integrator over the (h, α) plane.

use super::super::{Detail, ReportError};
use super::{figure_item, integrator, lattice};
use crate::figure::Figure;
use crate::page::Item;
use crate::step_map::{StepMap, step_map};
use courant_analysis::exact::rational::integer;
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue::PARTICLE_INTEGRATORS;
use courant_analysis::waves::dispersion::sweep::even_axis;
use courant_analysis::waves::sweep::Progress;
use std::ops::ControlFlow;

pub fn item(detail: Detail, progress: Progress<'_>) -> Result<Item, ReportError> {
    let (columns, rows) = match detail {
        // Along a crest, where a condition on oscillations gives way to one on alternating signs, the limit falls off
        // within hundredths of h and α: a coarser grid breaks the tongue of a level there into specks.
        Detail::Full => (101, 101),
        Detail::Quick => (31, 31),
    };
    let ratios = even_axis(&integer(1), &integer(2), columns);
    let alphas: Vec<f64> = (0..rows).map(|i| 3.0 * i as f64 / (rows - 1) as f64).collect();
    let viscous = lattice("sph-av", Kernel::CubicSpline, &integer(1))?;
    let count = PARTICLE_INTEGRATORS.len();
    let mut figure = Figure::grid(count.div_ceil(2), 2).size(8.0, 13.2);
    let mut data = Vec::new();
    let mut maps = Vec::new();
    for (index, integrator) in PARTICLE_INTEGRATORS.map(integrator).into_iter().enumerate() {
        let part = |done: usize, all: usize| -> ControlFlow<()> {
            progress(index * all + done, count * all)
        };
        let map = step_map(&viscous, integrator, &ratios, &alphas, &part)?;
        let letter = char::from(b'a' + index as u8);
        // Too long for a panel otherwise.
        let title = integrator.title.trim_start_matches("leapfrog ");
        figure = figure.panel(map.panel(&format!("({letter}) {title}"))?);
        data.extend(map.data_files(&format!("stable_step_{}", integrator.name)));
        maps.push(map);
    }
    let figure = figure.color_bar(StepMap::color_bar(&maps)?);
    let caption = "Largest stable c Δt/h of SPH with viscosity over the smoothing ratio and α, for every integrator; \
                   looked at on a grid of phases that resolves every oscillation, single points of it are proved in the \
                   table above. At α = 0 forward Euler, centred Euler and the second-order Runge–Kutta methods have no stable step: their \
                   lowest row is zero. Where viscosity binds, on the right and above, the limit falls like 1/α, and \
                   predicting the velocity of the last kick costs step rather than gains it. Edges that look ragged, as in (a) and (g) on \
                   the left, lie on a crest: there a bound on oscillations that rises with α meets one on alternating signs \
                   that starts like a square root, and the limit falls within less than a cell of the grid. Cubic B-spline, ρ0 = M Σ W, \
                   isothermal, 1 ≤ h/Δ ≤ 2, 0 ≤ α ≤ 3."
        .into();
    Ok(figure_item("stable_step_maps", figure, caption, data))
}
