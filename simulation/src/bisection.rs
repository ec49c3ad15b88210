//! Roots by halving the interval.

/// The root of a growing function between `low` and `high`, to the last bit; the end that is nearest where there is none.
pub(crate) fn root(mut low: f64, mut high: f64, growing: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        // Also where a bound is no number: that must not loop.
        if middle <= low || middle >= high || middle.is_nan() {
            return middle;
        }
        if growing(middle) < 0.0 { low = middle } else { high = middle }
    }
}
