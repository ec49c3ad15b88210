//! Numbers, lists and ranges, read exactly: `1,2,3`, `1:10:0.5` (inclusive), `3/2`.

use courant::analysis::exact::rational::{Rational, from_f64, integer, parse, ratio, to_f64};
use courant::analysis::kernel::lattice::{MAX_INVERSE_RATIO, MAX_RATIO, RatioOutOfRange};
use courant::analysis::scheme::catalogue::approximate;
use courant::reports::subject::brief;
use num_traits::{Signed, ToPrimitive, Zero};
use std::collections::HashSet;
use std::num::FpCategory;

/// The largest Courant number that is judged.
const MAX_COURANT: i64 = 1_000_000;

/// The largest coefficient of viscosity that is looked at.
const MAX_ALPHA: i64 = 1_000_000;

/// Values in one list or range at most.
const MAX_VALUES: i64 = 100_000;

/// A list of items, separated by commas; a type of its own because the argument library treats `Vec` as repetition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Names<T>(pub Vec<T>);

/// A list of exact numbers.
pub type Numbers = Names<Rational>;

/// Splits at commas and reads every name; what is named twice counts once.
pub fn names<T: PartialEq>(
    text: &str,
    read: impl Fn(&str) -> Result<T, String>,
) -> Result<Names<T>, String> {
    if text.trim().is_empty() {
        return Err("the list is empty; give at least one name".into());
    }
    let mut items = Vec::new();
    for name in text.split(',').map(str::trim) {
        let item = read(name).map_err(|problem| {
            if text.contains(',') { format!("`{name}`: {problem}") } else { problem }
        })?;
        if !items.contains(&item) {
            items.push(item);
        }
    }
    Ok(Names(items))
}

/// A list or range of numbers; what is named twice counts once.
pub fn list(text: &str) -> Result<Numbers, String> {
    list_read(text, number, &integer(0))
}

/// The same of angles in radians, where `pi/8`, `3pi/4` or `0.5*pi` stand for their nearest floating-point number.
pub fn angles(text: &str) -> Result<Numbers, String> {
    let angle = |one: &str| {
        // A factor before π needs no sign.
        let factor = one.find("pi").filter(|&pi| one[..pi].ends_with(|c: char| c.is_ascii_digit()));
        let product = factor.map(|pi| format!("{}*{}", &one[..pi], &one[pi..]));
        let multiple = approximate(product.as_deref().unwrap_or(one).trim()).and_then(from_f64);
        number(one).or_else(|problem| {
            multiple.ok_or(format!("{problem}, or a multiple of pi such as 3pi/4"))
        })
    };
    // The last of a range of multiples of π may lie a rounding beyond its end.
    list_read(text, angle, &ratio(1, 1_000_000_000))
}

fn list_read(
    text: &str,
    number: impl Fn(&str) -> Result<Rational, String>,
    slack: &Rational,
) -> Result<Numbers, String> {
    if text.trim().is_empty() {
        return Err(
            "the list is empty; give numbers such as 1,2,3 or a range such as 1:10:0.5".into()
        );
    }
    let mut values = Vec::new();
    for part in text.split(',') {
        let fields: Vec<&str> = part.split(':').collect();
        match fields.as_slice() {
            [value] => values.push(number(value)?),
            [from, to, step] => {
                range([number(from)?, number(to)?, number(step)?], slack, &mut values)?;
            }
            _ => {
                return Err(format!(
                    "`{part}` is no range; write from:to:step, for example 1:10:0.5"
                ));
            }
        }
        if values.len() as i64 > MAX_VALUES {
            return Err(format!("more than {MAX_VALUES} values"));
        }
    }
    let mut seen = HashSet::new();
    values.retain(|value| seen.insert(value.clone()));
    Ok(Names(values))
}

/// Values in equal steps; one that lies beyond the end by no more than `slack` of a step is the end.
fn range(
    [from, to, step]: [Rational; 3],
    slack: &Rational,
    values: &mut Vec<Rational>,
) -> Result<(), String> {
    if !step.is_positive() {
        return Err(format!("the step of a range must be above 0, not {}", brief(&step)));
    }
    if from > to {
        return Err(format!("the range from {} to {} is empty", brief(&from), brief(&to)));
    }
    let last = ((&to - &from) / &step + slack).floor().to_integer();
    match last.to_i64().filter(|last| *last < MAX_VALUES) {
        Some(last) => {
            let value = |index| (&from + &step * integer(index)).min(to.clone());
            values.extend((0..=last).map(value));
            Ok(())
        }
        None => Err(format!("the range has more than {MAX_VALUES} values; take a larger step")),
    }
}

