//! The relation printed for Godunov particle hydrodynamics, `ω² + c S ω − ω_SPH² = 0`: (61)–(64).
//!
//! It takes the particle itself as the left state towards every neighbour, so that its waves are not damped and not symmetric. No
//! running scheme has it: it has frequencies, and a step to look at, but no stable step that would mean anything.

use crate::wave_map::{Shown, WaveMap};
use courant_analysis::exact::rational::{Rational, to_f64};
use courant_analysis::kernel::{CompiledSums, Density, Kernel, LatticeSums};
use courant_analysis::scheme::LatticeMethod;
use courant_analysis::scheme::catalogue::SchemeFile;
use courant_analysis::waves::dispersion::{Frequencies, Regime, phase_error};
use courant_analysis::waves::sweep::{Progress, SweepError, with_progress};
use ndarray::Array2;
use num_complex::Complex64;
use rayon::prelude::*;
use std::sync::LazyLock;

/// The equations of the relation, with which an integrator can step a wave.
pub fn equations() -> &'static SchemeFile {
    static FILE: LazyLock<SchemeFile> = LazyLock::new(|| {
        SchemeFile::from_toml(include_str!("gph_published.toml")).expect("it is read by a test")
    });
    &FILE
}

/// The frequencies of the printed relation on one lattice.
#[derive(Debug, Clone)]
pub struct PublishedWaves(CompiledSums);

impl PublishedWaves {
    /// For an isothermal gas.
    ///
    /// # Errors
    /// When the ratio is out of range.
    pub fn new(kernel: Kernel, ratio: &Rational, density: Density) -> Result<Self, SweepError> {
        Ok(Self(LatticeSums::new(kernel, ratio, density)?.compile()))
    }

    /// Those of a method's lattice.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of(lattice: &LatticeMethod) -> Result<Self, SweepError> {
        Self::new(lattice.kernel(), lattice.ratio(), lattice.density())
    }

    /// `ω = (−S ± √(S² + 4 ω_SPH²))/2`, (64), in units of `c/Δ`, without cancellation.
    pub fn frequencies(&self, phase: f64) -> Frequencies {
        let sums = self.0.at(phase);
        let (skew, restoring) = (sums.gradient, 2.0 * sums.curvature - sums.gradient.powi(2));
        let discriminant = skew * skew + 4.0 * restoring;
        if discriminant < 0.0 {
            let growth = 0.5 * (-discriminant).sqrt();
            let frequency = |sign: f64| Complex64::new(-0.5 * skew, sign * growth);
            let (forward, backward) = (frequency(1.0), frequency(-1.0));
            return Frequencies { forward, backward, regime: Regime::Growing };
        }
        // The root away from zero first, the other from the product −ω0².
        let far = -0.5 * (skew + discriminant.sqrt().copysign(skew));
        let near = if far == 0.0 { 0.0 } else { -restoring / far };
        let (forward, backward) = if far < near { (near, far) } else { (far, near) };
        let regime = if near == 0.0 { Regime::ZeroFrequency } else { Regime::Propagating };
        Frequencies { forward: forward.into(), backward: backward.into(), regime }
    }
}

