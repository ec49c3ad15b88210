//! Edges of supports, the two paths, and what they keep.

use super::*;
use courant_analysis::kernel::lattice::LatticeWeights;
use proptest::prelude::*;

/// Ratios where a lattice point falls on the edge of a support (1, 4/3, 2/3, 10/3, 5, 0.3 typed as a
/// decimal, …) and where none does.
const RATIOS: [&str; 10] = ["1", "4/3", "2/3", "10/3", "1.3", "1.2", "0.3", "2", "2.5", "5"];

#[test]
fn the_edge_of_the_support_is_decided_as_the_analysis_does() {
    for ratio in RATIOS {
        let weights = LatticeWeights::new(Kernel::Gaussian, &exact(ratio)).unwrap();
        let euler = discretisation(AdvectionScheme::EulerSph, Kernel::Gaussian, ratio);
        let reach = weights.reach();
        for (particles, length) in [(40, 40.0), (200, 1.0), (997, 1.0), (20_000, 1.0)] {
            let ring = Ring::uniform(particles, length).unwrap();
            let found = ParticlePath::new(&euler, 1.0, &ring).interactions_per_step();
            assert_eq!(found, (2 * reach * particles) as u64, "{ratio} on {particles}");
        }
        let coefficients = LatticeCoefficients::new(&euler, 1.0);
        assert_eq!(
            (coefficients.left, coefficients.values.len()),
            (reach, 2 * reach + 1),
            "{ratio}"
        );
    }
}

#[test]
fn a_ratio_short_by_a_rounding_keeps_the_edge() {
    let short = to_f64(&exact("4/3")).next_down();
    assert!(3.0 * short < 4.0 && 4.0 / short > 3.0);
    let [exact, rounded] = [exact("4/3"), from_f64(short).unwrap()].map(|ratio| {
        let of = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::Gaussian, ratio);
        LatticeCoefficients::new(&of.unwrap(), 1.0)
    });
    assert_eq!(rounded.left, 4);
    assert!(rounded.values[0] > 1e-4 && distance(&exact.values, &rounded.values) < 1e-14);
}

#[test]
fn the_edge_has_its_weight_on_every_ring() {
    // On [0, 1] the smoothing length and the distances are rounded anew for every number of particles.
    for ratio in ["1", "4/3", "10/3"] {
        let of = discretisation(AdvectionScheme::GodunovSph, Kernel::Gaussian, ratio);
        for particles in 20..200 {
            let start = noise(particles, 12);
            let [a, b] = EQUALLY_SPACED.map(|layout| {
                let (_, mut stepper) = layout.stepper(&of, 0.5, particles, 1.0).unwrap();
                stepper.set_state(&start);
                stepper.step();
                stepper.state().to_vec()
            });
            // The weight at the edge is above 1e-5; distances are right to 1e-16 N.
            assert!(distance(&a, &b) < 1e-12, "{ratio} {particles}");
        }
    }
}

#[test]
fn lattice_coefficients_are_the_exact_stencil() {
    for scheme in AdvectionScheme::ALL {
        for kernel in Kernel::ALL {
            for ratio in RATIOS {
                let of = discretisation(scheme, kernel, ratio);
                let stencil = of.one_step().stencil_at(&exact("7/8"));
                let found = LatticeCoefficients::new(&of, 0.875);
                // Kernel values are right to 1e-13 of numbers below 1; small ratios enlarge them.
                let tolerance = 1e-13 * to_f64(&exact(ratio)).powi(-3).max(1.0);
                for offset in -16i64..=16 {
                    let index = offset + found.left as i64;
                    let value = usize::try_from(index).ok().and_then(|i| found.values.get(i));
                    let value = value.copied().unwrap_or(0.0);
                    let expected = stencil.terms().find(|(known, _)| *known == offset);
                    let expected = expected.map_or(0.0, |(_, value)| to_f64(value));
                    assert!(
                        (value - expected).abs() < tolerance,
                        "{scheme} {kernel} {ratio} {offset}: {value} {expected}"
                    );
                }
            }
        }
    }
}

