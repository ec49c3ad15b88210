//! The stability margin `(1 + ε)² − |g|²` as an exact polynomial in the Courant number and the phase,
//! with the factors taken out that vanish trivially.

use crate::exact::common_factor::{common_square_root, have_no_common_factor};
use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::polynomial::{Polynomial, Ring};
use crate::exact::rational::{
    Rational, common_denominator, greatest_divisor, least_multiple, numerator_over,
};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

mod compiled;

pub use compiled::{CompiledMargin, growth_from_excess};

/// `(1 + ε)² − |g(φ)|² = s^a (1 − s)^b H(φ)² C^c Σ_j t^j p_j(φ)` with `s = (1 − cos φ)/2` and `t = C^stride`.
///
/// `s^a` is the factor every scheme has that keeps constants (`g(0) = 1`), taken out as often as it
/// goes; `(1 − s)^b` is there when the shortest wave is neutral whatever the Courant number; `C^c` is
/// there because nothing happens at `C = 0`; the stride is 2 where only even powers of `C` occur. What
/// is left decides stability: the scheme is stable at `C` exactly when `P = Σ_j t^j p_j` is nowhere
/// negative on `0 < φ < π`, nor at π.
///
/// The `p_j` are cosine series with integer coefficients over one common denominator.
///
/// ```
/// use courant_analysis::{exact::rational::integer, scheme::Step};
/// let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
/// let margin = upwind.gain_margin("C", &integer(0))?.unwrap();
/// // 1 − |g|² = 4 s C (1 − C)
/// assert_eq!((margin.phase_power(), margin.courant_power()), (1, 1));
/// assert_eq!(margin.coefficient(0).at_zero(), integer(4));
/// assert_eq!(margin.coefficient(1).at_zero(), integer(-4));
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Margin {
    series: Vec<CosineSeries<BigInt>>,
    radius: Vec<BigInt>,
    denominator: BigInt,
    phase_power: usize,
    complement_power: usize,
    neutral_waves: Polynomial<Rational>,
    courant_power: usize,
    stride: usize,
    growth: Rational,
}

impl Margin {
    /// A polynomial `Σ_j t^j p_j(φ)` given as such, whose sign is to be decided: the factors that vanish
    /// trivially are taken out as from `(1 + ε)² − |g|²`. Here `C` is `t` or, with stride 2, its root.
    pub(crate) fn of_polynomial(powers: &[EnclosedSeries]) -> Self {
        let common = powers
            .iter()
            .fold(BigInt::one(), |all, power| least_multiple(&all, power.denominator()));
        let over = |power: &EnclosedSeries| -> Vec<BigInt> {
            let factor = &common / power.denominator();
            power.numerators().iter().map(|value| value * &factor).collect()
        };
        let mut numerators: Vec<Vec<BigInt>> = powers.iter().map(over).collect();
        let values = numerators.iter().flatten();
        // A remainder costs less than a common divisor, and tells that nothing is left to divide out.
        let content = values.fold(common.clone(), |all, value| {
            if all.is_one() || value.is_multiple_of(&all) {
                all
            } else {
                greatest_divisor(&all, value)
            }
        });
        if !content.is_one() {
            numerators.iter_mut().flatten().for_each(|value| *value /= &content);
        }
        let denominator = common / content;
        let series = numerators.into_iter().map(CosineSeries::new).collect();
        let radius = powers.iter().map(EnclosedSeries::radius);
        let mut margin = Self::whole(series, radius, denominator, Rational::zero());
        margin.take_out_courant_number();
        margin.phase_power = margin.take_out(CosineSeries::divide_by_s);
        margin.complement_power = margin.take_out(CosineSeries::divide_by_complement);
        margin.take_out_neutral_waves();
        margin
    }

    /// With factors `s^a (1 − s)^b` that were taken out before.
    pub(crate) fn with_factors(mut self, phase_power: usize, complement_power: usize) -> Self {
        self.phase_power += phase_power;
        self.complement_power += complement_power;
        self
    }

    /// As one of `(1 + growth)² − |g|²`.
    pub(crate) fn with_growth(self, growth: &Rational) -> Self {
        Self { growth: growth.clone(), ..self }
    }

