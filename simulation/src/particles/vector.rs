//! Vectors of a dimension known at compile time.

/// A vector of `D` components.
pub type Vector<const D: usize> = [f64; D];

/// `a·b`.
#[inline]
pub fn dot<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    let mut sum = 0.0;
    for axis in 0..D {
        sum += a[axis] * b[axis];
    }
    sum
}

/// `a + factor·b`.
#[inline]
pub fn plus_scaled<const D: usize>(a: &Vector<D>, factor: f64, b: &Vector<D>) -> Vector<D> {
    std::array::from_fn(|axis| a[axis] + factor * b[axis])
}
