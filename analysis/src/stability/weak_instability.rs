//! Weak instability: schemes that grow so slowly that yes or no is the wrong question. How they start
//! to grow, how fast at a given Courant number, and what a periodic run of `N` cells can see of it.

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, ratio};
use crate::golden_section::golden_section;
use crate::stability::margin::{CompiledMargin, Margin};
use num_traits::Zero;
use std::f64::consts::{LN_2, PI};

/// An extremum of `|g|` over all phases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremum {
    /// `|g| − 1`, free of cancellation.
    pub growth: f64,
    /// Where it is taken, in radians.
    pub phase: f64,
}

/// `|g|² − 1 ≈ A(C) φ^p` for long waves, with exact `A`.
#[derive(Debug, Clone, PartialEq)]
pub struct LongWaveBehaviour {
    /// The exponent `p`, even; 0 when the scheme does not keep constants: then the mean itself changes.
    pub power: usize,
    /// `A`, a polynomial in `C`.
    pub amplitude: Polynomial<Rational>,
}

/// The leading long-wave term of `|g|² − 1` for a general Courant number; `None` when `|g| = 1` for all
/// waves, or when growth is permitted (the question is then another one).
///
/// ```
/// use courant_analysis::{exact::rational::integer, scheme::Step};
/// use courant_analysis::stability::weak_instability::long_wave_behaviour;
/// // Forward Euler with central differences: |g|² = 1 + C² sin² φ.
/// let euler = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j+1] - u[n,j-1])/2")?;
/// let margin = euler.gain_margin("C", &integer(0))?.unwrap();
/// let leading = long_wave_behaviour(&margin).unwrap();
/// assert_eq!((leading.power, leading.amplitude.evaluate(&integer(3))), (2, integer(9)));
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
pub fn long_wave_behaviour(margin: &Margin) -> Option<LongWaveBehaviour> {
    if margin.is_neutral() || !margin.growth().is_zero() {
        return None;
    }
    // |g|² − 1 = −s^a (…)H² C^c Σ t^j p_j, and s ≈ φ²/4.
    let scale = -long_wave_scale(margin, 0);
    let mut amplitude = Polynomial::zero();
    for power in 0..margin.powers() {
        let value = margin.coefficient(power).at_zero() * &scale;
        let degree = margin.courant_power() + margin.stride() * power;
        amplitude = amplitude + Polynomial::monomial(value, degree);
    }
    Some(LongWaveBehaviour { power: 2 * margin.phase_power(), amplitude })
}

/// The exponent `p` and the amplitude `A` of `|g|² − 1 ≈ A φ^p` at one Courant number, where the general
/// amplitude may vanish and a higher power leads; `None` when `|g| = 1` for all waves.
pub fn long_wave_behaviour_at(
    margin: &Margin,
    courant_number: &Rational,
) -> Option<(usize, Rational)> {
    let t = courant_number.pow(margin.stride() as i32);
    let powers: Vec<Polynomial<Rational>> =
        (0..margin.powers()).map(|power| margin.coefficient(power).in_powers_of_s()).collect();
    let in_s =
        powers.into_iter().rev().fold(Polynomial::zero(), |sum, power| sum.scale(&t) + power);
    let order = in_s.coefficients().iter().position(|value| !value.is_zero())?;
    let factor = courant_number.pow(margin.courant_power() as i32);
    let amplitude = -in_s.coefficient(order) * long_wave_scale(margin, order) * factor;
    (!amplitude.is_zero()).then_some((2 * (margin.phase_power() + order), amplitude))
}

/// `H(0)² / 4^{a + order}`.
fn long_wave_scale(margin: &Margin, order: usize) -> Rational {
    let neutral = margin.neutral_waves().evaluate(&integer(0));
    &neutral * &neutral * ratio(1, 4).pow((margin.phase_power() + order) as i32)
}

/// Steps until a wave with `|g| − 1 = growth` has doubled, `ln 2 / ln |g|`; `None` when it does not grow.
///
/// ```
/// use courant_analysis::stability::weak_instability::steps_to_double;
/// assert_eq!(steps_to_double(1.0), Some(1.0));
/// assert_eq!(steps_to_double(-0.5), None);
/// ```
pub fn steps_to_double(growth: f64) -> Option<f64> {
    (growth > 0.0).then(|| LN_2 / growth.ln_1p())
}

