//! Plotters' backend for PNG: tiny-skia draws, antialiased.

use super::{error::FigureError, text};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
};
use std::convert::Infallible;
use tiny_skia::{
    Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, Transform,
};

/// Dots per inch.
const DPI: f64 = 300.0;
/// Units of the canvas in an inch.
const UNITS: f64 = 72.0 * text::POINT;

/// A canvas of pixels, in units of the canvas.
pub(super) struct Raster<'a> {
    size: (u32, u32),
    pixels: &'a mut Pixmap,
}

/// White pixels for a canvas of the given size in units.
pub(super) fn pixels((width, height): (u32, u32)) -> Result<Pixmap, FigureError> {
    let dots = |units: u32| (f64::from(units) * DPI / UNITS).round() as u32;
    let too_small =
        FigureError::TooSmall { width: f64::from(width) / 20.0, height: f64::from(height) / 20.0 };
    let mut pixels = Pixmap::new(dots(width), dots(height)).ok_or(too_small)?;
    pixels.fill(Color::WHITE);
    Ok(pixels)
}

/// The pixels as PNG with its physical size recorded.
pub(super) fn png(pixels: &Pixmap) -> Result<Vec<u8>, FigureError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, pixels.width(), pixels.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let per_metre = (DPI / 0.0254).round() as u32;
    let unit = png::Unit::Meter;
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit }));
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_filter(png::FilterType::Up);
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    // Painted on white nothing is transparent.
    let opaque: Vec<u8> =
        pixels.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
    writer.write_image_data(&opaque)?;
    writer.finish()?;
    Ok(bytes)
}

impl Raster<'_> {
    pub(super) fn new(size: (u32, u32), pixels: &mut Pixmap) -> Raster<'_> {
        Raster { size, pixels }
    }

    /// Paints a path, filled or as a line of the given width.
    fn paint(&mut self, path: Option<Path>, color: BackendColor, width: Option<u32>) {
        let Some(path) = path else { return };
        let (red, green, blue) = color.rgb;
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color_rgba8(red, green, blue, (255.0 * color.alpha).round() as u8);
        let scale = (DPI / UNITS) as f32;
        let scale = Transform::from_scale(scale, scale);
        match width {
            None => self.pixels.fill_path(&path, &paint, FillRule::Winding, scale, None),
            Some(width) => {
                let stroke =
                    Stroke { width: width as f32, line_join: LineJoin::Round, ..Stroke::default() };
                self.pixels.stroke_path(&path, &paint, &stroke, scale, None);
            }
        }
    }
}

fn path(points: impl IntoIterator<Item = (f32, f32)>) -> PathBuilder {
    let mut path = PathBuilder::new();
    for (x, y) in points {
        if path.is_empty() { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    path
}

fn at(p: BackendCoord) -> (f32, f32) {
    (p.0 as f32, p.1 as f32)
}

type Done = Result<(), DrawingErrorKind<Infallible>>;

impl DrawingBackend for Raster<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Done {
        let unit = Rect::from_xywh(x as f32, y as f32, 1.0, 1.0).map(PathBuilder::from_rect);
        self.paint(unit, color, None);
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S) -> Done {
        self.draw_path([a, b], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): BackendCoord,
        (right, bottom): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Done {
        let (a, b) = (at((left, top)), at((right, bottom)));
        let rect = Rect::from_ltrb(a.0, a.1, b.0, b.1).map(PathBuilder::from_rect);
        self.paint(rect, style.color(), (!fill).then(|| style.stroke_width()));
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Done {
        let line = path(points.into_iter().map(at)).finish();
        self.paint(line, style.color(), Some(style.stroke_width()));
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        centre: BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Done {
        let (x, y) = at(centre);
        let circle = PathBuilder::from_circle(x, y, radius as f32);
        self.paint(circle, style.color(), (!fill).then(|| style.stroke_width()));
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Done {
        self.paint(path(points.into_iter().map(at)).finish(), style.color(), None);
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        letters: &str,
        style: &S,
        place: BackendCoord,
    ) -> Done {
        let em = text::em(style);
        let angle = text::turn(&style.transform());
        let anchor = style.anchor();
        let back = text::back(&anchor.h_pos) * text::width(letters, em);
        let down = text::drop(&anchor.v_pos) * em;
        let (sin, cos) = angle.sin_cos();
        let origin = [
            f64::from(place.0) - back * cos + down * sin,
            f64::from(place.1) + back * sin + down * cos,
        ];
        let mut outlines = PathBuilder::new();
        for ring in text::rings(letters, origin, em, angle) {
            let ring = ring.into_iter().map(|p| (p[0] as f32, p[1] as f32));
            if let Some(ring) = path(ring).finish() {
                outlines.push_path(&ring);
                outlines.close();
            }
        }
        self.paint(outlines.finish(), style.color(), None);
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        Ok(text::extent(text, style))
    }
}
