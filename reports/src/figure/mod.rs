//! Figures for papers and reports: plain data in, PNG (300 dpi) or SVG out, in memory.
//!
//! A [`Figure`] is a grid of [`Panel`]s; a panel has two [`Axis`] and layers in data coordinates: [`Line`], [`Markers`],
//! [`ErrorBars`], [`Rule`], [`Region`], [`FilledContours`], [`Isolines`], [`Note`]. Sizes are in points (1/72 inch) on the
//! printed page.
//!
//! Axes, ticks, meshes and legends are those of [plotters], drawn on a canvas in units of a twentieth of a point: as SVG by
//! its own backend, as PNG by one over tiny-skia. The result depends on nothing but the data: equal figures give equal
//! bytes.
//!
//! ```
//! use courant_reports::figure::{Axis, Corner, Figure, Line, Marker, Markers, Panel};
//!
//! let h = [0.1, 0.05, 0.025];
//! let error = [4e-3, 1e-3, 2.5e-4];
//! let panel = Panel::new(Axis::log("h"), Axis::log("error"))
//!     .layer(Line::xy(&h, &error).label("run"))
//!     .layer(Markers::new(h.into_iter().zip(error), Marker::Circle).label("run"))
//!     .legend(Corner::TopLeft);
//! let figure = Figure::single(panel).size(3.5, 2.6);
//! assert!(figure.svg()?.starts_with("<svg"));
//! assert_eq!(&figure.png()?[1..4], b"PNG");
//! # Ok::<(), courant_reports::figure::FigureError>(())
//! ```

mod axis;
mod color;
mod color_bar;
mod colormap;
mod contour;
mod error;
mod geometry;
mod layer;
mod layout;
mod legend;
mod line_label;
mod number;
mod paint;
mod panel;
mod picture;
mod raster;
mod text;
mod vector;

pub use axis::Axis;
pub use color::Color;
pub use color_bar::{ColorBar, Side};
pub use colormap::{Bands, ColorMap};
pub use contour::Field;
pub use error::FigureError;
pub use layer::{
    Anchor, Dash, ErrorBars, FilledContours, Isolines, Layer, Line, Marker, Markers, Note, Region,
    Rule,
};
pub use layout::Figure;
pub use legend::Corner;
pub use panel::Panel;
