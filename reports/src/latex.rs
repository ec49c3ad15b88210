//! Text for LaTeX: every character that it reserves or that its fonts may lack becomes a command.

/// ASCII that LaTeX sets as the text.
///
/// ```
/// use courant_reports::latex::latex_text;
/// assert_eq!(latex_text("50 % of ρ₀"), r"50 \% of $\rho$$_{0}$");
/// assert_eq!(latex_text("α̃ ≤ 10⁻³"), r"$\tilde{\alpha}$ $\le$ 10$^{-3}$");
/// ```
pub fn latex_text(text: &str) -> String {
    let mut set = String::new();
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        if let Some(accent) = characters.peek().copied().and_then(accent) {
            characters.next();
            let plain = character.to_string();
            set.push_str(&format!("${accent}{{{}}}$", command(character).unwrap_or(&plain)));
        } else if let Some((level, first)) = script(character) {
            let mut digits = String::from(first);
            // One exponent, not one for each of its digits.
            while let Some((_, next)) =
                characters.peek().copied().and_then(script).filter(|next| next.0 == level)
            {
                digits.push(next);
                characters.next();
            }
            set.push_str(&format!("${level}{{{digits}}}$"));
        } else if let Some(command) = command(character) {
            set.push_str(&format!("${command}$"));
        } else if let Some(words) = words(character) {
            set.push_str(words);
        } else if character.is_ascii() {
            set.push(character);
        } else {
            // No command is known, but the file must stay readable by every LaTeX.
            set.push_str(&format!("[U+{:04X}]", u32::from(character)));
        }
    }
    set
}

/// What stands in mathematics.
fn command(character: char) -> Option<&'static str> {
    Some(match character {
        '<' => "<",
        '>' => ">",
        '|' => "|",
        'Δ' => "\\Delta",
        'Σ' => "\\Sigma",
        'α' => "\\alpha",
        'β' => "\\beta",
        'γ' => "\\gamma",
        'ε' => "\\varepsilon",
        'κ' => "\\kappa",
        'λ' => "\\lambda",
        'ν' => "\\nu",
        'ξ' => "\\xi",
        'π' => "\\pi",
        'ρ' => "\\rho",
        'σ' => "\\sigma",
        'φ' => "\\varphi",
        'ω' => "\\omega",
        'Ẋ' => "\\dot{X}",
        '≤' => "\\le",
        '≥' => "\\ge",
        '×' => "\\times",
        '·' => "\\cdot",
        '±' => "\\pm",
        '∓' => "\\mp",
        '−' => "-",
        '∞' => "\\infty",
        '√' => "\\surd",
        '∫' => "\\int",
        '∂' => "\\partial",
        '∇' => "\\nabla",
        '∈' => "\\in",
        '→' => "\\to",
        '′' => "'",
        _ => return None,
    })
}

/// What stands in running text.
fn words(character: char) -> Option<&'static str> {
    Some(match character {
        '%' => "\\%",
        '&' => "\\&",
        '#' => "\\#",
        '_' => "\\_",
        '$' => "\\$",
        '{' => "\\{",
        '}' => "\\}",
        '\\' => "\\textbackslash{}",
        '^' => "\\textasciicircum{}",
        '~' => "\\textasciitilde{}",
        '–' => "--",
        '—' => "---",
        '…' => "\\ldots{}",
        'ö' => "\\\"o",
        'ó' => "\\'o",
        'ø' => "\\o{}",
        _ => return None,
    })
}

/// A raised or lowered character: `^` or `_`, and what is raised or lowered.
fn script(character: char) -> Option<(char, char)> {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    const LOWERED: &str = "₀₁₂₃₄₅₆₇₈₉";
    let place = |row: &str| row.chars().position(|known| known == character);
    let sign = |place: usize| char::from(b"0123456789-"[place]);
    match (place(RAISED), place(LOWERED), character) {
        (Some(place), _, _) => Some(('^', sign(place))),
        (_, Some(place), _) => Some(('_', sign(place))),
        (_, _, 'ₓ') => Some(('_', 'x')),
        _ => None,
    }
}

/// The command of an accent that stands over the character before it.
fn accent(character: char) -> Option<&'static str> {
    Some(match character {
        '\u{303}' => "\\tilde",
        '\u{304}' => "\\bar",
        '\u{307}' => "\\dot",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::latex_text;
    use proptest::prelude::*;

    #[test]
    fn names_and_quantities_of_the_papers() {
        for (text, wanted) in [
            ("Σ|e|/N of ρ̄", r"$\Sigma$$|$e$|$/N of $\bar{\rho}$"),
            ("Sjögreen, v < −2", "Sj\\\"ogreen, v $<$ $-$2"),
            ("λ₂ = 0.2 max|v|", r"$\lambda$$_{2}$ = 0.2 max$|$v$|$"),
            ("a_b^c~d\\", r"a\_b\textasciicircum{}c\textasciitilde{}d\textbackslash{}"),
            ("1, 2, …", r"1, 2, \ldots{}"),
            ("日", "[U+65E5]"),
        ] {
            assert_eq!(latex_text(text), wanted);
        }
    }

    proptest! {
        #[test]
        fn nothing_but_ascii_is_left(text in any::<String>()) {
            prop_assert!(latex_text(&text).is_ascii());
        }
    }
}