/// The phase error of the printed relation over `(κ, h)`. Nothing damps; where the lattice is unstable the damping ratio is not a number.
///
/// # Errors
/// When a ratio is out of range or the callback stops the sweep.
pub fn phase_error_map(
    kernel: Kernel,
    density: Density,
    kappas: &[f64],
    ratios: &[Rational],
    progress: Progress<'_>,
) -> Result<WaveMap, SweepError> {
    let columns = with_progress(ratios.par_iter(), progress, |ratio| {
        let waves = PublishedWaves::new(kernel, ratio, density)?;
        let of = |&kappa: &f64| {
            let found = waves.frequencies(kappa);
            let damping = if found.regime == Regime::Growing { f64::NAN } else { 0.0 };
            (phase_error(found.forward, kappa), damping)
        };
        Ok(kappas.iter().map(of).collect::<Vec<_>>())
    })?;
    let shape = (kappas.len(), ratios.len());
    Ok(WaveMap {
        shown: Shown::PhaseError,
        kappas: kappas.to_vec(),
        second: ratios.iter().map(to_f64).collect(),
        values: Array2::from_shape_fn(shape, |(i, j)| columns[j][i].0),
        damping_ratio: Array2::from_shape_fn(shape, |(i, j)| columns[j][i].1),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::exact::rational::{integer, ratio};
    use courant_analysis::scheme::Integrator;
    use courant_analysis::waves::dispersion::two_waves;

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

        /// `b_GPH` below (64).
        fn b_gph(&self, kappa: f64) -> f64 {
            self.sum(|k, slope, _| Complex64::from((k * kappa).sin() * slope)).re
        }
    }

    #[test]
    fn the_relation_is_the_printed_algebra() {
        for kernel in [Kernel::CubicSpline, Kernel::QuinticSpline, Kernel::WendlandC4] {
            for at in [ratio(1, 1), ratio(6, 5), ratio(3, 2), ratio(23, 10)] {
                let waves = PublishedWaves::new(kernel, &at, Density::MassPerSpacing).unwrap();
                let printed = Printed { kernel, h: to_f64(&at) };
                let mut last = waves.frequencies(1e-4);
                assert!(last.forward.re > 0.0 && last.backward.re < 0.0);
                for step in 1..=310 {
                    let kappa = 0.01 * f64::from(step);
                    let found = waves.frequencies(kappa);
                    let (b, squared) = (printed.b_gph(kappa), printed.squared_sph(kappa));
                    // (64). Rounding of sums of ten terms of size ten.
                    let root = (b * b + 4.0 * squared.re).max(0.0).sqrt();
                    assert!(squared.im.abs() < 1e-13);
                    assert!(
                        (found.forward.re - 0.5 * (root - b)).abs() < 1e-12,
                        "{kernel} {kappa}"
                    );
                    assert!(
                        (found.backward.re + 0.5 * (b + root)).abs() < 1e-12,
                        "{kernel} {kappa}"
                    );
                    // (62): ω² = ω_SPH² − Σ (1 − e^{iφ}) ∂W ω i.
                    let friction =
                        printed.sum(|k, slope, _| (1.0 - Complex64::cis(k * kappa)) * slope);
                    for omega in [found.forward, found.backward] {
                        let residual = omega * omega - squared + friction * omega * Complex64::I;
                        assert!(residual.norm() < 1e-12, "{kernel} {kappa} {residual}");
                        assert_eq!(omega.im, 0.0, "the printed relation gives no damping");
                    }
                    // Continuous from ω = ±cκ.
                    assert!((found.forward - last.forward).norm() < 0.05);
                    assert!((found.backward - last.backward).norm() < 0.05);
                    last = found;
                }
            }
        }
    }

    #[test]
    fn its_equations_step_its_waves() {
        let lattice = LatticeMethod::new(equations(), Kernel::CubicSpline, &ratio(6, 5)).unwrap();
        let waves = PublishedWaves::of(&lattice).unwrap();
        let rk4 = lattice.step(Integrator::named("rk4").unwrap()).unwrap().compile().unwrap();
        for phase in [0.1, 1.0, 2.5, 3.1] {
            let exact = waves.frequencies(phase);
            let pair = two_waves(&rk4, &[0.01], phase, &exact, 0.012);
            for (y, omega) in pair.into_iter().zip([exact.forward, exact.backward]) {
                // RK4 is exact in time to (ωΔt)⁵/120.
                let expected = (-Complex64::I * omega * 0.012).exp();
                assert!((y + 1.0 - expected).norm() < 1e-9, "{phase}");
            }
        }
    }

    #[test]
    fn it_is_not_the_relation_of_the_scheme() {
        let waves = PublishedWaves::new(Kernel::CubicSpline, &integer(1), Density::Summation);
        let found = waves.unwrap().frequencies(1e-3);
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        assert!((found.forward.re / 1e-3 - golden).abs() < 1e-6);
        assert!((found.backward.re / 1e-3 + 1.0 + golden).abs() < 1e-6);
    }
}
