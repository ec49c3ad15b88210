//! Figures: panels in a grid, with what they share.

use super::canvas::{Canvas, Done, fill};
use super::geometry::Rect;
use super::legend::Legend;
use super::panel::Plot;
use super::{Color, ColorBar, FigureError, POINT, Panel, Svg, text};
use plotters::{backend::SVGBackend, drawing::IntoDrawingArea};
use plotters_backend::DrawingBackend;

const TITLE_SIZE: f64 = 10.5;
/// Between neighbouring panels, beside their labels.
const PANEL_GAP: f64 = 7.0 * POINT;
/// From panels to colour bars.
const BAR_GAP: f64 = 9.0 * POINT;
/// Around everything.
const PAGE_MARGIN: f64 = 4.0 * POINT;
/// What XML does not have, and what turns the direction of all that follows: titles are a user's.
const UNDRAWN: &str =
    "\u{fffe}\u{ffff}\u{202a}\u{202b}\u{202c}\u{202d}\u{202e}\u{2066}\u{2067}\u{2068}\u{2069}";

/// Panels in a grid, with title and colour bars in common, and below them a legend of all layers that have a label.
#[derive(Debug, Clone)]
pub struct Figure {
    grid: (usize, usize),
    /// In inches.
    size: (f64, f64),
    title: String,
    panels: Vec<Panel>,
    color_bars: Vec<ColorBar>,
}

impl Figure {
    /// A figure for `rows` x `columns` panels, 7 inches wide (the text width of most journals) and 5 high.
    pub fn grid(rows: usize, columns: usize) -> Figure {
        let (title, panels, color_bars) = (String::new(), Vec::new(), Vec::new());
        Figure { grid: (rows, columns), size: (7.0, 5.0), title, panels, color_bars }
    }

    /// A figure of one panel.
    pub fn single(panel: Panel) -> Figure {
        Figure::grid(1, 1).panel(panel)
    }

    /// Sets the size in inches.
    pub fn size(self, width: f64, height: f64) -> Figure {
        Figure { size: (width, height), ..self }
    }

    /// Sets the title above all panels; a long one takes several lines.
    pub fn title(self, title: impl Into<String>) -> Figure {
        Figure { title: title.into(), ..self }
    }

    /// Adds the next panel; panels fill the grid row by row.
    pub fn panel(self, panel: Panel) -> Figure {
        self.panels([panel])
    }

    /// Adds panels in order.
    pub fn panels(mut self, panels: impl IntoIterator<Item = Panel>) -> Figure {
        self.panels.extend(panels);
        self
    }

    /// Shows a colour bar at the right, for all panels; several stand above each other, the first one lowest.
    pub fn color_bar(mut self, bar: ColorBar) -> Figure {
        self.color_bars.push(bar);
        self
    }

    /// Draws it, as SVG, which is [rendered](Svg::png) as PNG.
    ///
    /// # Errors
    /// If an axis has an impossible range, or the panels do not fit.
    pub fn svg(&self) -> Result<Svg, FigureError> {
        let mut document = String::new();
        let (wide, high) = self.size;
        let [width, height] = [wide, high].map(|inches| (inches * 72.0 * POINT).round() as u32);
        self.draw(SVGBackend::with_string(&mut document, (width, height)))?;
        let units = format!(r#"width="{width}" height="{height}""#);
        let size =
            format!(r#"role="img" stroke-linejoin="round" width="{wide}in" height="{high}in""#);
        // In inches; letters centred by their capitals or standing on descenders: plotters' x-heights depend on the viewer.
        let document = document
            .replace(&units, &size)
            .replace(r#"dy="0.5ex""#, &format!(r#"dy="{}em""#, 0.5 * text::CAP_HEIGHT))
            .replace(r#"dy="-0.5ex""#, &format!(r#"dy="{}em""#, -text::DESCENT))
            .replace(|c: char| c.is_control() && c != '\n' || UNDRAWN.contains(c), "�");
        Ok(Svg(document))
    }

    fn draw(&self, backend: SVGBackend) -> Done {
        let (rows, columns) = self.grid;
        if self.panels.len() > rows * columns || self.panels.is_empty() {
            return Err(FigureError::PanelCount(self.panels.len(), rows, columns));
        }
        let plots = self.panels.iter().map(Panel::plot).collect::<Result<Vec<Plot>, _>>()?;
        let (width, height) = backend.get_size();
        let page = Rect { left: 0.0, top: 0.0, right: width.into(), bottom: height.into() };
        let mut area = page.grown(-PAGE_MARGIN);
        let title = text::wrapped(&self.title, TITLE_SIZE, area.width());
        let title_line = 1.3 * TITLE_SIZE * POINT;
        area.top += title.len() as f64 * title_line;
        let legend = Legend::new(&self.panels, area.width());
        area.bottom -= legend.height();
        let bars = self.color_bars.len() as f64;
        // Bars are as long as the plots, which are shorter than the area by titles and axes.
        let length = 0.8 * area.height() / bars;
        let breadths = self.color_bars.iter().map(|bar| BAR_GAP + bar.breadth(length));
        area.right -= breadths.fold(0.0, f64::max);
        // From panel to panel.
        let pitch = [
            (area.width() + PANEL_GAP) / columns as f64,
            (area.height() + PANEL_GAP) / rows as f64,
        ];
        let inner = |[left, right, above, below]: [f64; 4]| {
            [pitch[0] - PANEL_GAP - left - right, pitch[1] - PANEL_GAP - above - below]
        };
        let mut margins = [0.0; 4];
        // Margins depend on the ticks and these on the size: three rounds settle it.
        for _ in 0..3 {
            let [width, height] = inner(margins);
            if !(width >= 30.0 * POINT && height >= 30.0 * POINT) {
                return Err(FigureError::TooSmall(width / POINT, height / POINT));
            }
            for needed in plots.iter().map(|plot| plot.margins(width, height)) {
                margins = std::array::from_fn(|k| needed[k].max(margins[k]));
            }
        }
        let [width, height] = inner(margins);
        let place = |k: usize| {
            let left = area.left + margins[0] + (k % columns) as f64 * pitch[0];
            let top = area.top + margins[2] + (k / columns) as f64 * pitch[1];
            Rect { left, top, right: left + width, bottom: top + height }
        };
        let canvas = Canvas(backend.into_drawing_area());
        canvas.draw([fill(&[page.corners()], Color::WHITE)])?;
        let middle = 0.5 * page.right;
        for (k, line) in title.iter().enumerate() {
            let ascent = (text::ASCENT + text::DESCENT) * TITLE_SIZE * POINT;
            let down = PAGE_MARGIN + k as f64 * title_line + ascent;
            canvas.write(line, &text::above(TITLE_SIZE), [middle, down])?;
        }
        let (top, bottom) = (place(0).top, place(rows * columns - 1).bottom);
        let step = (bottom - top + BAR_GAP) / bars;
        for (k, bar) in self.color_bars.iter().enumerate() {
            let low = bottom - k as f64 * step;
            bar.draw(&canvas, area.right + BAR_GAP, (low, low - step + BAR_GAP))?;
        }
        legend.draw(&canvas, middle, area.bottom)?;
        for (k, plot) in plots.iter().enumerate() {
            plot.draw(&canvas, place(k), margins)?;
        }
        Ok(canvas.0.present()?)
    }
}

#[cfg(test)]
mod tests;
