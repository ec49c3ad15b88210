//! Sizes and weights common to all figures, in points: made for print at the size the figure states.

use super::color::Color;

pub(super) const TICK_SIZE: f64 = 8.0;
pub(super) const LABEL_SIZE: f64 = 9.0;
pub(super) const TITLE_SIZE: f64 = 9.0;
pub(super) const FIGURE_TITLE_SIZE: f64 = 10.5;
pub(super) const LEGEND_SIZE: f64 = 7.8;
pub(super) const ISOLINE_SIZE: f64 = 6.8;

pub(super) const TICK_LENGTH: f64 = 3.2;
pub(super) const MINOR_TICK_LENGTH: f64 = 1.8;
/// From tick to number.
pub(super) const TICK_GAP: f64 = 2.2;
/// From numbers to label.
pub(super) const LABEL_GAP: f64 = 3.5;
/// From plot to colour bar.
pub(super) const BAR_GAP: f64 = 9.0;
pub(super) const BAR_BREADTH: f64 = 9.0;
/// Between neighbouring panels, beside their labels.
pub(super) const PANEL_GAP: f64 = 7.0;
/// Around everything.
pub(super) const PAGE_MARGIN: f64 = 4.0;

pub(super) const FRAME_WIDTH: f64 = 0.7;
pub(super) const GRID_WIDTH: f64 = 0.4;
pub(super) const GRID_COLOR: Color = Color::rgb(222, 222, 222);
