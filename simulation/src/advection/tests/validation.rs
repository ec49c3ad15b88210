//! Predicted against measured, mode by mode.

use super::*;
use crate::advection::amplification::measure_amplification;
use num_complex::Complex64;
use std::f64::consts::PI;

fn plan(discretisation: Discretisation, courant_number: f64, layout: Layout) -> ValidationPlan {
    let (particles, steps, fault) = (64, 100, None);
    ValidationPlan { discretisation, courant_number, particles, steps, layout, fault }
}

#[test]
fn every_scheme_and_kernel_agrees_when_stable_neutral_and_unstable() {
    let mut worst = (0.0, 0.0);
    for scheme in AdvectionScheme::ALL {
        for kernel in Kernel::ALL {
            for ratio in ["1", "4/3", "1.3", "2"] {
                let discretisation = discretisation(scheme, kernel, ratio);
                let limit = discretisation.stable_set().limit().value();
                let limit = if limit > 0.0 && limit.is_finite() { limit } else { 1.0 };
                for courant_number in [0.5 * limit, limit, 3.0 * limit] {
                    for layout in EQUALLY_SPACED {
                        let plan = plan(discretisation.clone(), courant_number, layout);
                        let validation = validate(&plan).unwrap();
                        let label =
                            format!("{scheme} {kernel} {ratio} {courant_number} {layout:?}");
                        assert!(validation.max_error < 1e-12, "{label}: {}", validation.max_error);
                        assert!(validation.passed(), "{label}: {}", validation.max_error);
                        let share = validation.max_error / validation.tolerance;
                        if share > worst.0 {
                            worst = (share, validation.max_error);
                        }
                    }
                }
            }
        }
    }
    // The tolerance is no looser than it claims: some case comes within a factor of a hundred.
    assert!(worst.0 > 0.01 && worst.0 < 0.2, "{worst:?}");
}

#[test]
fn a_coefficient_off_by_a_billionth_fails() {
    for scheme in AdvectionScheme::ALL {
        for kernel in Kernel::ALL {
            for layout in EQUALLY_SPACED {
                for (offset, by) in [(-1, 1e-9), (0, -1e-9), (2, 1e-9)] {
                    let mut plan = plan(discretisation(scheme, kernel, "2"), 0.7, layout);
                    plan.fault = Some(Fault { offset, by });
                    let validation = validate(&plan).unwrap();
                    assert!(!validation.passed(), "{scheme} {kernel} {layout:?} {offset}");
                    // The fault is seen at its size: |1e-9 e^{ikφ}|.
                    assert!((validation.max_error - 1e-9).abs() < 1e-12);
                }
            }
        }
    }
}

#[test]
fn the_ring_transform_is_its_definition_and_leads_back() {
    for particles in [1, 2, 9, 24] {
        let modes = RingModes::new(particles);
        let values = noise(particles, 11);
        let amplitudes: Vec<_> = (0..modes.count()).map(|m| modes.amplitude(m, &values)).collect();
        for (mode, amplitude) in amplitudes.iter().enumerate() {
            let plain: Complex64 = (0..particles)
                .map(|j| values[j] * Complex64::new(0.0, -modes.phase(mode) * j as f64).exp())
                .sum();
            assert!((amplitude - plain / particles as f64).norm() < 1e-14);
        }
        assert!(distance(&modes.state(&amplitudes), &values) < 1e-14);
        assert!((modes.phase(modes.count() - 1) - PI).abs() <= PI / particles as f64 + 1e-15);
    }
}

#[test]
fn small_rings_and_wide_kernels_agree() {
    // Kernels that reach around the ring several times, and one particle that is its own neighbour.
    for (particles, ratio) in [(1, "2"), (2, "2"), (3, "10"), (7, "4.3"), (255, "10"), (256, "7/3")]
    {
        for scheme in AdvectionScheme::ALL {
            for layout in EQUALLY_SPACED {
                let mut plan = plan(discretisation(scheme, Kernel::Gaussian, ratio), 1.3, layout);
                plan.particles = particles;
                plan.steps = 10;
                let validation = validate(&plan).unwrap();
                assert_eq!(validation.rows.len(), particles / 2 + 1);
                assert!(validation.passed(), "{particles} {ratio} {scheme} {layout:?}");
                assert!(validation.tolerance < 1e-12 * if particles < 200 { 1.0 } else { 10.0 });
            }
        }
    }
}

#[test]
fn a_wave_that_vanishes_in_one_step_is_measured() {
    // Upwind at C = 1/2: g(π) = 0 exactly.
    let upwind = discretisation(AdvectionScheme::GodunovSph, Kernel::CubicSpline, "1");
    for particles in [2, 64] {
        let plan = ValidationPlan { particles, ..plan(upwind.clone(), 0.5, Layout::Lattice) };
        let validation = validate(&plan).unwrap();
        assert!(validation.passed(), "{}", validation.max_error);
        assert!(validation.rows[particles / 2].measured.norm() < 1e-14);
    }
    let nothing = LatticeCoefficients { values: vec![0.0], left: 0 };
    let mut stepper = LatticePath::with_coefficients(nothing, 9);
    let measured = measure_amplification(&mut stepper, &RingModes::new(9), 5);
    assert_eq!(measured, vec![Complex64::new(0.0, 0.0); 5]);
}

#[test]
fn impossible_validations_are_refused() {
    let good = plan(
        discretisation(AdvectionScheme::EulerSph, Kernel::CubicSpline, "2"),
        1.0,
        Layout::Uniform,
    );
    let refused = |plan: ValidationPlan| validate(&plan).unwrap_err();
    let none = ValidationPlan { particles: 0, ..good.clone() };
    assert_eq!(refused(none), InvalidOptions::Particles { particles: 0, least: 1 });
    let not_positive = |name| InvalidOptions::NotPositive { name, value: 0.0 };
    assert_eq!(refused(ValidationPlan { steps: 0, ..good.clone() }), not_positive("steps"));
    let still = ValidationPlan { courant_number: 0.0, ..good };
    assert_eq!(refused(still), not_positive("cfl"));
}
