//! Time integrators as data: what the analysis completes equations of lines with, and what the running code steps by.

use crate::exact::rational::{Rational, to_f64};
use crate::scheme::language::syntax::{Expression, Node};
use crate::scheme::language::{LanguageError, parse_expression};
use serde::Deserialize;
use thiserror::Error;

/// An exact coefficient: a fraction, or an expression with square roots.
#[derive(Debug, Clone, PartialEq)]
pub struct Coefficient {
    text: String,
    expression: Expression,
}

impl Coefficient {
    /// Reads `1/6`, `0.25` or `1/4 - sqrt(3)/6`.
    ///
    /// # Errors
    /// When the text is no expression.
    pub fn parse(text: &str) -> Result<Self, LanguageError> {
        Ok(Self { text: text.into(), expression: parse_expression(text)? })
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The expression.
    pub fn expression(&self) -> &Expression {
        &self.expression
    }

    /// The value, rounded; not a number where a name occurs.
    pub fn to_f64(&self) -> f64 {
        value(&self.expression)
    }
}

/// An expression without unknowns in `f64`.
fn value(expression: &Expression) -> f64 {
    match &expression.node {
        Node::Number(number) => to_f64(number),
        Node::Pi => std::f64::consts::PI,
        Node::SquareRoot(argument) => value(argument).sqrt(),
        Node::Negative(argument) => -value(argument),
        Node::Add(a, b) => value(a) + value(b),
        Node::Subtract(a, b) => value(a) - value(b),
        Node::Multiply(a, b) => value(a) * value(b),
        Node::Divide(a, b) => value(a) / value(b),
        Node::Power(base, exponent) => value(base).powi(*exponent),
        Node::Name(_) | Node::Unknown(_) | Node::Weight { .. } | Node::Sum { .. } => f64::NAN,
    }
}

/// A time integrator.
///
/// ```
/// use courant_analysis::scheme::Integrator;
/// let rk4 = Integrator::named("rk4").unwrap();
/// assert_eq!(rk4.stages(), 4);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Integrator {
    /// Its name on the command line and in files.
    pub name: String,
    /// Its name for titles and captions.
    pub title: String,
    /// Other accepted names.
    pub aliases: Vec<String>,
    /// Names accepted with particle methods only.
    pub method_aliases: Vec<String>,
    /// Where it comes from.
    pub source: String,
    /// What there is to know.
    pub notes: String,
    /// What it does.
    pub form: IntegratorForm,
}

/// What an integrator does in one step of length `Δt`.
#[derive(Debug, Clone, PartialEq)]
pub enum IntegratorForm {
    /// `K_i = F(U + Δt Σ_j a_ij K_j)`, `U' = U + Δt Σ_i b_i K_i`.
    RungeKutta {
        /// The matrix by rows.
        a: Vec<Vec<Coefficient>>,
        /// The weights.
        b: Vec<Coefficient>,
    },
    /// `Σ_k α_k U^{n+k} = Δt Σ_k β_k F^{n+k}`.
    Multistep {
        /// `[α_0, …, α_s]`.
        alpha: Vec<Coefficient>,
        /// `[β_0, …, β_s]`.
        beta: Vec<Coefficient>,
    },
    /// For `x'' = a(x, x')`: `a_i = a(x + c_i Δt v + Δt² Σ_j p_ij a_j, v + Δt Σ_j q_ij a_j)`, `x' = x + Δt v + Δt² Σ_j p_j a_j`,
    /// `v' = v + Δt Σ_j q_j a_j`.
    Nystrom(Nystrom<Coefficient>),
}

/// The table of a Runge–Kutta–Nyström method: kicks and drifts by stages.
#[derive(Debug, Clone, PartialEq)]
pub struct Nystrom<T> {
    /// `[c_1, …, c_s]`: how far each stage drifts with the first velocity.
    pub c: Vec<T>,
    /// `p_ij`.
    pub position: Vec<Vec<T>>,
    /// `q_ij`.
    pub velocity: Vec<Vec<T>>,
    /// `p_j`.
    pub position_weights: Vec<T>,
    /// `q_j`.
    pub velocity_weights: Vec<T>,
}

