//! A measured step as equations in the language of schemes.

use super::fit::MeasuredStep;
use super::from_stencil::StencilTerm;
use crate::exact::rational::{Rational, to_f64, to_text};
use num_traits::{One, Signed};

/// The indices of cells in one, two and three dimensions.
const INDICES: [&[&str]; 3] = [&["j"], &["i", "j"], &["i", "j", "k"]];

impl MeasuredStep {
    /// One equation for each unknown, which the language of schemes reads: `u[n+1,j] = 1/2*u[n,j-1] + (1 - C)*u[n,j]`. Coefficients that
    /// were not recognised are decimals.
    pub fn equations(&self) -> Vec<String> {
        let step = &self.step;
        let value = |unknown: usize, level: usize, offset: &[i64]| {
            let time = shift("n", 1 + level as i64 - self.levels as i64);
            let names = INDICES[step.dimension() - 1];
            let cells: Vec<String> =
                names.iter().zip(offset).map(|(name, by)| shift(name, *by)).collect();
            format!("{}[{time},{}]", step.unknowns()[unknown], cells.join(","))
        };
        let here = vec![0; step.dimension()];
        (0..step.unknowns().len())
            .map(|row| {
                let mut right = String::new();
                for term in self.terms.iter().filter(|term| term.place.row == row) {
                    let place = &term.place;
                    let read = value(place.column, place.level, &place.offset);
                    let (negative, factor) = self.factor(term);
                    right.push_str(match (right.is_empty(), negative) {
                        (true, false) => "",
                        (true, true) => "-",
                        (false, false) => " + ",
                        (false, true) => " - ",
                    });
                    right.push_str(&format!("{factor}{read}"));
                }
                if right.is_empty() {
                    right = format!("0*{}", value(row, self.levels - 1, &here));
                }
                format!("{} = {right}", value(row, self.levels, &here))
            })
            .collect()
    }

    /// Whether a coefficient is written with a minus before it, and as what: nothing for 1.
    fn factor(&self, term: &StencilTerm) -> (bool, String) {
        let parameter = self.parameter.as_deref().unwrap_or_default();
        let powers: Vec<(usize, &Rational)> = term
            .coefficient
            .coefficients()
            .iter()
            .enumerate()
            .filter(|(_, value)| **value != Rational::default())
            .collect();
        let monomial = |power: usize, value: &Rational| {
            let number = if self.recognised {
                to_text(&value.abs())
            } else {
                to_f64(&value.abs()).to_string()
            };
            let variable = match power {
                0 => return number,
                1 => parameter.to_string(),
                _ => format!("{parameter}^{power}"),
            };
            if value.abs().is_one() { variable } else { format!("{number}*{variable}") }
        };
        match powers.as_slice() {
            [(0, value)] if value.abs().is_one() => (value.is_negative(), String::new()),
            [(power, value)] => (value.is_negative(), format!("{}*", monomial(*power, value))),
            several => {
                let mut text = String::new();
                for (power, value) in several {
                    let sign = match (text.is_empty(), value.is_negative()) {
                        (true, false) => "",
                        (true, true) => "-",
                        (false, false) => " + ",
                        (false, true) => " - ",
                    };
                    text.push_str(&format!("{sign}{}", monomial(*power, value)));
                }
                (false, format!("({text})*"))
            }
        }
    }
}

/// `j+1`.
fn shift(name: &str, by: i64) -> String {
    if by == 0 { name.into() } else { format!("{name}{by:+}") }
}
