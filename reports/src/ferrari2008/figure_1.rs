//! Figure 1: two kernels, two schemes.

use super::{LimitKind, published_values, text};
use crate::figure::Figure;
use crate::number::significant;
use crate::page::Item;
use crate::report::{Detail, ReportError};
use crate::stability_map::{
    MapPlan, PublishedLimit, PublishedPoint, StabilityMap, damping_bar, growth_bar, stability_map,
};
use crate::words;
use courant_analysis::exact::rational::{Rational, integer, ratio, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::waves::sweep::no_progress;
use courant_simulation::advection::AdvectionScheme;

const KERNELS: [Kernel; 2] = [Kernel::CubicSpline, Kernel::Gaussian];
const SCHEMES: [AdvectionScheme; 2] =
    [AdvectionScheme::LaxWendroffSph, AdvectionScheme::GodunovSph];

/// The grid of one panel: ratio 1 to 10 (whole ratios are on it), Courant number 0 to 12.
pub fn figure_1_plan(scheme: AdvectionScheme, kernel: Kernel, detail: Detail) -> MapPlan {
    let cells = match detail {
        Detail::Quick => 90,
        Detail::Standard | Detail::Full => 270,
    };
    let axis = |from: i64, to: i64| -> Vec<Rational> {
        (0..=cells).map(|i| integer(from) + ratio(i * (to - from), cells)).collect()
    };
    MapPlan { scheme, kernel, ratios: axis(1, 10), courant_numbers: axis(0, 12) }
}

/// Draws the four panels.
///
/// # Errors
/// When a figure cannot be composed.
pub fn figure_1(detail: Detail) -> Result<Item, ReportError> {
    let mut figure = Figure::grid(2, 2).size(7.2, 6.6);
    let mut data = Vec::new();
    let mut nowhere_stable = String::new();
    let panels =
        KERNELS.iter().flat_map(|kernel| SCHEMES.iter().map(move |scheme| (*scheme, *kernel)));
    for (index, (scheme, kernel)) in panels.enumerate() {
        let plan = figure_1_plan(scheme, kernel, detail);
        let map = stability_map(plan, &no_progress)?;
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
        nowhere_stable.push_str(&without_strict_limit(&map));
        data.extend(map.data_files(&format!("figure_01{letter}")));
    }
    let figure = figure.color_bar(damping_bar()).color_bar(growth_bar());
    Ok(text().figure("figure_01", words!["nowhere" = nowhere_stable], figure, data))
}

/// Where a panel's scheme has no strictly stable Courant number, and how fast it grows there; empty when it has one
/// everywhere.
fn without_strict_limit(map: &StabilityMap) -> String {
    let Some(growth) = map.growth_without_limit() else { return String::new() };
    let stretches: Vec<String> = map
        .never_strictly_stable()
        .into_iter()
        .map(
            |[from, to]| {
                if from == to { format!("{from:.2}") } else { format!("{from:.2} to {to:.2}") }
            },
        )
        .collect();
    let [least, most] = growth.map(|growth| significant(growth, 2));
    text().text(
        "figure_01_nowhere",
        words![
            "scheme" = map.plan.scheme.title(),
            "kernel" = map.plan.kernel.title(),
            "stretches" = stretches.join(", "),
            "least" = least,
            "most" = most,
        ],
    )
}
