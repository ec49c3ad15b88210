//! Schemes: the catalogue of update rules for `u_t + a u_x = 0`, and how to add another.
//!
//! A scheme is whatever has a [symbol](Scheme::symbol).

pub mod catalogue;
mod constants;
mod integrator;
mod kernel_function;
pub mod language;
mod lattice_method;
mod linear;
mod lines;
mod names;
mod one_step;
mod step;
pub mod symbol;
#[cfg(test)]
pub(crate) mod testing;

pub use integrator::{Coefficient, Integrator, IntegratorFileError, IntegratorForm, Nystrom};
pub use kernel_function::KernelLattice;
pub use lattice_method::{COURANT, LatticeMethod};
pub use lines::Lines;
pub use names::{Letter, LetterKind, Name, Names};
pub use one_step::OneStep;
pub use step::{SchemeError, Step};

use crate::exact::rational::{Rational, integer, ratio as fraction};
use crate::exact::stencil::Stencil;
use crate::kernel::Kernel;
use crate::kernel::lattice::{LatticeWeights, RatioOutOfRange};
use crate::scheme::symbol::{EnclosedSymbol, Symbol};
use num_traits::Zero;

/// A linear one-step scheme with constant coefficients on a uniform lattice.
///
/// ```
/// use courant_analysis::stability::stability_limit;
/// use courant_analysis::{exact::rational::integer, scheme::Scheme, exact::stencil::Stencil};
/// use courant_analysis::scheme::symbol::{EnclosedSymbol, Symbol};
///
/// struct Upwind;
/// impl Scheme for Upwind {
///     fn symbol(&self) -> EnclosedSymbol {
///         let backward = Stencil::new(-1, vec![integer(-1), integer(1)]);
///         EnclosedSymbol::exact(Symbol::identity() - Symbol::courant_power(1, backward))
///     }
/// }
/// assert_eq!(stability_limit(&Upwind.symbol(), &integer(10)).value(), 1.0);
/// ```
pub trait Scheme {
    /// What one step does to `e^{iφj}`.
    fn symbol(&self) -> EnclosedSymbol;
}

/// The advection schemes of Ferrari et al. 2008, section 2, in the form with the orientation repaired
/// (as printed, (2.3) and (2.17)–(2.19) run downwind and move waves the wrong way; see `docs/misprints.md`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AdvectionScheme {
    /// `u_i − C Σ_k w_k (u_{i+k} − u_{i−k})`: (2.9).
    EulerSph,
    /// Euler-SPH `+ (C²/2)(v_0 u_i + Σ_k v_k (u_{i+k} + u_{i−k}))`: (2.17).
    LaxWendroffSph,
    /// `u_i − 2C Σ_k w_k (u_i − u_{i−k})`: (2.18) with the upwind flux of (2.19).
    GodunovSph,
}

/// A name that is no scheme's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no scheme `{0}`")]
pub struct UnknownScheme(pub String);

impl AdvectionScheme {
    /// All schemes, in the order they are listed to people.
    pub const ALL: [Self; 3] = [Self::EulerSph, Self::LaxWendroffSph, Self::GodunovSph];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::EulerSph => "euler-sph",
            Self::LaxWendroffSph => "lax-wendroff-sph",
            Self::GodunovSph => "godunov-sph",
        }
    }

    /// The name for titles and captions.
    pub fn title(self) -> &'static str {
        match self {
            Self::EulerSph => "Euler-SPH",
            Self::LaxWendroffSph => "Lax–Wendroff SPH",
            Self::GodunovSph => "Godunov SPH",
        }
    }

    /// The update in plain text.
    pub fn formula(self) -> &'static str {
        match self {
            Self::EulerSph => "u_i - C Σ_k w_k (u_{i+k} - u_{i-k})",
            Self::LaxWendroffSph => {
                "u_i - C Σ_k w_k (u_{i+k} - u_{i-k}) + (C²/2)(v_0 u_i + Σ_k v_k (u_{i+k} + u_{i-k}))"
            }
            Self::GodunovSph => "u_i - 2C Σ_k w_k (u_i - u_{i-k})",
        }
    }

    /// Where the scheme comes from.
    pub fn source(self) -> &'static str {
        match self {
            Self::EulerSph => "Ferrari et al. 2008 (2.9)",
            Self::LaxWendroffSph => "Ferrari et al. 2008 (2.17)",
            Self::GodunovSph => "Vila 1999; Ferrari et al. 2008 (2.18), (2.19)",
        }
    }

    /// The scheme for a kernel of one's own, given by its lattice weights.
    ///
    /// ```
    /// use courant_analysis::exact::interval::Interval;
    /// use courant_analysis::stability::{Evidence, stability_limit};
    /// use courant_analysis::{kernel::lattice::LatticeWeights, exact::rational::integer, scheme::AdvectionScheme};
    /// let half = Interval::new(0.5, 0.5_f64.next_up());
    /// let bend = [Interval::point(-2.0), Interval::point(1.0)];
    /// let weights = LatticeWeights::from_intervals(&[half], &bend).unwrap();
    /// let limit = stability_limit(&AdvectionScheme::GodunovSph.with_weights(&weights), &integer(9));
    /// assert_eq!(limit.evidence(), Evidence::Enclosed);
    /// assert!(limit.lower() <= 1.0 && limit.upper() >= 1.0 && limit.upper() - limit.lower() < 1e-14);
    /// ```
    pub fn with_weights(self, weights: &LatticeWeights) -> EnclosedSymbol {
        EnclosedSymbol::from_weights(weights, |weights| self.build(weights))
    }

    fn build(self, weights: &LatticeWeights) -> Symbol<Rational> {
        match self {
            Self::EulerSph => Symbol::identity() - Symbol::courant_power(1, gradient(weights)),
            Self::LaxWendroffSph => {
                Symbol::identity() - Symbol::courant_power(1, gradient(weights))
                    + Symbol::courant_power(2, half_second_derivative(weights))
            }
            Self::GodunovSph => {
                Symbol::identity() - Symbol::courant_power(1, upwind_difference(weights))
            }
        }
    }
}

