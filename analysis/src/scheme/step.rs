//! What a scheme is: a square matrix of Laurent polynomials in the shifts.

use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::laurent::{Laurent, VARIABLES, Variable};
use crate::exact::matrix::{MOST_ROWS, Matrix};
use crate::exact::rational::{Rational, greatest_divisor};
use crate::kernel::lattice::RatioOutOfRange;
use crate::scheme::kernel_function::KernelLattice;
use crate::scheme::language::syntax::Equations;
use crate::scheme::language::{LanguageError, parse};
use crate::scheme::linear::{LinearEquations, Place};
use crate::scheme::names::{Fraction, LetterKind, Names, TooManyNames};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};
use thiserror::Error;

/// A linear scheme with constant coefficients: `P(z, E; p) U = 0` on the lattice, where `z` shifts one time level, `E` one cell
/// and `p` are named parameters. On a wave `U_j^n = z^n e^{iφj} Û` the multipliers are the roots of `det P(z, e^{iφ}; p)`.
///
/// ```
/// use courant_analysis::scheme::Step;
/// let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")?;
/// assert_eq!(leapfrog.limit("C")?.exact().unwrap().to_string(), "1");
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Step {
    pub(crate) matrix: Matrix,
    pub(crate) unknowns: Vec<String>,
    pub(crate) dimension: usize,
    pub(crate) names: Names,
    /// What equations were multiplied by; where one vanishes the scheme is not defined.
    pub(crate) denominators: Vec<Laurent>,
    pub(crate) set: Vec<(String, Rational)>,
    /// Whether its coefficients were measured on a running code: nothing about it is then proved.
    pub(crate) measured: bool,
}

/// Why something is no scheme, or why nothing can be said about it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SchemeError {
    /// The text is not understood, or is no scheme.
    #[error(transparent)]
    Text(#[from] LanguageError),
    /// The determinant vanishes whatever the wave: the equations do not determine the unknowns.
    #[error("the equations do not determine {0}: their determinant vanishes for every wave")]
    Dependent(String),
    /// No multiplier: nothing is advanced in time.
    #[error(
        "no unknown stands at a later level than another, with a coefficient that is not 0: nothing is advanced in time"
    )]
    NoStep,
    /// A value at which the coefficients of the newest level vanish, or determine nothing.
    #[error("{name} = {value}: the step cannot be solved for any wave")]
    Singular {
        /// The parameter.
        name: String,
        /// Its value.
        value: String,
    },
    /// A parameter that does not occur.
    #[error("there is no parameter `{name}`; the scheme has {}", list(known))]
    UnknownParameter {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// Parameters without a value.
    #[error("the parameter{} {} need{} a value", plural(.0), list(.0), if .0.len() == 1 { "s" } else { "" })]
    NotSet(Vec<String>),
    /// A value for which a quotient in the equations has no meaning.
    #[error("{name} = {value}: a denominator of the equations vanishes")]
    Denominator {
        /// The parameter.
        name: String,
        /// Its value.
        value: String,
    },
    /// Too many names for one scheme.
    #[error(transparent)]
    TooManyNames(#[from] TooManyNames),
    /// Too many unknowns.
    #[error("{0} unknowns are left after substitution; at most {MOST_ROWS} are accepted")]
    TooManyUnknowns(usize),
    /// An integrator that does not serve these equations.
    #[error("{0}")]
    Integrator(String),
    /// A smoothing ratio out of range.
    #[error(transparent)]
    Ratio(#[from] RatioOutOfRange),
    /// More than one space dimension.
    #[error("{0} space dimensions: limits are decided in one")]
    Dimension(usize),
    /// [Interest](crate::interest::Interest) in the answer was lost.
    #[error("the work was cancelled")]
    Cancelled,
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "none".into() } else { names.join(", ") }
}

fn plural(names: &[String]) -> &'static str {
    if names.len() == 1 { "" } else { "s" }
}

impl Step {
    /// From equations in the language of schemes.
    ///
    /// # Errors
    /// With the place in the text when it is not understood, not linear or not square.
    pub fn from_text(text: &str) -> Result<Self, SchemeError> {
        Self::from_tree(&parse(text)?, None)
    }

