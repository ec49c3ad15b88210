//! Scenes as SVG.
//!
//! Coordinates are whole hundredths of a point, lines relative, so that maps stay small. Letters are outlines from the
//! bundled font, so that the picture is the same everywhere; the text itself is kept as `aria-label`.

use super::{
    color::Color,
    font,
    geometry::{Point, Rect},
    scene::{Pen, Scene, Shape, Text},
};
use crate::markup::escaped;
use ab_glyph::{GlyphId, OutlineCurve};
use std::{collections::BTreeSet, fmt::Write};

/// Units per point.
const UNITS: f64 = 100.0;

/// The scene as an SVG document.
pub(super) fn svg(scene: &Scene) -> String {
    let mut glyphs = BTreeSet::new();
    let mut clips: Vec<Rect> = Vec::new();
    let mut body = String::new();
    let mut open: Option<usize> = None;
    for (clip, shape) in &scene.items {
        let wanted = clip.map(|rect| {
            clips.iter().position(|c| *c == rect).unwrap_or_else(|| {
                clips.push(rect);
                clips.len() - 1
            })
        });
        if wanted != open {
            if open.is_some() {
                body.push_str("</g>\n");
            }
            if let Some(k) = wanted {
                put(&mut body, format_args!("<g clip-path=\"url(#c{k})\">\n"));
            }
            open = wanted;
        }
        draw(&mut body, shape, &mut glyphs);
    }
    if open.is_some() {
        body.push_str("</g>\n");
    }
    let mut out = String::with_capacity(body.len() + 40_000);
    let (w, h) = (scene.width, scene.height);
    put(
        &mut out,
        format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" role=\"img\" \
             width=\"{}in\" height=\"{}in\" viewBox=\"0 0 {} {}\">\n<defs>\n",
            w / 72.0,
            h / 72.0,
            whole(w),
            whole(h)
        ),
    );
    for (k, rect) in clips.iter().enumerate() {
        put(
            &mut out,
            format_args!(
                "<clipPath id=\"c{k}\"><path d=\"{}\"/></clipPath>\n",
                path(&[rect.corners()], true)
            ),
        );
    }
    for glyph in glyphs {
        put(
            &mut out,
            format_args!("<path id=\"g{glyph}\" d=\"{}\"/>\n", glyph_path(GlyphId(glyph))),
        );
    }
    out.push_str("</defs>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
    out.push_str(&body);
    out.push_str("</svg>\n");
    out
}

fn put(out: &mut String, text: std::fmt::Arguments) {
    out.write_fmt(text).expect("writing to a String cannot fail");
}

fn whole(v: f64) -> i64 {
    (v * UNITS).round() as i64
}

fn hex(color: Color) -> String {
    format!("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue)
}

fn draw(out: &mut String, shape: &Shape, glyphs: &mut BTreeSet<u16>) {
    match shape {
        Shape::Fill { rings, color, opacity } => {
            let (d, fill) = (path(rings, true), hex(*color));
            if *opacity < 1.0 {
                put(
                    out,
                    format_args!("<path fill=\"{fill}\" fill-opacity=\"{opacity}\" d=\"{d}\"/>\n"),
                );
            } else {
                put(out, format_args!("<path fill=\"{fill}\" d=\"{d}\"/>\n"));
            }
        }
        Shape::Stroke { lines, closed, pen } => {
            let d = path(lines, *closed);
            put(
                out,
                format_args!(
                    "<path fill=\"none\" stroke-linejoin=\"round\"{} d=\"{d}\"/>\n",
                    stroke(pen)
                ),
            );
        }
        Shape::Circle { centre, radius, fill, pen } => {
            let fill = fill.map_or("none".into(), hex);
            let outline = if pen.width > 0.0 { stroke(pen) } else { String::new() };
            put(
                out,
                format_args!(
                    "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{fill}\"{outline}/>\n",
                    whole(centre[0]),
                    whole(centre[1]),
                    whole(*radius)
                ),
            );
        }
        Shape::Text(text) => {
            if let Some(halo) = text.halo {
                let width = text.halo_width() * font::units_per_em() / text.size;
                let pen = format!(
                    " stroke=\"{}\" stroke-width=\"{width:.0}\" stroke-linejoin=\"round\"",
                    hex(halo)
                );
                letters(out, text, &pen, glyphs);
            }
            letters(out, text, "", glyphs);
        }
    }
}

fn stroke(pen: &Pen) -> String {
    let mut out = format!(" stroke=\"{}\" stroke-width=\"{}\"", hex(pen.color), whole(pen.width));
    if !pen.dash.is_empty() {
        let lengths: Vec<String> = pen.dash.iter().map(|d| whole(*d).to_string()).collect();
        put(&mut out, format_args!(" stroke-dasharray=\"{}\"", lengths.join(" ")));
    }
    out
}

fn letters(out: &mut String, text: &Text, pen: &str, glyphs: &mut BTreeSet<u16>) {
    let [x, y] = text.origin();
    let scale = text.size * UNITS / font::units_per_em();
    let turn =
        if text.angle == 0.0 { String::new() } else { format!(" rotate({:.2})", -text.angle) };
    let label = if pen.is_empty() {
        format!(" aria-label=\"{}\"", escaped(&text.text))
    } else {
        " aria-hidden=\"true\"".into()
    };
    put(
        out,
        format_args!(
            "<g{label} fill=\"{}\"{pen} transform=\"translate({} {}){turn} scale({scale:.5} -{scale:.5})\">",
            hex(text.color),
            whole(x),
            whole(y)
        ),
    );
    for (glyph, start) in font::shape(&text.text).0 {
        if !font::contours(glyph).is_empty() {
            glyphs.insert(glyph.0);
            put(out, format_args!("<use xlink:href=\"#g{}\" x=\"{start:.0}\"/>", glyph.0));
        }
    }
    out.push_str("</g>\n");
}

/// Polylines as path data.
fn path(lines: &[Vec<Point>], closed: bool) -> String {
    let mut out = String::new();
    for line in lines {
        let mut last: Option<[i64; 2]> = None;
        for p in line {
            let at = [whole(p[0]), whole(p[1])];
            match last {
                None => put(&mut out, format_args!("M{} {}l", at[0], at[1])),
                Some(l) if l == at => continue,
                Some(l) => {
                    let (dx, dy) = (at[0] - l[0], at[1] - l[1]);
                    // A minus sign separates numbers as well as a space does.
                    let gap = if out.ends_with('l') || dx < 0 { "" } else { " " };
                    let middle = if dy < 0 { "" } else { " " };
                    put(&mut out, format_args!("{gap}{dx}{middle}{dy}"));
                }
            }
            last = Some(at);
        }
        if out.ends_with('l') {
            out.pop(); // a single point draws nothing
        } else if closed {
            out.push('z');
        }
    }
    out
}

/// The outline of a letter in font units.
fn glyph_path(glyph: GlyphId) -> String {
    let mut out = String::new();
    for contour in font::contours(glyph) {
        let (start, _) = font::ends(&contour[0]);
        put(&mut out, format_args!("M{} {}", start.x, start.y));
        for curve in contour {
            match curve {
                OutlineCurve::Line(_, b) => put(&mut out, format_args!("L{} {}", b.x, b.y)),
                OutlineCurve::Quad(_, c, b) => {
                    put(&mut out, format_args!("Q{} {} {} {}", c.x, c.y, b.x, b.y));
                }
                OutlineCurve::Cubic(_, c, d, b) => {
                    put(&mut out, format_args!("C{} {} {} {} {} {}", c.x, c.y, d.x, d.y, b.x, b.y));
                }
            }
        }
    }
    out
}
