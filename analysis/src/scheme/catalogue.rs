//! The catalogue: schemes, spaces, integrators and particle methods, each a file in the user's own language.

use crate::exact::laurent::Laurent;
use crate::exact::rational::{Rational, parse as parse_number};
use crate::kernel::Kernel;
use crate::scheme::equation_text::EquationText;
use crate::scheme::integrator::{Integrator, one_line};
use crate::scheme::kernel_function::KernelLattice;
use crate::scheme::language::syntax::{Expression, Node};
use crate::scheme::language::{LanguageError, parse, parse_expression};
use crate::scheme::linear::constant;
use crate::scheme::lines::Lines;
use crate::scheme::names::Names;
use crate::scheme::step::{SchemeError, Step};
use crate::spelling::spells;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::LazyLock;
use thiserror::Error;

include!(concat!(env!("OUT_DIR"), "/catalogue.rs"));

/// A scheme as a file states it; equations with `u[j]'` are a space that an integrator completes.
#[derive(Debug, Clone, PartialEq)]
pub struct SchemeFile {
    /// Its name on the command line and in files.
    pub name: String,
    /// Its name for titles and captions.
    pub title: String,
    /// The equations; those of the catalogue are read when they are first asked for.
    pub equations: EquationText,
    /// The parameter whose limit is sought, if the file says so.
    pub parameter: Option<String>,
    /// The exponent of one exact step: `-I*C*phi`.
    pub exact: Option<String>,
    /// Where it comes from.
    pub source: String,
    /// What there is to know.
    pub notes: String,
    /// Defaults of the other parameters.
    pub parameters: BTreeMap<String, Rational>,
    /// What the literature says.
    pub known: Known,
}

/// Limits from the literature.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Known {
    /// Of stability.
    pub stability: Option<KnownLimit>,
    /// Of monotonicity.
    pub monotonicity: Option<KnownLimit>,
    /// All stable values, where they are not one interval from 0.
    pub stable_set: Option<KnownSet>,
    /// Orders of accuracy.
    pub order: Option<KnownOrder>,
}

/// Orders of accuracy from the literature.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownOrder {
    /// In space.
    pub space: Option<u32>,
    /// In time.
    pub time: Option<u32>,
    /// At a fixed parameter.
    pub overall: Option<u32>,
    /// Where they stand.
    pub source: String,
}

/// A limit from the literature.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownLimit {
    /// `15/8`, `sqrt(3)`, `0`, `unbounded`, or a decimal with the digits that are known.
    pub value: String,
    /// Where it stands.
    pub source: String,
}

/// Stable intervals from the literature.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownSet {
    /// `["1", "2"]`; `inf` for no end.
    pub intervals: Vec<[String; 2]>,
    /// Where they stand.
    pub source: String,
}

