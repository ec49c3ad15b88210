//! Figures for papers and reports: plain data in, PNG (300 dpi) or SVG out, in memory.
//!
//! A [`Figure`] is a grid of [`Panel`]s; a panel has two [`Axis`] and, in data coordinates, [`Contours`], [`Series`] and notes. Sizes
//! are in points (1/72 inch) on the printed page. [plotters] draws, on a canvas in units of a twentieth of a point, one [`Svg`], which
//! resvg renders as PNG. The result depends on nothing but the data: equal figures give equal bytes.
//!
//! ```
//! use courant_reports::figure::{Axis, Figure, Marker, Panel, Series};
//!
//! let h = [0.1, 0.05, 0.025];
//! let error = [4e-3, 1e-3, 2.5e-4];
//! let panel = Panel::new(Axis::log("h"), Axis::log("error"))
//!     .layer(Series::line(h.into_iter().zip(error)).label("run"))
//!     .layer(Series::markers(h.into_iter().zip(error), Marker::Circle).label("run"));
//! let figure = Figure::single(panel).size(3.5, 2.6);
//! let svg = figure.svg()?;
//! assert!(svg.0.starts_with("<svg") && svg.png()?[1..].starts_with(b"PNG"));
//! # Ok::<(), courant_reports::figure::FigureError>(())
//! ```

mod axis;
mod canvas;
mod color;
mod color_bar;
mod contours;
mod frame;
mod geometry;
mod isoline_label;
mod layout;
mod legend;
mod panel;
mod raster;
mod series;
mod text;

pub use axis::Axis;
pub use color::{Bands, Color, ColorMap};
pub use color_bar::ColorBar;
pub use contours::Contours;
pub use layout::Figure;
pub use panel::Panel;
pub use raster::Svg;
pub use series::{Dash, Marker, Series};

use text::POINT;

/// Why a figure, or a part of it, cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// A field to be drawn is none.
    #[error(transparent)]
    Field(#[from] crate::level_set::FieldError),
    /// An axis range is empty, not finite, or not positive on a logarithmic axis: label and ends.
    #[error("axis '{0}' cannot have the range {1} to {2}")]
    AxisRange(String, f64, f64),
    /// There is no panel, or there are more than cells in the grid: panels, rows and columns.
    #[error("{0} panels in a grid of {1} x {2}")]
    PanelCount(usize, usize, usize),
    /// Labels leave no room for the panels: width and height left for one, in points.
    #[error("no room for the panels: {0:.0} x {1:.0} points each")]
    TooSmall(f64, f64),
    /// The SVG cannot be rendered.
    #[error("cannot render the SVG: {0}")]
    Svg(#[from] resvg::usvg::Error),
    /// The PNG encoder failed.
    #[error("cannot encode the PNG: {0}")]
    Png(#[from] png::EncodingError),
    /// The drawing library failed.
    #[error("cannot draw: {0}")]
    Drawing(#[from] plotters::drawing::DrawingAreaErrorKind<std::io::Error>),
}
