//! Symbols whose coefficients are known exactly, or within a stated radius.

use super::Symbol;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer};
use crate::exact::stencil::Stencil;
use crate::kernel::lattice::LatticeWeights;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// A symbol with rational coefficients and a bound on how far the true one may be.
///
/// The bound is kept apart for the even part of each stencil (the real part of `g`) and its odd part
/// (the imaginary part), because a part that vanishes for *every* set of weights — the odd part of a
/// second derivative, say — vanishes exactly, and that decides how `|g|² − 1` starts in `C`.
#[derive(Debug, Clone, PartialEq)]
pub struct EnclosedSymbol {
    center: Symbol<Rational>,
    even_radius: Vec<Rational>,
    odd_radius: Vec<Rational>,
    coefficient_radius: Vec<Stencil<Rational>>,
    keeps_constants: bool,
}

impl EnclosedSymbol {
    /// A symbol known exactly.
    pub fn exact(symbol: Symbol<Rational>) -> Self {
        let zeros = vec![Rational::zero(); symbol.stencils().len()];
        let keeps_constants = symbol.moment(0, integer).is_one();
        let coefficient_radius = vec![Stencil::zero(); zeros.len()];
        Self {
            center: symbol,
            even_radius: zeros.clone(),
            odd_radius: zeros,
            coefficient_radius,
            keeps_constants,
        }
    }

    /// A symbol that is an affine function of lattice weights.
    ///
    /// When the weights are not exact, `build` is called once more for every weight with that weight
    /// one and the others zero: the differences say which parts of the symbol the errors of the
    /// weights can reach.
    pub fn from_weights(
        weights: &LatticeWeights,
        build: impl Fn(&LatticeWeights) -> Symbol<Rational>,
    ) -> Self {
        let mut enclosed = Self::exact(build(weights));
        if weights.radius.is_zero() {
            return enclosed;
        }
        let empty = LatticeWeights {
            gradient: vec![Rational::zero(); weights.gradient.len()],
            curvature: vec![Rational::zero(); weights.curvature.len()],
            radius: Rational::zero(),
        };
        let origin = build(&empty);
        let mut keeps_constants = origin.moment(0, integer).is_one();
        // How often each coefficient, and each part, takes a weight's error; the radius itself is a long
        // number and comes in at the end.
        let mut reached: BTreeMap<(usize, i64), Rational> = BTreeMap::new();
        let (mut even, mut odd): (Vec<Rational>, Vec<Rational>) = (Vec::new(), Vec::new());
        let mut add = |unit: &LatticeWeights| {
            let direction = build(unit) - origin.clone();
            keeps_constants &= direction.moment(0, integer).is_zero();
            let powers = direction.stencils().len().max(even.len());
            even.resize(powers, Rational::zero());
            odd.resize(powers, Rational::zero());
            for (power, stencil) in direction.stencils().iter().enumerate() {
                for (offset, value) in stencil.terms().filter(|(_, value)| !value.is_zero()) {
                    // c = even + odd with even = (c_k + c_{−k})/2 and odd = (c_k − c_{−k})/2; summing
                    // both over all offsets bounds the l1 norms of the two parts. An offset whose mirror
                    // image has no coefficient stands for both.
                    let mirrored = stencil.coefficient(-offset);
                    let both = if offset != 0 && mirrored.is_zero() { 1 } else { 2 };
                    even[power] += (value + &mirrored).abs() / integer(both);
                    odd[power] += (value - &mirrored).abs() / integer(both);
                    *reached.entry((power, offset)).or_insert_with(Rational::zero) += value.abs();
                }
            }
        };
        for index in 0..weights.gradient.len() {
            let mut unit = empty.clone();
            unit.gradient[index] = Rational::one();
            add(&unit);
        }
        for index in 0..weights.curvature.len() {
            let mut unit = empty.clone();
            unit.curvature[index] = Rational::one();
            add(&unit);
        }
        enclosed.reserve(even.len());
        for (power, (even, odd)) in even.iter().zip(&odd).enumerate() {
            enclosed.even_radius[power] = even * &weights.radius;
            enclosed.odd_radius[power] = odd * &weights.radius;
            let offsets = reached.range((power, i64::MIN)..=(power, i64::MAX));
            let (Some(((_, low), _)), Some(((_, high), _))) =
                (offsets.clone().next(), offsets.clone().next_back())
            else {
                continue;
            };
            let mut radii = vec![Rational::zero(); (high - low + 1) as usize];
            for ((_, offset), times) in offsets {
                radii[(offset - low) as usize] = times * &weights.radius;
            }
            enclosed.coefficient_radius[power] = Stencil::new(*low, radii);
        }
        enclosed.keeps_constants = keeps_constants;
        enclosed
    }

    /// Makes room for this many powers of `C`: the center may have fewer than the true symbol.
    fn reserve(&mut self, powers: usize) {
        let powers = powers.max(self.even_radius.len());
        self.even_radius.resize(powers, Rational::zero());
        self.odd_radius.resize(powers, Rational::zero());
        self.coefficient_radius.resize(powers, Stencil::zero());
    }

    /// The rational symbol in the middle.
    pub fn center(&self) -> &Symbol<Rational> {
        &self.center
    }

    /// Per power of `C`, how much the even parts (the cosines of `g`) may be wrong: a bound on the sum
    /// of the moduli of the errors of all coefficients.
    pub fn even_radius(&self) -> &[Rational] {
        &self.even_radius
    }

    /// The same for the odd parts (the sines of `g`).
    pub fn odd_radius(&self) -> &[Rational] {
        &self.odd_radius
    }

    /// Per power of `C`, how far each single coefficient may be from the true one.
    pub fn coefficient_radius(&self) -> &[Stencil<Rational>] {
        &self.coefficient_radius
    }

    /// The distance between the lowest and the highest offset that a coefficient or its error can have.
    pub fn span(&self) -> usize {
        let radii = self.coefficient_radius.iter().filter_map(Stencil::reach);
        let reaches = radii.chain(self.center.reach());
        let reach = reaches.reduce(|(a, b), (c, d)| (a.min(c), b.max(d)));
        reach.map_or(0, |(low, high)| low.abs_diff(high) as usize)
    }

    /// Whether the coefficients are known exactly.
    pub fn is_exact(&self) -> bool {
        self.even_radius.iter().chain(&self.odd_radius).all(Zero::is_zero)
    }

    /// Whether the scheme maps a constant to itself, `g(0) = 1`, for every Courant number: decided
    /// exactly for exact symbols, from the structure of the scheme for enclosed ones.
    pub fn keeps_constants(&self) -> bool {
        self.keeps_constants
    }

    /// `Σ_k c_k`, the factor by which one step multiplies the mean, as a polynomial in `C`.
    pub fn mean_gain(&self) -> Polynomial<Rational> {
        self.center.moment(0, integer)
    }
}