/// One exact number.
pub fn number(text: &str) -> Result<Rational, String> {
    parse(text).map_err(|error| error.to_string())
}

/// A positive number.
pub fn positive(text: &str) -> Result<Rational, String> {
    number(text).and_then(is_positive)
}

fn is_positive(value: Rational) -> Result<Rational, String> {
    if value.is_positive() { Ok(value) } else { Err("it must be above 0".into()) }
}

/// A Courant number that somebody may mean.
pub fn courant_number(text: &str) -> Result<Rational, String> {
    number(text).and_then(in_courant_range)
}

/// A number that stays what it is, within rounding, in floating point: neither too large nor too near to 0.
pub fn floating(value: Rational) -> Result<Rational, String> {
    match to_f64(&value).classify() {
        FpCategory::Normal => Ok(value),
        FpCategory::Zero if value.is_zero() => Ok(value),
        FpCategory::Infinite => Err("it must be below 1.8e308".into()),
        _ => Err("it must be 0 or at least 2.3e-308 in magnitude".into()),
    }
}

/// A list or range, each number of which `accept` takes.
pub fn list_of(
    text: &str,
    accept: impl Fn(Rational) -> Result<Rational, String>,
) -> Result<Numbers, String> {
    let values = list(text)?.0;
    let several = values.len() > 1;
    let one = |value: Rational| {
        let name = brief(&value);
        accept(value).map_err(|why| {
            if several && !why.starts_with(&name) { format!("`{name}`: {why}") } else { why }
        })
    };
    values.into_iter().map(one).collect::<Result<_, _>>().map(Names)
}

/// Courant numbers of runs, which have floating-point numbers.
pub fn running_courant_numbers(text: &str) -> Result<Numbers, String> {
    list_of(text, |value| in_courant_range(value).and_then(floating))
}

/// Positive numbers of runs.
pub fn running_positive(text: &str) -> Result<Numbers, String> {
    list_of(text, |value| is_positive(value).and_then(floating))
}

/// Numbers of runs that are not negative.
pub fn running_non_negative(text: &str) -> Result<Numbers, String> {
    list_of(text, |value| is_not_negative(value).and_then(floating))
}

/// A Courant number that was read.
pub fn in_courant_range(value: Rational) -> Result<Rational, String> {
    if !value.is_positive() {
        Err("it must be above 0".into())
    } else if value > integer(MAX_COURANT) {
        Err(format!("it must be at most {MAX_COURANT}"))
    } else {
        Ok(value)
    }
}

/// Courant numbers.
pub fn courant_numbers(text: &str) -> Result<Numbers, String> {
    list_of(text, in_courant_range)
}

/// Courant numbers, of which 0 is one.
pub fn courant_numbers_from_zero(text: &str) -> Result<Numbers, String> {
    list_of(text, from_zero)
}

/// The same for a number that was read.
pub fn from_zero(value: Rational) -> Result<Rational, String> {
    within(value, 0, MAX_COURANT)
}

/// A number within bounds.
pub fn within(value: Rational, least: i64, most: i64) -> Result<Rational, String> {
    if value < integer(least) || value > integer(most) {
        return Err(format!("{} is out of range: from {least} to {most}", brief(&value)));
    }
    Ok(value)
}

/// A number that is not negative.
pub fn non_negative(text: &str) -> Result<Rational, String> {
    number(text).and_then(is_not_negative)
}

fn is_not_negative(value: Rational) -> Result<Rational, String> {
    if value.is_negative() { Err("it must not be negative".into()) } else { Ok(value) }
}

/// Numbers that are not negative.
pub fn non_negative_list(text: &str) -> Result<Numbers, String> {
    let numbers = list(text)?;
    match numbers.0.iter().find(|value| value.is_negative() || **value > integer(MAX_COURANT)) {
        Some(value) => Err(format!("{} is out of range: from 0 to {MAX_COURANT}", brief(value))),
        None => Ok(numbers),
    }
}

fn ratio_in_range(value: Rational) -> Result<Rational, String> {
    if RatioOutOfRange::check(&value).is_ok() {
        Ok(value)
    } else {
        Err(format!(
            "{} is out of range: at least 1/{MAX_INVERSE_RATIO} and at most {MAX_RATIO}",
            brief(&value)
        ))
    }
}

