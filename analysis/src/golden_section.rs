//! Golden sections: a maximum between two points, whatever the shape of the function about it.

/// The largest value met and its point: where there is one maximum between `lower` and `upper`, it is within `width` of the point.
///
/// Of the two inner points of a bracket one is an inner point of the next, so each section costs one value. Values that are no numbers are no
/// maximum: where there are no others the answer is −∞ at `lower`.
///
/// ```
/// use courant_analysis::golden_section::golden_section;
/// let (value, at) = golden_section(f64::sin, [0.0, 3.0], 1e-7);
/// assert!((at - std::f64::consts::FRAC_PI_2).abs() < 1e-7 && (value - 1.0).abs() < 1e-14);
/// ```
pub fn golden_section(
    mut at: impl FnMut(f64) -> f64,
    [mut lower, mut upper]: [f64; 2],
    width: f64,
) -> (f64, f64) {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let mut best = (f64::NEG_INFINITY, lower);
    let mut look = |point: f64| {
        let value = at(point);
        if value > best.0 {
            best = (value, point);
        }
        value
    };
    let mut left = upper - golden * (upper - lower);
    let mut right = lower + golden * (upper - lower);
    let (mut at_left, mut at_right) = (look(left), look(right));
    while upper - lower > width {
        if at_left < at_right {
            (lower, left, at_left) = (left, right, at_right);
            right = lower + golden * (upper - lower);
            at_right = look(right);
        } else {
            (upper, right, at_right) = (right, left, at_left);
            left = upper - golden * (upper - lower);
            at_left = look(left);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_smooth_maxima_and_ends_are_found_with_a_value_a_section() {
        let mut calls = 0;
        let corner = |x: f64| {
            calls += 1;
            -(x - 0.7).abs()
        };
        let (value, at) = golden_section(corner, [0.0, 1.0], 1e-12);
        assert!((at - 0.7).abs() < 1e-12 && value == -(at - 0.7).abs());
        // log(1e-12)/log(0.618) = 57.4 sections, and two values to begin with.
        assert_eq!(calls, 60);
        let (value, at) = golden_section(f64::sin, [0.0, 3.0], 1e-7);
        assert!((at - std::f64::consts::FRAC_PI_2).abs() < 1e-7 && (value - 1.0).abs() < 1e-14);
        assert!(golden_section(|x| x, [0.0, 1.0], 1e-9).1 > 1.0 - 1e-9);
        assert_eq!(golden_section(|_| f64::NAN, [2.0, 3.0], 0.1), (f64::NEG_INFINITY, 2.0));
    }
}
