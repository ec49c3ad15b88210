//! Symbols as people read them: plain text and LaTeX, in cosines and sines of the phase.

use super::EnclosedSymbol;
use crate::exact::rational::{Rational, integer, to_f64, to_latex, to_text};
use num_traits::{One, Signed, Zero};

/// How one notation writes the parts of `g(φ)`.
struct Notation {
    number: fn(&Rational) -> String,
    decimal: fn(f64) -> String,
    courant: fn(usize) -> String,
    trigonometric: fn(&str, i64) -> String,
    open: &'static str,
    close: &'static str,
    minus: &'static str,
}

const TEXT: Notation = Notation {
    number: to_text,
    decimal: |value| format!("{value}"),
    courant: |power| if power == 1 { "C".into() } else { format!("C^{power}") },
    trigonometric: |function, k| {
        if k == 1 { format!("{function} φ") } else { format!("{function} {k}φ") }
    },
    open: " (",
    close: ")",
    minus: "-",
};

const LATEX: Notation = Notation {
    number: to_latex,
    decimal: latex_decimal,
    courant: |power| if power == 1 { "C".into() } else { format!("C^{{{power}}}") },
    trigonometric: |function, k| {
        if k == 1 { format!("\\{function}\\varphi") } else { format!("\\{function} {k}\\varphi") }
    },
    open: "\\left(",
    close: "\\right)",
    minus: "-",
};

fn latex_decimal(value: f64) -> String {
    let text = format!("{value:e}");
    match text.split_once('e') {
        Some((mantissa, "0")) => mantissa.into(),
        Some((mantissa, exponent)) => format!("{mantissa}\\cdot 10^{{{exponent}}}"),
        None => text,
    }
}

impl EnclosedSymbol {
    /// The amplification factor as plain text, such as
    /// `g(φ) = 1 + C (-1 + cos φ - i sin φ)` for the upwind scheme.
    ///
    /// Exact coefficients are fractions, enclosed ones decimals.
    pub fn to_text(&self) -> String {
        format!("g(φ) = {}", self.write(&TEXT))
    }

    /// The amplification factor as LaTeX.
    pub fn to_latex(&self) -> String {
        format!("g(\\varphi) = {}", self.write(&LATEX))
    }

    fn write(&self, notation: &Notation) -> String {
        let mut terms = Vec::new();
        for (power, stencil) in self.center().stencils().iter().enumerate() {
            let Some((low, high)) = stencil.reach() else { continue };
            let mut parts = Vec::new();
            let mut imaginary = Vec::new();
            for k in 0..=low.abs().max(high.abs()) {
                let (right, left) = (stencil.coefficient(k), stencil.coefficient(-k));
                if k == 0 {
                    self.push(&mut parts, &right, "", notation);
                } else {
                    let name = (notation.trigonometric)("cos", k);
                    self.push(&mut parts, &(&right + &left), &name, notation);
                    let name = format!("i {}", (notation.trigonometric)("sin", k));
                    self.push(&mut imaginary, &(right - left), &name, notation);
                }
            }
            parts.extend(imaginary);
            let several = parts.len() > 1;
            let body = join(parts, notation);
            terms.push(match (power, several) {
                (0, _) => body,
                (_, false) if !body.starts_with('-') => {
                    format!("{} {body}", (notation.courant)(power))
                }
                _ => format!(
                    "{}{}{body}{}",
                    (notation.courant)(power),
                    notation.open,
                    notation.close
                ),
            });
        }
        if terms.is_empty() { "0".into() } else { join(terms, notation) }
    }

    fn push(&self, parts: &mut Vec<String>, value: &Rational, factor: &str, notation: &Notation) {
        if value.is_zero() {
            return;
        }
        let sign = if value.is_negative() { notation.minus } else { "" };
        let magnitude = value.abs();
        let number = if self.is_exact() || magnitude == integer(1) {
            (notation.number)(&magnitude)
        } else {
            (notation.decimal)(to_f64(&magnitude))
        };
        parts.push(match (factor.is_empty(), magnitude.is_one()) {
            (true, _) => format!("{sign}{number}"),
            (false, true) => format!("{sign}{factor}"),
            (false, false) => format!("{sign}{number} {factor}"),
        });
    }
}

/// Terms with their signs as operators: `a - b + c`.
fn join(terms: Vec<String>, notation: &Notation) -> String {
    let mut text = String::new();
    for (index, term) in terms.iter().enumerate() {
        match (index, term.strip_prefix(notation.minus)) {
            (0, _) => text.push_str(term),
            (_, Some(rest)) => text.push_str(&format!(" - {rest}")),
            (_, None) => text.push_str(&format!(" + {term}")),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::Symbol;
    use super::*;
    use crate::exact::rational::ratio;
    use crate::exact::stencil::Stencil;

    fn enclosed(symbol: Symbol<Rational>) -> EnclosedSymbol {
        EnclosedSymbol::exact(symbol)
    }

    #[test]
    fn upwind_reads_as_in_a_book() {
        let backward = Stencil::new(-1, vec![integer(-1), integer(1)]);
        let upwind = enclosed(Symbol::identity() - Symbol::courant_power(1, backward));
        assert_eq!(upwind.to_text(), "g(φ) = 1 + C (-1 + cos φ - i sin φ)");
        assert_eq!(
            upwind.to_latex(),
            "g(\\varphi) = 1 + C\\left(-1 + \\cos\\varphi - i \\sin\\varphi\\right)"
        );
    }

    #[test]
    fn fractions_single_terms_and_zero() {
        let central = Stencil::new(-1, vec![ratio(-1, 2), integer(0), ratio(1, 2)]);
        let euler = enclosed(Symbol::identity() - Symbol::courant_power(2, central.clone()));
        assert_eq!(euler.to_text(), "g(φ) = 1 + C^2 (-i sin φ)");
        let plus = enclosed(Symbol::courant_power(1, central));
        assert_eq!(plus.to_text(), "g(φ) = C i sin φ");
        assert_eq!(enclosed(Symbol::identity() - Symbol::identity()).to_text(), "g(φ) = 0");
        let half = enclosed(Symbol::courant_power(0, Stencil::term(2, ratio(3, 2))));
        assert_eq!(
            half.to_latex(),
            "g(\\varphi) = \\frac{3}{2} \\cos 2\\varphi + \\frac{3}{2} i \\sin 2\\varphi"
        );
    }
}