/// What is wrong with the file of a scheme.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SchemeFileError {
    /// It is no TOML, or keys are missing or not known.
    #[error("{0}")]
    Form(String),
    /// The equations are not understood.
    #[error(transparent)]
    Equations(#[from] LanguageError),
    /// A default that is no number.
    #[error("[parameters] {name}: `{value}` is no exact number")]
    Parameter {
        /// The parameter.
        name: String,
        /// What stands there.
        value: String,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    title: Option<String>,
    equations: String,
    parameter: Option<String>,
    exact: Option<String>,
    #[serde(default)]
    source: String,
    #[serde(default)]
    notes: String,
    #[serde(default)]
    parameters: BTreeMap<String, toml::Value>,
    #[serde(default)]
    known: Known,
}

impl SchemeFile {
    /// Equations with nothing around them: they are their own name.
    ///
    /// # Errors
    /// When the text is not understood.
    pub fn typed(text: &str) -> Result<Self, LanguageError> {
        let name = text.split_whitespace().collect::<Vec<_>>().join(" ");
        Ok(Self {
            title: name.clone(),
            name,
            equations: parse(text)?.into(),
            parameter: None,
            exact: None,
            source: String::new(),
            notes: String::new(),
            parameters: BTreeMap::new(),
            known: Known::default(),
        })
    }

    /// Reads a file.
    ///
    /// # Errors
    /// When it is no scheme.
    pub fn from_toml(text: &str) -> Result<Self, SchemeFileError> {
        Self::with_equations(text, |equations| Ok(parse(&equations)?.into()))
    }

    fn with_equations(
        text: &str,
        read: impl Fn(String) -> Result<EquationText, SchemeFileError>,
    ) -> Result<Self, SchemeFileError> {
        let file: File =
            toml::from_str(text).map_err(|error| SchemeFileError::Form(one_line(&error)))?;
        let mut parameters = BTreeMap::new();
        for (name, value) in file.parameters {
            let text = match &value {
                toml::Value::String(text) => text.clone(),
                toml::Value::Integer(whole) => whole.to_string(),
                toml::Value::Float(number) => number.to_string(),
                other => other.type_str().to_string(),
            };
            let number = exact_number(&text)
                .ok_or_else(|| SchemeFileError::Parameter { name: name.clone(), value: text })?;
            parameters.insert(name, number);
        }
        Ok(Self {
            title: file.title.unwrap_or_else(|| file.name.clone()),
            name: file.name,
            equations: read(file.equations)?,
            parameter: file.parameter,
            exact: file.exact,
            source: file.source,
            notes: file.notes,
            parameters,
            known: file.known,
        })
    }

    /// Whether an integrator must complete it.
    pub fn is_of_lines(&self) -> bool {
        self.any(|node| matches!(node, Node::Unknown(unknown) if unknown.derivative))
    }

    /// Whether it needs a kernel.
    pub fn needs_kernel(&self) -> bool {
        self.any(|node| matches!(node, Node::Sum { .. } | Node::Weight { .. }))
    }

    /// Whether it has more than one space dimension.
    pub fn is_of_several_dimensions(&self) -> bool {
        self.any(|node| matches!(node, Node::Unknown(unknown) if unknown.space.len() > 1))
    }

    fn any(&self, is_it: impl Fn(&Node) -> bool) -> bool {
        let mut found = false;
        for equation in &self.equations.equations {
            visit(&equation.left, &mut |node| found |= is_it(node));
            visit(&equation.right, &mut |node| found |= is_it(node));
        }
        found
    }

    /// The step, completed by an integrator where it is a space, with the defaults of the parameters that are not in `values`, and those
    /// values; `sought` is left free.
    ///
    /// # Errors
    /// When text, kernel and integrator do not go together.
    pub fn step(
        &self,
        lattice: Option<&KernelLattice>,
        integrator: Option<&Integrator>,
        values: &[(String, Rational)],
        sought: Option<&str>,
    ) -> Result<Step, SchemeError> {
        if let Some(integrator) = integrator {
            return Step::lines(&self.lines(lattice, values, sought)?, integrator);
        }
        let mut step = Step::from_tree(&self.equations, lattice)?;
        for (name, value) in values {
            step = step.with(name, value)?;
        }
        for (name, value) in self.defaults(values, sought) {
            if step.free_parameters().contains(name) {
                step = step.with(name, value)?;
            }
        }
        Ok(step)
    }

    /// The equations of lines that an integrator completes, with values as in [`step`](Self::step).
    ///
    /// # Errors
    /// When text and kernel do not go together, or the equations are none of lines.
    pub fn lines(
        &self,
        lattice: Option<&KernelLattice>,
        values: &[(String, Rational)],
        sought: Option<&str>,
    ) -> Result<Lines, SchemeError> {
        let mut lines = Lines::from_tree(&self.equations, lattice)?;
        for (name, value) in values {
            lines = lines.with(name, value)?;
        }
        for (name, value) in self.defaults(values, sought) {
            if lines.names().parameter(name).is_some() {
                lines = lines.with(name, value)?;
            }
        }
        Ok(lines)
    }

    /// The defaults of parameters that nobody gave a value.
    fn defaults(
        &self,
        values: &[(String, Rational)],
        sought: Option<&str>,
    ) -> impl Iterator<Item = (&String, &Rational)> {
        let given =
            move |name: &str| values.iter().any(|(known, _)| known == name) || sought == Some(name);
        self.parameters.iter().filter(move |(name, _)| !given(name))
    }

    /// The step with a kernel at a smoothing ratio, the defaults of its parameters, and the parameter sought left free.
    ///
    /// ```
    /// use courant_analysis::{exact::rational::ratio, kernel::Kernel, scheme::catalogue};
    /// let godunov = catalogue::scheme("godunov-sph").unwrap();
    /// let step = godunov.with_kernel(Kernel::CubicSpline, &ratio(2, 1))?;
    /// assert_eq!(step.limit("C")?.exact().unwrap().to_string(), "15/8");
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    ///
    /// # Errors
    /// When the ratio is out of range, or the equations need an integrator.
    pub fn with_kernel(&self, kernel: Kernel, ratio: &Rational) -> Result<Step, SchemeError> {
        let lattice = KernelLattice::new(kernel, ratio)?;
        self.step(Some(&lattice), None, &[], self.parameter.as_deref())
    }
}

fn visit(expression: &Expression, look: &mut impl FnMut(&Node)) {
    look(&expression.node);
    match &expression.node {
        Node::Add(a, b) | Node::Subtract(a, b) | Node::Multiply(a, b) | Node::Divide(a, b) => {
            visit(a, look);
            visit(b, look);
        }
        Node::SquareRoot(a) | Node::Negative(a) | Node::Power(a, _) => visit(a, look),
        Node::Sum { body, .. } => visit(body, look),
        Node::Number(_) | Node::Pi | Node::Name(_) | Node::Unknown(_) | Node::Weight { .. } => {}
    }
}

/// An exact number: a decimal, a fraction, or an expression of them.
pub fn exact_number(text: &str) -> Option<Rational> {
    if let Ok(value) = parse_number(text) {
        return Some(value);
    }
    let mut names = Names::default();
    let expression = parse_expression(text).ok()?;
    let fraction = constant(&expression, text, &mut names).ok()?;
    let is_number = |p: &Laurent| p.as_constant().is_some();
    (is_number(&fraction.numerator) && is_number(&fraction.denominator))
        .then(|| fraction.as_number())
        .flatten()
}

/// Files read once; each is read by a test, so that none is refused here.
fn read_schemes(files: &[(&str, &str)]) -> Vec<SchemeFile> {
    files
        .iter()
        .map(|(name, text)| {
            SchemeFile::with_equations(text, |equations| Ok(EquationText::unread(equations)))
                .unwrap_or_else(|error| panic!("{name}.toml: {error}"))
        })
        .collect()
}

static ALL_SCHEMES: LazyLock<Vec<SchemeFile>> = LazyLock::new(|| read_schemes(SCHEMES));
static ALL_SPACES: LazyLock<Vec<SchemeFile>> = LazyLock::new(|| read_schemes(SPACES));
static ALL_METHODS: LazyLock<Vec<SchemeFile>> = LazyLock::new(|| read_schemes(METHODS));
static ALL_INTEGRATORS: LazyLock<Vec<Integrator>> = LazyLock::new(|| {
    let read = |(name, text): &(&str, &str)| {
        Integrator::from_toml(text).unwrap_or_else(|error| panic!("{name}.toml: {error}"))
    };
    INTEGRATORS.iter().map(read).collect()
});

/// The integrators that particle codes are stepped by, by name: those that tests and reports go through.
pub const PARTICLE_INTEGRATORS: [&str; 10] = [
    "forward-euler",
    "symplectic-euler",
    "centred-euler",
    "leapfrog-kdk",
    "leapfrog-kdk-predicted",
    "rk2-midpoint",
    "rk2-heun",
    "rk3-ssp",
    "rk4",
    "predictor-corrector",
];

/// The schemes of the catalogue, by name.
pub fn schemes() -> &'static [SchemeFile] {
    &ALL_SCHEMES
}