    /// The same with a kernel for `sum(k, …)`.
    ///
    /// # Errors
    /// As [`from_text`](Self::from_text).
    pub fn with_kernel(text: &str, lattice: &KernelLattice) -> Result<Self, SchemeError> {
        Self::from_tree(&parse(text)?, Some(lattice))
    }

    /// From a text that was read before.
    ///
    /// # Errors
    /// As [`from_text`](Self::from_text).
    pub fn from_tree(
        tree: &Equations,
        lattice: Option<&KernelLattice>,
    ) -> Result<Self, SchemeError> {
        let linear = LinearEquations::new(tree, lattice)?;
        if linear.equations.iter().flat_map(|e| &e.terms).any(|(place, _)| place.time.is_none()) {
            let message = "equations with u[j]' need a time integrator: give --integrator";
            return Err(linear.error(message, 0).into());
        }
        let rows = Rows::new(&linear)?;
        rows.has_a_step(&linear)?;
        Ok(Self {
            matrix: rows.matrix,
            unknowns: linear.unknowns,
            dimension: linear.dimension,
            names: linear.names,
            denominators: rows.denominators,
            set: Vec::new(),
            measured: false,
        })
    }

    /// The number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The names of the unknowns.
    pub fn unknowns(&self) -> &[String] {
        &self.unknowns
    }

    /// The parameters and letters of its polynomials.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// How one of its polynomials is printed: the shifts as `E`, in two and three dimensions as `E_1`, `E_2`, `E_3`.
    pub fn text(&self, polynomial: &Laurent) -> String {
        polynomial.to_text(&|place| match (place, self.dimension) {
            (1, 2..) => "E_1".into(),
            _ => self.names.name_at(place),
        })
    }

    /// `P` by rows: one equation each, times what clears its denominators.
    pub fn matrix(&self) -> &Matrix {
        &self.matrix
    }

    /// What equations were multiplied by.
    pub fn denominators(&self) -> &[Laurent] {
        &self.denominators
    }

    /// The parameters that have no value yet and occur.
    pub fn free_parameters(&self) -> Vec<String> {
        let occurs = |variable: Variable| {
            self.matrix.rows().iter().flatten().any(|entry| entry.contains(variable))
        };
        let free = self.names.parameters().filter(|(_, variable)| occurs(*variable));
        free.map(|(name, _)| name.to_string()).collect()
    }

    /// The parameters that were given a value, in the order of setting.
    pub fn set_parameters(&self) -> &[(String, Rational)] {
        &self.set
    }

    /// With a value for a parameter.
    ///
    /// # Errors
    /// When there is no such parameter.
    pub fn with(&self, name: &str, value: &Rational) -> Result<Self, SchemeError> {
        let variable = self.variable(name)?;
        let rows = self.matrix.rows().iter().map(|row| row_at(row.iter(), variable, value));
        let mut set = self.set.clone();
        set.push((name.to_string(), value.clone()));
        let denominators = denominators_at(&self.denominators, variable, name, value)?;
        Ok(Self { matrix: Matrix::new(rows.collect()), denominators, set, ..self.clone() })
    }

    /// With the kernel sums that are exact multiplied out in shifts.
    pub(crate) fn expanded(&self) -> Self {
        let mut matrix = self.matrix.clone();
        for (variable, letter) in self.names.letters() {
            if matches!(letter.kind, LetterKind::SquareRoot(_)) || !letter.value.is_exact() {
                continue;
            }
            let (numerator, denominator) = laurent_of(&letter.value);
            let rows = matrix.rows().iter().map(|row| {
                let degree = row.iter().map(|entry| entry.degree(variable)).max().unwrap_or(0);
                row.iter()
                    .map(|entry| {
                        let missing = (degree - entry.degree(variable)) as usize;
                        entry.substitute(variable, &numerator, &denominator)
                            * denominator.pow(missing)
                    })
                    .collect()
            });
            matrix = Matrix::new(rows.collect());
        }
        Self { matrix, ..self.clone() }
    }

    pub(crate) fn variable(&self, name: &str) -> Result<Variable, SchemeError> {
        self.names.known_parameter(name)
    }

