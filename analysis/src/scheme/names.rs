//! The names in a scheme's polynomials: parameters, and letters for what is no fraction or too long to be multiplied out.

use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::laurent::{Laurent, NAMES, VARIABLES, Variable};
use crate::exact::rational::Rational;
use crate::scheme::kernel_function::KernelFunction;
use num_bigint::BigInt;
use num_traits::One;

/// A name.
#[derive(Debug, Clone, PartialEq)]
pub enum Name {
    /// A number that the user sets, or whose limit is sought.
    Parameter(String),
    /// A value that is known.
    Letter(Box<Letter>),
}

/// A real, even function of the wave (or a constant) that stands for itself in all algebra, until signs are decided: what cancels
/// cancels whatever its value, and its uncertainty enters once.
#[derive(Debug, Clone, PartialEq)]
pub struct Letter {
    /// How it is printed.
    pub name: String,
    /// What it is.
    pub kind: LetterKind,
    /// The value with its radius, as a cosine series.
    pub value: EnclosedSeries,
    /// The function whose sum it is, so that sums of the same one can be brought together again.
    pub(crate) of: Option<KernelFunction>,
}

/// What a letter stands for.
#[derive(Debug, Clone, PartialEq)]
pub enum LetterKind {
    /// A number within a radius.
    Constant,
    /// One over a polynomial in other letters.
    Quotient,
    /// The square root of a natural number: its square is this. No product of those of a scheme is a fraction.
    SquareRoot(BigInt),
    /// `Σ_k c_k (1 − cos kφ)/s` over the lattice, `s = (1 − cos φ)/2`.
    Versines,
    /// `Σ_k c_k sin kφ/sin φ` over the lattice.
    Sines,
}

/// All names of one scheme, by the number of their [variable](Variable::name).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Names(Vec<Name>);

/// More names than polynomials have room for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "at most {NAMES} names are accepted: parameters, irrational numbers and kernel sums together"
)]
pub struct TooManyNames;

impl Names {
    /// The names.
    pub fn all(&self) -> &[Name] {
        &self.0
    }

    /// The variable of a parameter, if it occurs.
    pub fn parameter(&self, name: &str) -> Option<Variable> {
        let is_it = |known: &Name| matches!(known, Name::Parameter(text) if text == name);
        self.0.iter().position(is_it).map(Variable::name)
    }

    /// The parameters in the order in which they were first met.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, Variable)> {
        self.0.iter().enumerate().filter_map(|(number, name)| match name {
            Name::Parameter(text) => Some((text.as_str(), Variable::name(number))),
            Name::Letter(_) => None,
        })
    }

    /// The letters.
    pub fn letters(&self) -> impl Iterator<Item = (Variable, &Letter)> {
        self.0.iter().enumerate().filter_map(|(number, name)| match name {
            Name::Letter(letter) => Some((Variable::name(number), letter.as_ref())),
            Name::Parameter(_) => None,
        })
    }

    /// The variable of a parameter, new or known.
    pub(crate) fn insert_parameter(&mut self, name: &str) -> Result<Variable, TooManyNames> {
        match self.parameter(name) {
            Some(variable) => Ok(variable),
            None => self.push(Name::Parameter(name.into())),
        }
    }

    /// The variable of a letter, new or known by its kind and value.
    pub(crate) fn insert_letter(
        &mut self,
        kind: LetterKind,
        value: EnclosedSeries,
        of: Option<KernelFunction>,
        name: impl Fn(usize) -> String,
    ) -> Result<Variable, TooManyNames> {
        let same = |known: &Name| matches!(known, Name::Letter(l) if l.kind == kind && l.value == value && l.of == of);
        if let Some(number) = self.0.iter().position(same) {
            return Ok(Variable::name(number));
        }
        let name = name(self.letters().count());
        self.push(Name::Letter(Box::new(Letter { name, kind, value, of })))
    }

    fn push(&mut self, name: Name) -> Result<Variable, TooManyNames> {
        if self.0.len() == NAMES {
            return Err(TooManyNames);
        }
        self.0.push(name);
        Ok(Variable::name(self.0.len() - 1))
    }

    /// Whether no polynomial in the irrational numbers vanishes but for what [`reduce`](Self::reduce) knows: not with quotients. Numbers of
    /// a kernel are any within their radius.
    pub(crate) fn are_independent(&self) -> bool {
        self.letters().all(|(_, letter)| letter.kind != LetterKind::Quotient)
    }

    /// Squares of square roots replaced by what they are the roots of.
    pub fn reduce(&self, polynomial: Laurent) -> Laurent {
        self.letters().fold(polynomial, |reduced, (variable, letter)| match &letter.kind {
            LetterKind::SquareRoot(square) if reduced.degree(variable) > 1 => {
                let terms = reduced.terms().iter().map(|(exponents, value)| {
                    let mut rest = *exponents;
                    rest[variable.0] %= 2;
                    (rest, value * square.pow((exponents[variable.0] / 2) as u32))
                });
                Laurent::new(terms.collect())
            }
            _ => reduced,
        })
    }

    /// The printed name of the variable at a place among the exponents.
    pub fn name_at(&self, place: usize) -> String {
        match place {
            0 => "z".into(),
            1 => "E".into(),
            2 | 3 => format!("E_{place}"),
            _ => match self.0.get(place - 4) {
                Some(Name::Parameter(name)) => name.clone(),
                Some(Name::Letter(letter)) => letter.name.clone(),
                None => format!("p{}", place - 4),
            },
        }
    }

    /// A power of the value of a monomial's letters.
    pub(crate) fn letters_at(&self, exponents: &[i16; VARIABLES]) -> Vec<(usize, i16)> {
        self.letters()
            .filter(|(variable, _)| exponents[variable.0] != 0)
            .map(|(variable, _)| (variable.0, exponents[variable.0]))
            .collect()
    }
}

