//! Figures: panels in a grid, with what they share.

use super::{
    FigureError,
    color::Color,
    color_bar::ColorBar,
    geometry::Rect,
    ink::{Ink, failed},
    legend,
    panel::{LABEL_GAP, Panel},
    raster::{self, Raster},
    text::{self, POINT},
};
use plotters::{
    backend::SVGBackend,
    drawing::IntoDrawingArea,
    style::{
        FontTransform,
        text_anchor::{HPos, VPos},
    },
};
use plotters_backend::DrawingBackend;

const TITLE_SIZE: f64 = 10.5;
/// Between neighbouring panels, beside their labels.
const PANEL_GAP: f64 = 7.0 * POINT;
/// From panels to colour bars.
const BAR_GAP: f64 = 9.0 * POINT;
/// Around everything.
const PAGE_MARGIN: f64 = 4.0 * POINT;

/// Panels in a grid, with title, legend and colour bars in common.
///
/// The picture is made in memory as PNG or SVG; both show the same, and equal figures give equal bytes.
#[derive(Debug, Clone)]
pub struct Figure {
    rows: usize,
    columns: usize,
    width: f64,
    height: f64,
    title: String,
    panels: Vec<Panel>,
    color_bars: Vec<ColorBar>,
    legend_below: bool,
}

impl Figure {
    /// A figure for `rows` x `columns` panels, 7 inches wide (the text width of most journals) and 5 high.
    pub fn grid(rows: usize, columns: usize) -> Figure {
        Figure {
            rows,
            columns,
            width: 7.0,
            height: 5.0,
            title: String::new(),
            panels: Vec::new(),
            color_bars: Vec::new(),
            legend_below: false,
        }
    }

    /// A figure of one panel.
    pub fn single(panel: Panel) -> Figure {
        Figure::grid(1, 1).panel(panel)
    }

    /// Sets the size in inches.
    pub fn size(mut self, width: f64, height: f64) -> Figure {
        (self.width, self.height) = (width, height);
        self
    }

    /// Sets the title above all panels; a long one takes several lines.
    pub fn title(mut self, title: impl Into<String>) -> Figure {
        self.title = title.into();
        self
    }

    /// Adds the next panel; panels fill the grid row by row.
    pub fn panel(mut self, panel: Panel) -> Figure {
        self.panels.push(panel);
        self
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

    /// Shows one legend below all panels, with the names of all layers.
    pub fn legend_below(mut self) -> Figure {
        self.legend_below = true;
        self
    }

    /// The picture as PNG at 300 dots per inch, with its size recorded in the file.
    ///
    /// # Errors
    /// If an axis has an impossible range, or the panels do not fit.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        let mut pixels = raster::pixels(self.units())?;
        self.draw_on(Raster::new(self.units(), &mut pixels))?;
        raster::png(pixels)
    }

    /// The picture as SVG. Axes, titles and legends are text.
    ///
    /// # Errors
    /// As [`Figure::png`].
    pub fn svg(&self) -> Result<String, FigureError> {
        let mut document = String::new();
        let (width, height) = self.units();
        self.draw_on(SVGBackend::with_string(&mut document, (width, height)))?;
        // Its physical size instead of units of the canvas.
        let inches = |units: u32| f64::from(units) / (72.0 * POINT);
        let size = format!(
            "role=\"img\" stroke-linejoin=\"round\" width=\"{}in\" height=\"{}in\"",
            inches(width),
            inches(height)
        );
        Ok(document.replacen(&format!("width=\"{width}\" height=\"{height}\""), &size, 1))
    }

    /// The size of the canvas.
    fn units(&self) -> (u32, u32) {
        let units = |inches: f64| (inches * 72.0 * POINT).round() as u32;
        (units(self.width), units(self.height))
    }

    fn draw_on<DB: DrawingBackend>(&self, backend: DB) -> Result<(), FigureError> {
        let (rows, columns) = (self.rows, self.columns);
        if self.panels.len() > rows * columns || self.panels.is_empty() {
            return Err(FigureError::PanelCount(self.panels.len(), rows, columns));
        }
        let panels: Vec<Panel> =
            self.panels.iter().map(Panel::resolve).collect::<Result<_, _>>()?;
        let (width, height) = self.units();
        let page = Rect { left: 0.0, top: 0.0, right: width.into(), bottom: height.into() };
        let mut area = page.grown(-PAGE_MARGIN);
        let title = text::wrapped(&self.title, TITLE_SIZE, area.width());
        let title_line = 1.3 * TITLE_SIZE * POINT;
        area.top += title.len() as f64 * title_line;
        let layers = self.panels.iter().filter(|_| self.legend_below).flat_map(|p| &p.layers);
        let legend = legend::rows(layers, area.width());
        area.bottom -= legend.len() as f64 * (legend::ROW + LABEL_GAP / legend.len().max(1) as f64);
        let bars = self.color_bars.len() as f64;
        // Bars are as long as the plots, which are shorter than the area by titles and axes.
        let length = 0.8 * area.height() / bars;
        let breadths = self.color_bars.iter().map(|bar| BAR_GAP + bar.breadth(length));
        area.right -= breadths.fold(0.0, f64::max);
        let cell = Rect {
            right: area.left + (area.width() + PANEL_GAP) / columns as f64 - PANEL_GAP,
            bottom: area.top + (area.height() + PANEL_GAP) / rows as f64 - PANEL_GAP,
            ..area
        };
        let inner = |m: Rect| (cell.width() - m.left - m.right, cell.height() - m.top - m.bottom);
        let mut margins = Rect { left: 0.0, top: 0.0, right: 0.0, bottom: 0.0 };
        // Margins depend on the ticks and these on the size: three rounds settle it.
        for _ in 0..3 {
            let (width, height) = inner(margins);
            if !(width >= 30.0 * POINT && height >= 30.0 * POINT) {
                return Err(FigureError::TooSmall(width / POINT, height / POINT));
            }
            for m in panels.iter().map(|panel| panel.margins(width, height)) {
                margins = margins.union_of_sides(m);
            }
        }
        let plot = |row: usize, column: usize| {
            let left = area.left + margins.left + column as f64 * (cell.width() + PANEL_GAP);
            let top = area.top + margins.top + row as f64 * (cell.height() + PANEL_GAP);
            let (width, height) = inner(margins);
            Rect { left, top, right: left + width, bottom: top + height }
        };
        let canvas = backend.into_drawing_area();
        Ink::fill(&canvas, &[page.corners()], Color::WHITE)?;
        for (k, line) in title.iter().enumerate() {
            let at = [0.5 * page.right, PAGE_MARGIN + k as f64 * title_line];
            canvas.write(line, TITLE_SIZE, at, (HPos::Center, VPos::Top, FontTransform::None))?;
        }
        for (k, panel) in panels.iter().enumerate() {
            panel.draw(&canvas, plot(k / columns, k % columns), margins)?;
        }
        let (top, bottom) = (plot(0, 0).top, plot(rows - 1, 0).bottom);
        let step = (bottom - top + BAR_GAP) / bars;
        for (k, bar) in self.color_bars.iter().enumerate() {
            let low = bottom - k as f64 * step;
            bar.draw(&canvas, area.right + BAR_GAP, (low, low - step + BAR_GAP))?;
        }
        legend::draw(&canvas, &legend, 0.5 * page.right, area.bottom + LABEL_GAP)?;
        canvas.present().map_err(failed)
    }
}

#[cfg(test)]
mod tests;
