//! Figure 1: two kernels, two schemes.

use super::{Detail, LimitKind, ReportError, published_values};
use crate::figure::{ColorBar, Figure, Side};
use crate::page::Item;
use crate::stability_map::{
    COLOR_BAR_LABEL, MapPlan, PublishedLimit, PublishedPoint, bands, stability_map,
};
use courant_analysis::kernel::Kernel;
use courant_analysis::rational::{Rational, integer, ratio, to_f64};
use courant_analysis::scheme::AdvectionScheme;
use courant_analysis::sweep::Progress;
use std::ops::ControlFlow;

const KERNELS: [Kernel; 2] = [Kernel::CubicSpline, Kernel::Gaussian];
const SCHEMES: [AdvectionScheme; 2] =
    [AdvectionScheme::LaxWendroffSph, AdvectionScheme::GodunovSph];

/// The grid of one panel: ratio 1 to 10 (whole ratios are on it), Courant number 0 to 12.
pub fn figure_1_plan(scheme: AdvectionScheme, kernel: Kernel, detail: Detail) -> MapPlan {
    let cells = match detail {
        Detail::Full => 270,
        Detail::Quick => 90,
    };
    let axis = |from: i64, to: i64| -> Vec<Rational> {
        (0..=cells).map(|i| integer(from) + ratio(i * (to - from), cells)).collect()
    };
    MapPlan { scheme, kernel, ratios: axis(1, 10), courant_numbers: axis(0, 12) }
}

/// Draws the four panels.
///
/// # Errors
/// When the callback stops a sweep.
pub fn figure_1(detail: Detail, progress: Progress<'_>) -> Result<Item, ReportError> {
    let mut figure = Figure::grid(2, 2).size(7.2, 6.6);
    let mut data = Vec::new();
    let panels =
        KERNELS.iter().flat_map(|kernel| SCHEMES.iter().map(move |scheme| (*scheme, *kernel)));
    for (index, (scheme, kernel)) in panels.enumerate() {
        let plan = figure_1_plan(scheme, kernel, detail);
        let rows = plan.ratios.len();
        let part = |done: usize, _all: usize| -> ControlFlow<()> {
            progress(index * rows + done, 4 * rows)
        };
        let map = stability_map(plan, &part)?;
        let letter = char::from(b'a' + index as u8);
        let title = format!("({letter}) {}, {}", scheme.title(), kernel.title());
        // The table is about the Godunov scheme.
        let printed: Vec<PublishedPoint> = published_values()
            .iter()
            .filter(|value| value.kernel == kernel && scheme == AdvectionScheme::GodunovSph)
            .map(|value| PublishedPoint {
                limit: match value.kind {
                    LimitKind::Stability => PublishedLimit::Stability,
                    LimitKind::Monotonicity => PublishedLimit::Monotonicity,
                },
                point: (to_f64(&value.ratio), to_f64(&value.courant)),
            })
            .collect();
        figure = figure.panel(map.panel(&title, &printed)?);
        data.extend(map.data_files(&format!("figure_1{letter}")));
    }
    let figure =
        figure.color_bar(ColorBar::new(bands()?, COLOR_BAR_LABEL), Side::Right).legend_below();
    Ok(Item::Figure {
        name: "figure_1".into(),
        figure: Box::new(figure),
        caption: "Figure 1. Amplification factor on the (l/Δξ, C) plane. Where no wave grows by more than 1e-3 \
                  per step the colour shows |g| of the most damped wave, elsewhere |g| of the fastest growing one. \
                  The limit curves are proved at every ratio of the grid, not read off it. Lax–Wendroff SPH with \
                  the cut Gaussian is strictly unstable from l/Δξ of about 2.2 on, so weakly that no practical run \
                  shows it: the dashed curve is the limit for a growth of 1e-3 per step. With the cubic spline the \
                  strict limit dips at whole ratios, where the scheme keeps constants exactly and long waves bind. \
                  Markers: Table 1 as printed."
            .into(),
        data,
        command: super::COMMAND.into(),
    })
}