    /// `Σ_j C^j p_j` with no factor taken out; the radii are rounded up to the unit of the series.
    fn whole<'a>(
        series: Vec<CosineSeries<BigInt>>,
        radius: impl Iterator<Item = &'a Rational>,
        denominator: BigInt,
        growth: Rational,
    ) -> Self {
        let unit = Rational::from(denominator.clone());
        Self {
            series,
            // Most data are exact: a product of fractions takes a divisor.
            radius: radius
                .map(|value| match value.is_zero() {
                    true => BigInt::zero(),
                    false => (value * &unit).ceil().to_integer(),
                })
                .collect(),
            denominator,
            phase_power: 0,
            complement_power: 0,
            neutral_waves: Polynomial::one(),
            courant_power: 0,
            stride: 1,
            growth,
        }
    }

    fn take_out_courant_number(&mut self) {
        while self.series.last().is_some_and(CosineSeries::is_zero)
            && self.radius.last().is_some_and(Zero::is_zero)
        {
            self.series.pop();
            self.radius.pop();
        }
        let occupied: Vec<usize> = (0..self.series.len())
            .filter(|&power| !self.series[power].is_zero() || !self.radius[power].is_zero())
            .collect();
        let Some(&first) = occupied.first() else { return };
        let even = occupied.iter().all(|power| (power - first) % 2 == 0) && occupied.len() > 1;
        self.courant_power = first;
        self.stride = if even { 2 } else { 1 };
        self.series = self.series.iter().skip(first).step_by(self.stride).cloned().collect();
        self.radius = self.radius.iter().skip(first).step_by(self.stride).cloned().collect();
    }

    /// Divides an exact margin by a factor as often as it goes: how often.
    fn take_out(
        &mut self,
        divided: impl Fn(&CosineSeries<BigInt>) -> Option<CosineSeries<BigInt>>,
    ) -> usize {
        let mut times = 0;
        while self.is_exact() && !self.is_neutral() {
            let Some(series) = self.series.iter().map(&divided).collect() else { break };
            self.series = series;
            times += 1;
        }
        times
    }

    fn take_out_neutral_waves(&mut self) {
        if !self.is_exact() || self.is_neutral() || self.degree() < 2 {
            return;
        }
        if have_no_common_factor(&self.series) {
            return;
        }
        let powers: Vec<Polynomial<Rational>> = self
            .series
            .iter()
            .map(|series| series.in_powers_of_s().map(|value| Rational::from(value.clone())))
            .collect();
        let root = common_square_root(&powers);
        if root.degree() < Some(1) {
            return;
        }
        let square = root.pow(2);
        let quotients: Vec<_> = powers.iter().map(|power| power.divide(&square).0).collect();
        let common = common_denominator(quotients.iter().flat_map(Polynomial::coefficients));
        let degree = self.degree() - 2 * root.degree().unwrap_or(0);
        self.series = quotients
            .iter()
            .map(|quotient| {
                let integers = quotient.map(|v| numerator_over(v, &common));
                CosineSeries::from_powers_of_s(&integers, degree)
            })
            .collect();
        self.denominator *= common << (2 * degree);
        self.neutral_waves = root;
    }

    /// The polynomial `H` in powers of `s` whose square was taken out: it vanishes at the waves that are
    /// neutral at every Courant number. 1 when there are none.
    pub fn neutral_waves(&self) -> &Polynomial<Rational> {
        &self.neutral_waves
    }

    /// The power of `s = (1 − cos φ)/2` taken out.
    pub fn phase_power(&self) -> usize {
        self.phase_power
    }

    /// The power of `1 − s = (1 + cos φ)/2` taken out.
    pub fn complement_power(&self) -> usize {
        self.complement_power
    }

    /// The power of `C` taken out.
    pub fn courant_power(&self) -> usize {
        self.courant_power
    }

    /// `t = C^stride`: 1 or 2.
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// The permitted growth per step `ε`.
    pub fn growth(&self) -> &Rational {
        &self.growth
    }

    /// Whether the scheme is exactly neutral at every Courant number and phase: `|g| = 1`.
    pub fn is_neutral(&self) -> bool {
        self.series.iter().all(CosineSeries::is_zero) && self.is_exact()
    }

    /// Whether all coefficients are exact.
    pub fn is_exact(&self) -> bool {
        self.radius.iter().all(Zero::is_zero)
    }

    /// The number of powers of `t`.
    pub fn powers(&self) -> usize {
        self.series.len()
    }

    /// The degree in `cos φ`.
    pub fn degree(&self) -> usize {
        degree(&self.series)
    }

    /// `p_j` as an exact cosine series.
    pub fn coefficient(&self, power: usize) -> CosineSeries<Rational> {
        self.series[power].map(|value| Rational::new(value.clone(), self.denominator.clone()))
    }

    /// The series `p_j` times [`denominator`](Self::denominator).
    pub fn integer_series(&self) -> &[CosineSeries<BigInt>] {
        &self.series
    }

    /// Bounds on how far each integer series may be from the true function.
    pub fn integer_radius(&self) -> &[BigInt] {
        &self.radius
    }

    /// The common denominator, positive.
    pub fn denominator(&self) -> &BigInt {
        &self.denominator
    }
}

