//! Phases and directions as they are written.

use crate::cli::numbers;
use courant::analysis::exact::rational::to_f64;
use courant::analysis::scheme::catalogue::approximate;
use std::f64::consts::PI;

/// Waves of one curve at most.
const MOST: usize = 100_000;

/// Phases in radians, above 0, ascending.
#[derive(Debug, Clone, PartialEq)]
pub struct Phases(pub Vec<f64>);

/// Angles in degrees.
#[derive(Debug, Clone, PartialEq)]
pub struct Degrees(pub Vec<f64>);

/// `pi/8:pi:pi/8`, `0.1,pi/2`.
pub fn phases(text: &str) -> Result<Phases, String> {
    let number = |text: &str| {
        let value = approximate(text.trim()).filter(|value| value.is_finite());
        value.ok_or_else(|| format!("`{}` is not a number such as 0.1 or 3*pi/4", text.trim()))
    };
    let mut all = Vec::new();
    for part in text.split(',') {
        match part.split(':').collect::<Vec<_>>()[..] {
            [one] => all.push(number(one)?),
            [from, to, step] => {
                let (from, to, step) = (number(from)?, number(to)?, number(step)?);
                let count = ((to - from) / step + 1e-9).floor();
                if !(step > 0.0 && count >= 0.0) {
                    return Err(format!("the range `{part}` is empty"));
                }
                if count >= MOST as f64 {
                    return Err(format!(
                        "the range has more than {MOST} values; take a larger step"
                    ));
                }
                all.extend((0..=count as usize).map(|k| from + step * k as f64));
            }
            _ => return Err(format!("`{part}` is no range; write from:to:step, as pi/8:pi:pi/8")),
        }
    }
    // A wave of phase 0 has no speed; the end of a range may be rounded.
    all.retain(|phase| *phase != 0.0);
    for phase in &mut all {
        if (*phase - PI).abs() < 1e-9 {
            *phase = PI;
        }
    }
    let most = PI * 3f64.sqrt() + 1e-9;
    if let Some(phase) = all.iter().find(|phase| !(**phase > 0.0 && **phase <= most)) {
        return Err(format!("{phase} is out of range: above 0, the shortest wave has π"));
    }
    all.sort_by(f64::total_cmp);
    all.dedup();
    match all.len() {
        0 => Err("no phase above 0 is in it".into()),
        1..=MOST => Ok(Phases(all)),
        _ => Err(format!("more than {MOST} values")),
    }
}

/// Angles from the first axis.
pub fn degrees(text: &str) -> Result<Degrees, String> {
    let list = numbers::list(text)?.0;
    let angles: Vec<f64> = list.iter().map(to_f64).collect();
    match angles.iter().find(|angle| !(-360.0..=360.0).contains(*angle)) {
        Some(angle) => Err(format!("{angle} is out of range: from -360 to 360 degrees")),
        None => Ok(Degrees(angles)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_are_read_with_pi() {
        let eighths = phases("0:pi:pi/8").unwrap().0;
        assert_eq!((eighths.len(), eighths[7]), (8, PI));
        assert_eq!(phases("pi/2, 0.1").unwrap().0, [0.1, PI / 2.0]);
        for bad in ["", "x", "1:0:1", "0", "-1", "0:1:0", "1:2", "6", "0:1:1e-9"] {
            assert!(phases(bad).is_err(), "{bad}");
        }
        assert!(degrees("0,400").is_err());
    }
}