/// The fastest growing of all waves `0 < φ ≤ π` at one Courant number, in `f64` without cancellation.
///
/// Looked for on a grid that resolves every oscillation of the margin, and on a geometric one towards
/// long waves, because just above a long-wave limit only those grow; then refined. Growth below about
/// `1e-16 C²` is lost in rounding.
///
/// ```
/// use courant_analysis::{exact::rational::integer, kernel::Kernel, scheme::catalogue};
/// use courant_analysis::stability::weak_instability::{fastest_growth, steps_to_double};
/// let godunov = catalogue::scheme("godunov-sph").unwrap();
/// let step = godunov.with_kernel(Kernel::CubicSpline, &integer(2))?;
/// let margin = step.gain_margin("C", &integer(0))?.unwrap();
/// // The published 1.90 is above 15/8.
/// let growth = fastest_growth(&margin, 1.90);
/// assert!(growth.growth > 1e-6 && steps_to_double(growth.growth).is_some());
/// assert!(fastest_growth(&margin, 1.87).growth <= 0.0);
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
pub fn fastest_growth(margin: &Margin, courant_number: f64) -> Extremum {
    let compiled = margin.compile();
    let cells = (16 * margin.degree()).max(64);
    let uniform = (1..=cells).map(|index| index as f64 * PI / cells as f64);
    let geometric = (1..=208).map(|index| PI / cells as f64 * 0.5f64.powf(f64::from(index) / 8.0));
    let mut phases: Vec<f64> = uniform.chain(geometric).collect();
    phases.sort_by(f64::total_cmp);
    if let Some(last) = phases.last_mut() {
        *last = PI;
    }
    let values: Vec<f64> =
        phases.iter().map(|&phase| compiled.growth(courant_number, phase)).collect();
    let mut best = mean_growth(margin, &compiled, courant_number);
    for index in 0..phases.len() {
        let (before, after) = (index.saturating_sub(1), (index + 1).min(phases.len() - 1));
        if values[index] < values[before] || values[index] < values[after] {
            continue;
        }
        best = larger(best, Extremum { growth: values[index], phase: phases[index] });
        let around = [phases[before], phases[after]];
        let at = |phase| compiled.growth(courant_number, phase);
        let (growth, phase) = golden_section(at, around, 1e-8 * around[1]);
        best = larger(best, Extremum { growth, phase });
    }
    best
}

/// The fastest growing wave of those a periodic run of `cells` cells can hold: `φ = 2πm/N`.
///
/// A long-wave instability narrower than the smallest phase `2π/N` is not there.
pub fn growth_seen_by(margin: &Margin, courant_number: f64, cells: usize) -> Extremum {
    let compiled = margin.compile();
    (1..=cells / 2)
        .map(|mode| {
            let phase = (2.0 * PI * mode as f64 / cells as f64).min(PI);
            Extremum { growth: compiled.growth(courant_number, phase), phase }
        })
        .fold(mean_growth(margin, &compiled, courant_number), larger)
}

/// The infinitely long wave: 0 for a scheme that keeps constants.
fn mean_growth(margin: &Margin, compiled: &CompiledMargin, courant_number: f64) -> Extremum {
    if margin.phase_power() > 0 {
        return Extremum { growth: f64::NEG_INFINITY, phase: 0.0 };
    }
    Extremum { growth: compiled.growth(courant_number, 0.0), phase: 0.0 }
}