/// The largest degree in `cos φ` among the powers of `t`.
fn degree<T: Ring>(series: &[CosineSeries<T>]) -> usize {
    series.iter().map(CosineSeries::degree).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{integer, ratio, to_f64};
    use crate::kernel::Kernel;
    use crate::scheme::testing::{SPH, sph};
    use proptest::prelude::*;

    fn margin(scheme: &str, kernel: Kernel, ratio: Rational) -> Margin {
        sph(scheme, kernel, &ratio).gain_margin("C", &integer(0)).unwrap().unwrap()
    }

    #[test]
    fn structure_is_recognised() {
        let shape = |scheme, kernel, ratio| {
            let margin = margin(scheme, kernel, ratio);
            (margin.phase_power(), margin.courant_power(), margin.stride(), margin.powers())
        };
        let [euler, lax_wendroff, godunov] = SPH;
        for kernel in Kernel::ALL {
            assert_eq!(shape(godunov, kernel, integer(2)), (1, 1, 1, 2), "{kernel}");
        }
        assert_eq!(shape(euler, Kernel::Gaussian, integer(2)), (1, 2, 1, 1));
        // Fully consistent: fourth order in φ. Not keeping constants: no factor at all.
        assert_eq!(shape(lax_wendroff, Kernel::CubicSpline, integer(2)), (2, 2, 2, 2));
        assert_eq!(shape(lax_wendroff, Kernel::CubicSpline, ratio(13, 10)), (0, 2, 2, 2));
        assert_eq!(shape(lax_wendroff, Kernel::Gaussian, integer(2)), (0, 2, 2, 2));
        // At ratio 2 the cubic spline does not see the shortest wave: g(π) = 1 at every C.
        let cubic = margin(lax_wendroff, Kernel::CubicSpline, integer(2));
        assert_eq!(cubic.complement_power(), 2);
        // At ratio 3 it does not see φ = 2π/3, s = 3/4, and sees nothing of it to fourth order.
        let cubic = margin(lax_wendroff, Kernel::CubicSpline, integer(3));
        let neutral = cubic.neutral_waves().clone();
        assert!(neutral.evaluate(&ratio(3, 4)).is_zero(), "{neutral:?}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn the_margin_is_one_minus_the_squared_gain(
            numerator in 5i64..60, courant_number in 0.0f64..5.0, phase in 0.0f64..3.2,
            growth in 0i64..3
        ) {
            for scheme in SPH {
                for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
                    let step = sph(scheme, kernel, &ratio(numerator, 10));
                    let growth = ratio(growth, 10);
                    let margin = step.gain_margin("C", &growth).unwrap().unwrap().compile();
                    let gain = step.one_step("C").unwrap().gain(courant_number, phase);
                    let direct = (1.0 + to_f64(&growth)).powi(2) - gain.norm_sqr();
                    // Rounding of sums of moduli at most (1 + C)⁴.
                    let tolerance = 1e-13 * (1.0 + courant_number).powi(4);
                    prop_assert!((margin.at(courant_number, phase) - direct).abs() < tolerance);
                    prop_assert!(
                        (margin.growth(courant_number, phase) - (gain.norm() - 1.0)).abs()
                            < tolerance.max(tolerance.sqrt() * f64::from(gain.norm() < 1e-6))
                    );
                }
            }
        }
    }

    #[test]
    fn what_is_zero_within_a_radius_is_not_nothing() {
        let series =
            |value: i64, radius: i64| EnclosedSeries::new(&[integer(value)], integer(radius));
        let of = |powers: &[EnclosedSeries]| Margin::of_polynomial(powers);
        assert!(of(&[series(0, 0)]).is_neutral() && of(&[]).is_neutral());
        let open = of(&[series(0, 1)]);
        assert!(!open.is_neutral() && !open.is_exact());
        // 1 + (0 ± 1) t, and 1 + 0 t.
        assert_eq!(of(&[series(1, 0), series(0, 1)]).powers(), 2);
        assert_eq!(of(&[series(1, 0), series(0, 0)]).powers(), 1);
        // Nothing is divided out of what is only near zero.
        let long = EnclosedSeries::new(&[integer(1), integer(-1)], ratio(1, 9));
        assert_eq!(of(&[long]).phase_power(), 0);
        // cos² φ, exactly and not.
        let squared = |radius: Rational| {
            let half = ratio(1, 2);
            of(&[EnclosedSeries::new(&[half.clone(), integer(0), half], radius)])
        };
        let degrees =
            [integer(0), ratio(1, 9)].map(|radius| squared(radius).neutral_waves().degree());
        assert_eq!(degrees, [Some(1), Some(0)]);
    }

    #[test]
    fn long_waves_lose_no_digits() {
        // 1 − |g|² = 4 s C (1 − C) for the upwind scheme, at a phase where the difference of squares
        // would have no digit left.
        let margin = margin("godunov-sph", Kernel::CubicSpline, integer(1)).compile();
        let phase: f64 = 1e-9;
        let expected = 4.0 * (0.5 * phase).sin().powi(2) * 0.25;
        assert!((margin.at(0.5, phase) / expected - 1.0).abs() < 4.0 * f64::EPSILON);
    }
}
