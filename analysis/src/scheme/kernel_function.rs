//! Functions of the running index of a kernel sum, `f(1), …, f(K)`, each value within a radius.

use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::rational::{Rational, common_denominator, integer, numerator_over};
use crate::kernel::lattice::{LatticeWeights, RatioOutOfRange};
use crate::kernel::{Density, Enclosure, Kernel, relative_density, relative_value};
use crate::scheme::language::syntax::Weight;
use num_bigint::BigInt;
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
    density: Density,
}

impl KernelLattice {
    /// A known kernel at a ratio.
    ///
    /// # Errors
    /// When the ratio is not in `[1/100, 50]`.
    pub fn new(kernel: Kernel, ratio: &Rational) -> Result<Self, RatioOutOfRange> {
        let weights = LatticeWeights::new(kernel, ratio)?;
        let (kernel, ratio) = (Some(kernel), ratio.clone());
        Ok(Self { kernel, ratio, weights, density: Density::default() })
    }

    /// With the density of the undisturbed lattice that the equations use.
    #[must_use]
    pub fn with_density(self, density: Density) -> Self {
        Self { density, ..self }
    }

    /// `rho` in the text, `ρ0 Δ/M`; 1 for a kernel of one's own.
    pub fn density(&self) -> Enclosure {
        let known = self.kernel.map(|kernel| relative_density(kernel, &self.ratio, self.density));
        let one = || Enclosure { center: Rational::one(), radius: Rational::zero() };
        // The ratio of a known kernel is in range.
        known.and_then(Result::ok).unwrap_or_else(one)
    }

    /// A kernel of one's own by its weights.
    pub fn from_weights(ratio: Rational, weights: LatticeWeights) -> Self {
        Self { kernel: None, ratio, weights, density: Density::default() }
    }

    /// How many neighbours on either side enter a sum.
    pub fn reach(&self) -> usize {
        self.weights.reach()
    }

    /// One weight with its radius; zero beyond the reach. `None` where the values of the kernel are not known.
    pub fn weight(&self, weight: Weight, offset: usize) -> Option<(Rational, Rational)> {
        let radius = self.weights.radius.clone();
        let found = match weight {
            Weight::Value => {
                let kernel = self.kernel?;
                let value = (offset <= self.reach())
                    .then(|| relative_value(kernel, &self.ratio, offset as i64));
                return Some(value.map_or_else(Default::default, |v| (v.center, v.radius)));
            }
            Weight::Slope if offset == 0 => None,
            Weight::Slope => self.weights.gradient.get(offset - 1),
            Weight::Curvature => self.weights.curvature.get(offset),
        };
        Some(found.map_or_else(Default::default, |value| (value.clone(), radius)))
    }
}

/// `[f(1), …, f(K)]` as integers over one denominator, with one radius for all.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KernelFunction {
    pub(crate) numerators: Vec<BigInt>,
    pub(crate) denominator: BigInt,
    pub(crate) radius: Rational,
}

impl KernelFunction {
    fn whole(numerators: Vec<BigInt>) -> Self {
        Self { numerators, denominator: BigInt::one(), radius: Rational::zero() }
    }

    fn new(values: &[Rational], radius: Rational) -> Self {
        let denominator = common_denominator(values);
        let numerators = values.iter().map(|v| numerator_over(v, &denominator)).collect();
        Self { numerators, denominator, radius }
    }

    /// The running index itself.
    pub(crate) fn index(reach: usize) -> Self {
        Self::whole((1..=reach).map(BigInt::from).collect())
    }

    /// 1.
    pub(crate) fn one(reach: usize) -> Self {
        Self::whole(vec![BigInt::one(); reach])
    }

    /// A weight.
    pub(crate) fn weight(lattice: &KernelLattice, weight: Weight) -> Option<Self> {
        let values: Option<Vec<_>> =
            (1..=lattice.reach()).map(|k| lattice.weight(weight, k)).collect();
        let (values, radii): (Vec<_>, Vec<_>) = values?.into_iter().unzip();
        Some(Self::new(&values, radii.into_iter().max().unwrap_or_default()))
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        let largest = |f: &Self| {
            let largest = f.numerators.iter().map(Signed::abs).max().unwrap_or_default();
            Rational::new(largest, f.denominator.clone()) + &f.radius
        };
        let numerators =
            self.numerators.iter().zip(&other.numerators).map(|(a, b)| a * b).collect();
        // |ab − a₀b₀| ≤ |a| r_b + |b₀| r_a.
        let radius = largest(self) * &other.radius + largest(other) * &self.radius;
        Self { numerators, denominator: &self.denominator * &other.denominator, radius }
    }

    /// `1/f`, for exact functions without zeros.
    pub(crate) fn reciprocal(&self) -> Option<Self> {
        let exact = self.radius.is_zero() && self.numerators.iter().all(|value| !value.is_zero());
        let inverse = |value: &BigInt| Rational::new(self.denominator.clone(), value.clone());
        exact.then(|| {
            let values: Vec<Rational> = self.numerators.iter().map(inverse).collect();
            Self::new(&values, Rational::zero())
        })
    }

    /// `Σ_k f(k)` with its radius.
    pub(crate) fn sum(&self) -> (Rational, Rational) {
        let sum = Rational::new(self.numerators.iter().sum(), self.denominator.clone());
        (sum, &self.radius * integer(self.numerators.len() as i64))
    }

    /// `Σ_k f(k) (1 − cos kφ)/s`.
    pub(crate) fn versines(&self) -> EnclosedSeries {
        let constant: BigInt = self.numerators.iter().sum();
        let coefficients =
            [constant].into_iter().chain(self.numerators.iter().map(|value| -value)).collect();
        let quotient = CosineSeries::new(coefficients).divide_by_s();
        let quotient = quotient.expect("1 − cos kφ vanishes at zero, and so do their sums");
        // (1 − cos kφ)/s = 2 sin²(kφ/2)/sin²(φ/2) has coefficients that sum to 2k².
        let squares: Rational =
            (1..=self.numerators.len() as i64).map(|k| integer(2 * k * k)).sum();
        let numerators = quotient.coefficients().to_vec();
        EnclosedSeries::over(numerators, self.denominator.clone(), &self.radius * squares)
    }

    /// `Σ_k f(k) sin kφ/sin φ`.
    pub(crate) fn sines(&self) -> EnclosedSeries {
        // sin kφ/sin φ = 2 cos (k−1)φ + 2 cos (k−3)φ + …, ending with 1 when k is odd.
        let count = self.numerators.len();
        let mut coefficients: Vec<BigInt> = self.numerators.iter().map(|value| value * 2).collect();
        for m in (0..count.saturating_sub(2)).rev() {
            let later = coefficients[m + 2].clone();
            coefficients[m] += later;
        }
        if let Some(first) = coefficients.first_mut() {
            *first /= 2;
        }
        let sum: Rational = (1..=count as i64).map(integer).sum();
        EnclosedSeries::over(coefficients, self.denominator.clone(), &self.radius * sum)
    }
}
