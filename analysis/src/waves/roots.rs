//! All roots of a complex polynomial in `f64`.

use num_complex::Complex64;

/// Iterations of Aberth's method at most: simple roots need about ten, a root of multiplicity m gains one digit in three m of them.
const MOST_ITERATIONS: usize = 400;

/// The roots of `Σ_j a_j y^j`: by closed formulas up to degree 2, by Aberth's iteration beyond. A leading coefficient of zero is a root at
/// infinity. Empty where all coefficients but the constant one are zero in number; not numbers where all are zero in value.
pub(crate) fn roots(coefficients: &[Complex64]) -> Vec<Complex64> {
    let degree = coefficients.len().saturating_sub(1);
    let finite = coefficients.iter().all(|a| a.is_finite());
    let Some(highest) = coefficients.iter().rposition(|a| *a != Complex64::ZERO) else {
        return vec![Complex64::new(f64::NAN, f64::NAN); degree];
    };
    if !finite {
        return vec![Complex64::new(f64::NAN, f64::NAN); degree];
    }
    let lowest = coefficients.iter().position(|a| *a != Complex64::ZERO).unwrap_or(0);
    // y = 2^k w makes the first and the last coefficient about equal, without rounding.
    let exponent = |a: &Complex64| a.re.abs().max(a.im.abs()).log2();
    let (first, last) = (exponent(&coefficients[lowest]), exponent(&coefficients[highest]));
    let unit = ((first - last) / (highest - lowest).max(1) as f64).round();
    let heights = (0..).zip(&coefficients[lowest..=highest]);
    let top = heights
        .map(|(j, a)| exponent(a) + unit * f64::from(j))
        .fold(f64::NEG_INFINITY, f64::max)
        .floor();
    let a: Vec<Complex64> = (0..)
        .zip(&coefficients[lowest..=highest])
        .map(|(j, a)| scaled(*a, unit * f64::from(j) - top))
        .collect();
    let mut found = vec![Complex64::ZERO; lowest];
    match a.as_slice() {
        [_] => {}
        [constant, slope] => found.push(-constant / slope),
        [constant, slope, leading] => found.extend(quadratic(*leading, *slope, *constant)),
        _ => found.extend(aberth(&a)),
    }
    found.iter_mut().for_each(|root| *root = scaled(*root, unit));
    found.resize(degree, Complex64::new(f64::INFINITY, 0.0));
    found
}

/// Times a power of two whose exponent may be out of range by itself.
fn scaled(value: Complex64, exponent: f64) -> Complex64 {
    let half = (0.5 * exponent).floor();
    value * half.exp2() * (exponent - half).exp2()
}

/// `a y² + b y + c = 0` with `a` and `c` not zero, without cancellation between `b` and the root of the discriminant.
fn quadratic(a: Complex64, b: Complex64, c: Complex64) -> [Complex64; 2] {
    let half = b * 0.5;
    let is_real = a.im == 0.0 && b.im == 0.0 && c.im == 0.0;
    let discriminant = if is_real {
        Complex64::from(difference_of_products(half.re, half.re, a.re, c.re))
    } else {
        // Real and imaginary part of h² − a c, each a sum of two differences of products.
        let re = difference_of_products(half.re, half.re, a.re, c.re)
            - difference_of_products(half.im, half.im, a.im, c.im);
        let im = difference_of_products(half.re, half.im, a.re, c.im)
            + difference_of_products(half.re, half.im, a.im, c.re);
        Complex64::new(re, im)
    };
    if is_real && discriminant.re < 0.0 {
        let root = (-discriminant.re).sqrt() / a.re;
        let middle = -half.re / a.re;
        return [Complex64::new(middle, -root.abs()), Complex64::new(middle, root.abs())];
    }
    let root = discriminant.sqrt();
    let sum = if (half.conj() * root).re >= 0.0 { half + root } else { half - root };
    if sum == Complex64::ZERO {
        return [Complex64::ZERO; 2];
    }
    [-sum / a, -c / sum]
}

