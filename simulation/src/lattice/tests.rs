//! Distances by looking at everybody, against what crystallography says.

use super::Lattice;
use std::f64::consts::PI;

/// The smallest distance and how many are at it, the same for every particle.
fn contacts<const D: usize>(lattice: Lattice, upper: [f64; D], count: usize) -> (f64, usize, f64) {
    let lower: [f64; D] = std::array::from_fn(|axis| -0.3 + axis as f64);
    let upper: [f64; D] = std::array::from_fn(|axis| lower[axis] + upper[axis]);
    let filling = lattice.fill(lower, upper, count).expect("a lattice of that dimension");
    assert_eq!(filling.upper[0], upper[0]);
    let positions = &filling.positions;
    assert!(positions.len() * 10 > count * 7 && positions.len() * 7 < count * 10);
    let box_edge: [f64; D] = std::array::from_fn(|axis| filling.upper[axis] - lower[axis]);
    let apart = |x: &[f64; D], y: &[f64; D]| -> f64 {
        let components = (0..D).map(|axis| {
            let d = (x[axis] - y[axis]).abs();
            d.min(box_edge[axis] - d)
        });
        components.map(|d| d * d).sum::<f64>().sqrt()
    };
    let mut seen = None;
    for (i, x) in positions.iter().enumerate() {
        for axis in 0..D {
            assert!(x[axis] > lower[axis] && x[axis] < filling.upper[axis]);
        }
        let others =
            || positions.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, y)| apart(x, y));
        let nearest = others().fold(f64::INFINITY, f64::min);
        let at_it = others().filter(|d| *d < nearest * (1.0 + 1e-9)).count();
        let (distance, number) = *seen.get_or_insert((nearest, at_it));
        assert!((nearest / distance - 1.0).abs() < 1e-9 && at_it == number, "{lattice:?} {i}");
    }
    let (distance, number) = seen.expect("particles");
    let volume: f64 = box_edge.iter().product();
    (distance, number, volume / positions.len() as f64)
}

#[test]
fn neighbours_and_packing_are_those_of_the_books() {
    let disc = |d: f64| PI * d * d / 4.0;
    for (lattice, number, packing) in
        [(Lattice::Square, 4, PI / 4.0), (Lattice::Hexagonal, 6, PI / 12f64.sqrt())]
    {
        for (upper, count) in [([1.0, 1.0], 400), ([2.0, 0.7], 150)] {
            let (distance, seen, each) = contacts(lattice, upper, count);
            assert_eq!(seen, number, "{lattice:?}");
            assert!((disc(distance) / each / packing - 1.0).abs() < 1e-9, "{lattice:?}");
        }
    }
    let ball = |d: f64| PI * d * d * d / 6.0;
    let close = PI / 18f64.sqrt();
    for (lattice, number, packing) in [
        (Lattice::Cubic, 6, PI / 6.0),
        (Lattice::BodyCentred, 8, PI * 3f64.sqrt() / 8.0),
        (Lattice::FaceCentred, 12, close),
        (Lattice::HexagonalClose, 12, close),
    ] {
        for (upper, count) in [([1.0; 3], 600), ([1.0, 1.5, 0.8], 400)] {
            let (distance, seen, each) = contacts(lattice, upper, count);
            assert_eq!(seen, number, "{lattice:?}");
            assert!((ball(distance) / each / packing - 1.0).abs() < 1e-9, "{lattice:?}");
        }
    }
}

#[test]
fn dimensions_are_kept() {
    for lattice in Lattice::ALL {
        assert_eq!(lattice.fill([0.0; 2], [1.0; 2], 10).is_some(), lattice.dimension() == 2);
        assert_eq!(lattice.fill([0.0; 3], [1.0; 3], 10).is_some(), lattice.dimension() == 3);
    }
}
