//! Plotters' backend for PNG: tiny-skia draws, antialiased.

use super::{FigureError, POINT, text};
use plotters::style::FontTransform;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
};
use std::convert::Infallible;
use std::f64::consts::{FRAC_PI_2, PI};
use tiny_skia::{FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

/// Dots per inch.
const DPI: f64 = 300.0;
/// Dots per unit of the canvas.
const SCALE: f64 = DPI / (72.0 * POINT);

/// Pixels under a canvas of a size in units.
pub(super) struct Raster<'a> {
    size: (u32, u32),
    pixels: &'a mut Pixmap,
}

/// What is drawn on a canvas of the given size in units as PNG, with its physical size recorded.
pub(super) fn png(
    size: (u32, u32),
    draw: impl FnOnce(Raster) -> Result<(), FigureError>,
) -> Result<Vec<u8>, FigureError> {
    let [width, height] = [size.0, size.1].map(|units| (f64::from(units) * SCALE).round() as u32);
    let too_small = FigureError::TooSmall(f64::from(size.0) / POINT, f64::from(size.1) / POINT);
    let mut pixels = Pixmap::new(width, height).ok_or(too_small)?;
    draw(Raster { size, pixels: &mut pixels })?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let (per_metre, unit) = ((DPI / 0.0254).round() as u32, png::Unit::Meter);
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

type Done = Result<(), DrawingErrorKind<Infallible>>;

impl Raster<'_> {
    /// Paints a path, filled or as a line of the given width.
    fn paint(&mut self, path: Option<Path>, color: BackendColor, width: Option<u32>) -> Done {
        let Some(path) = path else { return Ok(()) };
        let (red, green, blue) = color.rgb;
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color_rgba8(red, green, blue, (255.0 * color.alpha).round() as u8);
        let scale = Transform::from_scale(SCALE as f32, SCALE as f32);
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

fn polyline(points: impl IntoIterator<Item = BackendCoord>) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (x, y) in points {
        let (x, y) = (x as f32, y as f32);
        if path.is_empty() { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    path.finish()
}

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
        self.paint(polyline([(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]), color, None)
    }

    fn draw_line<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S) -> Done {
        self.draw_path([a, b], style)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Done {
        self.paint(polyline(points), style.color(), Some(style.stroke_width()))
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        (x, y): BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Done {
        let circle = PathBuilder::from_circle(x as f32, y as f32, radius as f32);
        self.paint(circle, style.color(), (!fill).then(|| style.stroke_width()))
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Done {
        self.paint(polyline(points), style.color(), None)
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        letters: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> Done {
        let angle = match style.transform() {
            FontTransform::None => 0.0,
            FontTransform::Rotate270 => FRAC_PI_2,
            FontTransform::Rotate180 => PI,
            FontTransform::Rotate90 => -FRAC_PI_2,
        };
        let (em, anchor) = (style.size() / text::SIZE_OVER_EM, style.anchor());
        let mut path = PathBuilder::new();
        let anchor = (anchor.h_pos, anchor.v_pos);
        for ring in text::rings(letters, em, [x.into(), y.into()], anchor, angle) {
            path.move_to(ring[0][0] as f32, ring[0][1] as f32);
            ring[1..].iter().for_each(|p| path.line_to(p[0] as f32, p[1] as f32));
            path.close();
        }
        self.paint(path.finish(), style.color(), None)
    }
}