/// `a b − c d` with one rounding's error (Kahan).
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let product = c * d;
    let error = (-c).mul_add(d, product);
    a.mul_add(b, -product) + error
}

/// All roots at once, started on circles that the moduli of the coefficients suggest (Bini 1996).
fn aberth(a: &[Complex64]) -> Vec<Complex64> {
    let degree = a.len() - 1;
    let mut roots = starting_points(a);
    let mut settled = vec![false; degree];
    for _ in 0..MOST_ITERATIONS {
        for i in 0..degree {
            if settled[i] {
                continue;
            }
            let (step, exact) = newton_step(a, roots[i]);
            let repulsion: Complex64 = (0..degree)
                .filter(|&j| j != i)
                .map(|j| {
                    let distance = roots[i] - roots[j];
                    if distance == Complex64::ZERO { distance } else { distance.inv() }
                })
                .sum();
            let correction = step / (Complex64::ONE - step * repulsion);
            if exact || !correction.is_finite() {
                settled[i] = true;
                continue;
            }
            roots[i] -= correction;
            settled[i] = correction.norm() <= f64::EPSILON * roots[i].norm();
        }
        if settled.iter().all(|&done| done) {
            break;
        }
    }
    if a.iter().all(|value| value.im == 0.0) {
        for root in &mut roots {
            if root.im.abs() <= 64.0 * f64::EPSILON * root.norm() {
                root.im = 0.0;
            }
        }
    }
    roots
}

/// `p/p'` at a point, and whether `p` vanishes there to rounding; outside the unit circle by the reversed polynomial.
fn newton_step(a: &[Complex64], y: Complex64) -> (Complex64, bool) {
    let degree = (a.len() - 1) as f64;
    let inside = y.norm() <= 1.0;
    let x = if inside { y } else { y.inv() };
    let horner = |values: &mut dyn Iterator<Item = &Complex64>| {
        let (mut value, mut slope, mut size) = (Complex64::ZERO, Complex64::ZERO, 0.0);
        for coefficient in values {
            slope = slope * x + value;
            value = value * x + coefficient;
            size = size * x.norm() + coefficient.norm();
        }
        (value, slope, size)
    };
    let (value, slope, size) =
        if inside { horner(&mut a.iter().rev()) } else { horner(&mut a.iter()) };
    let exact = value.norm() <= 0.5 * f64::EPSILON * size;
    if inside {
        return (value / slope, exact);
    }
    // p(y) = y^n q(1/y), so that p'/p = (n − x q'/q) x.
    ((x * (degree - x * slope / value)).inv(), exact)
}

fn starting_points(a: &[Complex64]) -> Vec<Complex64> {
    let heights = a.iter().enumerate().filter(|(_, value)| **value != Complex64::ZERO);
    let heights = heights.map(|(j, value)| (j, value.norm().ln())).collect();
    let point = |(logarithm, angle): (f64, f64)| Complex64::from_polar(logarithm.exp(), angle);
    circles(heights).into_iter().map(point).collect()
}

