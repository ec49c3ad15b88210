//! Numbers for people.

/// The shortest decimal up to six significant digits, with a proper minus sign, and powers of ten for very large and
/// very small numbers.
pub(super) fn format_number(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if (1e-4..1e6).contains(&rounded.abs()) || !rounded.is_finite() {
        return minus(rounded.to_string());
    }
    let text = format!("{rounded:e}");
    let (mantissa, power) = text.split_once('e').expect("the format writes an exponent");
    let power = power_of_ten(power);
    match mantissa {
        "1" => power,
        "-1" => format!("−{power}"),
        _ => minus(format!("{mantissa}×{power}")),
    }
}

/// Numbers with the same decimals, as few as tell their values; as powers of ten where they are very large or small.
pub(super) fn format_numbers(values: &[f64]) -> Vec<String> {
    let largest = values.iter().fold(0.0f64, |most, v| most.max(v.abs()));
    let told = |d: &usize| {
        let lost = |v: &f64| (format!("{v:.d$}").parse::<f64>().unwrap_or(*v) - v).abs();
        values.iter().all(|v| lost(v) <= 1e-7 * largest)
    };
    match (0..6).find(told) {
        Some(d) if (1e-3..1e5).contains(&largest) => {
            values.iter().map(|v| minus(format!("{v:.d$}"))).collect()
        }
        _ => values.iter().map(|&v| format_number(v)).collect(),
    }
}

/// Ten to a power written in digits.
pub(super) fn power_of_ten(power: &str) -> String {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| c.to_digit(10).map_or('⁻', |d| digits[d as usize]);
    std::iter::once("10".into()).chain(power.chars().map(|c| raised(c).to_string())).collect()
}

fn minus(text: String) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.into(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!(format_number(0.30000000000000004), "0.3");
        assert_eq!(format_number(-1.25), "−1.25");
        assert_eq!(format_number(1e-9), "10⁻⁹");
        assert_eq!(format_number(2.5e7), "2.5×10⁷");
        assert_eq!(format_numbers(&[-0.5, 0.1 + 0.2, 1.0]), ["−0.5", "0.3", "1.0"]);
        assert_eq!(format_numbers(&[0.0, 2e-5]), ["0", "2×10⁻⁵"]);
    }
}
