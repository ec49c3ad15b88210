//! What a scheme asks for at one value of its parameter: polynomials in `s = sin²(φ/2)` that must not be negative on `[0, 1]`.

use super::margin::Margin;
use super::torus::{TorusInequality, decide_on_torus};
use super::{Demands, Inequality, PointVerdict, Wave, even_series, phase_of};
use crate::exact::laurent::Laurent;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, common_denominator, integer, numerator_over};
use crate::exact::unit_interval::Zeros;
use crate::interest::Interest;
use crate::scheme::Names;
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::f64::consts::FRAC_PI_2;

/// The demands at one value.
#[derive(Debug, Clone)]
pub(crate) enum DemandsAt {
    /// None of these may be negative anywhere.
    All(Vec<DemandAt>),
    /// The same in two and three dimensions.
    OnTorus(Vec<TorusInequality>),
    /// What cannot be.
    Nowhere(usize),
    /// What is not known.
    Unknown,
}

/// One polynomial.
#[derive(Debug, Clone)]
pub(crate) struct DemandAt {
    /// The polynomial in the middle of its enclosure.
    polynomial: Polynomial<BigInt>,
    /// How far the true one may be from it.
    radius: BigInt,
    /// The zeros in the middle of the enclosure.
    zeros: Zeros,
}

impl DemandsAt {
    /// Of demands without a parameter.
    pub(crate) fn new(demands: &Demands) -> Self {
        match demands {
            Demands::Nowhere(dimension) => Self::Nowhere(*dimension),
            Demands::Unknown => Self::Unknown,
            Demands::OnTorus(demands) => Self::OnTorus(demands.inequalities.clone()),
            Demands::All(all) => {
                let at = |one: &Inequality| DemandAt::new(&one.margin, &Rational::one());
                Self::All(all.iter().filter_map(at).collect())
            }
        }
    }

    /// Of demands with a parameter, at a value of it. `None` where they say less about this value than about its neighbours: a condition
    /// vanishes for every wave, or may have been divided by a square that does. Then the demands of the scheme at the value decide.
    pub(crate) fn of_parameter(demands: &Demands, value: &Rational) -> Option<Self> {
        let all = match demands {
            Demands::All(all) => all,
            Demands::OnTorus(demands) => return demands.at(value).map(Self::OnTorus),
            other => return Some(Self::new(other)),
        };
        let at = |one: &&Inequality| {
            let t = value.pow(one.margin.stride() as i32);
            DemandAt::new(&one.margin, &t)
        };
        let asked = || all.iter().filter(|one| !one.margin.is_neutral());
        let found: Vec<DemandAt> = asked().filter_map(|one| at(&one)).collect();
        let complete = found.len() == asked().count() && !value.is_zero();
        let all = Self::All(found);
        // What holds here holds whatever was divided out: values nearby are stable, and so is their limit.
        let sound = asked().all(|one| !one.thinned) || all.decide() == PointVerdict::Stable;
        (complete && sound).then_some(all)
    }

    /// Whether all waves meet them: exact.
    pub(crate) fn decide(&self) -> PointVerdict<Wave> {
        self.decide_while(&Interest::default())
    }

    /// [`decide`](Self::decide), undecided where nobody wants to know any longer.
    pub(crate) fn decide_while(&self, interest: &Interest) -> PointVerdict<Wave> {
        let all = match self {
            Self::All(all) => all,
            Self::OnTorus(all) => return decide_on_torus(all, interest),
            Self::Nowhere(dimension) => {
                return PointVerdict::Unstable(Wave::new(vec![FRAC_PI_2; *dimension]));
            }
            Self::Unknown => return PointVerdict::Undecided,
        };
        let mut undecided = false;
        for demand in all {
            match demand.decide() {
                PointVerdict::Stable => {}
                PointVerdict::Undecided => undecided = true,
                PointVerdict::Unstable(s) => {
                    return PointVerdict::Unstable(Wave::along_a_line(phase_of(&s)));
                }
            }
        }
        if undecided { PointVerdict::Undecided } else { PointVerdict::Stable }
    }

    /// Whether they are met with something to spare for every wave, but for what vanishes whatever the parameter.
    pub(crate) fn are_strict(&self) -> bool {
        matches!(self, Self::All(all) if all.iter().all(DemandAt::is_strict))
    }
}

impl DemandAt {
    /// `Σ_j t^j p_j`; `None` where it is zero.
    fn new(margin: &Margin, t: &Rational) -> Option<Self> {
        let powers = |base: &BigInt| -> Vec<BigInt> {
            let next = |power: &BigInt| Some(power * base);
            std::iter::successors(Some(BigInt::one()), next).take(margin.powers()).collect()
        };
        let (numerators, denominators) = (powers(t.numer()), powers(t.denom()));
        let weights = numerators.iter().zip(denominators.iter().rev()).map(|(a, b)| a * b);
        let weights: Vec<BigInt> = weights.collect();
        let series = weights.iter().zip(margin.integer_series());
        let polynomial = series.fold(Polynomial::<BigInt>::zero(), |sum, (weight, series)| {
            sum + series.in_powers_of_s().scale(weight)
        });
        let radius: BigInt = weights.iter().zip(margin.integer_radius()).map(|(w, r)| w * r).sum();
        if polynomial.is_zero() && radius.is_zero() {
            return None;
        }
        let zeros = Zeros::of(&polynomial);
        Some(Self { polynomial, radius, zeros })
    }

    pub(crate) fn zeros(&self) -> &Zeros {
        &self.zeros
    }

    fn moved(&self, by: &BigInt) -> Zeros {
        Zeros::of(&(self.polynomial.clone() + Polynomial::constant(by.clone())))
    }

    fn decide(&self) -> PointVerdict {
        let exact = self.radius.is_zero();
        let lowest = if exact { self.zeros.clone() } else { self.moved(&-&self.radius) };
        match lowest.negative_point() {
            None => PointVerdict::Stable,
            Some(s) if exact => PointVerdict::Unstable(s),
            Some(_) => self
                .moved(&self.radius)
                .negative_point()
                .map_or(PointVerdict::Undecided, PointVerdict::Unstable),
        }
    }

    fn is_strict(&self) -> bool {
        let lowest = self.moved(&-&self.radius);
        lowest.is_empty()
            && !lowest.at_end(0)
            && !lowest.at_end(1)
            && lowest.negative_point().is_none()
    }
}

/// The zeros in `s`, within `[0, 1]`, of a polynomial without parameters that is real on every wave; none where it is zero. Letters have
/// the values in the middle of their enclosures.
pub(crate) fn zeros_of(real: &Laurent, names: &Names, bits: u32) -> Vec<Rational> {
    let Some((series, s_power, complement_power)) = even_series(real, names) else {
        return Vec::new();
    };
    let center = series.center();
    let common = common_denominator(center.coefficients());
    let polynomial = center.map(|value| numerator_over(value, &common)).in_powers_of_s();
    if polynomial.is_zero() {
        return Vec::new();
    }
    let zeros = Zeros::of(&polynomial);
    let inside = zeros.enclosed(bits).into_iter();
    let mut found: Vec<Rational> =
        inside.map(|(lower, upper)| (lower + upper) / integer(2)).collect();
    let ends = [(0, s_power), (1, complement_power)];
    let at_ends = ends.into_iter().filter(|&(end, power)| power > 0 || zeros.at_end(end));
    found.extend(at_ends.map(|(end, _)| integer(end)));
    found
}

#[cfg(test)]
mod tests;
