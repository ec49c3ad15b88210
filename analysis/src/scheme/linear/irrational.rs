//! Numbers that are no fractions: letters with the radius to which they are known.

use super::Reader;
use super::value::{Scalar, Value, number, single};
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::rational::{Rational, square_root_enclosure};
use crate::scheme::kernel_function::KernelFunction;
use crate::scheme::language::LanguageError;
use crate::scheme::language::syntax::Span;
use crate::scheme::names::{Fraction, Letter, LetterKind};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Bits of the enclosure of an irrational number.
const CONSTANT_BITS: u32 = 256;

impl Reader<'_> {
    /// A number within a radius: a letter, unless it is exact.
    pub(super) fn enclosed(
        &mut self,
        value: Rational,
        radius: Rational,
        name: &str,
        span: &Span,
    ) -> Result<Value, LanguageError> {
        if radius.is_zero() {
            return Ok(number(Fraction::number(&value)));
        }
        let series = EnclosedSeries::new(&[value], radius);
        self.letter(LetterKind::Constant, series, None, name, span)
            .map(|variable| number(Fraction::variable(variable)))
    }

    pub(super) fn letter(
        &mut self,
        kind: LetterKind,
        value: EnclosedSeries,
        of: Option<KernelFunction>,
        name: &str,
        span: &Span,
    ) -> Result<Variable, LanguageError> {
        self.names
            .insert_letter(kind, value, of, |number| match number {
                0 => name.to_string(),
                _ => format!("{name}_{number}"),
            })
            .map_err(|problem| self.error(problem.to_string(), span))
    }

    /// `√(p/q) = √(p q)/q`, a letter for `√(p q)` unless letters that are there give it: where `p q` times some of their squares is
    /// `r²`, it is `r` over their product. So no product of letters is a fraction, and square roots cancel as polynomials.
    pub(super) fn square_root(
        &mut self,
        square: &Rational,
        span: &Span,
    ) -> Result<Value, LanguageError> {
        let whole = square.numer() * square.denom();
        let scale = Rational::new(BigInt::one(), square.denom().clone());
        // Some letters: their product, that of their squares.
        let mut some = vec![(Fraction::number(&Rational::one()), BigInt::one())];
        for (variable, letter) in self.names.letters() {
            if let LetterKind::SquareRoot(square) = &letter.kind {
                let with = |(product, squares): &(Fraction, BigInt)| {
                    (product.times(&Fraction::variable(variable)), squares * square)
                };
                some.extend(some.iter().map(with).collect::<Vec<_>>());
            }
        }
        for (product, squares) in some {
            let all = &whole * &squares;
            let root = all.sqrt();
            if &root * &root == all {
                let factor = Rational::new(root, squares) * &scale;
                return Ok(number(product.times(&Fraction::number(&factor))));
            }
        }
        let radicand = Rational::from(whole.clone());
        let (lower, upper) = square_root_enclosure(&radicand, &radicand, CONSTANT_BITS);
        let two = Rational::from(BigInt::from(2));
        let series = EnclosedSeries::new(&[(&lower + &upper) / &two], (upper - lower) / two);
        let name = format!("sqrt({whole})");
        let root = self.letter(LetterKind::SquareRoot(whole), series, None, &name, span)?;
        Ok(number(Fraction::variable(root).times(&Fraction::number(&scale))))
    }

    /// `1/scalar`: of square roots by their conjugates, of another number with a radius a new letter.
    pub(super) fn reciprocal(
        &mut self,
        scalar: Scalar,
        span: &Span,
    ) -> Result<Scalar, LanguageError> {
        let zero = "a quotient by zero";
        if let [(fraction, Some(function))] = scalar.as_slice() {
            let (function, whole) = (function.reciprocal(), fraction.as_number());
            return match (function, whole) {
                (Some(function), Some(whole)) if !whole.is_zero() => {
                    Ok(vec![(Fraction::number(&whole.recip()), Some(function))])
                }
                _ => {
                    Err(self
                        .error("inside a sum only a quotient by k or a number is understood", span))
                }
            };
        }
        if scalar.iter().any(|(_, function)| function.is_some()) {
            return Err(
                self.error("inside a sum only a quotient by k or a number is understood", span)
            );
        }
        let divisor = single(scalar);
        if divisor.is_zero() {
            return Err(self.error(zero, span));
        }
        let letters: Vec<Variable> = self.names.letters().map(|(variable, _)| variable).collect();
        let occurs = |variable: &Variable| {
            divisor.numerator.contains(*variable) || divisor.denominator.contains(*variable)
        };
        let parameters = self.names.parameters().any(|(_, variable)| occurs(&variable));
        if parameters || !letters.iter().any(occurs) {
            return Ok(vec![(Fraction::number(&Rational::one()).over(&divisor), None)]);
        }
        if let Some((above, below)) = self.rationalised(&divisor) {
            if below.is_zero() {
                return Err(self.error(zero, span));
            }
            let above = Fraction { numerator: above, denominator: Laurent::integer(1) };
            return Ok(vec![(above.times(&Fraction::number(&below.recip())), None)]);
        }
        let (center, radius) = self.ball(&divisor.numerator);
        let (below, below_radius) = self.ball(&divisor.denominator);
        if center.abs() <= radius || below.abs() <= below_radius {
            return Err(self.error(zero, span));
        }
        // |b/a − b₀/a₀| ≤ (|b₀| r_a + |a₀| r_b)/(|a₀| (|a₀| − r_a)).
        let value = &below / &center;
        let spread = (below.abs() * &radius + center.abs() * &below_radius)
            / (center.abs() * (center.abs() - &radius));
        // A long fraction is cut: products of it would be longer still.
        let unit = Rational::from(BigInt::one() << CONSTANT_BITS);
        let cut = (&value * &unit).floor() / &unit;
        let series = EnclosedSeries::new(&[cut], spread + unit.recip());
        let quotient = self.letter(LetterKind::Quotient, series, None, "q", span)?;
        Ok(vec![(Fraction::variable(quotient), None)])
    }

    /// One over a number in which no letters are but square roots, as a polynomial in them over a fraction: `1/(a + b √s)` is
    /// `(a − b √s)/(a² − b² s)`.
    fn rationalised(&self, divisor: &Fraction) -> Option<(Laurent, Rational)> {
        let reduce = |polynomial| self.names.reduce(polynomial);
        let (mut above, mut below) =
            (divisor.denominator.clone(), reduce(divisor.numerator.clone()));
        for (variable, _) in self.names.letters() {
            if let [even, odd] = below.coefficients(variable).as_slice() {
                let conjugate = even.clone() - odd * &Laurent::variable(variable);
                (above, below) = (reduce(&above * &conjugate), reduce(&below * &conjugate));
            }
        }
        let only_roots = |(variable, letter): (Variable, &Letter)| {
            matches!(letter.kind, LetterKind::SquareRoot(_)) || !above.contains(variable)
        };
        let below = Rational::from(below.as_constant()?);
        self.names.letters().all(only_roots).then_some((above, below))
    }

    /// A polynomial in constant letters as a number within a radius.
    pub(super) fn ball(&self, polynomial: &Laurent) -> (Rational, Rational) {
        let mut sum = EnclosedSeries::constant(Rational::zero());
        for (exponents, value) in polynomial.terms() {
            let mut term = EnclosedSeries::constant(Rational::from(value.clone()));
            for (place, power) in self.names.letters_at(exponents) {
                let letter = self.names.letters().find(|(v, _)| v.0 == place).map(|(_, l)| l);
                for _ in 0..power {
                    term = term.times(&letter.expect("a letter that occurs").value);
                }
            }
            sum = sum.plus(&term);
        }
        (sum.center().at_zero(), sum.radius().clone())
    }
}

/// π within `2^−250`, by Machin's formula.
pub(super) fn pi_enclosure() -> EnclosedSeries {
    let bits = CONSTANT_BITS;
    let one: BigInt = BigInt::one() << bits;
    let arctangent = |inverse: i64| {
        let square = BigInt::from(inverse * inverse);
        let mut power = &one / inverse;
        let mut sum = power.clone();
        let mut odd = 1;
        while !power.is_zero() {
            power /= &square;
            odd += 2;
            let term: BigInt = &power / odd;
            sum += if odd % 4 == 3 { -term } else { term };
        }
        sum
    };
    let value = BigInt::from(16) * arctangent(5) - BigInt::from(4) * arctangent(239);
    // Some hundred terms, each cut twice, times 16.
    let radius = Rational::new(BigInt::from(1 << 13), one.clone());
    EnclosedSeries::new(&[Rational::new(value, one)], radius)
}