/// Smoothing ratios.
pub fn ratio_list(text: &str) -> Result<Numbers, String> {
    list_of(text, ratio_in_range)
}

/// Coefficients of viscosity.
pub fn alphas(text: &str) -> Result<Numbers, String> {
    list_of(text, |value| within(value, 0, MAX_ALPHA))
}

/// An axis of a map: at least two ascending values.
pub fn axis(values: &Numbers) -> Result<(), String> {
    if values.0.len() < 2 {
        return Err("a map needs at least two values; write a range such as 1:10:0.05".into());
    }
    match values.0.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some(pair) => Err(format!(
            "values must ascend, but {} is followed by {}",
            brief(&pair[0]),
            brief(&pair[1])
        )),
        None => Ok(()),
    }
}

/// A number of threads.
pub fn threads(text: &str) -> Result<usize, String> {
    count(text, 1, 1024)
}

/// Numbers of particles.
pub fn particles(text: &str) -> Result<Names<usize>, String> {
    counts(text, 4, 10_000_000)
}

/// A number of phases.
pub fn phases(text: &str) -> Result<usize, String> {
    count(text, 2, 10_000_000)
}

/// Boxes of a search.
pub fn budget(text: &str) -> Result<usize, String> {
    count(text, 1, usize::MAX)
}

/// A number of significant digits.
pub fn digits(text: &str) -> Result<usize, String> {
    count(text, 1, 300)
}

/// A seed of random numbers.
pub fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("a whole number from 0 to {} is accepted", u64::MAX))
}

/// Whole numbers within bounds.
pub fn counts(text: &str, least: usize, most: usize) -> Result<Names<usize>, String> {
    let checked = list_of(text, |value| count(&value.to_string(), least, most).map(|_| value))?;
    Ok(Names(checked.0.iter().filter_map(|value| value.to_integer().to_usize()).collect()))
}

/// A whole number within bounds.
pub fn count(text: &str, least: usize, most: usize) -> Result<usize, String> {
    text.parse()
        .ok()
        .filter(|count| (least..=most).contains(count))
        .ok_or_else(|| format!("a whole number from {least} to {most} is accepted"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant::analysis::exact::rational::ratio as fraction;

    #[test]
    fn lists_and_ranges_are_exact_and_inclusive() {
        assert_eq!(list("1,3/2,0.1").unwrap().0, [integer(1), fraction(3, 2), fraction(1, 10)]);
        let range = list("0.1:3.1:0.1").unwrap().0;
        assert_eq!((range.len(), range.last()), (31, Some(&fraction(31, 10))));
        assert_eq!(list("1:2:0.3").unwrap().0.len(), 4);
        assert_eq!(list("1,2:4:1").unwrap().0.len(), 4);
        assert_eq!(list("2,1,4/2,1:2:1").unwrap().0, [integer(2), integer(1)]);
        let eighths = angles("pi/8:pi:pi/8").unwrap().0;
        assert_eq!((eighths.len(), to_f64(&eighths[3])), (8, std::f64::consts::FRAC_PI_2));
        assert_eq!(
            (angles("0:pi:pi/10").unwrap().0.len(), angles("1,3/2").unwrap().0.len()),
            (11, 2)
        );
        assert_eq!(angles("3pi/4").unwrap().0, angles("0.75*pi").unwrap().0);
        assert!(angles("1,px/2").unwrap_err().contains("px") && angles("3ppi").is_err());
        let read = |name: &str| Ok(name.len());
        assert_eq!(names("a,bb,c", read).unwrap().0, [1, 2]);
    }

    #[test]
    fn bad_lists_say_what_is_wrong() {
        for (text, word) in [
            ("", "empty"),
            ("1:0:1", "empty"),
            ("0:1:0", "step"),
            ("0:1:-1", "step"),
            ("0:1e9:1", "more than"),
            ("1:2", "range"),
            ("NaN", "NaN"),
            ("1,,2", "not a number"),
        ] {
            let error = list(text).unwrap_err();
            assert!(error.contains(word), "{text}: {error}");
        }
        assert!(ratio_list("0").unwrap_err().contains("out of range"));
        assert!(ratio_list("1,51").unwrap_err().contains("51"));
        let huge = ratio_list("1e400").unwrap_err();
        assert!(huge.len() < 100 && huge.contains("1000"), "{huge}");
        assert!(axis(&list("2,1").unwrap()).is_err());
    }
}
