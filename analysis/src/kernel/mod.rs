//! Smoothing kernels in one dimension: `W(x, l) = w(q) / l` with `q = |x| / l`.
//!
//! One definition serves the analysis (exact polynomials where there are any) and the simulation
//! (fast `f64` evaluation). The shape `w` and its derivatives are with respect to `q`, so that
//! `∂W/∂|x| = w'(q)/l²` and `∂²W/∂x² = w''(q)/l³`.

mod density;
mod gaussian;
pub mod lattice;
mod lattice_sums;
mod piecewise;

pub(crate) use density::relative_value;
pub use density::{Density, Enclosure, UnknownDensity, relative_density};
pub use gaussian::GAUSSIAN_CUT;
pub use lattice_sums::{CompiledSums, LatticeSums, SumValues};
pub use piecewise::{Piece, PiecewisePolynomial};

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, ratio, to_f64};
use crate::spelling::spells;
use num_traits::Zero;
use std::sync::LazyLock;

/// A smoothing kernel.
///
/// ```
/// use courant_analysis::kernel::Kernel;
/// let cubic = Kernel::CubicSpline;
/// assert_eq!(cubic.value(0.0), 2.0 / 3.0);
/// assert_eq!(cubic.slope(1.0), -0.5);
/// assert_eq!(cubic.value(2.5), 0.0);
/// assert_eq!("m4".parse(), Ok(cubic));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kernel {
    /// Schoenberg's M4, Ferrari et al. 2008 (2.7): support 2.
    CubicSpline,
    /// Schoenberg's M5: support 5/2.
    QuarticSpline,
    /// Schoenberg's M6: support 3.
    QuinticSpline,
    /// `exp(−q²)/√π` for `q ≤ 3` and zero beyond, not renormalised: Ferrari et al. 2008 (2.8).
    Gaussian,
    /// `(5/8)(1 − q/2)³(1 + 3q/2)`: Wendland's C² function of one dimension, support 2.
    WendlandC2,
    /// `(3/4)(1 − q/2)⁵(1 + 5q/2 + 2q²)`, support 2.
    WendlandC4,
    /// `(55/64)(1 − q/2)⁷(1 + 7q/2 + 19q²/4 + 21q³/8)`, support 2.
    WendlandC6,
}

/// A name that is no kernel's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no kernel `{0}`")]
pub struct UnknownKernel(pub String);

static CUBIC: LazyLock<PiecewisePolynomial> = LazyLock::new(|| b_spline(4));
static QUARTIC: LazyLock<PiecewisePolynomial> = LazyLock::new(|| b_spline(5));
static QUINTIC: LazyLock<PiecewisePolynomial> = LazyLock::new(|| b_spline(6));
static C2: LazyLock<PiecewisePolynomial> = LazyLock::new(|| wendland(ratio(5, 8), 3, &[1, 3]));
static C4: LazyLock<PiecewisePolynomial> = LazyLock::new(|| wendland(ratio(3, 4), 5, &[1, 5, 8]));
static C6: LazyLock<PiecewisePolynomial> =
    LazyLock::new(|| wendland(ratio(55, 64), 7, &[1, 7, 19, 21]));

