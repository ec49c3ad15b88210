//! The search for neighbours against looking at everybody.

use super::scatter;
use crate::boundary::Boundary;
use crate::particles::*;

/// Pairs by looking at everybody and every image: `(first, second, distance)` with first ≤ second.
fn brute_force<const D: usize>(
    domain: &Domain<D>,
    positions: &[Vector<D>],
    radii: &[f64],
) -> Vec<(u32, u32, u64)> {
    // Every combination of "here", two shifts and two mirrors on each axis.
    let mut images = vec![Image::<D>::IDENTITY];
    for axis in 0..D {
        let length = domain.upper[axis] - domain.lower[axis];
        let maps: Vec<(f64, f64)> = match domain.boundary[axis][0] {
            Boundary::Open | Boundary::Transmissive => vec![],
            Boundary::Periodic => vec![(1.0, length), (1.0, -length)],
            Boundary::Mirror => {
                vec![(-1.0, 2.0 * domain.lower[axis]), (-1.0, 2.0 * domain.upper[axis])]
            }
        };
        for image in images.clone() {
            for &(flip, shift) in &maps {
                let mut image = image;
                image.flip[axis] = flip;
                image.shift[axis] = shift;
                images.push(image);
            }
        }
    }
    let mut found = Vec::new();
    for (index, image) in images.iter().enumerate() {
        for i in 0..positions.len() {
            for j in 0..positions.len() {
                if i == j && index == 0 {
                    continue;
                }
                let square: f64 = image
                    .displacement(&positions[i], &positions[j])
                    .iter()
                    .map(|component| component * component)
                    .sum();
                // Every pair of two is seen from both ends: keep one. A particle sees its own image once.
                if square <= radii[i].max(radii[j]).powi(2) && i <= j {
                    found.push((i as u32, j as u32, square.sqrt().to_bits()));
                }
            }
        }
    }
    found.sort_unstable();
    found
}

fn check_search<const D: usize>(boundary: Boundary, seed: u64, count: usize, radius: f64) {
    let numbers = scatter(count * (D + 1), seed);
    let domain = Domain::new([0.0; D], [1.0; D], boundary);
    let positions: Vec<Vector<D>> =
        (0..count).map(|i| std::array::from_fn(|axis| numbers[i * D + axis])).collect();
    // Radii spread over a factor of 16, some exactly equal.
    let radii: Vec<f64> =
        (0..count).map(|i| radius * 2f64.powi((numbers[count * D + i] * 5.0) as i32 - 2)).collect();
    let mut neighbours = Neighbours::default();
    neighbours.search(&domain, &positions, &radii);
    let mut found = Vec::new();
    for block in &neighbours.blocks {
        for k in 0..block.len {
            let at = neighbours.active[block.start + k] as usize;
            let first = neighbours.number(block, k) as u32;
            // Either of two has the other in its list.
            found.extend(block.all(k).filter_map(|&neighbour| {
                let (_, second, _, distance) = neighbours.see(at, neighbour);
                (first <= second as u32).then(|| (first, second as u32, distance.to_bits()))
            }));
        }
    }
    found.sort_unstable();
    let expected = brute_force(&domain, &positions, &radii);
    assert_eq!(found, expected, "{D} dimensions, {boundary:?}, seed {seed}");
    assert!(!expected.is_empty());
}

#[test]
fn cell_list_finds_what_brute_force_finds() {
    for boundary in [Boundary::Open, Boundary::Periodic, Boundary::Mirror] {
        for seed in 1..20 {
            check_search::<1>(boundary, seed, 150, 0.01);
            check_search::<2>(boundary, seed, 120, 0.06);
            check_search::<3>(boundary, seed, 60, 0.1);
        }
        // More than one block.
        check_search::<1>(boundary, 99, 1500, 0.001);
        check_search::<2>(boundary, 99, 1100, 0.01);
    }
}