/// `Σ_k w_k (E^k − E^{−k})`.
fn gradient(weights: &LatticeWeights) -> Stencil<Rational> {
    let right = &weights.gradient;
    let left = right.iter().rev().map(|w| -w);
    let coefficients = left.chain([Rational::zero()]).chain(right.iter().cloned()).collect();
    Stencil::new(-(right.len() as i64), coefficients)
}

/// `(v_0 + Σ_k v_k (E^k + E^{−k}))/2`.
fn half_second_derivative(weights: &LatticeWeights) -> Stencil<Rational> {
    let half = fraction(1, 2);
    let right = &weights.curvature;
    let left = right.iter().skip(1).rev();
    let coefficients: Vec<_> = left.chain(right).map(|v| v * &half).collect();
    Stencil::new(-(coefficients.len() as i64 / 2), coefficients)
}

/// `2 Σ_k w_k (1 − E^{−k})`.
fn upwind_difference(weights: &LatticeWeights) -> Stencil<Rational> {
    let doubled: Vec<_> = weights.gradient.iter().map(|w| w * integer(2)).collect();
    let total: Rational = doubled.iter().sum();
    let coefficients = doubled.iter().rev().map(|w| -w).chain([total]).collect();
    Stencil::new(-(doubled.len() as i64), coefficients)
}

impl std::fmt::Display for AdvectionScheme {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.pad(self.name())
    }
}

impl std::str::FromStr for AdvectionScheme {
    type Err = UnknownScheme;
    fn from_str(text: &str) -> Result<Self, UnknownScheme> {
        let wanted = text.trim().to_ascii_lowercase();
        Self::ALL
            .into_iter()
            .find(|scheme| scheme.name() == wanted)
            .ok_or_else(|| UnknownScheme(text.into()))
    }
}

/// Where limits of these schemes are looked for: Courant numbers up to `10 + 4 l/Δξ`, far beyond any limit,
/// about `1.2 l/Δξ`.
pub fn search_range(ratio: &Rational) -> Rational {
    integer(10) + ratio * integer(4)
}

/// An advection scheme with its kernel and smoothing ratio `l/Δξ`: everything but the time step.
///
/// ```
/// use courant_analysis::{kernel::Kernel, exact::rational::ratio};
/// use courant_analysis::scheme::{AdvectionScheme, Discretisation, Scheme};
/// let scheme = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, ratio(2, 1));
/// let upwind_neighbour = scheme.unwrap().symbol().center().coefficient(-1);
/// assert_eq!(upwind_neighbour.coefficients(), &[ratio(0, 1), ratio(5, 16)]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Discretisation {
    scheme: AdvectionScheme,
    kernel: Kernel,
    ratio: Rational,
    weights: LatticeWeights,
}

impl Discretisation {
    /// The scheme on the lattice.
    ///
    /// # Errors
    /// When the ratio is not in `[1/100, 50]`.
    pub fn new(
        scheme: AdvectionScheme,
        kernel: Kernel,
        ratio: Rational,
    ) -> Result<Self, RatioOutOfRange> {
        let weights = LatticeWeights::new(kernel, &ratio)?;
        Ok(Self { scheme, kernel, ratio, weights })
    }

    /// The update rule.
    pub fn scheme(&self) -> AdvectionScheme {
        self.scheme
    }

    /// The kernel.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    /// The smoothing ratio `l/Δξ`.
    pub fn ratio(&self) -> &Rational {
        &self.ratio
    }

    /// The lattice weights.
    pub fn weights(&self) -> &LatticeWeights {
        &self.weights
    }
}

impl Scheme for Discretisation {
    fn symbol(&self) -> EnclosedSymbol {
        self.scheme.with_weights(&self.weights)
    }
}
