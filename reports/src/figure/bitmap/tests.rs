use super::*;
use crate::figure::scene::{Anchor, Pen};
use proptest::prelude::*;

/// Width, height, pixels and dots per metre.
fn decode(bytes: &[u8]) -> (usize, usize, Vec<u8>, u32) {
    let mut reader = png::Decoder::new(bytes).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size()];
    reader.next_frame(&mut pixels).unwrap();
    let info = reader.info();
    let dims = info.pixel_dims.unwrap();
    assert_eq!(dims.unit, png::Unit::Meter);
    assert_eq!(dims.xppu, dims.yppu);
    (info.width as usize, info.height as usize, pixels, dims.xppu)
}

/// Black ink in pixels.
fn ink(bitmap: &Bitmap) -> f64 {
    bitmap.pixels.chunks_exact(3).map(|p| 1.0 - f64::from(p[0]) / 255.0).sum()
}

fn rectangle(left: f64, top: f64, right: f64, bottom: f64) -> Vec<Point> {
    Rect { left, top, right, bottom }.corners()
}

#[test]
fn size_and_resolution_are_recorded() {
    let (width, height, _, dots) = decode(&png(&Scene::new(144.0, 72.0), 300.0).unwrap());
    assert_eq!((width, height), (600, 300));
    assert_eq!(dots, 11811); // 300 / 0.0254
}

#[test]
fn pixels_are_covered_by_their_share() {
    let mut bitmap = Bitmap::new(8, 4);
    bitmap.fill(&[rectangle(1.25, 1.0, 3.0, 2.5)], Color::BLACK, 1.0);
    let row = |k: usize| -> Vec<u8> {
        bitmap.pixels[24 * k..24 * k + 24].iter().step_by(3).copied().collect()
    };
    assert_eq!(row(0), [255; 8]);
    assert_eq!(row(1), [255, 64, 0, 255, 255, 255, 255, 255]);
    assert_eq!(row(2), [255, 159, 128, 255, 255, 255, 255, 255]);
    assert_eq!(row(3), [255; 8]);
}

#[test]
fn overlaps_of_one_shape_count_once_and_holes_stay_free() {
    let mut bitmap = Bitmap::new(20, 20);
    bitmap.fill(
        &[rectangle(2.0, 2.0, 12.0, 12.0), rectangle(6.0, 6.0, 16.0, 16.0)],
        Color::BLACK,
        0.5,
    );
    assert!((ink(&bitmap) - 0.5 * (100.0 + 100.0 - 36.0)).abs() < 164.0 / 255.0);
    let mut bitmap = Bitmap::new(20, 20);
    let hole = rectangle(6.0, 6.0, 10.0, 10.0).into_iter().rev().collect();
    bitmap.fill(&[rectangle(2.0, 2.0, 12.0, 12.0), hole], Color::BLACK, 1.0);
    assert_eq!(ink(&bitmap), 84.0);
}

#[test]
fn shapes_are_cut_to_their_rectangle() {
    let mut bitmap = Bitmap::new(20, 20);
    bitmap.clip = Rect { left: 5.0, top: 5.5, right: 10.0, bottom: 10.0 };
    bitmap.fill(&[rectangle(-1e6, -1e6, 1e6, 1e6)], Color::BLACK, 1.0);
    assert!((ink(&bitmap) - 22.5).abs() < 5.0 / 255.0);
}

#[test]
fn a_bent_stroke_is_as_dark_as_a_straight_one() {
    // A smooth curve of many pieces: joins must neither add ink nor leave gaps.
    let arc = |n: usize| -> Vec<Point> {
        (0..=n)
            .map(|k| (std::f64::consts::PI * k as f64 / n as f64).sin_cos())
            .map(|(sin, cos)| [100.0 + 80.0 * cos, 10.0 + 80.0 * sin])
            .collect()
    };
    let mut bitmap = Bitmap::new(200, 100);
    bitmap.fill(&stroke_rings(&arc(500), false, 3.0), Color::BLACK, 1.0);
    let exact = 3.0 * 80.0 * std::f64::consts::PI;
    // Rounding of about 4 border pixels per unit of length, with random sign: well below a thousandth.
    assert!((ink(&bitmap) / exact - 1.0).abs() < 1e-3, "{}", ink(&bitmap) / exact);
}

#[test]
fn text_stands_where_it_is_put() {
    let mut scene = Scene::new(72.0, 72.0);
    scene.text(Text { anchor: Anchor::Middle, ..Text::new("HH", [36.0, 50.0], 20.0) });
    let (width, _, pixels, _) = decode(&png(&scene, 72.0).unwrap());
    let dark: Vec<(usize, usize)> = (0..width * width)
        .filter(|k| pixels[3 * k] < 128)
        .map(|k| (k % width, k / width))
        .collect();
    let (top, bottom) =
        (dark.iter().map(|p| p.1).min().unwrap(), dark.iter().map(|p| p.1).max().unwrap());
    let (left, right) =
        (dark.iter().map(|p| p.0).min().unwrap(), dark.iter().map(|p| p.0).max().unwrap());
    assert_eq!(bottom, 49); // the last row above the baseline
    assert!((bottom + 1 - top).abs_diff(15) <= 1); // capitals of 0.729 x 20
    assert!((left + right).abs_diff(71) <= 1); // centred
}

#[test]
fn dashes_leave_their_gaps() {
    let mut scene = Scene::new(100.0, 10.0);
    let pen = Pen { color: Color::BLACK, width: 2.0, dash: vec![6.0, 4.0] };
    scene.stroke(vec![vec![[0.0, 5.0], [100.0, 5.0]]], pen);
    let (_, _, pixels, _) = decode(&png(&scene, 72.0).unwrap());
    let dark = pixels.chunks_exact(3).filter(|p| p[0] == 0).count();
    assert_eq!(dark, 10 * 6 * 2);
}

proptest! {
    #[test]
    fn ink_is_the_area_of_a_triangle(corners in prop::array::uniform3(prop::array::uniform2(1.0f64..63.0))) {
        let [a, b, c] = corners;
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
        let mut bitmap = Bitmap::new(64, 64);
        bitmap.fill(&[corners.to_vec()], Color::BLACK, 1.0);
        // The midpoint rule over sub-rows of height 1/8 errs by at most half a sub-row of the greatest width at each of
        // the three corners; rounding to 1/255 of at most 3 x 130 border pixels adds half a level each.
        prop_assert!((ink(&bitmap) - area).abs() < 3.0 * 64.0 / 16.0 + 390.0 / 510.0);
    }
}
