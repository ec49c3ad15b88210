//! The relations of Cha & Whitworth 2003, section 4, evaluated as they are printed, term by term in
//! complex numbers, against the library.

use courant_analysis::exact::rational::{integer, ratio};
use courant_analysis::kernel::Density;
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{LatticeMethod, catalogue};
use num_complex::Complex64;

/// `M = Δ = ρ0 = c = 1`, as the paper's figures have it.
struct Printed {
    kernel: Kernel,
    h: f64,
}

impl Printed {
    /// `Σ_b f(b − a) ` with `∂W_ab/∂x_a` and `∂²W_ab/∂x_a²`.
    fn sum(&self, f: impl Fn(f64, f64, f64) -> Complex64) -> Complex64 {
        (-12i32..=12)
            .filter(|&k| k != 0)
            .map(|k| {
                let q = f64::from(k.abs()) / self.h;
                let slope = -self.kernel.slope(q) / (self.h * self.h) * f64::from(k.signum());
                f(f64::from(k), slope, self.kernel.curvature(q) / self.h.powi(3))
            })
            .sum()
    }

    /// (46).
    fn squared_sph(&self, kappa: f64) -> Complex64 {
        let e = |k: f64| Complex64::cis(k * kappa);
        let plus = self.sum(|k, slope, _| (1.0 + e(k)) * slope);
        let minus = self.sum(|k, slope, _| (1.0 - e(k)) * slope);
        let second = self.sum(|k, _, curvature| 2.0 * (1.0 - e(k)) * curvature);
        -plus * minus + second
    }

    /// `b_SPH,AV` below (60), with the denominator as printed.
    fn b_av(&self, kappa: f64, alpha: f64) -> f64 {
        let term = |k: f64, slope: f64| (1.0 - (k * kappa).cos()) / k * slope;
        alpha * self.h * self.sum(|k, slope, _| Complex64::from(term(k, slope))).re
    }
}

/// With `ρ0 = M/Δ` and `h/Δ` in hundredths.
fn lattice(name: &str, kernel: Kernel, hundredths: i64) -> LatticeMethod {
    let method = catalogue::method(name).expect("it is in the list");
    let lattice = LatticeMethod::new(method, kernel, &ratio(hundredths, 100));
    lattice.expect("the ratio is in range").with_density(Density::MassPerSpacing)
}

#[test]
fn viscosity_as_printed_would_amplify() {
    // (59): ω² − i b ω − ω_SPH² = 0 damps for b < 0. As printed, b is positive; with the denominator
    // (a − b)Δ it is the negative of the library's damping rate.
    let waves = lattice("sph-av", Kernel::CubicSpline, 120).waves().unwrap().compile();
    let printed = Printed { kernel: Kernel::CubicSpline, h: 1.2 };
    for step in 1..=31 {
        let kappa = 0.1 * f64::from(step);
        let mode = waves.mode(kappa);
        let b = printed.b_av(kappa, 1.0);
        assert!(b > 0.0 && (mode.damping - b).abs() < 1e-13);
        assert!((mode.restoring - printed.squared_sph(kappa).re).abs() < 1e-13);
        let found = mode.frequencies();
        for omega in [found.forward, found.backward] {
            let residual = omega * omega + Complex64::I * b * omega - mode.restoring;
            assert!(residual.norm() < 1e-13 && omega.im < 0.0);
        }
    }
}

#[test]
fn long_waves_are_sound_only_where_the_lattice_sums_are_consistent() {
    // The caption of Figure 2 lets the phase error vanish for long waves at all 1 < h < 1.5. With
    // ρ0 = M/Δ = 1 it does so at h = 1, is +8 % at h = 1.1 and −22 % at h = 1.5, and the summation density
    // changes the third digit of that.
    let error = |numerator: i64, density: Density| {
        let sph = lattice("sph", Kernel::CubicSpline, numerator).with_density(density);
        let omega = sph.waves().unwrap().compile().mode(1e-4).frequencies().forward;
        courant_analysis::waves::dispersion::phase_error(omega, 1e-4)
    };
    assert!(error(100, Density::MassPerSpacing).abs() < 1e-8);
    for density in [Density::MassPerSpacing, Density::Summation] {
        assert!((error(110, density) - 0.0788).abs() < 1e-3);
        assert!((error(150, density) + 0.222).abs() < 1e-3);
    }
    assert!(error(200, Density::MassPerSpacing).abs() < 1e-8);
}

#[test]
fn branches_are_continuous_in_the_wave_number() {
    // From the sound waves ω = ±cκ on: no jump at fine steps, through regions of over-damping too, where
    // a square root lets a step of 1e-4 move a root by at most a few hundredths.
    for kernel in Kernel::ALL {
        for (numerator, alpha) in [(10, 0), (12, 1), (15, 3), (20, 6)] {
            for name in ["sph-av", "gph"] {
                let mut method = lattice(name, kernel, 10 * numerator);
                if name == "sph-av" {
                    method = method.with("alpha", &integer(alpha));
                }
                let waves = method.waves().unwrap().compile();
                let mut last = waves.mode(1e-4).frequencies();
                assert!(last.forward.re > 0.0 && last.backward.re < 0.0);
                for step in 2..=31_415 {
                    let next = waves.mode(1e-4 * f64::from(step)).frequencies();
                    assert!((next.forward - last.forward).norm() < 0.05, "{kernel} {step}");
                    assert!((next.backward - last.backward).norm() < 0.05, "{kernel} {step}");
                    last = next;
                }
            }
        }
    }
}