/// What is wrong with the file of an integrator.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum IntegratorFileError {
    /// It is no TOML, or keys are missing or not known.
    #[error("{0}")]
    Form(String),
    /// A coefficient is not understood.
    #[error(transparent)]
    Coefficient(#[from] LanguageError),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct File {
    name: String,
    title: Option<String>,
    #[serde(default)]
    aliases: Vec<String>,
    #[serde(default, rename = "method_aliases")]
    method_aliases: Vec<String>,
    #[serde(default)]
    source: String,
    #[serde(default)]
    notes: String,
    runge_kutta: Option<Tableau>,
    multistep: Option<Multistep>,
    nystrom: Option<NystromFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Tableau {
    #[serde(rename = "A")]
    a: Vec<Vec<String>>,
    b: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Multistep {
    alpha: Vec<String>,
    beta: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NystromFile {
    c: Vec<String>,
    position: Vec<Vec<String>>,
    velocity: Vec<Vec<String>>,
    position_weights: Vec<String>,
    velocity_weights: Vec<String>,
}

impl Integrator {
    /// Reads a file.
    ///
    /// # Errors
    /// When it is no integrator.
    pub fn from_toml(text: &str) -> Result<Self, IntegratorFileError> {
        let file: File =
            toml::from_str(text).map_err(|error| IntegratorFileError::Form(one_line(&error)))?;
        let form = match (file.runge_kutta, file.multistep, file.nystrom) {
            (Some(tableau), None, None) => {
                let form = IntegratorForm::RungeKutta {
                    a: table(&tableau.a, tableau.b.len())?,
                    b: row(&tableau.b)?,
                };
                if tableau.a.len() != tableau.b.len() || tableau.b.is_empty() {
                    let message = "A needs one row for each entry of b, and at least one";
                    return Err(IntegratorFileError::Form(message.into()));
                }
                form
            }
            (None, Some(rows), None) => {
                if rows.alpha.len() != rows.beta.len() || rows.alpha.len() < 2 {
                    let message = "alpha and beta need as many entries, at least two";
                    return Err(IntegratorFileError::Form(message.into()));
                }
                IntegratorForm::Multistep { alpha: row(&rows.alpha)?, beta: row(&rows.beta)? }
            }
            (None, None, Some(file)) => {
                let stages = file.c.len();
                let lengths = [
                    file.position.len(),
                    file.velocity.len(),
                    file.position_weights.len(),
                    file.velocity_weights.len(),
                ];
                if stages == 0 || lengths.iter().any(|&length| length != stages) {
                    let message = "c, position, velocity, position_weights and velocity_weights need as many entries";
                    return Err(IntegratorFileError::Form(message.into()));
                }
                IntegratorForm::Nystrom(Nystrom {
                    c: row(&file.c)?,
                    position: table(&file.position, stages)?,
                    velocity: table(&file.velocity, stages)?,
                    position_weights: row(&file.position_weights)?,
                    velocity_weights: row(&file.velocity_weights)?,
                })
            }
            _ => {
                let message = "an integrator has one of [runge-kutta], [multistep], [nystrom]";
                return Err(IntegratorFileError::Form(message.into()));
            }
        };
        Ok(Self {
            title: file.title.unwrap_or_else(|| file.name.clone()),
            name: file.name,
            aliases: file.aliases,
            method_aliases: file.method_aliases,
            source: file.source,
            notes: file.notes,
            form,
        })
    }

    /// How many times one step evaluates the right-hand side anew.
    pub fn stages(&self) -> usize {
        match &self.form {
            IntegratorForm::RungeKutta { b, .. } => b.len(),
            IntegratorForm::Multistep { .. } => 1,
            IntegratorForm::Nystrom(table) => table.c.len(),
        }
    }

    /// The table for `x'' = a(x, x')` in `f64`, for code that runs: of an explicit Runge–Kutta or Nyström method; `None` for the
    /// others.
    pub fn nystrom(&self) -> Option<Nystrom<f64>> {
        let numbers = |row: &[Coefficient]| row.iter().map(Coefficient::to_f64).collect::<Vec<_>>();
        let rows =
            |table: &[Vec<Coefficient>]| table.iter().map(|row| numbers(row)).collect::<Vec<_>>();
        let explicit = |table: &[Vec<f64>]| {
            table.iter().enumerate().all(|(i, row)| row.iter().skip(i).all(|&value| value == 0.0))
        };
        let table = match &self.form {
            IntegratorForm::Multistep { .. } => return None,
            IntegratorForm::Nystrom(table) => Nystrom {
                c: numbers(&table.c),
                position: rows(&table.position),
                velocity: rows(&table.velocity),
                position_weights: numbers(&table.position_weights),
                velocity_weights: numbers(&table.velocity_weights),
            },
            IntegratorForm::RungeKutta { a, b } => {
                let (a, b) = (rows(a), numbers(b));
                let stages = b.len();
                let entry = |i: usize, j: usize| a[i].get(j).copied().unwrap_or(0.0);
                let square = |weights: &dyn Fn(usize) -> f64| -> Vec<f64> {
                    (0..stages)
                        .map(|j| (0..stages).map(|k| weights(k) * entry(k, j)).sum())
                        .collect()
                };
                Nystrom {
                    c: a.iter().map(|row| row.iter().sum()).collect(),
                    position: (0..stages).map(|i| square(&|k| entry(i, k))).collect(),
                    position_weights: square(&|k| b[k]),
                    velocity: a.clone(),
                    velocity_weights: b,
                }
            }
        };
        (explicit(&table.position) && explicit(&table.velocity)).then_some(table)
    }
}

impl std::fmt::Display for Integrator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.pad(&self.name)
    }
}

fn row(texts: &[String]) -> Result<Vec<Coefficient>, LanguageError> {
    texts.iter().map(|text| Coefficient::parse(text)).collect()
}

/// Rows may be short: what is missing is zero.
fn table(
    rows: &[Vec<String>],
    columns: usize,
) -> Result<Vec<Vec<Coefficient>>, IntegratorFileError> {
    if rows.iter().any(|row| row.len() > columns) {
        return Err(IntegratorFileError::Form(format!("a row has more than {columns} entries")));
    }
    rows.iter().map(|entries| row(entries).map_err(Into::into)).collect()
}

/// The message of a TOML error without its picture.
pub(crate) fn one_line(error: &toml::de::Error) -> String {
    error.message().replace('\n', " ")
}

/// A coefficient of a fraction, for tests and for tables written in code.
impl From<&Rational> for Coefficient {
    fn from(value: &Rational) -> Self {
        let text = crate::exact::rational::to_text(value);
        Self::parse(&text).expect("a fraction is an expression")
    }
}
