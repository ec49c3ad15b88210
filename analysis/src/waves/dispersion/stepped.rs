//! The frequencies that a stepped wave shows.

use super::branches::{Frequencies, Regime};
use crate::waves::multipliers::CompiledStep;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Roundings of a multiplier near one.
const NO_GROWTH: f64 = 16.0 * f64::EPSILON;

/// `z − 1` of the two waves of a mode as `step` steps them: the forward one first.
///
/// Of two multipliers the forward one has `Im z ≤ 0`, and of two real ones it is the larger in modulus, which is left in the end. Of more,
/// as of a multistep method, or where the two are no pair, those nearest to what is `exact` in time; `time` is `c Δt/Δ`.
pub fn two_waves(
    step: &CompiledStep,
    values: &[f64],
    phase: f64,
    exact: &Frequencies,
    time: f64,
) -> [Complex64; 2] {
    let mut found = step.differences(values, &[phase]);
    if let [first, second] = found[..] {
        let real = first.im == 0.0 && second.im == 0.0;
        if real || first == second.conj() {
            return [first, second];
        }
    }
    [exact.forward, exact.backward].map(|frequency| {
        let expected = (Complex64::new(frequency.im, -frequency.re) * time).exp() - 1.0;
        let distance = |y: &Complex64| (y - expected).norm();
        let nearest =
            (0..found.len()).min_by(|&a, &b| distance(&found[a]).total_cmp(&distance(&found[b])));
        nearest.map_or(Complex64::new(f64::NAN, f64::NAN), |index| found.swap_remove(index))
    })
}

/// `|1 + y| − 1` without cancellation near 1.
fn excess(y: Complex64) -> f64 {
    if y.im == 0.0 {
        return if y.re >= -1.0 { y.re } else { -2.0 - y.re };
    }
    let x = 2.0 * y.re + y.norm_sqr();
    x / (1.0 + (1.0 + x).max(0.0).sqrt())
}

/// The frequencies of a stepped wave, `ω = i ln z/Δt` in units of `c/Δ`, from `z − 1` of its two multipliers; `time` is `c Δt/Δ` and not
/// zero.
///
/// A real negative multiplier turns the sign at every step: it is `Re ω = ±π/Δt`.
///
/// ```
/// use courant_analysis::{exact::rational::integer, kernel::Kernel};
/// use courant_analysis::scheme::{Integrator, LatticeMethod, catalogue};
/// use courant_analysis::waves::dispersion::{stepped_frequencies, two_waves};
/// let sph = LatticeMethod::new(catalogue::method("sph").unwrap(), Kernel::CubicSpline, &integer(1))?;
/// let exact = sph.waves()?.compile().mode(1.0).frequencies();
/// let leapfrog = sph.step(Integrator::named("kdk").unwrap())?.compile()?;
/// let stepped = stepped_frequencies(two_waves(&leapfrog, &[0.1], 1.0, &exact, 0.1), 0.1);
/// // sin(ωΔt/2) = ω0Δt/2
/// let expected = 20.0 * (0.05 * exact.forward.re).asin();
/// assert!((stepped.forward.re - expected).abs() < 1e-13 && stepped.forward.im.abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn stepped_frequencies([first, second]: [Complex64; 2], time: f64) -> Frequencies {
    let frequency = |y: Complex64, sign: f64| {
        let z = y + 1.0;
        let angle = if z.im == 0.0 && z.re < 0.0 { sign * PI } else { -z.arg() };
        let growth = excess(y);
        // Near |z| = 1 the logarithm of the excess, which is exact there.
        let rate = if growth > -0.5 { growth.ln_1p() } else { z.norm().ln() };
        Complex64::new(angle + 0.0, rate) / time
    };
    // y² − e y + d = 0: where its discriminant is rounding, one multiplier twice.
    let (sum, product) = (first + second, first * second);
    let apart = 0.25 * (first - second).norm_sqr();
    let double = apart <= 8.0 * f64::EPSILON * (0.25 * sum.norm_sqr() + product.norm());
    let pair = if double { [0.5 * sum, 0.5 * sum] } else { [first, second] };
    let growth = excess(pair[0]).max(excess(pair[1]));
    let real = pair.iter().all(|y| y.im == 0.0);
    let regime = if growth > NO_GROWTH {
        Regime::Growing
    } else if real && pair[0] == Complex64::ZERO {
        Regime::ZeroFrequency
    } else if double {
        Regime::CriticallyDamped
    } else if real {
        Regime::OverDamped
    } else {
        Regime::Propagating
    };
    Frequencies { forward: frequency(pair[0], 1.0), backward: frequency(pair[1], -1.0), regime }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use crate::kernel::Kernel;
    use crate::scheme::{Integrator, LatticeMethod, catalogue};

    #[test]
    fn small_steps_show_the_waves_exact_in_time() {
        let viscous = catalogue::method("sph-av").unwrap();
        let lattice = LatticeMethod::new(viscous, Kernel::CubicSpline, &ratio(6, 5)).unwrap();
        let waves = lattice.waves().unwrap().compile();
        let time = 1.2e-3;
        for integrator in ["rk4", "ab3", "bdf2", "kdk", "leapfrog"] {
            let step = lattice.step(Integrator::named(integrator).unwrap()).unwrap();
            let step = step.compile().unwrap();
            for phase in [0.3, 1.0, 2.0, 4.0] {
                let exact = waves.mode(phase).frequencies();
                let shown =
                    stepped_frequencies(two_waves(&step, &[1e-3], phase, &exact, time), time);
                assert!((shown.forward - exact.forward).norm() < 1e-3, "{integrator} {phase}");
                assert!((shown.backward - exact.backward).norm() < 1e-3, "{integrator} {phase}");
                assert_eq!(shown.regime, exact.regime, "{integrator} {phase}");
            }
        }
    }

    #[test]
    fn regimes_are_those_of_the_multipliers() {
        let of = |first: f64, second: f64| {
            stepped_frequencies([Complex64::from(first), Complex64::from(second)], 0.5)
        };
        assert_eq!(of(0.0, -0.5).regime, Regime::ZeroFrequency);
        assert_eq!(of(-0.2, -0.5).regime, Regime::OverDamped);
        assert_eq!(of(-0.5, -0.5).regime, Regime::CriticallyDamped);
        let turning = of(-1.9, -0.5);
        assert_eq!(turning.forward.re, 2.0 * PI);
        assert!((turning.forward.im - 0.9f64.ln() / 0.5).abs() < 1e-15);
        assert_eq!(of(-2.1, -0.5).regime, Regime::Growing);
    }
}