/// A fraction of polynomials in names, not reduced but for integers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fraction {
    pub(crate) numerator: Laurent,
    pub(crate) denominator: Laurent,
}

impl Fraction {
    pub(crate) fn number(value: &Rational) -> Self {
        Self {
            numerator: Laurent::constant(value.numer().clone()),
            denominator: Laurent::constant(value.denom().clone()),
        }
    }

    pub(crate) fn variable(variable: Variable) -> Self {
        Self { numerator: Laurent::variable(variable), denominator: Laurent::integer(1) }
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }

    /// The value where no name occurs.
    pub(crate) fn as_number(&self) -> Option<Rational> {
        Some(Rational::new(self.numerator.as_constant()?, self.denominator.as_constant()?))
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        if self.denominator == other.denominator {
            return Self {
                numerator: self.numerator.clone() + other.numerator.clone(),
                denominator: self.denominator.clone(),
            }
            .reduced();
        }
        Self {
            numerator: &self.numerator * &other.denominator + &other.numerator * &self.denominator,
            denominator: &self.denominator * &other.denominator,
        }
        .reduced()
    }

    pub(crate) fn negated(&self) -> Self {
        Self { numerator: -self.numerator.clone(), denominator: self.denominator.clone() }
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        Self {
            numerator: &self.numerator * &other.numerator,
            denominator: &self.denominator * &other.denominator,
        }
        .reduced()
    }

    /// By a fraction that is not zero.
    pub(crate) fn over(&self, other: &Self) -> Self {
        Self {
            numerator: &self.numerator * &other.denominator,
            denominator: &self.denominator * &other.numerator,
        }
        .reduced()
    }

    /// Without the integer that both share, with a positive constant below; divided out where it goes.
    fn reduced(self) -> Self {
        use num_integer::Integer;
        use num_traits::Signed;
        // Names keep natural powers: what is divided by stays below.
        let natural =
            |quotient: &Laurent| quotient.lowest_powers()[4..].iter().all(|&power| power >= 0);
        if let Some(quotient) = self.numerator.divide_exactly(&self.denominator)
            && natural(&quotient)
        {
            return Self { numerator: quotient, denominator: Laurent::integer(1) };
        }
        let mut common = self.numerator.integer_content().gcd(&self.denominator.integer_content());
        if self.denominator.as_constant().is_some_and(|value| value.is_negative()) {
            common = -common;
        }
        if common.is_one() {
            return self;
        }
        let common = Laurent::constant(common);
        let exactly = |p: &Laurent| p.divide_exactly(&common).expect("the content divides");
        Self { numerator: exactly(&self.numerator), denominator: exactly(&self.denominator) }
    }
}
