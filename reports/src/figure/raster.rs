//! Plotters' backend for PNG: tiny-skia draws, antialiased.

use super::{FigureError, text};
use plotters::style::{
    FontTransform,
    text_anchor::{HPos, VPos},
};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
};
use std::convert::Infallible;
use std::f64::consts::{FRAC_PI_2, PI};
use tiny_skia::{FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

/// Dots per inch.
const DPI: f64 = 300.0;
/// Units of the canvas in an inch.
const UNITS: f64 = 72.0 * text::POINT;

/// A canvas of pixels, in units of the canvas.
pub(super) struct Raster<'a> {
    size: (u32, u32),
    pixels: &'a mut Pixmap,
}

/// Pixels for a canvas of the given size in units.
pub(super) fn pixels((width, height): (u32, u32)) -> Result<Pixmap, FigureError> {
    let dots = |units: u32| (f64::from(units) * DPI / UNITS).round() as u32;
    let points = |units: u32| f64::from(units) / text::POINT;
    let too_small = FigureError::TooSmall(points(width), points(height));
    Pixmap::new(dots(width), dots(height)).ok_or(too_small)
}

/// The pixels as PNG with its physical size recorded.
pub(super) fn png(pixels: Pixmap) -> Result<Vec<u8>, FigureError> {
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
    // Painted on white nothing is transparent: three bytes of four, in their own place.
    let mut opaque = pixels.take();
    let count = opaque.len() / 4;
    for k in 0..count {
        let [red, green, blue] = [0, 1, 2].map(|part| opaque[4 * k + part]);
        opaque[3 * k..3 * k + 3].copy_from_slice(&[red, green, blue]);
    }
    writer.write_image_data(&opaque[..3 * count])?;
    writer.finish()?;
    Ok(bytes)
}

impl Raster<'_> {
    pub(super) fn new(size: (u32, u32), pixels: &mut Pixmap) -> Raster<'_> {
        Raster { size, pixels }
    }

    /// Paints a path, filled or as a line of the given width.
    fn paint(&mut self, path: Option<Path>, color: BackendColor, width: Option<u32>) -> Done {
        let Some(path) = path else { return Ok(()) };
        let (red, green, blue) = color.rgb;
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color_rgba8(red, green, blue, (255.0 * color.alpha).round() as u8);
        let scale = Transform::from_scale((DPI / UNITS) as f32, (DPI / UNITS) as f32);
        match width.map(|width| width as f32) {
            None => self.pixels.fill_path(&path, &paint, FillRule::Winding, scale, None),
            Some(width) => {
                let stroke = Stroke { width, line_join: LineJoin::Round, ..Stroke::default() };
                self.pixels.stroke_path(&path, &paint, &stroke, scale, None);
            }
        }
        Ok(())
    }
}

fn path(points: impl IntoIterator<Item = (f32, f32)>) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (x, y) in points {
        if path.is_empty() { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    path.finish()
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
        let square = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)].map(at);
        self.paint(path(square), color, None)
    }

    fn draw_line<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S) -> Done {
        self.draw_path([a, b], style)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Done {
        self.paint(path(points.into_iter().map(at)), style.color(), Some(style.stroke_width()))
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
        self.paint(circle, style.color(), (!fill).then(|| style.stroke_width()))
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Done {
        self.paint(path(points.into_iter().map(at)), style.color(), None)
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        letters: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> Done {
        let em = style.size() / text::SIZE_OVER_EM;
        let angle = match style.transform() {
            FontTransform::None => 0.0,
            FontTransform::Rotate270 => FRAC_PI_2,
            FontTransform::Rotate180 => PI,
            FontTransform::Rotate90 => -FRAC_PI_2,
        };
        let back = text::width(letters, em)
            * match style.anchor().h_pos {
                HPos::Left => 0.0,
                HPos::Center => 0.5,
                HPos::Right => 1.0,
            };
        // Capitals hang from, are centred on and, with their descenders, stand on the place.
        let down = em
            * match style.anchor().v_pos {
                VPos::Top => 0.76,
                VPos::Center => 0.5 * text::CAP_HEIGHT,
                VPos::Bottom => -text::DESCENT,
            };
        let (sin, cos) = angle.sin_cos();
        let (x, y) = (f64::from(x), f64::from(y));
        let origin = [x - back * cos + down * sin, y + back * sin + down * cos];
        let mut outlines = PathBuilder::new();
        for ring in text::rings(letters, origin, em, angle) {
            if let Some(ring) = path(ring.into_iter().map(|p| (p[0] as f32, p[1] as f32))) {
                outlines.push_path(&ring);
                outlines.close();
            }
        }
        self.paint(outlines.finish(), style.color(), None)
    }
}
