//! Functions of the running index of a kernel sum, `f(1), …, f(K)`, each value within a radius.

use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::rational::{Rational, integer};
use crate::kernel::lattice::{LatticeWeights, RatioOutOfRange};
use crate::kernel::{Density, Enclosure, Kernel, relative_density, relative_value};
use crate::scheme::language::syntax::Weight;
use num_traits::{One, Signed, Zero};

/// The kernel of a scheme's sums on its lattice: `W[k]`, `w[k]`, `v[k]` and `ratio` in the text.
#[derive(Debug, Clone, PartialEq)]
pub struct KernelLattice {
    /// The kernel, if it is one of the known ones.
    pub kernel: Option<Kernel>,
    /// `l/Δξ = h/Δ`.
    pub ratio: Rational,
    /// `w_k` and `v_k`.
    pub weights: LatticeWeights,
    /// `[W_0, W_1, …, W_K]`; empty where the kernel is given by its derivatives only.
    values: Vec<Rational>,
    value_radius: Rational,
    /// `rho` in the text, `ρ0 Δ/M`.
    density: Enclosure,
}

impl KernelLattice {
    /// A known kernel at a ratio.
    ///
    /// # Errors
    /// When the ratio is not in `[1/100, 50]`.
    pub fn new(kernel: Kernel, ratio: &Rational) -> Result<Self, RatioOutOfRange> {
        let weights = LatticeWeights::new(kernel, ratio)?;
        let value = |k| relative_value(kernel, ratio, k);
        let enclosures: Vec<_> = (0..=weights.reach()).map(|k| value(k as i64)).collect();
        let value_radius = enclosures.iter().map(|e| e.radius.clone()).max().unwrap_or_default();
        let values = enclosures.into_iter().map(|enclosure| enclosure.center).collect();
        let density = relative_density(kernel, ratio, Density::default())?;
        Ok(Self {
            kernel: Some(kernel),
            ratio: ratio.clone(),
            weights,
            values,
            value_radius,
            density,
        })
    }

    /// With the density of the undisturbed lattice that the equations use.
    #[must_use]
    pub fn with_density(self, density: Density) -> Self {
        let density = match self.kernel {
            Some(kernel) => relative_density(kernel, &self.ratio, density).ok(),
            None => None,
        };
        Self { density: density.unwrap_or_else(|| self.density.clone()), ..self }
    }

    /// `ρ0 Δ/M`.
    pub fn density(&self) -> &Enclosure {
        &self.density
    }

    /// A kernel of one's own by its weights.
    pub fn from_weights(ratio: Rational, weights: LatticeWeights) -> Self {
        let density = Enclosure { center: Rational::one(), radius: Rational::zero() };
        let values = Vec::new();
        Self { kernel: None, ratio, weights, values, value_radius: Rational::zero(), density }
    }

    /// How many neighbours on either side enter a sum.
    pub fn reach(&self) -> usize {
        self.weights.reach()
    }

    /// One weight with its radius; zero beyond the reach. `None` where the values of the kernel are not known.
    pub fn weight(&self, weight: Weight, offset: usize) -> Option<(Rational, Rational)> {
        let radius = self.weights.radius.clone();
        let (found, radius) = match weight {
            Weight::Value if self.values.is_empty() => return None,
            Weight::Value => (self.values.get(offset), self.value_radius.clone()),
            Weight::Slope if offset == 0 => return Some((Rational::zero(), Rational::zero())),
            Weight::Slope => (self.weights.gradient.get(offset - 1), radius),
            Weight::Curvature => (self.weights.curvature.get(offset), radius),
        };
        let nothing = (Rational::zero(), Rational::zero());
        Some(found.map_or(nothing, |value| (value.clone(), radius)))
    }
}

/// `[f(1), …, f(K)]` with one radius for all.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KernelFunction {
    pub(crate) values: Vec<Rational>,
    pub(crate) radius: Rational,
}

impl KernelFunction {
    /// The running index itself.
    pub(crate) fn index(reach: usize) -> Self {
        Self { values: (1..=reach as i64).map(integer).collect(), radius: Rational::zero() }
    }

    /// 1.
    pub(crate) fn one(reach: usize) -> Self {
        Self { values: vec![Rational::one(); reach], radius: Rational::zero() }
    }

    /// A weight.
    pub(crate) fn weight(lattice: &KernelLattice, weight: Weight) -> Option<Self> {
        let values: Option<Vec<_>> =
            (1..=lattice.reach()).map(|k| lattice.weight(weight, k)).collect();
        let (values, radii): (Vec<_>, Vec<_>) = values?.into_iter().unzip();
        Some(Self { values, radius: radii.into_iter().max().unwrap_or_default() })
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        let largest =
            |f: &Self| f.values.iter().map(Signed::abs).max().unwrap_or_default() + &f.radius;
        let values = self.values.iter().zip(&other.values).map(|(a, b)| a * b).collect();
        // |ab − a₀b₀| ≤ |a| r_b + |b₀| r_a.
        let radius = largest(self) * &other.radius + largest(other) * &self.radius;
        Self { values, radius }
    }

    /// `1/f`, for exact functions without zeros.
    pub(crate) fn reciprocal(&self) -> Option<Self> {
        let exact = self.radius.is_zero() && self.values.iter().all(|value| !value.is_zero());
        exact.then(|| Self {
            values: self.values.iter().map(Rational::recip).collect(),
            radius: Rational::zero(),
        })
    }

    /// `Σ_k f(k)` with its radius.
    pub(crate) fn sum(&self) -> (Rational, Rational) {
        (self.values.iter().sum(), &self.radius * integer(self.values.len() as i64))
    }

    /// `Σ_k f(k) (1 − cos kφ)/s`.
    pub(crate) fn versines(&self) -> EnclosedSeries {
        let constant: Rational = self.values.iter().sum();
        let coefficients =
            [constant].into_iter().chain(self.values.iter().map(|value| -value)).collect();
        let quotient = CosineSeries::new(coefficients).divide_by_s();
        let quotient = quotient.expect("1 − cos kφ vanishes at zero, and so do their sums");
        // (1 − cos kφ)/s = 2 sin²(kφ/2)/sin²(φ/2) has coefficients that sum to 2k².
        let squares: Rational = (1..=self.values.len() as i64).map(|k| integer(2 * k * k)).sum();
        EnclosedSeries::new(quotient.coefficients(), &self.radius * squares)
    }

    /// `Σ_k f(k) sin kφ/sin φ`.
    pub(crate) fn sines(&self) -> EnclosedSeries {
        // sin kφ/sin φ = 2 cos (k−1)φ + 2 cos (k−3)φ + …, ending with 1 when k is odd.
        let mut coefficients = vec![Rational::zero(); self.values.len()];
        for (index, value) in self.values.iter().enumerate() {
            for m in (0..=index).rev().step_by(2) {
                let weight = if m == 0 { Rational::one() } else { integer(2) };
                coefficients[m] += value * weight;
            }
        }
        let sum: Rational = (1..=self.values.len() as i64).map(integer).sum();
        EnclosedSeries::new(&coefficients, &self.radius * sum)
    }
}
