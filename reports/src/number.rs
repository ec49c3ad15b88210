//! Numbers as people and scripts read them.

use courant_analysis::exact::rational::{parse, to_text};

/// A number for JSON, which has none that is not finite.
pub fn finite(value: f64) -> Option<f64> {
    // Zero has no sign for people and scripts.
    value.is_finite().then_some(value + 0.0)
}

/// Appends a number as `Display` writes it, the shortest decimal that is this number, in a fraction of the time.
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

#[cfg(test)]
mod tests {
    use super::{exact_text, finite, push_shortest, significant};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_shortest_decimal_is_that_of_display(bits in any::<u64>(), near in -1e4f64..1e4) {
            for value in [f64::from_bits(bits), near, near.round(), 1.0 / near, 0.0, -0.0, 1e21] {
                let mut text = String::from("x");
                push_shortest(&mut text, value);
                prop_assert_eq!(text, format!("x{value}"));
            }
        }
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
}