impl Kernel {
    /// All kernels, in the order they are listed to people.
    pub const ALL: [Self; 7] = [
        Self::CubicSpline,
        Self::QuarticSpline,
        Self::QuinticSpline,
        Self::Gaussian,
        Self::WendlandC2,
        Self::WendlandC4,
        Self::WendlandC6,
    ];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::CubicSpline => "cubic-spline",
            Self::QuarticSpline => "quartic-spline",
            Self::QuinticSpline => "quintic-spline",
            Self::Gaussian => "gaussian",
            Self::WendlandC2 => "wendland-c2",
            Self::WendlandC4 => "wendland-c4",
            Self::WendlandC6 => "wendland-c6",
        }
    }

    /// Other accepted names.
    pub fn aliases(self) -> &'static [&'static str] {
        match self {
            Self::CubicSpline => &["cubic", "m4"],
            Self::QuarticSpline => &["quartic", "m5"],
            Self::QuinticSpline => &["quintic", "m6"],
            Self::Gaussian => &["gauss"],
            Self::WendlandC2 => &["c2"],
            Self::WendlandC4 => &["c4"],
            Self::WendlandC6 => &["c6"],
        }
    }

    /// The name for titles and captions.
    pub fn title(self) -> &'static str {
        match self {
            Self::CubicSpline => "cubic B-spline",
            Self::QuarticSpline => "quartic B-spline",
            Self::QuinticSpline => "quintic B-spline",
            Self::Gaussian => "Gaussian, cut at 3",
            Self::WendlandC2 => "Wendland C2",
            Self::WendlandC4 => "Wendland C4",
            Self::WendlandC6 => "Wendland C6",
        }
    }

    /// Where the kernel comes from.
    pub fn source(self) -> &'static str {
        match self {
            Self::CubicSpline => {
                "Schoenberg 1946; Monaghan & Lattanzio 1985; Ferrari et al. 2008 (2.7)"
            }
            Self::QuarticSpline | Self::QuinticSpline => "Schoenberg 1946; Morris 1996",
            Self::Gaussian => "Gingold & Monaghan 1977; Ferrari et al. 2008 (2.8)",
            Self::WendlandC2 | Self::WendlandC4 | Self::WendlandC6 => {
                "Wendland 1995; Dehnen & Aly 2012 (Table 1, one dimension)"
            }
        }
    }

    /// The exact piecewise polynomial in `q`; `None` for the Gaussian.
    pub fn polynomial(self) -> Option<&'static PiecewisePolynomial> {
        match self {
            Self::CubicSpline => Some(&CUBIC),
            Self::QuarticSpline => Some(&QUARTIC),
            Self::QuinticSpline => Some(&QUINTIC),
            Self::Gaussian => None,
            Self::WendlandC2 => Some(&C2),
            Self::WendlandC4 => Some(&C4),
            Self::WendlandC6 => Some(&C6),
        }
    }

    /// The largest `q` at which the kernel may be non-zero, in smoothing lengths.
    pub fn support(self) -> f64 {
        match self {
            Self::QuarticSpline => 2.5,
            Self::QuinticSpline => 3.0,
            Self::Gaussian => GAUSSIAN_CUT as f64,
            Self::CubicSpline | Self::WendlandC2 | Self::WendlandC4 | Self::WendlandC6 => 2.0,
        }
    }

    /// [`support`](Self::support), exactly.
    pub fn exact_support(self) -> Rational {
        match self.polynomial() {
            Some(shape) => shape.support().clone(),
            None => integer(GAUSSIAN_CUT),
        }
    }

    /// The shape `w(q)` for `q ≥ 0` (so `W = w/l`).
    pub fn value(self, q: f64) -> f64 {
        self.polynomial().map_or_else(|| gaussian::value(q), |shape| shape.value(q))
    }

    /// `w'(q)` for `q ≥ 0`: never positive (so `∂W/∂|x| = w'/l²`).
    pub fn slope(self, q: f64) -> f64 {
        self.polynomial().map_or_else(|| gaussian::slope(q), |shape| shape.slope(q))
    }

    /// `w''(q)` for `q ≥ 0`, at 0 the limit from the right (so `∂²W/∂x² = w''/l³`).
    pub fn curvature(self, q: f64) -> f64 {
        self.polynomial().map_or_else(|| gaussian::curvature(q), |shape| shape.curvature(q))
    }

    /// The standard deviation `√(∫ q² w dq / ∫ w dq)` over the whole line, in smoothing lengths.
    ///
    /// Dehnen & Aly 2012 take twice this as the resolution scale that makes kernels comparable.
    pub fn standard_deviation(self) -> f64 {
        match self.polynomial() {
            Some(shape) => (to_f64(&shape.half_moment(2)) / to_f64(&shape.half_moment(0))).sqrt(),
            None => gaussian::standard_deviation(),
        }
    }
}

impl std::fmt::Display for Kernel {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.pad(self.name())
    }
}

impl std::str::FromStr for Kernel {
    type Err = UnknownKernel;
    fn from_str(text: &str) -> Result<Self, UnknownKernel> {
        let is_it = |name: &str| spells(text, name);
        Self::ALL
            .into_iter()
            .find(|kernel| is_it(kernel.name()) || kernel.aliases().iter().any(|name| is_it(name)))
            .ok_or_else(|| UnknownKernel(text.into()))
    }
}

/// Schoenberg's B-spline of order `n`:
/// `M_n(q) = 1/(n−1)! Σ_j (−1)^j C(n, j) (n/2 − j − q)_+^{n−1}` for `q ≥ 0`.
fn b_spline(order: i64) -> PiecewisePolynomial {
    let degree = (order - 1) as usize;
    let factorial: i64 = (1..order).product();
    let knots: Vec<Rational> = (0..)
        .map(|j| ratio(order - 2 * j, 2))
        .take_while(|knot| *knot > Rational::zero())
        .collect();
    let mut total = Polynomial::zero();
    let mut binomial = 1;
    let mut pieces = Vec::new();
    // From the outermost knot inwards: passing a knot adds its truncated power.
    for (j, knot) in (0i64..).zip(&knots) {
        let power = Polynomial::new(vec![knot.clone(), integer(-1)]).pow(degree);
        let sign = if j % 2 == 0 { 1 } else { -1 };
        total = total + power.scale(&ratio(sign * binomial, factorial));
        binomial = binomial * (order - j) / (j + 1);
        pieces.push((knot.clone(), total.clone()));
    }
    pieces.reverse();
    PiecewisePolynomial::new(pieces)
}

/// `norm · (1 − r)^power · Σ_j tail_j r^j` with `r = q/2`, so that the support is 2.
fn wendland(norm: Rational, power: usize, tail: &[i64]) -> PiecewisePolynomial {
    let radius = Polynomial::new(vec![Rational::zero(), ratio(1, 2)]);
    let edge = Polynomial::new(vec![integer(1), integer(-1)]).pow(power);
    let tail = Polynomial::new(tail.iter().map(|&value| integer(value)).collect());
    let shape = (edge * tail).compose(&radius).scale(&norm);
    // One polynomial, in two pieces so that each is evaluated about its own end of the support.
    PiecewisePolynomial::new(vec![(integer(1), shape.clone()), (integer(2), shape)])
}

#[cfg(test)]
mod tests;
