//! What a paper says, as data: its text, the numbers measured for it, and the rules by which they decide.
//!
//! A file of claims holds sets of members, such as the runs that are compared, and the claims:
//!
//! ```
//! use courant_reports::claim::{Claims, Verdict};
//! let claims = Claims::from_toml(r#"
//!     [sets]
//!     both = [["upwind", "run-1"], ["centred", "run-2"]]
//!     [[claim]]
//!     id = "sharper"
//!     place = "section 3"
//!     text = "the centred scheme is sharper by a half, and nobody overshoots"
//!     shown = "widths: {widths:2}"
//!     measures = { widths = "width left @ both", ratio = "width left @ run-2 / run-1" }
//!     rules = ["ratio < 0.5", "each widths > 0"]
//! "#)?;
//! let found = claims.judge(|_, name, arguments, member| {
//!     assert_eq!((name, arguments), ("width", &["left"][..]));
//!     Some(if member == "run-1" { 0.08 } else { 0.02 })
//! })?;
//! assert_eq!(found[0].shown, "widths: upwind 0.080, centred 0.020");
//! assert_eq!(found[0].verdict, Verdict::Confirmed);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A measure is `[REDUCTION] NAME ARGUMENT… @ SET [/ SET]`: a number of every member of a set (or of the one member of
//! that name), over that of another set, reduced to its `least`, `largest`, `sum`, `median` or `spread` (largest over
//! smallest). A rule compares it with a number, a measure or a multiple of one, `each` of its numbers a condition or
//! all of them one; `and` joins comparisons to one condition.

use crate::number::significant;
use serde::Deserialize;
use std::collections::BTreeMap;

/// What became of a claim. It follows from the numbers, by the rules that stand beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Every condition holds.
    Confirmed,
    /// Some hold and some do not.
    InPart,
    /// None holds.
    Contradicted,
    /// A number that could decide is missing.
    NotDecided,
}

impl Verdict {
    fn of(conditions: &[Option<bool>]) -> Self {
        let any = |wanted| conditions.contains(&wanted);
        match (any(Some(true)), any(Some(false)), any(None)) {
            (true, true, _) => Self::InPart,
            (_, _, true) => Self::NotDecided,
            (true, ..) => Self::Confirmed,
            _ => Self::Contradicted,
        }
    }

    /// As it stands in a table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::InPart => "in part",
            Self::Contradicted => "contradicted",
            Self::NotDecided => "not decided",
        }
    }
}

/// A statement of a paper.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// The name of the claim, for messages.
    pub id: String,
    /// Where the paper says it.
    pub place: String,
    /// What it says, in our words.
    pub text: String,
    /// What is shown of the measures: `{name:3}` in three digits, `{name:.2}` with two decimals, `{name:%}` in per
    /// cent, `{name:yes}` as yes or no.
    pub shown: String,
    /// The measures by the names that `shown` and `rules` use.
    pub measures: BTreeMap<String, String>,
    /// The conditions.
    pub rules: Vec<String>,
}

/// The claims of a paper.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claims {
    /// Sets by name: labels with members, in the order in which they are shown.
    #[serde(default)]
    sets: BTreeMap<String, Vec<(String, String)>>,
    /// The claims in the order of the paper.
    #[serde(rename = "claim")]
    claims: Vec<Claim>,
}

/// What is wrong with a claim as it is written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("claim `{id}`: `{text}` {what}")]
pub struct ClaimError {
    id: String,
    text: String,
    what: &'static str,
}

/// A claim with what was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged<'a> {
    /// The claim.
    pub claim: &'a Claim,
    /// Its numbers in words.
    pub shown: String,
    /// What became of it.
    pub verdict: Verdict,
}

/// The numbers of a measure, with the labels of their members.
#[derive(Debug, Clone, PartialEq)]
struct Numbers(Vec<(String, f64)>);