/// Logarithms of moduli and angles to start from: the upper convex hull of `(j, log |a_j|)` is as many circles as it has edges,
/// each with as many roots as its edge is long.
pub(super) fn circles(heights: Vec<(usize, f64)>) -> Vec<(f64, f64)> {
    let slope = |p: (usize, f64), q: (usize, f64)| (q.1 - p.1) / (q.0 - p.0) as f64;
    let mut hull: Vec<(usize, f64)> = Vec::new();
    for point in heights {
        while let [.., before, last] = hull.as_slice()
            && slope(*before, *last) <= slope(*last, point)
        {
            hull.pop();
        }
        hull.push(point);
    }
    let degree = hull.last().map_or(1, |last| last.0);
    let mut points = Vec::with_capacity(degree);
    for (edge, pair) in hull.windows(2).enumerate() {
        let count = pair[1].0 - pair[0].0;
        for k in 0..count {
            let turn = k as f64 / count as f64 + edge as f64 / degree as f64;
            points.push((-slope(pair[0], pair[1]), std::f64::consts::TAU * turn + 0.7));
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn from_roots(roots: &[Complex64]) -> Vec<Complex64> {
        roots.iter().fold(vec![Complex64::ONE], |p, root| {
            let mut product = vec![Complex64::ZERO; p.len() + 1];
            for (j, value) in p.iter().enumerate() {
                product[j + 1] += value;
                product[j] -= root * value;
            }
            product
        })
    }

    /// The largest distance of a chosen root to the found ones.
    fn distance(chosen: &[Complex64], found: &[Complex64]) -> f64 {
        let nearest =
            |z: &Complex64| found.iter().map(|w| (z - w).norm()).fold(f64::INFINITY, f64::min);
        chosen.iter().map(nearest).fold(0.0, f64::max)
    }

    #[test]
    fn leading_and_constant_coefficients_may_vanish() {
        let c = |values: &[f64]| values.iter().map(|&v| Complex64::from(v)).collect::<Vec<_>>();
        let found = roots(&c(&[0.0, -2.0, 1.0, 0.0]));
        assert_eq!((found[0], found[1]), (Complex64::ZERO, Complex64::from(2.0)));
        assert!(found[2].re.is_infinite());
        assert!(roots(&c(&[0.0, 0.0])).iter().all(|root| root.re.is_nan()));
        assert!(roots(&c(&[1.0])).is_empty());
        // Nothing overflows: y² = 1e-300/1e300.
        let tiny = roots(&c(&[-1e-300, 0.0, 1e300]));
        assert!((tiny[0].re.abs() / 1e-300 - 1.0).abs() < 1e-9, "{tiny:?}");
    }

    #[test]
    fn multiple_roots_come_with_the_digits_they_have() {
        for multiplicity in 2..6 {
            let mut chosen = vec![Complex64::new(0.6, 0.8); multiplicity];
            chosen.push(Complex64::new(-0.3, 0.0));
            let found = roots(&from_roots(&chosen));
            assert_eq!(found.len(), chosen.len());
            // A multiple root moves by the root of the rounding.
            let tolerance = 20.0 * f64::EPSILON.powf(1.0 / multiplicity as f64);
            assert!(distance(&found, &chosen) < tolerance, "{multiplicity}: {found:?}");
        }
    }

    proptest! {
        #[test]
        fn chosen_roots_are_found(
            parts in prop::collection::vec((-2.0f64..2.0, -2.0f64..2.0), 1..9), scale in -40i32..40
        ) {
            let chosen: Vec<Complex64> = parts.iter().map(|&(re, im)| Complex64::new(re, im)).collect();
            let coefficients: Vec<Complex64> =
                from_roots(&chosen).into_iter().map(|a| a * 2f64.powi(scale)).collect();
            let found = roots(&coefficients);
            prop_assert_eq!(found.len(), chosen.len());
            // Backward stable: the polynomial of the found roots is the given one to rounding.
            let back = from_roots(&found);
            let size: f64 = coefficients.iter().map(|a| a.norm()).sum::<f64>() * 2f64.powi(-scale);
            for (a, b) in coefficients.iter().zip(back) {
                prop_assert!((a * 2f64.powi(-scale) - b).norm() <= 1e-12 * size * chosen.len() as f64);
            }
        }

        #[test]
        fn real_quadratics_have_conjugate_or_real_roots(a in 0.1f64..3.0, b in -3.0f64..3.0, c in -3.0f64..3.0) {
            let [first, second] = quadratic(a.into(), b.into(), c.into());
            if b * b < 4.0 * a * c {
                prop_assert_eq!(first, second.conj());
            } else {
                prop_assert!(first.im == 0.0 && second.im == 0.0);
            }
            prop_assert!((first * second - c / a).norm() <= 1e-14 * (1.0 + (c / a).abs()));
        }
    }
}
