//! Layers made of areas: marked regions and fields, filled or as isolines.

use super::{color::Color, colormap::Bands, contour::Field, curve::Dash, geometry::Point};

/// A marked area: tinted, hatched or both.
#[derive(Debug, Clone)]
pub struct Region {
    pub(super) outline: Vec<Point>,
    pub(super) fill: Option<(Color, f64)>,
    pub(super) hatch: Option<Color>,
    pub(super) label: String,
}

impl Region {
    /// The inside of a polygon. Infinite coordinates mean the border of the panel.
    pub fn polygon(points: impl IntoIterator<Item = (f64, f64)>) -> Region {
        Region {
            outline: points.into_iter().map(|(x, y)| [x, y]).collect(),
            fill: None,
            hatch: None,
            label: String::new(),
        }
    }

    /// The area between two curves over the same `x`; an infinite value means the border of the panel.
    ///
    /// ```
    /// use courant_reports::figure::{Color, Region};
    /// let x = [0.0, 1.0, 2.0];
    /// let unstable = Region::between(&x, &[0.5, 0.4, 0.3], &[f64::INFINITY; 3]).hatch(Color::GREY);
    /// ```
    pub fn between(x: &[f64], lower: &[f64], upper: &[f64]) -> Region {
        let way = |y: &[f64]| x.iter().copied().zip(y.iter().copied()).collect::<Vec<_>>();
        let mut points = way(lower);
        points.extend(way(upper).into_iter().rev());
        points.retain(|p| !p.0.is_nan() && !p.1.is_nan());
        Region::polygon(points)
    }

    /// Tints the area; the opacity is from 0 to 1.
    pub fn fill(mut self, color: Color, opacity: f64) -> Region {
        self.fill = Some((color, opacity));
        self
    }

    /// Hatches the area.
    pub fn hatch(mut self, color: Color) -> Region {
        self.hatch = Some(color);
        self
    }

    /// Names the area in the legend.
    pub fn label(mut self, label: impl Into<String>) -> Region {
        self.label = label.into();
        self
    }
}

/// A field painted in bands of value. Cells with a corner that is not finite stay blank.
#[derive(Debug, Clone)]
pub struct FilledContours {
    pub(super) field: Field,
    pub(super) bands: Bands,
}

impl FilledContours {
    /// The field in the colours of the bands.
    pub fn new(field: Field, bands: Bands) -> FilledContours {
        FilledContours { field, bands }
    }
}

/// Lines of equal value of a field.
#[derive(Debug, Clone)]
pub struct Isolines {
    pub(super) field: Field,
    pub(super) levels: Vec<f64>,
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) dash: Dash,
    pub(super) labelled: bool,
    pub(super) label: String,
}

impl Isolines {
    /// Thin black lines with their values written into them.
    pub fn new(field: Field, levels: impl IntoIterator<Item = f64>) -> Isolines {
        Isolines {
            field,
            levels: levels.into_iter().collect(),
            color: Color::BLACK,
            width: 0.6,
            dash: Dash::Solid,
            labelled: true,
            label: String::new(),
        }
    }

    /// Sets the colour.
    pub fn color(mut self, color: Color) -> Isolines {
        self.color = color;
        self
    }

    /// Sets the width in points.
    pub fn width(mut self, width: f64) -> Isolines {
        self.width = width;
        self
    }

    /// Sets the dash pattern.
    pub fn dash(mut self, dash: Dash) -> Isolines {
        self.dash = dash;
        self
    }

    /// Leaves out the values in the lines.
    pub fn without_values(mut self) -> Isolines {
        self.labelled = false;
        self
    }

    /// Names the lines in the legend.
    pub fn label(mut self, label: impl Into<String>) -> Isolines {
        self.label = label.into();
        self
    }
}