impl Claims {
    /// Reads a file of claims.
    ///
    /// # Errors
    /// When it is no such file.
    pub fn from_toml(text: &str) -> Result<Self, toml::de::Error> {
        toml::from_str(text)
    }

    /// Measures and judges every claim. `measure` gives a number for a claim, a name, its arguments and a member: not a
    /// number where there is none to be found, `None` where nothing has that name.
    ///
    /// # Errors
    /// When a claim names what is not there or is not written as a measure or a rule.
    pub fn judge(
        &self,
        measure: impl Fn(&Claim, &str, &[&str], &str) -> Option<f64>,
    ) -> Result<Vec<Judged<'_>>, ClaimError> {
        self.claims
            .iter()
            .map(|claim| {
                let failed = |(text, what): (&str, &'static str)| ClaimError {
                    id: claim.id.clone(),
                    text: text.into(),
                    what,
                };
                let one = |name: &str, arguments: &[&str], member: &str| {
                    measure(claim, name, arguments, member)
                };
                let mut found = BTreeMap::new();
                for (name, text) in &claim.measures {
                    let what = self.numbers(text, one).map_err(|what| failed((text, what)))?;
                    found.insert(name.as_str(), what);
                }
                let mut conditions = Vec::new();
                for rule in &claim.rules {
                    conditions
                        .extend(judge_rule(rule, &found).map_err(|what| failed((rule, what)))?);
                }
                let shown = show(&claim.shown, &found).map_err(failed)?;
                Ok(Judged { claim, shown, verdict: Verdict::of(&conditions) })
            })
            .collect()
    }

    fn numbers(
        &self,
        text: &str,
        measure: impl Fn(&str, &[&str], &str) -> Option<f64>,
    ) -> Result<Numbers, &'static str> {
        let (what, sets) = text.split_once(" @ ").ok_or("has no ` @ ` before its set")?;
        let mut words: Vec<&str> = what.split(' ').collect();
        let reduction = Reduction::named(words[0]);
        if reduction.is_some() {
            words.remove(0);
        }
        let (name, arguments) = words.split_first().ok_or("has no name of a measure")?;
        let of = |set: &str| -> Result<Vec<(String, f64)>, &'static str> {
            let single = [(String::new(), set.to_owned())];
            let members = self.sets.get(set).map_or(&single[..], Vec::as_slice);
            let number = |(label, member): &(String, String)| {
                let value = measure(name, arguments, member).ok_or("is no measure or member")?;
                Ok((label.clone(), value))
            };
            members.iter().map(number).collect()
        };
        let (set, over) =
            sets.split_once(" / ").map_or((sets, None), |(set, over)| (set, Some(over)));
        let mut numbers = of(set)?;
        if let Some(over) = over {
            let [(_, over)] = of(over)?[..] else { return Err("is over more than one number") };
            numbers.iter_mut().for_each(|(_, number)| *number /= over);
        }
        Ok(Numbers(match reduction {
            Some(reduction) => {
                let values: Vec<f64> = numbers.into_iter().map(|(_, value)| value).collect();
                vec![(String::new(), reduction.of(values))]
            }
            None => numbers,
        }))
    }
}

/// What makes one number of several.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reduction {
    Least,
    Largest,
    Sum,
    Median,
    Spread,
}

impl Reduction {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "least" => Self::Least,
            "largest" => Self::Largest,
            "sum" => Self::Sum,
            "median" => Self::Median,
            "spread" => Self::Spread,
            _ => return None,
        })
    }

    /// Not a number if one of them is not.
    fn of(self, mut values: Vec<f64>) -> f64 {
        values.sort_by(f64::total_cmp);
        let (Some(&least), Some(&largest)) = (values.first(), values.last()) else {
            return f64::NAN;
        };
        if values.iter().any(|value| value.is_nan()) {
            return f64::NAN;
        }
        match self {
            Self::Least => least,
            Self::Largest => largest,
            Self::Sum => values.iter().sum(),
            Self::Median => 0.5 * (values[(values.len() - 1) / 2] + values[values.len() / 2]),
            Self::Spread => largest / least,
        }
    }
}

