//! Which numbers stand at an axis.

/// A tick: where it is and what it says; minor ticks say nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Value on the axis.
    pub value: f64,
    /// Its label; empty for a minor tick.
    pub label: String,
}

/// Ticks at round numbers in `low..=high`: multiples of 1, 2, 2.5 or 5 times a power of ten, the finest such step that
/// gives no more than `most` labels, with unlabelled ticks between.
///
/// ```
/// use courant_reports::figure::linear_ticks;
/// let labels: Vec<String> =
///     linear_ticks(0.0, 1.0, 6).into_iter().map(|t| t.label).filter(|l| !l.is_empty()).collect();
/// assert_eq!(labels, ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
/// ```
pub fn linear_ticks(low: f64, high: f64, most: usize) -> Vec<Tick> {
    let span = high - low;
    // One step more than intervals would be: the range need not begin on a tick.
    let rough = span / most.max(2) as f64;
    let power = rough.log10().floor() as i32;
    let (digit, power) = [
        (1.0, power),
        (2.0, power),
        (2.5, power),
        (5.0, power),
        (1.0, power + 1),
        (2.0, power + 1),
    ]
    .into_iter()
    .find(|&(digit, power)| multiples(low, high, digit, power).count() <= most.max(2))
    .unwrap_or((5.0, power + 1));
    let (parts, part_digit, part_power) = match digit {
        1.0 => (5, 2.0, power - 1),
        2.0 => (4, 5.0, power - 1),
        2.5 => (5, 5.0, power - 1),
        _ => (5, 1.0, power),
    };
    let decimals = usize::try_from(if digit == 2.5 { 1 - power } else { -power }).unwrap_or(0);
    let scientific = low.abs().max(high.abs()) >= 1e5 || low.abs().max(high.abs()) < 1e-3;
    multiples(low, high, part_digit, part_power)
        .map(|(n, value)| {
            let label = if n % parts != 0 {
                String::new()
            } else if scientific {
                format_scientific(value, if digit == 2.5 { power - 1 } else { power })
            } else {
                minus(format!("{value:.decimals$}"))
            };
            Tick { value, label }
        })
        .collect()
}

/// The multiples `n` of `digit * 10^power` within the range, give or take round-off at its ends.
fn multiples(low: f64, high: f64, digit: f64, power: i32) -> impl Iterator<Item = (i64, f64)> {
    // Dividing by a whole power of ten gives 0.3 and not 3 * 0.1.
    let value = move |n: i64| {
        let v = n as f64 * digit;
        if power < 0 { v / 10f64.powi(-power) } else { v * 10f64.powi(power) }
    };
    let step = digit * 10f64.powi(power);
    let slack = 1e-9;
    let first = (low / step - slack).ceil() as i64;
    let last = (high / step + slack).floor() as i64;
    (first..=last).map(move |n| (n, value(n)))
}

/// The longest part of a short logarithmic axis that may lie beyond its outermost label.
const UNLABELLED: f64 = 0.3;

/// Ticks of a logarithmic axis: labelled powers of ten and unlabelled 2…9 between; on short ranges the numbers between
/// are labelled too, and where even those are too few or leave an end bare the ticks are those of a linear axis.
pub fn log_ticks(low: f64, high: f64, most: usize) -> Vec<Tick> {
    let most = most.max(2);
    let (first, last) = ((low.log10() + 1e-9).floor() as i32, (high.log10() + 1e-9).floor() as i32);
    let inside = |v: f64| v >= low * (1.0 - 1e-9) && v <= high * (1.0 + 1e-9);
    let all: Vec<(i32, i32, f64)> = (first..=last)
        .flat_map(|p| (1..10).map(move |d| (d, p, power_of_ten(d, p))))
        .filter(|&(_, _, v)| inside(v))
        .collect();
    let decades = all.iter().filter(|t| t.0 == 1).count();
    if decades >= 3 || decades > most / 2 {
        let stride = (1..).find(|s| decades.div_ceil(*s) <= most).unwrap_or(1) as i32;
        return all
            .into_iter()
            .filter(|&(d, _, _)| d == 1 || stride == 1)
            .map(|(d, p, value)| {
                let labelled = d == 1 && p.rem_euclid(stride) == 0;
                let label = if labelled { format!("10{}", superscript(p)) } else { String::new() };
                Tick { value, label }
            })
            .collect();
    }
    let subsets: [&[i32]; 4] = [&[1, 2, 3, 4, 5, 6, 7, 8, 9], &[1, 2, 3, 5], &[1, 2, 5], &[1, 3]];
    let labelled = subsets.into_iter().find(|subset| {
        let values: Vec<f64> =
            all.iter().filter(|t| subset.contains(&t.0)).map(|&(_, _, value)| value).collect();
        // An end of the axis without a number near leaves the reader to guess what stands there.
        let bare = |from: f64, to: f64| (to / from).ln() > UNLABELLED * (high / low).ln();
        (2..=most).contains(&values.len())
            && !bare(low, values[0])
            && !bare(values[values.len() - 1], high)
    });
    match labelled {
        Some(subset) => all
            .into_iter()
            .map(|(d, p, value)| {
                let label = if !subset.contains(&d) {
                    String::new()
                } else if (-3..4).contains(&first) && last < 4 {
                    format_number(value)
                } else if d == 1 {
                    format!("10{}", superscript(p))
                } else {
                    format!("{d}×10{}", superscript(p))
                };
                Tick { value, label }
            })
            .collect(),
        None => linear_ticks(low, high, most),
    }
}