/// The update with indices taken modulo the ring, one coefficient after the other.
fn plain_step(coefficients: &LatticeCoefficients, values: &[f64]) -> Vec<f64> {
    let count = values.len() as i64;
    (0..count)
        .map(|i| {
            (-(coefficients.left as i64)..)
                .zip(&coefficients.values)
                .fold(0.0, |sum, (k, c)| sum + c * values[(i + k).rem_euclid(count) as usize])
        })
        .collect()
}

#[test]
fn the_lattice_path_is_the_plain_loop_bit_by_bit() {
    for (width, left) in [(1, 0), (2, 1), (3, 0), (8, 3), (9, 8), (16, 2), (31, 15)] {
        let coefficients = LatticeCoefficients { values: noise(width, 9), left };
        for particles in [1, 2, 7, 30, 1025, 3000] {
            let mut path = LatticePath::with_coefficients(coefficients.clone(), particles);
            let mut values = noise(particles, 4);
            path.set_state(&values);
            for _ in 0..3 {
                values = plain_step(&coefficients, &values);
                path.step();
                assert_eq!(path.state(), values, "{width} {left} {particles}");
            }
        }
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    const COUNT: usize = 70_000; // above the sizes from which both paths are split
    let of = discretisation(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, "2");
    let start = noise(COUNT, 8);
    let ring = Ring::disordered(COUNT, 1.0, 0.2, 6).unwrap();
    let end = |threads: usize, mut stepper: Box<dyn Stepper + Send>| -> Vec<f64> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        stepper.set_state(&start);
        pool.install(|| (0..3).for_each(|_| stepper.step()));
        stepper.state().to_vec()
    };
    let lattice = LatticePath::new(&of, 0.8, COUNT);
    let particles = ParticlePath::new(&of, 0.8, &ring);
    assert_eq!(end(1, Box::new(lattice.clone())), end(3, Box::new(lattice.clone())));
    assert_eq!(end(1, Box::new(particles.clone())), end(3, Box::new(particles)));
    let mut plain = start.clone();
    (0..3).for_each(|_| plain = plain_step(lattice.coefficients(), &plain));
    assert_eq!(end(2, Box::new(lattice)), plain);
}

#[test]
fn godunov_conserves_on_any_positions() {
    // The pair (i, j) exchanges V_i V_j W' f: what one gives the other takes.
    for disorder in [0.0, 0.1, 0.4] {
        let ring = Ring::disordered(64, 1.0, disorder, 1).unwrap();
        let of = discretisation(AdvectionScheme::GodunovSph, Kernel::QuinticSpline, "1.7");
        let mut stepper = ParticlePath::new(&of, 0.3, &ring);
        stepper.set_state(&noise(64, 7));
        let total = |values: &[f64]| -> f64 {
            values.iter().zip(ring.volumes()).map(|(value, volume)| value * volume).sum()
        };
        let before = total(stepper.state());
        (0..200).for_each(|_| stepper.step());
        assert!((total(stepper.state()) - before).abs() < 200.0 * 64.0 * f64::EPSILON);
    }
}

proptest! {
    #[test]
    fn volumes_fill_the_ring(particles in 1usize..80, disorder in 0.0f64..0.49, seed in 0u64..99) {
        let ring = Ring::disordered(particles, 3.0, disorder, seed).unwrap();
        let total: f64 = ring.volumes().iter().sum();
        prop_assert!((total - 3.0).abs() < 1e-13);
        prop_assert!(ring.volumes().iter().all(|&volume| volume > 0.0));
    }
}

#[test]
fn impossible_rings_are_refused() {
    let nobody = InvalidOptions::Particles { particles: 0, least: 1 };
    assert_eq!(Ring::uniform(0, 1.0), Err(nobody));
    let no_length = InvalidOptions::NotPositive { name: "length", value: 0.0 };
    assert_eq!(Ring::uniform(3, 0.0), Err(no_length));
    assert_eq!(Ring::disordered(3, 1.0, 0.5, 0), Err(InvalidOptions::Disorder(0.5)));
}
