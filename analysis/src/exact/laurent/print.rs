//! As text, with `z`, `E` and numbered names; whoever knows the names prints them instead.

use super::{Exponents, Laurent, VARIABLES};
use num_bigint::BigInt;
use num_traits::{One, Signed};

impl Laurent {
    /// As text with these names for the variables, by place among the exponents.
    pub fn to_text(&self, names: &dyn Fn(usize) -> String) -> String {
        let mut text = String::new();
        for (exponents, value) in self.terms() {
            let sign = match (text.is_empty(), value.is_negative()) {
                (true, false) => "",
                (true, true) => "-",
                (false, false) => " + ",
                (false, true) => " - ",
            };
            text.push_str(sign);
            text.push_str(&term(exponents, &value.abs(), names));
        }
        if text.is_empty() { "0".into() } else { text }
    }
}

/// A polynomial as it is printed, in LaTeX: exponents in braces, Greek letters by their commands.
pub fn latex(text: &str) -> String {
    let word = |word: &str| {
        if word.starts_with('\\') {
            return word.into();
        }
        let (base, exponent) = word.split_once('^').unwrap_or((word, ""));
        let base = match base {
            "alpha" | "beta" | "gamma" | "delta" | "epsilon" | "eta" | "theta" | "kappa"
            | "lambda" | "mu" | "nu" | "omega" | "pi" | "rho" | "sigma" | "tau" => {
                format!("\\{base}")
            }
            _ if base.len() > 1 && base.chars().all(|c| c.is_ascii_alphabetic()) => {
                format!("\\mathrm{{{base}}}")
            }
            _ => base.into(),
        };
        if exponent.is_empty() { base } else { format!("{base}^{{{exponent}}}") }
    };
    text.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

fn term(exponents: &Exponents, size: &BigInt, names: &dyn Fn(usize) -> String) -> String {
    let mut factors: Vec<String> = Vec::new();
    if !size.is_one() || exponents.iter().all(|&power| power == 0) {
        factors.push(size.to_string());
    }
    for (place, &power) in exponents.iter().enumerate().filter(|(_, power)| **power != 0) {
        let name = names(place);
        factors.push(if power == 1 { name } else { format!("{name}^{power}") });
    }
    factors.join(" ")
}

impl std::fmt::Display for Laurent {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names: [&str; VARIABLES] = [
            "z", "E", "E2", "E3", "p0", "p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8", "p9",
            "p10", "p11",
        ];
        formatter.pad(&self.to_text(&|place| names[place].to_string()))
    }
}
