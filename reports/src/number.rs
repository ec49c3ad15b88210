//! Numbers as people and scripts read them.

use courant_analysis::exact::rational::{parse, to_text};

/// A number for JSON, which has none that is not finite.
pub fn finite(value: f64) -> Option<f64> {
    // Zero has no sign for people and scripts.
    value.is_finite().then_some(value + 0.0)
}

/// Appends the shortest decimal that is this number, as `Display` does (of two that are equally near perhaps the other), in a fraction of the time.
pub(crate) fn push_shortest(text: &mut String, value: f64) {
    use std::fmt::Write;
    let mut buffer = zmij::Buffer::new();
    let shortest = buffer.format(value);
    // Very small, very large, or not finite: the notation differs, unless it is plain all the same.
    let bytes = shortest.as_bytes();
    let is_plain = (1e-3..1e9).contains(&value.abs())
        || bytes.iter().all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'-'));
    if is_plain {
        text.push_str(shortest.strip_suffix(".0").unwrap_or(shortest));
    } else {
        write!(text, "{value}").expect("a string takes what is written");
    }
}

/// A smoothing ratio as it is written exactly, from the shortest decimal that is this number: `1.05` is 21/20.
pub fn exact_text(value: f64) -> String {
    let decimal = value.to_string();
    parse(&decimal).map_or(decimal, |exact| to_text(&exact))
}

/// A number with a fixed count of significant digits, in scientific notation when it is very small or
/// very large.
///
/// ```
/// use courant_reports::number::significant;
/// assert_eq!(significant(1.17295910, 6), "1.17296");
/// assert_eq!(significant(1.2e-7, 3), "1.20e-7");
/// assert_eq!(significant(f64::INFINITY, 3), "∞");
/// ```
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if value.is_nan() {
        return "–".into();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞".into() } else { "-∞".into() };
    }
    let exponent = value.abs().log10().floor() as i32;
    if (-4..digits as i32 + 3).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.*e}", digits - 1)
    }
}

/// The shortest decimal up to six significant digits, with a proper minus sign, and powers of ten for very large and
/// very small numbers.
pub(crate) fn format_number(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-4..1e6).contains(&rounded.abs()) || !rounded.is_finite() {
        return minus(&rounded.to_string());
    }
    let text = format!("{rounded:e}");
    let (mantissa, power) = text.split_once('e').expect("the format writes an exponent");
    match mantissa {
        "1" => power_of_ten(power),
        "-1" => format!("−{}", power_of_ten(power)),
        _ => minus(&format!("{mantissa}×{}", power_of_ten(power))),
    }
}

/// Numbers with the same decimals, as few as tell their values; as powers of ten where they are very large or small.
pub(crate) fn format_numbers(values: &[f64]) -> Vec<String> {
    let largest = values.iter().fold(0.0f64, |most, v| most.max(v.abs()));
    let told = |d: &usize| {
        let lost = |v: &f64| (format!("{v:.d$}").parse::<f64>().unwrap_or(*v) - v).abs();
        values.iter().all(|v| lost(v) <= 1e-7 * largest)
    };
    match (0..6).find(told) {
        Some(d) if (1e-3..1e5).contains(&largest) => {
            values.iter().map(|v| minus(&format!("{v:.d$}"))).collect()
        }
        _ => values.iter().map(|&v| format_number(v)).collect(),
    }
}

/// Ten to a power written in digits.
pub(crate) fn power_of_ten(power: &str) -> String {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| c.to_digit(10).map_or('⁻', |d| digits[d as usize]);
    "10".chars().chain(power.chars().map(raised)).collect()
}

/// With a minus sign for a hyphen; zero has none.
fn minus(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.into(),
        Some(rest) => format!("−{rest}"),
        None => text.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::exact::rational::{from_f64, parse};
    use num_traits::Signed;
    use proptest::prelude::*;

    /// As `Display` writes it; or as short, as near to the number, and read as the same one: 1183081514314095.25 lies
    /// between two such decimals.
    fn is_shortest(value: f64) -> Result<(), TestCaseError> {
        let (mut text, display) = (String::from("x"), value.to_string());
        push_shortest(&mut text, value);
        let text = text.strip_prefix('x').expect("it appends");
        if text != display {
            let exact = from_f64(value).expect("only finite numbers have two decimals");
            let off = |text: &str| (parse(text).expect("a decimal") - &exact).abs();
            prop_assert_eq!((text.len(), off(text)), (display.len(), off(&display)));
            prop_assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
        }
        Ok(())
    }

    proptest! {
        #[test]
        fn the_shortest_decimal_is_that_of_display(bits in any::<u64>(), near in -1e4f64..1e4) {
            for value in [f64::from_bits(bits), near, near.round(), 1.0 / near, 0.0, -0.0, 1e21] {
                is_shortest(value)?;
            }
        }
    }

    #[test]
    fn of_two_shortest_decimals_either_will_do() {
        is_shortest(f64::from_bits(4_832_591_126_598_428_093)).expect("a tie");
        is_shortest(f64::MAX).and(is_shortest(f64::NAN)).expect("no tie");
    }

    #[test]
    fn numbers_for_scripts() {
        assert!(finite(-0.0).is_some_and(f64::is_sign_positive));
        assert_eq!(finite(f64::NAN), None);
        assert_eq!([1.05, 2.0].map(exact_text), ["21/20", "2"]);
    }

    #[test]
    fn digits_are_significant_ones() {
        assert_eq!(significant(0.0123456, 3), "0.0123");
        assert_eq!(significant(123456.0, 3), "123456");
        assert_eq!(significant(1234567.0, 3), "1.23e6");
        assert_eq!(significant(-2.5, 2), "-2.5");
        assert_eq!(significant(0.0, 4), "0");
    }

    #[test]
    fn numbers_for_people() {
        let numbers = [0.0, 0.30000000000000004, -1.25, 1e-9, 2.5e7].map(format_number);
        assert_eq!(numbers, ["0", "0.3", "−1.25", "10⁻⁹", "2.5×10⁷"]);
        assert_eq!(format_numbers(&[-0.5, 0.1 + 0.2, 1.0]), ["−0.5", "0.3", "1.0"]);
        assert_eq!(format_numbers(&[0.0, 2e-5]), ["0", "2×10⁻⁵"]);
    }
}
