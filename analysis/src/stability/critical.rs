//! Where stability is lost and regained, found in `f64`: guesses for the exact decisions, and the
//! answer itself where only sampling is asked for.
//!
//! At one phase the margin is a polynomial in `t`, negative on a few intervals. The union of these
//! intervals over all phases is the unstable set; its ends are the critical values.

use crate::golden_section::golden_section;
use crate::stability::margin::CompiledMargin;

/// An end of the unstable set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Critical {
    /// The value of `t = C^stride`.
    pub parameter: f64,
    /// The phase whose margin vanishes there, in radians.
    pub phase: f64,
}

/// A maximal interval of `t` where some looked-at phase is unstable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UnstableInterval {
    pub from: Critical,
    pub to: Critical,
}

/// The unstable intervals within `[0, max_parameter]` seen by the given phases.
pub(super) fn sampled_unstable_set(
    margin: &CompiledMargin,
    phases: impl Iterator<Item = f64>,
    max_parameter: f64,
) -> Vec<UnstableInterval> {
    let phases: Vec<f64> = phases.collect();
    let mut intervals = Vec::with_capacity(phases.len());
    let (all, powers) = (margin.powers_on(&phases), margin.powers());
    let mut scratch = Scratch::default();
    for (index, &phase) in phases.iter().enumerate() {
        let found = scratch.negative_intervals(&all[index * powers..][..powers], max_parameter);
        intervals.extend(found.iter().map(|&(from, to)| UnstableInterval {
            from: Critical { parameter: from, phase },
            to: Critical { parameter: to, phase },
        }));
    }
    // Of ends that are equal the longest wave comes first.
    intervals.sort_unstable_by(|a, b| {
        let [a, b] = [a.from, b.from];
        a.parameter.total_cmp(&b.parameter).then(a.phase.total_cmp(&b.phase))
    });
    let mut union: Vec<UnstableInterval> = Vec::new();
    for interval in intervals {
        match union.last_mut() {
            Some(last) if interval.from.parameter <= last.to.parameter => {
                if interval.to.parameter > last.to.parameter {
                    last.to = interval.to;
                }
            }
            _ => union.push(interval),
        }
    }
    union
}

/// A phase grid fine enough to see every oscillation of a margin of this degree: 16 samples for each
/// half-wave, both ends included.
pub(crate) fn resolving_phases(degree: usize) -> impl Iterator<Item = f64> {
    let cells = (16 * degree).max(64);
    (0..=cells).map(move |index| {
        if index == cells {
            std::f64::consts::PI
        } else {
            index as f64 * std::f64::consts::PI / cells as f64
        }
    })
}

/// Moves an end of the unstable set to the extremum over all phases near the sampled one.
pub(super) fn refine(
    margin: &CompiledMargin,
    guess: Critical,
    is_start: bool,
    max_parameter: f64,
) -> Critical {
    let spacing = std::f64::consts::PI / (16 * margin.degree()).max(64) as f64;
    let (mut powers, mut scratch) = (Vec::new(), Scratch::default());
    // The end of the unstable interval at one phase that belongs to this guess: the one nearest to it.
    let mut end_at = |phase: f64| -> Option<f64> {
        margin.powers_at(phase, &mut powers);
        scratch
            .negative_intervals(&powers, max_parameter)
            .iter()
            .map(|&(from, to)| if is_start { from } else { to })
            .min_by(|a, b| (a - guess.parameter).abs().total_cmp(&(b - guess.parameter).abs()))
    };
    let worse = |parameter: f64| if is_start { -parameter } else { parameter };
    let about =
        [(guess.phase - spacing).max(0.0), (guess.phase + spacing).min(std::f64::consts::PI)];
    let value = |phase| end_at(phase).map_or(f64::NEG_INFINITY, worse);
    let (found, phase) = golden_section(value, about, 1e-9);
    if found.is_finite() && found > worse(guess.parameter) {
        Critical { parameter: worse(found), phase }
    } else {
        guess
    }
}

/// The open intervals within `[0, end]` where `Σ_j a_j t^j` is negative.
pub(crate) fn negative_intervals(coefficients: &[f64], end: f64) -> Vec<(f64, f64)> {
    let mut scratch = Scratch::default();
    scratch.negative_intervals(coefficients, end);
    scratch.intervals
}

/// Room for knots and intervals that is used again for every phase.
#[derive(Default)]
struct Scratch {
    knots: Vec<f64>,
    intervals: Vec<(f64, f64)>,
}

impl Scratch {
    fn negative_intervals(&mut self, coefficients: &[f64], end: f64) -> &[(f64, f64)] {
        let Self { knots, intervals } = self;
        knots.clear();
        knots.push(0.0);
        push_roots(coefficients, end, knots);
        knots.push(end);
        intervals.clear();
        let value = |t: f64| coefficients.iter().rev().fold(0.0, |sum, a| sum * t + a);
        for pair in knots.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            if to > from && value(0.5 * (from + to)) < 0.0 {
                match intervals.last_mut() {
                    Some(last) if last.1 == from => last.1 = to,
                    _ => intervals.push((from, to)),
                }
            }
        }
        intervals
    }
}

/// Adds the roots in `(0, end)`, ascending: between the extrema, which are the roots of the derivative.
fn push_roots(coefficients: &[f64], end: f64, found: &mut Vec<f64>) {
    let inside = |root: &f64| *root > 0.0 && *root < end;
    match coefficients {
        [] | [_] => {}
        [constant, slope] => found.extend(Some(-constant / slope).filter(inside)),
        [constant, slope, leading] => {
            // The larger root without cancellation, the other from their product.
            let root = (slope * slope - 4.0 * leading * constant).sqrt();
            let sum = -0.5 * (slope + root.copysign(*slope));
            let (one, other) = (sum / leading, constant / sum);
            let ordered = if other < one { [other, one] } else { [one, other] };
            found.extend(ordered.into_iter().filter(inside));
        }
        _ => {
            let derivative: Vec<f64> =
                (1..).zip(&coefficients[1..]).map(|(j, a)| f64::from(j) * a).collect();
            let value = |t: f64| coefficients.iter().rev().fold(0.0, |sum, a| sum * t + a);
            let mut knots = vec![0.0];
            push_roots(&derivative, end, &mut knots);
            knots.push(end);
            for pair in knots.windows(2) {
                let (mut lower, mut upper) = (pair[0], pair[1]);
                let sign = value(lower) < 0.0;
                if sign == (value(upper) < 0.0) {
                    continue;
                }
                // Bisection to the last bit: monotone between the knots.
                while lower.midpoint(upper) > lower && lower.midpoint(upper) < upper {
                    let middle = lower.midpoint(upper);
                    if (value(middle) < 0.0) == sign { lower = middle } else { upper = middle }
                }
                found.push(upper);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn negative_intervals_of_a_known_cubic() {
        // (t − 1)(t − 2)(t − 3) = −6 + 11t − 6t² + t³: negative on (0, 1) and (2, 3).
        let found = negative_intervals(&[-6.0, 11.0, -6.0, 1.0], 10.0);
        assert_eq!(found.len(), 2);
        for ((from, to), (a, b)) in found.into_iter().zip([(0.0, 1.0), (2.0, 3.0)]) {
            assert!((from - a).abs() < 1e-14 && (to - b).abs() < 1e-14);
        }
        assert!(negative_intervals(&[], 1.0).is_empty());
        assert_eq!(negative_intervals(&[-1.0], 5.0), [(0.0, 5.0)]);
    }
}
