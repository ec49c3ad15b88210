//! What can be wrong with a figure.

use thiserror::Error;

/// Why a figure, or a part of it, cannot be drawn.
#[derive(Debug, Error)]
pub enum FigureError {
    /// The array of a field does not have the shape `(x.len(), y.len())`, or is below 2 x 2.
    #[error(
        "field of shape {rows} x {columns} on {x} x {y} nodes; need equal shapes, at least 2 x 2"
    )]
    FieldShape {
        /// First extent of the array.
        rows: usize,
        /// Second extent of the array.
        columns: usize,
        /// Number of x nodes.
        x: usize,
        /// Number of y nodes.
        y: usize,
    },
    /// Numbers that must be finite and strictly increasing are not.
    #[error("{what} must be finite and strictly increasing")]
    NotIncreasing {
        /// Which numbers.
        what: &'static str,
    },
    /// There is not exactly one colour between each two neighbouring band edges.
    #[error("{edges} band edges need one colour fewer, got {colors}")]
    BandColors {
        /// Number of edges.
        edges: usize,
        /// Number of colours.
        colors: usize,
    },
    /// The break of a two-sided colour scale is not one of the band edges.
    #[error("the break {0} of a two-sided scale must be one of the band edges")]
    BreakNotAnEdge(f64),
    /// An axis range is empty, not finite, or not positive on a logarithmic axis.
    #[error("axis '{label}' cannot have the range {low} to {high}")]
    AxisRange {
        /// Label of the axis.
        label: String,
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// There is no panel, or there are more than cells in the grid.
    #[error("{panels} panels in a grid of {rows} x {columns}")]
    PanelCount {
        /// Number of panels.
        panels: usize,
        /// Rows of the grid.
        rows: usize,
        /// Columns of the grid.
        columns: usize,
    },
    /// Labels leave no room for the panels.
    #[error("no room for the panels: {width:.0} x {height:.0} points each")]
    TooSmall {
        /// Width left for a panel, in points.
        width: f64,
        /// Height left for a panel, in points.
        height: f64,
    },
    /// The PNG encoder failed.
    #[error("cannot encode the PNG: {0}")]
    Png(#[from] png::EncodingError),
    /// The drawing library failed.
    #[error("cannot draw: {0}")]
    Drawing(String),
}