/// The spaces for the method of lines.
pub fn spaces() -> &'static [SchemeFile] {
    &ALL_SPACES
}

/// The particle methods: equations of the waves on a lattice of particles.
pub fn methods() -> &'static [SchemeFile] {
    &ALL_METHODS
}

/// The integrators.
pub fn integrators() -> &'static [Integrator] {
    &ALL_INTEGRATORS
}

/// A scheme by name.
pub fn scheme(name: &str) -> Option<&'static SchemeFile> {
    named(schemes(), name)
}

/// A space by name.
pub fn space(name: &str) -> Option<&'static SchemeFile> {
    named(spaces(), name)
}

/// A particle method by name.
pub fn method(name: &str) -> Option<&'static SchemeFile> {
    named(methods(), name)
}

/// The file of this very name, else the one whose name it spells.
fn named<'a>(files: &'a [SchemeFile], name: &str) -> Option<&'a SchemeFile> {
    let exactly = files.iter().find(|file| file.name == name);
    exactly.or_else(|| files.iter().find(|file| spells(name, &file.name)))
}

impl Integrator {
    /// An integrator of the catalogue by its name or another accepted one.
    pub fn named(name: &str) -> Option<&'static Self> {
        let is_it = |known: &String| spells(name, known);
        integrators().iter().find(|one| is_it(&one.name) || one.aliases.iter().any(is_it))
    }

    /// The same as particle codes say it: `leapfrog` is kick–drift–kick there.
    pub fn for_particles(name: &str) -> Option<&'static Self> {
        let is_it = |known: &String| spells(name, known);
        let theirs = integrators().iter().find(|one| one.method_aliases.iter().any(is_it));
        theirs.or_else(|| Self::named(name))
    }
}

/// An expression without names, rounded: `sqrt(9/11)`.
pub fn approximate(text: &str) -> Option<f64> {
    let value = crate::scheme::Coefficient::parse(text).ok()?.to_f64();
    value.is_finite().then_some(value)
}
