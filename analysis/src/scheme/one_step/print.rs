//! Amplification factors as people read them: plain text and LaTeX, in cosines and sines of the phase.

use super::OneStep;
use crate::exact::rational::{Rational, integer, to_f64, to_latex, to_text};
use num_traits::{One, Signed, Zero};

/// How one notation writes the parts of `g(φ)`.
struct Notation {
    number: fn(&Rational) -> String,
    decimal: fn(f64) -> String,
    power: fn(&str, usize) -> String,
    trigonometric: fn(&str, i64) -> String,
    open: &'static str,
    close: &'static str,
    minus: &'static str,
}

const TEXT: Notation = Notation {
    number: to_text,
    decimal: |value| format!("{value}"),
    power: |name, power| if power == 1 { name.into() } else { format!("{name}^{power}") },
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
    power: |name, power| if power == 1 { name.into() } else { format!("{name}^{{{power}}}") },
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

impl OneStep {
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
        let degrees = self.coefficients.iter().filter_map(|(_, center, _)| center.degree());
        let reach = self.coefficients.iter().map(|(offset, _, _)| offset.abs()).max().unwrap_or(0);
        let mut terms = Vec::new();
        for power in 0..=degrees.max().unwrap_or(0) {
            let (mut parts, mut imaginary) = (Vec::new(), Vec::new());
            for k in 0..=reach {
                let right = self.coefficient(k).coefficient(power);
                if k == 0 {
                    self.push(&mut parts, &right, "", notation);
                } else {
                    let left = self.coefficient(-k).coefficient(power);
                    let name = (notation.trigonometric)("cos", k);
                    self.push(&mut parts, &(&right + &left), &name, notation);
                    let name = format!("i {}", (notation.trigonometric)("sin", k));
                    self.push(&mut imaginary, &(right - left), &name, notation);
                }
            }
            parts.extend(imaginary);
            if parts.is_empty() {
                continue;
            }
            let several = parts.len() > 1;
            let body = join(parts, notation);
            let factor = || (notation.power)(&self.parameter, power);
            terms.push(match (power, several) {
                (0, _) => body,
                (_, false) if body == "1" => factor(),
                (_, false) if !body.starts_with('-') => format!("{} {body}", factor()),
                _ => format!("{}{}{body}{}", factor(), notation.open, notation.close),
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
    use crate::scheme::Step;

    fn printed(text: &str) -> (String, String) {
        let one_step = Step::from_text(text).unwrap().one_step("C").unwrap();
        (one_step.to_text(), one_step.to_latex())
    }

    #[test]
    fn schemes_read_as_in_a_book() {
        let (text, latex) = printed("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])");
        assert_eq!(text, "g(φ) = 1 + C (-1 + cos φ - i sin φ)");
        let expected = "g(\\varphi) = 1 + C\\left(-1 + \\cos\\varphi - i \\sin\\varphi\\right)";
        assert_eq!(latex, expected);
        let (text, _) = printed("u[n+1,j] = u[n,j] - C^2/2*(u[n,j+1] - u[n,j-1])");
        assert_eq!(text, "g(φ) = 1 + C^2 (-i sin φ)");
        let (text, _) = printed("u[n+1,j] = C*(u[n,j+1] - u[n,j-1])/2");
        assert_eq!(text, "g(φ) = C i sin φ");
        let (_, latex) = printed("u[n+1,j] = 3/2*u[n,j+2] + C^3*u[n,j]");
        let expected =
            "g(\\varphi) = \\frac{3}{2} \\cos 2\\varphi + \\frac{3}{2} i \\sin 2\\varphi + C^{3}";
        assert_eq!(latex, expected);
    }
}
