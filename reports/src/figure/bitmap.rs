//! Scenes as PNG images.
//!
//! Polygons are filled with coverage: each pixel row is eight sub-rows, on which spans are exact along x. This is what a
//! large image filtered down would give, without its memory.

use super::{
    color::Color,
    error::FigureError,
    font,
    geometry::{Point, Rect, dashes},
    scene::{Scene, Shape, Text},
    stroke::{circle_ring, stroke_rings},
};
use ab_glyph::OutlineCurve;

/// Sub-rows per pixel row; a power of two keeps the sums of coverage exact.
const SUBROWS: usize = 8;

/// The scene as a PNG of `dpi` dots per inch, with its physical size recorded.
pub(super) fn png(scene: &Scene, dpi: f64) -> Result<Vec<u8>, FigureError> {
    let scale = dpi / 72.0;
    let (width, height) = ((scene.width * scale).round(), (scene.height * scale).round());
    let mut bitmap = Bitmap::new(width as usize, height as usize);
    for (clip, shape) in &scene.items {
        bitmap.clip = clip.unwrap_or(scene_rect(scene)).scaled(scale);
        bitmap.draw(shape, scale);
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, bitmap.width as u32, bitmap.height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let per_metre = (dpi / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_filter(png::FilterType::Up);
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&bitmap.pixels)?;
    writer.finish()?;
    Ok(bytes)
}

fn scene_rect(scene: &Scene) -> Rect {
    Rect { left: 0.0, top: 0.0, right: scene.width, bottom: scene.height }
}

impl Rect {
    fn scaled(&self, by: f64) -> Rect {
        Rect {
            left: self.left * by,
            top: self.top * by,
            right: self.right * by,
            bottom: self.bottom * by,
        }
    }
}

/// An edge of a polygon between two sub-rows.
struct Edge {
    first: usize,
    end: usize,
    /// x on the first sub-row and its step from one to the next.
    x: f64,
    step: f64,
    winding: i32,
}

struct Bitmap {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
    /// In pixels.
    clip: Rect,
    /// Coverage of the current row: of single pixels, and changes that last to the right.
    single: Vec<f32>,
    lasting: Vec<f32>,
}

impl Bitmap {
    fn new(width: usize, height: usize) -> Bitmap {
        Bitmap {
            width,
            height,
            pixels: vec![255; 3 * width * height],
            clip: Rect { left: 0.0, top: 0.0, right: width as f64, bottom: height as f64 },
            single: vec![0.0; width + 2],
            lasting: vec![0.0; width + 2],
        }
    }

    fn draw(&mut self, shape: &Shape, scale: f64) {
        let at = |p: &Point| [p[0] * scale, p[1] * scale];
        match shape {
            Shape::Fill { rings, color, opacity } => {
                let rings: Vec<Vec<Point>> =
                    rings.iter().map(|r| r.iter().map(at).collect()).collect();
                self.fill(&rings, *color, *opacity);
            }
            Shape::Stroke { lines, closed, pen } => {
                let dash: Vec<f64> = pen.dash.iter().map(|d| d * scale).collect();
                let mut rings = Vec::new();
                for line in lines {
                    let line: Vec<Point> = line.iter().map(at).collect();
                    if dash.is_empty() {
                        rings.extend(stroke_rings(&line, *closed, pen.width * scale));
                    } else {
                        let whole: Vec<Point> =
                            line.iter().chain(line.first().filter(|_| *closed)).copied().collect();
                        for piece in dashes(&whole, &dash) {
                            rings.extend(stroke_rings(&piece, false, pen.width * scale));
                        }
                    }
                }
                self.fill(&rings, pen.color, 1.0);
            }
            Shape::Circle { centre, radius, fill, pen } => {
                let ring = circle_ring(at(centre), radius * scale);
                if let Some(fill) = fill {
                    self.fill(std::slice::from_ref(&ring), *fill, 1.0);
                }
                if pen.width > 0.0 {
                    self.fill(&stroke_rings(&ring, true, pen.width * scale), pen.color, 1.0);
                }
            }
            Shape::Text(text) => {
                let rings = text_rings(text, scale);
                if let Some(halo) = text.halo {
                    let border: Vec<Vec<Point>> = rings
                        .iter()
                        .flat_map(|r| stroke_rings(r, true, text.halo_width() * scale))
                        .collect();
                    self.fill(&border, halo, 1.0);
                }
                self.fill(&rings, text.color, 1.0);
            }
        }
    }

    /// Fills where the winding number is not zero.
    fn fill(&mut self, rings: &[Vec<Point>], color: Color, opacity: f64) {
        let clip = self.clip;
        let (top, bottom) = (clip.top.max(0.0), clip.bottom.min(self.height as f64));
        let (left, right) = (clip.left.max(0.0), clip.right.min(self.width as f64));
        let mut edges = edges(rings, top, bottom);
        edges.sort_by_key(|e| e.first);
        let mut waiting = edges.into_iter().peekable();
        let mut active: Vec<Edge> = Vec::new();
        let mut crossings: Vec<(f64, i32)> = Vec::new();
        let Some(mut subrow) = waiting.peek().map(|e| e.first) else { return };
        let mut touched: Option<(usize, usize)> = None;
        loop {
            while let Some(edge) = waiting.next_if(|e| e.first <= subrow) {
                active.push(edge);
            }
            crossings.clear();
            crossings.extend(
                active.iter().map(|e| (e.x + e.step * (subrow - e.first) as f64, e.winding)),
            );
            crossings.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let mut winding = 0;
            let mut start = 0.0;
            for &(x, change) in &crossings {
                let before = winding;
                winding += change;
                if before == 0 {
                    start = x;
                } else if winding == 0 {
                    let (from, to) = (start.max(left), x.min(right));
                    if from < to {
                        self.cover(from, to);
                        let (a, b) = (from as usize, (to as usize).min(self.width - 1));
                        touched = Some(touched.map_or((a, b), |(l, r)| (l.min(a), r.max(b))));
                    }
                }
            }
            subrow += 1;
            active.retain(|e| e.end > subrow);
            let done = active.is_empty() && waiting.peek().is_none();
            if (subrow % SUBROWS == 0 || done)
                && let Some((from, to)) = touched.take()
            {
                self.blend((subrow - 1) / SUBROWS, from, to, color, opacity);
            }
            if done {
                return;
            }
        }
    }

    /// Adds one sub-row of the span to the coverage of the current row.
    fn cover(&mut self, from: f64, to: f64) {
        const WEIGHT: f32 = 1.0 / SUBROWS as f32;
        let (a, b) = (from as usize, to as usize);
        if a == b {
            self.single[a] += (to - from) as f32 * WEIGHT;
        } else {
            self.single[a] += (a as f64 + 1.0 - from) as f32 * WEIGHT;
            self.single[b] += (to - b as f64) as f32 * WEIGHT;
            self.lasting[a + 1] += WEIGHT;
            self.lasting[b] -= WEIGHT;
        }
    }

    /// Paints the covered pixels of a row and clears the coverage.
    fn blend(&mut self, row: usize, from: usize, to: usize, color: Color, opacity: f64) {
        let ink = [color.red, color.green, color.blue];
        let mut whole = 0.0f32;
        for column in from..=to {
            whole += self.lasting[column];
            let alpha = (whole + self.single[column]).min(1.0) * opacity as f32;
            self.lasting[column] = 0.0;
            self.single[column] = 0.0;
            if alpha <= 0.0 {
                continue;
            }
            let start = 3 * (row * self.width + column);
            let pixel = &mut self.pixels[start..start + 3];
            if alpha >= 0.999 {
                pixel.copy_from_slice(&ink);
            } else {
                for (p, ink) in pixel.iter_mut().zip(ink) {
                    *p = (f32::from(*p) + alpha * (f32::from(ink) - f32::from(*p))).round() as u8;
                }
            }
        }
        // A span up to the right border leaves its end one pixel beyond it.
        self.lasting[self.width] = 0.0;
        self.single[self.width] = 0.0;
    }
}

/// The edges of the rings with the sub-rows they cross between `top` and `bottom` (pixels).
fn edges(rings: &[Vec<Point>], top: f64, bottom: f64) -> Vec<Edge> {
    // Sub-row k lies at the height (k + 1/2) / SUBROWS.
    let subrow = |y: f64| (y * SUBROWS as f64 - 0.5).ceil().max(0.0) as usize;
    let mut edges = Vec::new();
    for ring in rings {
        for (k, &p) in ring.iter().enumerate() {
            let q = ring[(k + 1) % ring.len()];
            let (a, b, winding) = if p[1] < q[1] { (p, q, 1) } else { (q, p, -1) };
            if a[1] == b[1] || !(a[0] + b[0] + a[1] + b[1]).is_finite() {
                continue;
            }
            let (first, end) = (subrow(a[1].max(top)), subrow(b[1].min(bottom)));
            if first < end {
                let slope = (b[0] - a[0]) / (b[1] - a[1]);
                let y = (first as f64 + 0.5) / SUBROWS as f64;
                let step = slope / SUBROWS as f64;
                edges.push(Edge { first, end, x: a[0] + slope * (y - a[1]), step, winding });
            }
        }
    }
    edges
}

/// The letters of a text as polygons in pixels.
fn text_rings(text: &Text, scale: f64) -> Vec<Vec<Point>> {
    let unit = text.size * scale / font::units_per_em();
    let (sin, cos) = text.angle.to_radians().sin_cos();
    let origin = text.origin();
    let mut rings: Vec<Vec<Point>> = Vec::new();
    for (glyph, start) in font::shape(&text.text).0 {
        let place = |p: ab_glyph::Point| {
            let (x, y) = (unit * (start + f64::from(p.x)), unit * f64::from(p.y));
            [origin[0] * scale + x * cos - y * sin, origin[1] * scale - x * sin - y * cos]
        };
        for contour in font::contours(glyph) {
            let mut ring = vec![place(font::ends(&contour[0]).0)];
            for curve in contour {
                let end = place(font::ends(&curve).1);
                match curve {
                    OutlineCurve::Line(..) => {}
                    OutlineCurve::Quad(a, c, _) => {
                        ring.extend(bend(place(a), place(c), place(c), end, 2.0 / 3.0));
                    }
                    OutlineCurve::Cubic(a, c, d, _) => {
                        ring.extend(bend(place(a), place(c), place(d), end, 1.0));
                    }
                }
                ring.push(end);
            }
            rings.push(ring);
        }
    }
    rings
}

/// Inner points of a cubic curve whose control points lie a fraction `pull` of the way to the given ones
/// (2/3 turns the control point of a quadratic curve into those of the equal cubic one).
fn bend(a: Point, c: Point, d: Point, b: Point, pull: f64) -> impl Iterator<Item = Point> {
    const STEPS: usize = 6;
    let towards = |from: Point, to: Point| [0, 1].map(|k| from[k] + pull * (to[k] - from[k]));
    let (c, d) = (towards(a, c), towards(b, d));
    (1..STEPS).map(move |k| {
        let t = k as f64 / STEPS as f64;
        let s = 1.0 - t;
        [0, 1].map(|k| {
            s * s * s * a[k] + 3.0 * s * s * t * c[k] + 3.0 * s * t * t * d[k] + t * t * t * b[k]
        })
    })
}

#[cfg(test)]
mod tests;
