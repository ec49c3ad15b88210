//! Rational functions as people write them: `-C (1 - C) (1 - 2 C)/6`.

use crate::exact::laurent::{Laurent, VARIABLES, Variable};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::Rational;
use crate::exact::rational_function::RationalFunction;
use crate::exact::real_roots::{real_roots, root_bound};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// How a polynomial, brackets around one and exponents are set.
struct Notation<'a> {
    write: &'a dyn Fn(&Laurent) -> String,
    brackets: [&'a str; 2],
    braces: [&'a str; 2],
}

/// `± content Π f^m`, every factor with a positive first coefficient: powers of variables, linear factors of a polynomial in one
/// variable, and what is left.
struct Factors {
    content: BigInt,
    factors: Vec<(Laurent, usize)>,
}

impl Factors {
    fn of(polynomial: &Laurent) -> Self {
        let mut content = polynomial.integer_content();
        let mut rest = polynomial.primitive();
        let mut factors: Vec<(Laurent, usize)> = Vec::new();
        let powers = polynomial.lowest_powers();
        for place in (0..VARIABLES).filter(|&place| powers[place] != 0) {
            factors.push((Laurent::variable(Variable(place)), powers[place] as usize));
        }
        let variables = (0..VARIABLES).map(Variable).filter(|&v| rest.contains(v));
        if let [only] = variables.collect::<Vec<_>>()[..] {
            for root in rational_roots(&rest, only) {
                // (a − b x) for the root a/b.
                let line = Laurent::constant(root.numer().clone())
                    - Laurent::variable(only).scaled(root.denom());
                let mut multiplicity = 0;
                while let Some(quotient) = rest.divide_exactly(&line) {
                    (rest, multiplicity) = (quotient, multiplicity + 1);
                }
                if root.is_negative() && multiplicity % 2 == 1 {
                    rest = -rest;
                }
                factors.push((if root.is_negative() { -line } else { line }, multiplicity));
            }
        }
        if rest.terms().first().is_some_and(|(_, value)| value.is_negative()) {
            (rest, content) = (-rest, -content);
        }
        // Primitive, and positive: a constant is 1.
        if rest.as_constant().is_none() {
            factors.push((rest, 1));
        }
        Self { content, factors }
    }

    /// What the product is put together from, without its sign.
    fn parts(&self, notation: &Notation) -> Vec<String> {
        let Notation { write, brackets: [open, close], braces: [begin, end] } = notation;
        let content = self.content.abs();
        let mut parts: Vec<String> = Vec::new();
        if !content.is_one() || self.factors.is_empty() {
            parts.push(content.to_string());
        }
        for (factor, multiplicity) in &self.factors {
            let text = match factor.as_monomial() {
                Some(_) => write(factor),
                None => format!("{open}{}{close}", write(factor)),
            };
            parts.push(match multiplicity {
                1 => text,
                _ => format!("{text}^{begin}{multiplicity}{end}"),
            });
        }
        parts
    }
}

/// The rational roots but zero.
fn rational_roots(polynomial: &Laurent, variable: Variable) -> Vec<Rational> {
    let Some(polynomial) = polynomial.in_one_variable(variable) else { return Vec::new() };
    let bound = root_bound(&polynomial);
    let roots = real_roots(&polynomial, &-bound.clone(), &bound, 64);
    let mut found: Vec<Rational> = roots.iter().filter_map(|root| root.exact().cloned()).collect();
    found.sort_by_key(|root| (root.is_negative(), root.denom().clone(), root.abs()));
    found
}

impl Laurent {
    /// As a polynomial in one variable, if it contains no other.
    ///
    /// # Panics
    /// When it has negative powers.
    pub fn in_one_variable(&self, variable: Variable) -> Option<Polynomial<Rational>> {
        let coefficients = self.coefficients(variable).into_iter();
        let values = coefficients.map(|value| value.as_constant().map(Rational::from));
        Some(Polynomial::new(values.collect::<Option<_>>()?))
    }
}

impl RationalFunction {
    /// As plain text, factors apart; `name` gives the names of variables by place.
    pub fn to_text(&self, name: &dyn Fn(usize) -> String) -> String {
        let write = |p: &Laurent| p.to_text(name);
        let notation = Notation { write: &write, brackets: ["(", ")"], braces: [""; 2] };
        self.set(&notation, |above, below| match below {
            [single] => format!("{above}/{single}"),
            several => format!("{above}/({})", several.join(" ")),
        })
    }

    /// As LaTeX; `write` sets a polynomial.
    pub fn to_latex(&self, write: &dyn Fn(&Laurent) -> String) -> String {
        let notation = Notation { write, brackets: ["\\left(", "\\right)"], braces: ["{", "}"] };
        self.set(&notation, |above, below| format!("\\frac{{{above}}}{{{}}}", below.join(" ")))
    }

    fn set(&self, notation: &Notation, quotient: impl Fn(&str, &[String]) -> String) -> String {
        if self.is_zero() {
            return "0".into();
        }
        let (above, below) = (Factors::of(self.numerator()), Factors::of(self.denominator()));
        let is_negative = above.content.is_negative() != below.content.is_negative();
        let sign = if is_negative { "-" } else { "" };
        let (above, below) = (above.parts(notation).join(" "), below.parts(notation));
        match below.as_slice() {
            [one] if one == "1" => format!("{sign}{above}"),
            parts => format!("{sign}{}", quotient(&above, parts)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_those_of_a_book() {
        let c = || RationalFunction::from(Laurent::variable(Variable::name(0)));
        let whole = |value: i64| RationalFunction::from(Laurent::integer(value));
        let name = |_: usize| "C".to_string();
        let cubic = c() * (whole(1) - c()) * (whole(2) * c() - whole(1)) * (whole(3) + c());
        let text = cubic.over(&whole(6)).unwrap().to_text(&name);
        assert_eq!(text, "-C (1 - C) (1 - 2 C) (3 + C)/6");
        let square =
            (whole(1) - c()).pow(2) * (whole(2) - c() * c()).over(&(whole(1) + c())).unwrap();
        assert_eq!(square.to_text(&name), "(1 - C)^2 (2 - C^2)/(1 + C)");
        let write = |p: &Laurent| p.to_text(&name);
        assert_eq!(whole(-3).over(&whole(4)).unwrap().to_latex(&write), "-\\frac{3}{4}");
        assert_eq!((whole(0) * c()).to_text(&name), "0");
        // Nothing but a number above; a sign below; a root below zero, twice.
        let over = |below: RationalFunction| whole(1).over(&below).unwrap().to_text(&name);
        assert_eq!(over(whole(1) + c()), "1/(1 + C)");
        assert_eq!(over(c() - whole(1)), "-1/(1 - C)");
        assert_eq!(over(c() * (whole(2) + whole(3) * c())), "1/(C (2 + 3 C))");
        let cubed = |p: RationalFunction| (p.pow(3) * c()).to_text(&name);
        assert_eq!(cubed(c() + whole(3)), "C (3 + C)^3");
        assert_eq!(((c() + whole(3)).pow(2) * c()).to_text(&name), "C (3 + C)^2");
        assert_eq!(((c() + whole(3)) * (whole(1) + c() * c())).to_text(&name), "(3 + C) (1 + C^2)");
        assert_eq!((whole(2) * c()).to_text(&name), "2 C");
    }
}
