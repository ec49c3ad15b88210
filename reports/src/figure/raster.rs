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

/// A figure drawn as SVG, in which axes, titles and legends are text.
#[derive(Debug, PartialEq)]
pub struct Svg(pub String);

impl Svg {
    /// The same picture as PNG at 300 dots per inch, with its size recorded in the file.
    ///
    /// # Errors
    /// If it cannot be rendered or encoded.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        let picture = Tree::from_str(&self.0, &OPTIONS)?;
        let size = picture.size();
        let [columns, rows] = [size.width(), size.height()].map(|length| length.round() as u32);
        let mut pixels = Pixmap::new(columns, rows).expect("a plot is larger than a dot");
        resvg::render(&picture, Transform::identity(), &mut pixels.as_mut());
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, columns, rows);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let [xppu, yppu] = [(DPI / 0.0254).round() as u32; 2];
        encoder.set_pixel_dims(Some(png::PixelDimensions { xppu, yppu, unit: png::Unit::Meter }));
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Up);
        let mut writer = encoder.write_header()?;
        // Painted on white nothing is transparent.
        let dots = pixels.data().as_chunks().0.iter();
        let opaque: Vec<u8> = dots.flat_map(|&[red, green, blue, _]| [red, green, blue]).collect();
        writer.write_image_data(&opaque)?;
        writer.finish()?;
        Ok(bytes)
    }
}
