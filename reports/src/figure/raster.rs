//! The picture in pixels: resvg renders the SVG, antialiased, with letters of the bundled font.

use super::{FigureError, text};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Source};
use resvg::usvg::{Options, Tree};
use std::sync::{Arc, LazyLock};

/// Dots per inch.
const DPI: f32 = 300.0;

pub(super) static OPTIONS: LazyLock<Options<'static>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_font_source(Source::Binary(Arc::new(text::FONT_FILE)));
    Options { dpi: DPI, fontdb: Arc::new(fonts), ..Options::default() }
});

/// An opaque SVG as PNG, with its physical size recorded.
pub(super) fn png(svg: &str) -> Result<Vec<u8>, FigureError> {
    let picture = Tree::from_str(svg, &OPTIONS)?;
    let size = [picture.size().width(), picture.size().height()];
    let [columns, rows] = size.map(|length| length.round() as u32);
    let mut pixels = Pixmap::new(columns, rows).expect("a plot is larger than a dot");
    resvg::render(&picture, Transform::identity(), &mut pixels.as_mut());
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, columns, rows);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let (per_metre, unit) = ((DPI / 0.0254).round() as u32, png::Unit::Meter);
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit }));
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_filter(png::Filter::Up);
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
