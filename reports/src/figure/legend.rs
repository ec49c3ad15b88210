//! The legend below all panels: each name is plotters' legend of a chart of its own, as plotters has but one column in one
//! chart; here they are put into rows.

use super::canvas::{Canvas, Done, fill, outline, pen, stroke};
use super::geometry::Rect;
use super::panel::LABEL_GAP;
use super::{Color, Dash, POINT, Panel, text};
use plotters::backend::SVGBackend;
use plotters::chart::{ChartBuilder, SeriesLabelPosition::Coordinate};
use plotters::element::{Drawable, PointCollection};
use plotters_backend::{BackendCoord, DrawingErrorKind};

/// Size of the names, in points.
const SIZE: f64 = 7.8;
/// From line to line.
const ROW: f64 = 1.55 * SIZE * POINT;
/// Length of a sample, and of the room between entries.
const SAMPLE: f64 = 20.0 * POINT;
/// From sample to name.
const GAP: f64 = 4.0 * POINT;

/// All names in the panels, each with the first panel that has it and the room it takes up to the next one, in rows.
pub(super) struct Legend<'a>(Vec<Vec<(&'a str, &'a Panel, f64)>>);

impl<'a> Legend<'a> {
    /// The legend of the panels, `room` wide at most; what has the same name shares an entry.
    pub(super) fn new(panels: &'a [Panel], room: f64) -> Legend<'a> {
        let mut entries: Vec<(&str, &Panel, f64)> = Vec::new();
        for panel in panels {
            let contours = panel.contours.iter().map(|contours| contours.label.as_str());
            for name in contours.chain(panel.series.iter().map(|series| series.label.as_str())) {
                if !name.is_empty() && entries.iter().all(|entry| entry.0 != name) {
                    entries.push((name, panel, 2.0 * SAMPLE + GAP + text::width(name, SIZE)));
                }
            }
        }
        let widths: Vec<f64> = entries.iter().map(|entry| entry.2).collect();
        let rows = text::lines(&widths, room + SAMPLE).into_iter();
        Legend(rows.map(|row| entries[row].to_vec()).collect())
    }

    pub(super) fn height(&self) -> f64 {
        self.0.len() as f64 * ROW + if self.0.is_empty() { 0.0 } else { LABEL_GAP }
    }

    /// Draws the legend from `top` down, each row centred on `middle`.
    pub(super) fn draw(&self, canvas: &Canvas, middle: f64, top: f64) -> Done {
        for (k, row) in self.0.iter().enumerate() {
            let y = top + LABEL_GAP + (k as f64 + 0.5) * ROW;
            let width: f64 = row.iter().map(|entry| entry.2).sum();
            let mut x = middle - 0.5 * (width - SAMPLE);
            for (name, panel, room) in row {
                let [left, high, wide] = [x, y, *room].map(|length| length.round() as i32);
                let area = canvas.0.clone().shrink((left, high), (wide, 1));
                let mut chart = ChartBuilder::on(&area).build_cartesian_2d(0..1, 0..1)?;
                // Names stand level with the upper edge of the chart, not below it.
                let start = |(x, _): BackendCoord| Sample { panel, name, start: (x, 0) };
                chart.draw_series(std::iter::empty::<Sample>())?.label(*name).legend(start);
                let mut labels = chart.configure_series_labels();
                labels.legend_area_size((SAMPLE + GAP) as i32).label_font(text::beside(SIZE));
                labels.margin(0).position(Coordinate(0, 0)).draw()?;
                x += room;
            }
        }
        Ok(())
    }
}

/// The look of everything with a name.
struct Sample<'a> {
    panel: &'a Panel,
    name: &'a str,
    start: BackendCoord,
}

impl<'a> PointCollection<'a, BackendCoord> for &'a Sample<'_> {
    type Point = BackendCoord;
    type IntoIter = [BackendCoord; 1];
    fn point_iter(self) -> Self::IntoIter {
        [self.start]
    }
}

impl Drawable<SVGBackend<'_>> for Sample<'_> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        places: I,
        backend: &mut SVGBackend,
        size: (u32, u32),
    ) -> Result<(), DrawingErrorKind<std::io::Error>> {
        let Sample { panel, name, .. } = self;
        for [x, y] in places.map(|(x, y)| [x, y].map(f64::from)) {
            let line = [[x, y], [x + SAMPLE, y]];
            let half = 0.4 * SIZE * POINT;
            let patch = Rect { left: x, top: y - half, right: x + SAMPLE, bottom: y + half };
            let contours = panel.contours.iter().filter(|contours| contours.label == *name);
            let contours = contours.flat_map(|contours| match &contours.bands {
                None => vec![stroke(&line, pen(Color::BLACK, contours.width), Dash::Solid)],
                Some(bands) => vec![
                    fill(&[patch.corners()], bands.colors[0]),
                    outline(&patch.corners(), pen(Color::GREY, 0.4)),
                ],
            });
            let series = panel.series.iter().filter(|series| series.label == *name);
            for element in contours.chain(series.flat_map(|series| series.elements(&line))) {
                element.draw(element.point_iter().iter().copied(), backend, size)?;
            }
        }
        Ok(())
    }
}