    /// `P` with all unknowns substituted that an equation gives by a unit: its null space keeps its dimension.
    pub(crate) fn reduced(&self) -> Matrix {
        let mut matrix = self.matrix.clone();
        let all: Vec<usize> = (0..self.unknowns.len()).collect();
        if matrix.size() > 1 {
            matrix.substitute(&all);
        }
        matrix
    }

    /// `χ(z) = det P`, auxiliaries substituted first: without the powers of `z`, `E` and names and the integer that all its terms
    /// share. Its roots in `z` are the multipliers.
    ///
    /// # Errors
    /// When it vanishes identically or has no power of `z`.
    pub fn characteristic(&self) -> Result<Laurent, SchemeError> {
        let matrix = self.reduced();
        if matrix.size() > MOST_ROWS {
            return Err(SchemeError::TooManyUnknowns(matrix.size()));
        }
        let determinant = self.names.reduce(matrix.determinant()).primitive();
        if determinant.is_zero() {
            return Err(SchemeError::Dependent(self.unknowns.join(", ")));
        }
        if determinant.degree(Variable::TIME) == 0 {
            return Err(SchemeError::NoStep);
        }
        Ok(determinant)
    }
}

/// A row of equations with a value for a parameter: every entry times the same power of the value's denominator.
pub(crate) fn row_at<'a>(
    row: impl Iterator<Item = &'a Laurent> + Clone,
    variable: Variable,
    value: &Rational,
) -> Vec<Laurent> {
    let degree = row.clone().map(|entry| entry.degree(variable)).max().unwrap_or(0);
    row.map(|entry| {
        let missing = (degree - entry.degree(variable)) as u32;
        entry.at_fraction(variable, value).scaled(&value.denom().pow(missing))
    })
    .collect()
}

/// Denominators with a value for a parameter.
pub(crate) fn denominators_at(
    denominators: &[Laurent],
    variable: Variable,
    name: &str,
    value: &Rational,
) -> Result<Vec<Laurent>, SchemeError> {
    let denominators: Vec<Laurent> =
        denominators.iter().map(|d| d.at_fraction(variable, value)).collect();
    if denominators.iter().any(Laurent::is_zero) {
        let value = crate::exact::rational::to_text(value);
        return Err(SchemeError::Denominator { name: name.into(), value });
    }
    Ok(denominators)
}

/// The centre of a cosine series as a Laurent polynomial over an integer.
pub(crate) fn laurent_of(series: &EnclosedSeries) -> (Laurent, Laurent) {
    let shorter = |content: BigInt, value: &BigInt| {
        if content.is_one() || value.is_multiple_of(&content) {
            content
        } else {
            greatest_divisor(&content, value)
        }
    };
    let content = series.numerators().iter().fold(series.denominator().clone(), shorter);
    let terms = series.numerators().iter().enumerate().flat_map(|(order, value)| {
        let half = value / &content;
        let at = |sign: i16| {
            let mut exponents = [0; VARIABLES];
            exponents[1] = sign * order as i16;
            (exponents, half.clone())
        };
        [at(1), at(-1)]
    });
    (Laurent::new(terms.collect()), Laurent::constant(series.denominator() / &content * 2))
}

impl Names {
    /// The variable of a parameter that must occur.
    pub(crate) fn known_parameter(&self, name: &str) -> Result<Variable, SchemeError> {
        self.parameter(name).ok_or_else(|| SchemeError::UnknownParameter {
            name: name.into(),
            known: self.parameters().map(|(name, _)| name.to_string()).collect(),
        })
    }
}

/// The matrix of equations, with fractions cleared row by row.
pub(crate) struct Rows {
    pub(crate) matrix: Matrix,
    /// The coefficients of the time derivatives; zero for schemes that step.
    pub(crate) mass: Matrix,
    pub(crate) denominators: Vec<Laurent>,
}

