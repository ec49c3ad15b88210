//! Layers on the page: from data coordinates to shapes.

use super::{
    area::{FilledContours, Isolines, Region},
    color::Color,
    contour::Field,
    curve::{ErrorBars, Line, Marker, Markers, Rule},
    font,
    geometry::{self, Point, clip_polygon, clip_polyline, simplify, simplify_ring},
    layer::{Layer, Note},
    line_label::Obstacles,
    panel::Frame,
    scene::{Anchor, Pen, Scene, Shape, Text},
    ticks::format_number,
    typography::ISOLINE_SIZE,
};

/// Points of curves closer than this to their neighbours' chord are left out (points; a tenth of a pixel at 300 dpi is 0.024).
const TOLERANCE: f64 = 0.01;
/// Distance of hatch strokes and their width.
const HATCH: (f64, f64) = (4.5, 0.45);

/// Draws the layers in order; the scene is cut to the frame.
pub(super) fn draw_layers(scene: &mut Scene, frame: &Frame, layers: &[Layer]) {
    let mut labels = Obstacles::new(frame, layers);
    for layer in layers {
        match layer {
            Layer::Line(line) => draw_line(scene, frame, line),
            Layer::Markers(markers) => draw_markers(scene, frame, markers),
            Layer::ErrorBars(bars) => draw_error_bars(scene, frame, bars),
            Layer::Rule(rule) => draw_rule(scene, frame, rule),
            Layer::Region(region) => draw_region(scene, frame, region),
            Layer::FilledContours(contours) => draw_bands(scene, frame, contours),
            Layer::Isolines(isolines) => draw_isolines(scene, frame, isolines, &mut labels),
            Layer::Note(note) => draw_note(scene, frame, note),
        }
    }
}

fn draw_line(scene: &mut Scene, frame: &Frame, line: &Line) {
    let points: Vec<Point> = line.points.iter().map(|&p| frame.at(p)).collect();
    let pen = Pen { color: line.color, width: line.width, dash: line.dash.lengths(line.width) };
    // Cut a width outside: the clip of the scene makes the exact end, whatever the slope.
    let pieces = clip_polyline(&points, &frame.rect.grown(4.0 * line.width));
    scene.stroke(pieces.iter().map(|p| simplify(p, TOLERANCE)).collect(), pen);
}

fn draw_markers(scene: &mut Scene, frame: &Frame, markers: &Markers) {
    // Markers on the border are drawn whole.
    let clip = scene.clip.take();
    for &p in &markers.points {
        let at = frame.at(p);
        if frame.rect.grown(1e-6).contains(at) {
            draw_marker(scene, at, markers);
        }
    }
    scene.clip = clip;
}

/// One marker at a place of the page.
pub(super) fn draw_marker(scene: &mut Scene, at: Point, markers: &Markers) {
    let r = 0.5 * markers.size;
    let pen = Pen::solid(markers.color, markers.width);
    let ring = |corners: &[Point]| -> Vec<Point> {
        corners.iter().map(|c| [at[0] + r * c[0], at[1] + r * c[1]]).collect()
    };
    // Sizes are such that all forms weigh about the same.
    let corners: Vec<Point> = match markers.marker {
        Marker::Circle => {
            scene.add(Shape::Circle { centre: at, radius: r, fill: markers.fill, pen });
            return;
        }
        Marker::Cross => {
            let d = 0.85;
            scene.stroke(vec![ring(&[[-d, -d], [d, d]]), ring(&[[-d, d], [d, -d]])], pen);
            return;
        }
        Marker::Plus => {
            let d = 1.1;
            scene.stroke(vec![ring(&[[-d, 0.0], [d, 0.0]]), ring(&[[0.0, -d], [0.0, d]])], pen);
            return;
        }
        Marker::Square => {
            let d = 0.88;
            ring(&[[-d, -d], [d, -d], [d, d], [-d, d]])
        }
        Marker::Triangle => ring(&[[0.0, -1.25], [1.1, 0.7], [-1.1, 0.7]]),
        Marker::Diamond => ring(&[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]]),
    };
    if let Some(fill) = markers.fill {
        scene.fill(vec![corners.clone()], fill, 1.0);
    }
    if markers.width > 0.0 {
        scene.outline(corners, pen);
    }
}

fn draw_error_bars(scene: &mut Scene, frame: &Frame, bars: &ErrorBars) {
    const CAP: f64 = 2.0;
    let mut lines = Vec::new();
    for &[x, low, high] in &bars.bars {
        let (a, b) = (frame.at([x, low]), frame.at([x, high]));
        lines.extend(clip_polyline(&[a, b], &frame.rect));
        for end in [a, b].into_iter().filter(|&end| frame.rect.contains(end)) {
            lines.push(vec![[end[0] - CAP, end[1]], [end[0] + CAP, end[1]]]);
        }
    }
    scene.stroke(lines, Pen::solid(bars.color, bars.width));
}

fn draw_rule(scene: &mut Scene, frame: &Frame, rule: &Rule) {
    let r = frame.rect;
    let ends = if rule.vertical {
        let x = frame.x_at(rule.at);
        [[x, r.bottom], [x, r.top]]
    } else {
        let y = frame.y_at(rule.at);
        [[r.left, y], [r.right, y]]
    };
    let pen = Pen { color: rule.color, width: rule.width, dash: rule.dash.lengths(rule.width) };
    scene.stroke(clip_polyline(&ends, &r), pen);
}