fn larger(first: Extremum, second: Extremum) -> Extremum {
    if second.growth > first.growth { second } else { first }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::to_f64;
    use crate::kernel::Kernel;
    use crate::scheme::Step;
    use crate::scheme::testing::{SPH, sph};

    fn margin(scheme: &str, kernel: Kernel, l: Rational) -> Margin {
        sph(scheme, kernel, &l).gain_margin("C", &integer(0)).unwrap().unwrap()
    }

    #[test]
    fn the_leading_term_is_the_limit_of_the_symbol() {
        // The margin has no cancellation, so the quotient is good to φ² at φ = 1e-3.
        for kernel in [Kernel::CubicSpline, Kernel::QuinticSpline, Kernel::WendlandC2] {
            for scheme in SPH {
                let margin = margin(scheme, kernel, integer(2));
                let leading = long_wave_behaviour(&margin).unwrap();
                for courant_number in [ratio(1, 3), ratio(7, 5)] {
                    let amplitude = to_f64(&leading.amplitude.evaluate(&courant_number));
                    let phase: f64 = 1e-3;
                    let direct = -margin.compile().at(to_f64(&courant_number), phase);
                    let expected = amplitude * phase.powi(leading.power as i32);
                    assert!((direct - expected).abs() < 1e-4 * expected.abs(), "{scheme} {kernel}");
                    assert_eq!(
                        long_wave_behaviour_at(&margin, &courant_number),
                        Some((leading.power, leading.amplitude.evaluate(&courant_number)))
                    );
                }
            }
        }
    }

    #[test]
    fn at_the_long_wave_limit_the_next_power_leads() {
        let margin = margin("godunov-sph", Kernel::CubicSpline, integer(2));
        let limit = ratio(15, 8);
        let general = long_wave_behaviour(&margin).unwrap();
        assert_eq!((general.power, general.amplitude.evaluate(&limit)), (2, integer(0)));
        let (power, amplitude) = long_wave_behaviour_at(&margin, &limit).unwrap();
        assert!(power == 4 && amplitude < integer(0), "{amplitude}");
        // The exact shift is neutral at C = 1: no power at all.
        let shift = self::margin("godunov-sph", Kernel::CubicSpline, integer(1));
        assert_eq!(long_wave_behaviour_at(&shift, &integer(1)), None);
        // Nothing happens without a step, without neighbours, or where it is not growth that is asked about.
        assert_eq!(long_wave_behaviour_at(&margin, &integer(0)), None);
        let alone = self::margin("godunov-sph", Kernel::CubicSpline, ratio(1, 4));
        assert_eq!((long_wave_behaviour(&alone), steps_to_double(0.0)), (None, None));
        let growing =
            sph("godunov-sph", Kernel::CubicSpline, &integer(2)).gain_margin("C", &ratio(1, 9));
        assert_eq!(long_wave_behaviour(&growing.unwrap().unwrap()), None);
        assert_eq!(steps_to_double(-0.5), None);
    }

    #[test]
    fn growth_is_found_wherever_it_is() {
        // Euler with central differences: |g|² = 1 + C² sin² φ, largest at π/2.
        let euler = margin("euler-sph", Kernel::CubicSpline, integer(1));
        let growth = fastest_growth(&euler, 0.3);
        assert!((growth.growth - (1.09f64.sqrt() - 1.0)).abs() < 1e-15);
        assert!((growth.phase - PI / 2.0).abs() < 1e-6);
        // (1 + x)^n = 2.
        let steps = steps_to_double(growth.growth).unwrap();
        assert!(((1.0 + growth.growth).powf(steps) - 2.0).abs() < 1e-12);
        // A hair above a long-wave limit: only very long waves grow, |g|² − 1 = −A₂φ² − A₄φ⁴.
        let godunov = margin("godunov-sph", Kernel::CubicSpline, integer(2));
        let excess = 1e-9;
        let growth = fastest_growth(&godunov, 15.0 / 8.0 * (1.0 + excess));
        assert!(growth.growth > 0.0 && growth.phase < 1e-3, "{growth:?}");
        let slope = to_f64(
            &long_wave_behaviour(&godunov).unwrap().amplitude.derivative().evaluate(&ratio(15, 8)),
        );
        let (_, quartic) = long_wave_behaviour_at(&godunov, &ratio(15, 8)).unwrap();
        let (a, b) = (slope * 15.0 / 8.0 * excess, to_f64(&quartic));
        // max of aφ² + bφ⁴ is −a²/(4b); half of it is the growth.
        let expected = -a * a / (8.0 * b);
        assert!((growth.growth / expected - 1.0).abs() < 1e-3, "{} {expected}", growth.growth);
    }

    #[test]
    fn few_cells_do_not_see_a_long_wave_instability() {
        let godunov = margin("godunov-sph", Kernel::CubicSpline, integer(2));
        let courant_number = 1.876;
        let all = fastest_growth(&godunov, courant_number);
        assert!(all.growth > 0.0);
        assert!(growth_seen_by(&godunov, courant_number, 20).growth <= 0.0);
        let many = growth_seen_by(&godunov, courant_number, 20_000);
        assert!((many.growth / all.growth - 1.0).abs() < 1e-3);
        // A scheme that does not keep constants grows whatever the number of cells.
        let drifting = margin("lax-wendroff-sph", Kernel::Gaussian, integer(3));
        let seen = growth_seen_by(&drifting, 1.0, 2);
        assert_eq!(seen.phase == 0.0, seen.growth > 0.0, "{seen:?}");
        let of = |text: &str| {
            Step::from_text(text).unwrap().gain_margin("C", &integer(0)).unwrap().unwrap()
        };
        // g = 1 + C/5 cos φ; |g| = |1 − 2C| for the shortest wave.
        let drifting = of("u[n+1,j] = u[n,j] + C/10*(u[n,j+1] + u[n,j-1])");
        for seen in [growth_seen_by(&drifting, 1.0, 20), fastest_growth(&drifting, 1.0)] {
            assert!(seen.phase == 0.0 && (seen.growth - 0.2).abs() < 1e-15, "{seen:?}");
        }
        let upwind = of("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])");
        let seen = fastest_growth(&upwind, 1.2);
        assert!((seen.phase - PI).abs() < 1e-7 && (seen.growth - 0.4).abs() < 1e-15, "{seen:?}");
        let damped = fastest_growth(&upwind, 0.5);
        assert!(damped.growth < 0.0 && damped.phase > 0.0, "{damped:?}");
    }
}