impl Rows {
    pub(crate) fn new(linear: &LinearEquations) -> Result<Self, LanguageError> {
        let unknowns = linear.unknowns.len();
        let origins = origins(linear)?;
        let mut matrix = Matrix::zero(linear.equations.len(), unknowns);
        let mut mass = matrix.clone();
        let mut denominators: Vec<Laurent> = Vec::new();
        for (row, equation) in linear.equations.iter().enumerate() {
            let mut common = Laurent::integer(1);
            for (_, fraction) in &equation.terms {
                if common.divide_exactly(&fraction.denominator).is_none() {
                    common = least_common_multiple(&common, &fraction.denominator);
                }
            }
            for (place, fraction) in &equation.terms {
                let Fraction { numerator, denominator } = fraction;
                let factor = common.divide_exactly(denominator).expect("a multiple of each");
                let mut entry = &factor * numerator;
                let (time, space) = origins[place.unknown];
                let steps = |halves: i32, origin: i32| ((halves - origin) / 2) as i16;
                if let Some(offset) = place.time {
                    entry = entry.shifted(Variable::TIME, steps(offset.halves, time));
                }
                for (axis, origin) in space.into_iter().enumerate().take(linear.dimension) {
                    let by = steps(place.space[axis].halves, origin);
                    entry = entry.shifted(Variable::axis(axis), by);
                }
                let target = if place.derivative { &mut mass } else { &mut matrix }
                    .entry(row, place.unknown);
                *target = std::mem::take(target) + entry;
            }
            if common.as_constant().is_none() && !denominators.contains(&common) {
                denominators.push(common);
            }
        }
        Ok(Self { matrix, mass, denominators })
    }

    /// Whether any unknown stands at two levels, or two unknowns at different ones.
    fn has_a_step(&self, linear: &LinearEquations) -> Result<(), LanguageError> {
        let levels = linear.equations.iter().flat_map(|equation| &equation.terms);
        let levels = levels.filter_map(|(place, _)| place.time.map(|time| time.halves));
        let (lowest, highest) = levels
            .fold((i32::MAX, i32::MIN), |(low, high), level| (low.min(level), high.max(level)));
        if highest <= lowest {
            let message = "no unknown stands at a later level than another: write u[n+1,j]";
            return Err(linear.error(message, usize::MAX));
        }
        Ok(())
    }
}

fn least_common_multiple(left: &Laurent, right: &Laurent) -> Laurent {
    use num_integer::Integer;
    if let (Some(a), Some(b)) = (left.as_constant(), right.as_constant()) {
        return Laurent::constant(a.lcm(&b));
    }
    let (a, b) = (left.integer_content(), right.integer_content());
    let common = crate::exact::laurent::greatest_common_divisor(left, right).scaled(&a.gcd(&b));
    let quotient = right.divide_exactly(&common).unwrap_or_else(|| right.clone());
    left * &quotient
}

/// Where the lattice of each unknown begins, in halves: 0 or 1 in time and along each axis.
fn origins(linear: &LinearEquations) -> Result<Vec<(i32, [i32; 3])>, LanguageError> {
    let mut origins: Vec<Option<(i32, [i32; 3])>> = vec![None; linear.unknowns.len()];
    for (row, equation) in linear.equations.iter().enumerate() {
        for (place, _) in &equation.terms {
            let parity = |halves: i32| halves.rem_euclid(2);
            let time = place.time.map_or(0, |time| parity(time.halves));
            let space = place.space.map(|offset| parity(offset.halves));
            let known = origins[place.unknown].get_or_insert((time, space));
            if *known != (time, space) {
                let name = &linear.unknowns[place.unknown];
                let message = format!(
                    "`{name}` stands at whole and at half indices: an unknown keeps one parity in time and along each axis"
                );
                return Err(linear.error(message, row));
            }
        }
    }
    Ok(origins.into_iter().map(Option::unwrap_or_default).collect())
}

impl Place {
    /// Whether the value stands in the method of lines.
    pub(crate) fn is_of_lines(&self) -> bool {
        self.time.is_none()
    }
}

impl Step {
    /// Whether it advances one unknown from one level to the next without solving for anything, once auxiliaries are substituted.
    pub fn is_explicit_one_step(&self) -> bool {
        self.characteristic().is_ok_and(|chi| {
            let coefficients = chi.coefficients(Variable::TIME);
            coefficients.len() == 2
                && coefficients[1]
                    .as_monomial()
                    .is_some_and(|(e, _)| e[4..].iter().all(Zero::is_zero))
        })
    }
}