type Found<'a> = BTreeMap<&'a str, Numbers>;

/// The conditions of a rule: one, or one for each number; `None` where a number is missing.
fn judge_rule(rule: &str, found: &Found<'_>) -> Result<Vec<Option<bool>>, &'static str> {
    if let Some(single) = rule.strip_prefix("each ") {
        return compare(single, found);
    }
    let mut all = Vec::new();
    for comparison in rule.split(" and ") {
        all.extend(compare(comparison, found)?);
    }
    Ok(vec![if all.contains(&Some(false)) {
        Some(false)
    } else if all.contains(&None) {
        None
    } else {
        Some(true)
    }])
}

/// `NAME < NUMBER`, `NAME > FACTOR NAME`, `NAME in LEAST to LARGEST`; a name may pick a label: `NAME.LABEL`.
fn compare(comparison: &str, found: &Found<'_>) -> Result<Vec<Option<bool>>, &'static str> {
    let words: Vec<&str> = comparison.split(' ').collect();
    let [left, sign, right @ ..] = &words[..] else { return Err("is no comparison") };
    let left = operand(left, found)?;
    let number = |text: &str| text.parse::<f64>().map_err(|_| "has something else than a number");
    let compared = |right: Vec<f64>, holds: fn(f64, f64) -> bool| {
        if right.len() != 1 && right.len() != left.len() {
            return Err("compares different counts of numbers");
        }
        let decided = |(index, &left): (usize, &f64)| {
            let right = right[if right.len() == 1 { 0 } else { index }];
            (!left.is_nan() && !right.is_nan()).then(|| holds(left, right))
        };
        Ok(left.iter().enumerate().map(decided).collect())
    };
    let right = match right {
        [least, "to", largest] if *sign == "in" => {
            let (least, largest) = (number(least)?, number(largest)?);
            let inside = |value: &f64| (!value.is_nan()).then(|| (least..=largest).contains(value));
            return Ok(left.iter().map(inside).collect());
        }
        [one] => number(one).map(|value| vec![value]).or_else(|_| operand(one, found))?,
        [factor, one] => {
            let factor = number(factor)?;
            operand(one, found)?.into_iter().map(|value| factor * value).collect()
        }
        _ => return Err("is no comparison"),
    };
    match *sign {
        "<" => compared(right, |left, right| left < right),
        ">" => compared(right, |left, right| left > right),
        "=" => compared(right, |left, right| left == right),
        _ => Err("compares by another sign than <, >, = or `in`"),
    }
}

fn operand(text: &str, found: &Found<'_>) -> Result<Vec<f64>, &'static str> {
    let (name, label) =
        text.split_once('.').map_or((text, None), |(name, label)| (name, Some(label)));
    let Numbers(numbers) = found.get(name).ok_or("names a measure that is not there")?;
    let chosen = numbers.iter().filter(|(own, _)| label.is_none_or(|label| own == label));
    let values: Vec<f64> = chosen.map(|(_, value)| *value).collect();
    if values.is_empty() { Err("names a label that is not there") } else { Ok(values) }
}

/// The text with the numbers in their places.
fn show<'a>(text: &'a str, found: &Found<'_>) -> Result<String, (&'a str, &'static str)> {
    let mut shown = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let (place, behind) = after.split_once('}').ok_or((text, "has a brace without its end"))?;
        let (name, format) = place.split_once(':').ok_or((place, "has no format"))?;
        let Numbers(numbers) = found.get(name).ok_or((place, "is no measure of the claim"))?;
        let mut words = Vec::new();
        for (label, value) in numbers {
            let value = written(*value, format).ok_or((place, "has an unknown format"))?;
            words.push(if label.is_empty() { value } else { format!("{label} {value}") });
        }
        shown.push_str(before);
        shown.push_str(&words.join(", "));
        rest = behind;
    }
    Ok(shown + rest)
}

fn written(value: f64, format: &str) -> Option<String> {
    Some(match format {
        _ if value.is_nan() => "–".into(),
        "yes" => if value == 0.0 { "no" } else { "yes" }.into(),
        "%" => format!("{:.1} %", 100.0 * value),
        _ => match format.strip_prefix('.') {
            Some(decimals) => format!("{value:.*}", decimals.parse().ok()?),
            None => significant(value, format.parse().ok()?),
        },
    })
}

/// The rows of a table: where a claim stands, the claim, its numbers, and what became of it.
pub fn rows(judged: &[Judged<'_>]) -> impl Iterator<Item = Vec<String>> {
    judged.iter().map(|Judged { claim, shown, verdict }| {
        vec![claim.place.clone(), claim.text.clone(), shown.clone(), verdict.name().into()]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(measures: &str, rules: &str) -> Result<Verdict, ClaimError> {
        let text = format!(
            "[sets]\nthree = [[\"a\", \"1\"], [\"b\", \"2\"], [\"c\", \"nan\"]]\ntwo = [[\"a\", \"1\"], [\"b\", \"2\"]]\n\
             [[claim]]\nid = \"x\"\nplace = \"\"\ntext = \"\"\nshown = \"\"\nmeasures = {{ {measures} }}\nrules = {rules}\n"
        );
        let claims = Claims::from_toml(&text).expect("a file of claims");
        let measure = |_: &Claim, name: &str, _: &[&str], member: &str| {
            (name == "value").then(|| member.parse().ok()).flatten()
        };
        claims.judge(measure).map(|found| found[0].verdict)
    }

    #[test]
    fn rules_decide_by_the_numbers() {
        let of = |rules: &str| {
            judged("two = 'value @ two', three = 'value @ three', four = 'value @ 4'", rules)
        };
        for (rules, verdict) in [
            ("['two < 3']", Verdict::Confirmed),
            ("['two < 2']", Verdict::Contradicted),
            ("['each two < 2']", Verdict::InPart),
            ("['two.b > 1.9 two.a', 'two in 1 to 2']", Verdict::Confirmed),
            ("['two < four and four = 4']", Verdict::Confirmed),
            ("['two < four and four = 3', 'four < 5']", Verdict::InPart),
            ("['three < 3']", Verdict::NotDecided),
            ("['three < 2']", Verdict::Contradicted),
            ("['each three < 3']", Verdict::NotDecided),
        ] {
            assert_eq!(of(rules), Ok(verdict), "{rules}");
        }
        for (rules, what) in [
            ("['two < 3 4']", "is not there"),
            ("['two']", "no comparison"),
            ("['two.z < 1']", "label"),
            ("['two < three']", "different counts"),
            ("['two <= 3']", "another sign"),
        ] {
            let error = of(rules).unwrap_err().to_string();
            assert!(error.starts_with("claim `x`") && error.contains(what), "{error}");
        }
    }

    #[test]
    fn measures_are_reduced_and_divided() {
        let of =
            |measure: &str, rule: &str| judged(&format!("m = '{measure}'"), &format!("['{rule}']"));
        for (measure, rule) in [
            ("spread value @ two", "m = 2"),
            ("median value @ two", "m = 1.5"),
            ("sum value @ two / 2", "m = 1.5"),
            ("value @ two / 4", "m.b = 0.5"),
            ("least value @ two", "m = 1"),
            ("largest value @ two", "m = 2"),
        ] {
            assert_eq!(of(measure, rule), Ok(Verdict::Confirmed), "{measure}");
        }
        assert_eq!(of("largest value @ three", "m > 0"), Ok(Verdict::NotDecided));
        assert!(of("value two", "m > 0").is_err());
        assert!(of("other @ two", "m > 0").is_err());
        assert!(of("value @ 4 / two", "m > 0").is_err());
    }
}
