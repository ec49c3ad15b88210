//! Contours of a field: bands of colour and lines of equal value.

use super::canvas::{Canvas, Done, pen};
use super::frame::Frame;
use super::geometry::distance;
use super::isoline_label::IsolineLabels;
use super::{Bands, Color, Dash, POINT};
use crate::level_set::{Field, Outline};
use std::sync::OnceLock;

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
    values: bool,
    pub(super) label: String,
    /// Levels, ascending, and their outlines: followed once, for bands and lines.
    known: OnceLock<Vec<(f64, Outline)>>,
}

impl Contours {
    /// A field of which nothing is shown yet.
    pub fn new(field: Field) -> Contours {
        let (bands, isolines, known) = (None, Vec::new(), OnceLock::new());
        Contours { field, bands, isolines, width: 0.6, values: true, label: String::new(), known }
    }

    /// The region where the field is at least `level`, in one colour.
    pub fn region(field: Field, level: f64, color: Color) -> Contours {
        Contours::new(field).bands(Bands::new(vec![level, f64::INFINITY], |_| color))
    }

    /// Paints these bands.
    pub fn bands(self, bands: Bands) -> Contours {
        Contours { bands: Some(bands), known: OnceLock::new(), ..self }
    }

    /// Draws the lines of these values.
    pub fn isolines(self, levels: impl IntoIterator<Item = f64>) -> Contours {
        Contours { isolines: levels.into_iter().collect(), known: OnceLock::new(), ..self }
    }

    /// Sets the width of the lines, in points.
    pub fn width(self, width: f64) -> Contours {
        Contours { width, ..self }
    }

    /// Sets whether values are written into the lines.
    pub fn values(self, values: bool) -> Contours {
        Contours { values, ..self }
    }

    /// Sets the name in the legend.
    pub fn label(self, label: impl Into<String>) -> Contours {
        Contours { label: label.into(), ..self }
    }

    /// Follows all outlines, unless they are known.
    pub(super) fn follow(&self) -> &[(f64, Outline)] {
        self.known.get_or_init(|| {
            let bands = self.bands.iter().flat_map(Bands::ascending).map(|band| band.0);
            let mut levels: Vec<f64> = bands.chain(self.isolines.iter().copied()).collect();
            levels.sort_by(f64::total_cmp);
            levels.dedup();
            let outlines = self.field.outlines(&levels);
            levels.into_iter().zip(outlines).collect()
        })
    }

    fn outline(&self, level: f64) -> &Outline {
        let known = self.follow();
        &known[known.partition_point(|one| one.0 < level)].1
    }

    /// Draws bands and lines; values are asked for.
    pub(super) fn draw(&self, canvas: &Canvas, frame: &Frame, labels: &mut IsolineLabels) -> Done {
        // Each band is painted from its lower edge all the way up and the next one over it: neighbours overlap, so no
        // seam of background can show between them.
        for (level, color) in self.bands.iter().flat_map(Bands::ascending) {
            let rings = self.outline(level).rings().map(|ring| frame.contour(&ring));
            canvas.fill(&rings.collect::<Vec<_>>(), color)?;
        }
        for &level in &self.isolines {
            let lines = self.outline(level).lines().into_iter().map(|line| frame.contour(&line));
            // Without specks: islands no larger than a letter.
            for line in lines.filter(|l| l.iter().any(|&p| distance(p, l[0]) > 6.0 * POINT)) {
                canvas.stroke(&line, pen(Color::BLACK, self.width), Dash::Solid)?;
                match self.values {
                    true => labels.wanted.push((level, line)),
                    false => labels.keep_off(&line),
                }
            }
        }
        Ok(())
    }
}