fn draw_region(scene: &mut Scene, frame: &Frame, region: &Region) {
    // Infinite coordinates, and zero on a logarithmic axis, lie one panel beyond the border.
    let place = |fraction: f64, value: f64| {
        if fraction.is_finite() {
            fraction.clamp(-1e6, 1e6)
        } else if value > 0.0 {
            2.0
        } else {
            -1.0
        }
    };
    let r = frame.rect;
    let outline: Vec<Point> = region
        .outline
        .iter()
        .map(|p| {
            [
                r.left + place(frame.x.fraction(p[0]), p[0]) * r.width(),
                r.bottom - place(frame.y.fraction(p[1]), p[1]) * r.height(),
            ]
        })
        .collect();
    let outline = clip_polygon(&outline, &r);
    draw_patch(scene, outline, region);
}

/// An area of the page in the look of a region.
pub(super) fn draw_patch(scene: &mut Scene, outline: Vec<Point>, region: &Region) {
    if let Some(color) = region.hatch {
        let strokes = geometry::hatch(&outline, HATCH.0).into_iter().map(|s| s.to_vec()).collect();
        if let Some((fill, opacity)) = region.fill {
            scene.fill(vec![outline], fill, opacity);
        }
        scene.stroke(strokes, Pen::solid(color, HATCH.1));
    } else if let Some((fill, opacity)) = region.fill {
        scene.fill(vec![outline], fill, opacity);
    }
}

/// The nodes of a field on the page.
fn nodes(frame: &Frame, field: &Field) -> (Vec<f64>, Vec<f64>) {
    (
        field.x().iter().map(|&x| frame.x_at(x)).collect(),
        field.y().iter().map(|&y| frame.y_at(y)).collect(),
    )
}

/// Each band is painted from its lower edge all the way up and the next one over it: neighbours overlap, so no seam of
/// background can show between them.
fn draw_bands(scene: &mut Scene, frame: &Frame, contours: &FilledContours) {
    let FilledContours { field, bands } = contours;
    let (x, y) = nodes(frame, field);
    let trace = field.on(&x, &y);
    let region = |level: f64| -> Vec<Vec<Point>> {
        trace
            .region(level)
            .iter()
            .map(|ring| simplify_ring(ring, TOLERANCE))
            .filter(|ring| ring.len() > 2)
            .collect()
    };
    let edges = bands.edges();
    let last = edges[edges.len() - 1];
    // The last edge belongs to the last band.
    let above = region(last.next_up());
    // What is not to be painted above the last edge is cut out of every region as a hole.
    let hole: Vec<Vec<Point>> = match bands.above() {
        Some(_) => Vec::new(),
        None => above.iter().map(|ring| ring.iter().rev().copied().collect()).collect(),
    };
    let mut paint = |mut rings: Vec<Vec<Point>>, color: Color| {
        if !rings.is_empty() {
            rings.extend(hole.iter().cloned());
            scene.fill(rings, color, 1.0);
        }
    };
    if let Some(color) = bands.below() {
        paint(region(f64::NEG_INFINITY), color);
    }
    for (&edge, &color) in edges.iter().zip(bands.colors()) {
        paint(region(edge), color);
    }
    if let Some(color) = bands.above() {
        paint(above, color);
    }
}

fn draw_isolines(scene: &mut Scene, frame: &Frame, isolines: &Isolines, labels: &mut Obstacles) {
    let (x, y) = nodes(frame, &isolines.field);
    let trace = isolines.field.on(&x, &y);
    let dash = isolines.dash.lengths(isolines.width);
    let pen = Pen { color: isolines.color, width: isolines.width, dash };
    for &level in &isolines.levels {
        let text = format_number(level);
        let width = font::width(&text, ISOLINE_SIZE);
        let mut lines = Vec::new();
        for line in trace.isolines(level) {
            let mut points = line.points;
            if line.closed {
                points.push(points[0]);
            }
            for piece in clip_polyline(&simplify(&points, TOLERANCE), &frame.rect) {
                let place =
                    isolines.labelled.then(|| labels.place(&piece, width, ISOLINE_SIZE)).flatten();
                match place {
                    Some(place) => {
                        lines.extend(place.rest);
                        scene.text(Text {
                            angle: place.angle,
                            anchor: Anchor::Middle,
                            color: isolines.color,
                            ..Text::new(text.clone(), place.baseline, ISOLINE_SIZE)
                        });
                    }
                    None => lines.push(piece),
                }
            }
        }
        scene.stroke(lines, pen.clone());
    }
}

fn draw_note(scene: &mut Scene, frame: &Frame, note: &Note) {
    let at = frame.at(note.at);
    if !at.iter().all(|v| v.is_finite()) {
        return;
    }
    // The point is at half the height of the capitals.
    let drop = 0.5 * font::CAP_HEIGHT * note.size;
    let (sin, cos) = note.angle.to_radians().sin_cos();
    scene.text(Text {
        angle: note.angle,
        anchor: note.anchor,
        color: note.color,
        halo: Some(Color::WHITE),
        ..Text::new(note.text.clone(), [at[0] + drop * sin, at[1] + drop * cos], note.size)
    });
}