fn power_of_ten(digit: i32, power: i32) -> f64 {
    let d = f64::from(digit);
    if power < 0 { d / 10f64.powi(-power) } else { d * 10f64.powi(power) }
}

/// A number for people: shortest decimal up to six significant digits, with a proper minus sign and powers of ten for
/// very large and very small ones.
pub fn format_number(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if (1e-4..1e6).contains(&rounded.abs()) || !rounded.is_finite() {
        return minus(format!("{rounded}"));
    }
    format_scientific(rounded, rounded.abs().log10().floor() as i32 - 5)
}

/// `value` as a mantissa times a power of ten, its last decimal at ten to the `last` or the last one that is not zero.
fn format_scientific(value: f64, last: i32) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let power = value.abs().log10().floor() as i32;
    let digits = usize::try_from(power - last).unwrap_or(0);
    let text = format!("{value:.digits$e}");
    let (mantissa, power) = text.split_once('e').expect("the format writes an exponent");
    let mantissa = match mantissa.contains('.') {
        true => mantissa.trim_end_matches('0').trim_end_matches('.'),
        false => mantissa,
    };
    let power = superscript(power.parse().expect("the exponent is a whole number"));
    match mantissa {
        "1" => format!("10{power}"),
        "-1" => format!("−10{power}"),
        _ => minus(format!("{mantissa}×10{power}")),
    }
}

fn minus(text: String) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.into(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}

fn superscript(power: i32) -> String {
    power
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '0' => '⁰',
            '4' => '⁴',
            '5' => '⁵',
            '6' => '⁶',
            '7' => '⁷',
            '8' => '⁸',
            _ => '⁹',
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|t| t.label.as_str()).filter(|l| !l.is_empty()).collect()
    }

    #[test]
    fn linear_labels() {
        assert_eq!(labels(&linear_ticks(0.0, 1.0, 6)), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(&linear_ticks(-1.0, 1.0, 5)), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(labels(&linear_ticks(0.0, 100.0, 4)), ["0", "50", "100"]);
        assert_eq!(labels(&linear_ticks(0.0, 3e-5, 4)), ["0", "10⁻⁵", "2×10⁻⁵", "3×10⁻⁵"]);
        assert_eq!(
            labels(&linear_ticks(0.0, 0.1, 5)),
            ["0.000", "0.025", "0.050", "0.075", "0.100"]
        );
        assert_eq!(linear_ticks(0.0, 1.0, 6)[6].value, 0.3);
    }

    #[test]
    fn log_labels() {
        let ticks = log_ticks(1e-3, 1.0, 6);
        assert_eq!(labels(&ticks), ["10⁻³", "10⁻²", "10⁻¹", "10⁰"]);
        assert_eq!(ticks.len(), 28);
        assert_eq!(labels(&log_ticks(1e-12, 1.0, 5)), ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]);
        assert_eq!(labels(&log_ticks(0.1, 1.0, 6)), ["0.1", "0.2", "0.3", "0.5", "1"]);
        assert_eq!(
            labels(&log_ticks(2e-7, 6e-7, 5)),
            ["2×10⁻⁷", "3×10⁻⁷", "4×10⁻⁷", "5×10⁻⁷", "6×10⁻⁷"]
        );
        assert_eq!(labels(&log_ticks(1.1, 1.4, 4)), ["1.1", "1.2", "1.3", "1.4"]);
        // 0.5 to 1 alone would leave the upper third bare.
        assert_eq!(labels(&log_ticks(0.48, 1.55, 7)), ["0.6", "0.8", "1.0", "1.2", "1.4"]);
    }

    #[test]
    fn numbers_for_people() {
        assert_eq!(format_number(0.30000000000000004), "0.3");
        assert_eq!(format_number(-1.25), "−1.25");
        assert_eq!(format_number(1e-9), "10⁻⁹");
        assert_eq!(format_number(2.5e7), "2.5×10⁷");
    }

    proptest! {
        #[test]
        fn linear_ticks_are_few_distinct_and_inside(low in -1e4f64..1e4, exponent in -4f64..4.0, most in 3usize..9) {
            let span = 10f64.powf(exponent);
            let ticks = linear_ticks(low, low + span, most);
            let named = labels(&ticks);
            // Fewer labels than half the most (less one) would mean that a finer step fits: steps grow by at most 2.5.
            prop_assert!(named.len() <= most && named.len() + 2 > most / 3, "{:?}", named);
            prop_assert!(named.windows(2).all(|w| w[0] != w[1]), "{:?}", named);
            for t in &ticks {
                prop_assert!(t.value >= low - 1e-6 * span && t.value <= low + span * (1.0 + 1e-6));
            }
        }

        #[test]
        fn log_ticks_are_few_distinct_and_inside(low in -12f64..8.0, decades in 0.05f64..14.0, most in 3usize..9) {
            let (a, b) = (10f64.powf(low), 10f64.powf(low + decades));
            let ticks = log_ticks(a, b, most);
            let named = labels(&ticks);
            prop_assert!(named.len() <= most, "{:?}", named);
            prop_assert!(!named.is_empty(), "{:?}", ticks);
            prop_assert!(named.windows(2).all(|w| w[0] != w[1]), "{:?}", named);
            prop_assert!(ticks.windows(2).all(|w| w[0].value < w[1].value));
            prop_assert!(ticks.iter().all(|t| t.value >= a * 0.999 && t.value <= b * 1.001));
        }
    }
}
