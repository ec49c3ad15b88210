//! Headings and cells for machines: ASCII names, plain decimals.

/// A heading for machines: `l/Δξ` and `h/Δ` are the `ratio` everywhere, `|g|` and `|z|` the `gain`, `C` the `cfl`.
pub(super) fn machine_name(heading: &str) -> String {
    if heading == "C" {
        return "cfl".into();
    }
    let known = [
        ("l/Δξ", "ratio"),
        ("h/Δ", "ratio"),
        ("|g|", "gain"),
        ("|z|", "gain"),
        ("arg g", "phase"),
        ("arg z", "phase"),
        ("α", "alpha"),
        ("β", "beta"),
        ("γ", "gamma"),
        ("κΔ", "kappa"),
        ("Δ", "delta_"),
        ("η", "eta"),
        ("κ", "kappa"),
        ("λ", "lambda"),
        ("ξ", "xi"),
        ("π", "pi"),
        ("ρ", "rho"),
        ("σ", "sigma"),
        ("φ", "phase"),
        ("ω", "omega"),
        ("∞", "inf"),
        ("−", " minus "),
        ("%", " percent"),
    ];
    let text =
        known.iter().fold(heading.to_string(), |text, (sign, name)| text.replace(sign, name));
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { ' ' };
    let words: String = text.chars().map(plain).collect();
    words.split_whitespace().collect::<Vec<_>>().join("_")
}

/// A cell for machines.
pub(super) fn machine_cell(cell: &str) -> String {
    let number = cell.replace('−', "-").replace('∞', "inf");
    match number.parse::<f64>() {
        _ if cell == "–" => String::new(),
        Ok(value) if value.is_nan() => String::new(),
        Ok(_) => without_exponent(&number).unwrap_or(number),
        Err(_) => cell.into(),
    }
}

/// A decimal with its exponent written out, all digits as they are.
pub(super) fn without_exponent(number: &str) -> Option<String> {
    let (mantissa, exponent) = number.split_once(['e', 'E'])?;
    let exponent: i32 = exponent.parse().ok()?;
    let (sign, digits) = match mantissa.strip_prefix('-') {
        Some(digits) => ("-", digits),
        None => ("", mantissa),
    };
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let (before, after) = (whole.len() as i32 + exponent, part.len() as i32 - exponent);
    let zeros = |count: i32| "0".repeat(count.max(0) as usize);
    let all = format!("{}{whole}{part}{}", zeros(1 - before), zeros(-after));
    let (whole, part) = all.split_at(before.max(1) as usize);
    let point = if part.is_empty() { "" } else { "." };
    Some(format!("{sign}{whole}{point}{part}"))
}
