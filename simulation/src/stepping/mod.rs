//! The second road: typed equations run as they stand.
//!
//! A scheme's [syntax tree](courant_analysis::scheme::language::syntax) is compiled into stencils on arrays and stepped on a
//! periodic lattice, a ring in one dimension and a torus in more. This code knows numbers and arrays; it shares nothing with the analysis but the text that was read and the numbers
//! of kernels and integrators. What it measures is therefore evidence: [`validate`] excites every wave and compares what a step does
//! with multipliers that were predicted.

mod dense;
mod eigenvalues;
mod lattice;
mod levels;
mod linear_form;
mod pairing;
mod program;
mod propagator;
mod rounded;
mod runs;
mod stages;
mod torus_scheme;
mod validation;

pub use eigenvalues::eigenvalues;
pub use lattice::PerAxis;
pub(crate) use rounded::largest;
pub use runs::Run;
pub use torus_scheme::{Torus, TorusScheme};
pub use validation::{Multiplier, Row, Validation, ValidationPlan, validate};

/// Why equations cannot be run.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SteppingError {
    /// An expression that is no linear scheme's.
    #[error("{problem}: `{place}`")]
    NotUnderstood {
        /// What is wrong.
        problem: String,
        /// The text of the place.
        place: String,
    },
    /// A parameter without a value.
    #[error("the parameter `{0}` needs a value")]
    NotSet(String),
    /// Another number of axes than of dimensions.
    #[error("{axes} number{} of cells for {dimension} space dimension{}: one for each", plural(*axes), plural(*dimension))]
    Dimension {
        /// Of the equations.
        dimension: usize,
        /// Of the torus.
        axes: usize,
    },
    /// Not as many equations as unknowns.
    #[error("{equations} equations for {unknowns} unknowns: there must be as many")]
    NotSquare {
        /// Equations.
        equations: usize,
        /// Unknowns.
        unknowns: usize,
    },
    /// Too many equations.
    #[error("{equations} equations with time levels; at most {most} are run together")]
    TooManyEquations {
        /// Equations.
        equations: usize,
        /// How many may be.
        most: usize,
    },
    /// An unknown that the equations do not give.
    #[error("the equations do not determine `{0}`")]
    NotDetermined(String),
    /// All unknowns at one level.
    #[error("no unknown stands at a later level than another: nothing is advanced in time")]
    NoStep,
    /// Equations with `u[j]'` alone.
    #[error("equations with u[j]' need a time integrator")]
    NeedsIntegrator,
    /// Equations with time levels and an integrator.
    #[error("an integrator completes equations with u[j]', not with time levels")]
    TakesNoIntegrator,
    /// A Nyström method without positions and velocities.
    #[error(
        "this integrator is for positions and velocities: it needs an equation x[j]' = v[j] and one for v[j]'"
    )]
    NoPositions,
    /// A torus without cells.
    #[error("a torus needs at least one cell along each axis")]
    NoCells,
    /// The implicit part has no solution.
    #[error(
        "the implicit step is singular on a torus of {} cells: some wave has no next value",
        points.joined(" × ")
    )]
    Singular {
        /// Cells along each axis.
        points: PerAxis<usize>,
    },
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
