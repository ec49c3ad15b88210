//! Contours of a field: bands of colour and lines of equal value.

use super::canvas::{Canvas, Done, fill, pen, stroke};
use super::frame::Frame;
use super::geometry::distance;
use super::isoline_label::IsolineLabels;
use super::{Bands, Color, Dash, POINT};
use crate::level_set::Field;

/// Broader lines, in points, are borders: no values are written into them.
const BROAD: f64 = 1.2;

/// A field painted in bands of value, with lines of equal value, black and 0.6 points wide, that have their values written
/// into them.
///
/// A name in the legend stands beside the colour of the first band, or a line where there are no bands.
#[derive(Debug, Clone)]
pub struct Contours {
    pub(super) field: Field,
    pub(super) bands: Option<Bands>,
    isolines: Vec<f64>,
    pub(super) width: f64,
    pub(super) label: String,
}

impl Contours {
    /// A field of which nothing is shown yet.
    pub fn new(field: Field) -> Contours {
        Contours { field, bands: None, isolines: Vec::new(), width: 0.6, label: String::new() }
    }

    /// The region where the field is at least `level`, in one colour.
    pub fn region(field: Field, level: f64, color: Color) -> Contours {
        Contours::new(field).bands(Bands::new(vec![level, f64::INFINITY], |_| color))
    }

    /// Paints these bands.
    pub fn bands(self, bands: Bands) -> Contours {
        Contours { bands: Some(bands), ..self }
    }

    /// Draws the lines of these values.
    pub fn isolines(self, levels: impl IntoIterator<Item = f64>) -> Contours {
        Contours { isolines: levels.into_iter().collect(), ..self }
    }

    /// Sets the width of the lines, in points; those of more than 1.2 are borders, without values.
    pub fn width(self, width: f64) -> Contours {
        Contours { width, ..self }
    }

    /// Sets the name in the legend.
    pub fn label(self, label: impl Into<String>) -> Contours {
        Contours { label: label.into(), ..self }
    }

    /// Draws bands and lines; values are asked for.
    pub(super) fn draw(&self, canvas: &Canvas, frame: &Frame, labels: &mut IsolineLabels) -> Done {
        let bands: Vec<(f64, Color)> = self.bands.iter().flat_map(Bands::ascending).collect();
        let mut levels: Vec<f64> = bands.iter().map(|band| band.0).collect();
        levels.extend(&self.isolines);
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        let outlines = self.field.outlines(&levels);
        let outline = |level: f64| &outlines[levels.partition_point(|&lower| lower < level)];
        // Each band is painted from its lower edge all the way up and the next one over it: neighbours overlap, so no
        // seam of background can show between them.
        for (level, color) in bands {
            let rings = outline(level).rings().map(|ring| frame.contour(&ring));
            canvas.draw([fill(&rings.collect::<Vec<_>>(), color)])?;
        }
        for &level in &self.isolines {
            let lines = outline(level).lines().into_iter().map(|line| frame.contour(&line));
            // Without specks: islands no larger than a letter.
            for line in lines.filter(|l| l.iter().any(|&p| distance(p, l[0]) > 6.0 * POINT)) {
                canvas.draw([stroke(&line, pen(Color::BLACK, self.width), Dash::Solid)])?;
                match self.width > BROAD {
                    true => labels.keep_off(&line),
                    false => labels.wanted.push((level, line)),
                }
            }
        }
        Ok(())
    }
}
