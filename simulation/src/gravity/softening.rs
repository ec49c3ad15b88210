//! Gravity of a particle that is spread like the cubic spline.

/// Where the spline ends, in smoothing lengths: beyond, a particle attracts like a point.
pub const SUPPORT: f64 = 2.0;

/// `M(<r)/r³` of a unit mass spread like the cubic spline M4 of smoothing length `h` (support `2h`): its attraction
/// at the displacement `d`, `|d| = r`, is `−G M(<r)/r³ d`. Units 1/length³.
/// Price & Monaghan 2007, appendix A.
///
/// ```
/// use courant_simulation::gravity::attraction;
/// assert_eq!(attraction(2.0, 0.5), 1.0 / 8.0); // a point from outside
/// assert!((attraction(0.0, 1.0) - 4.0 / 3.0).abs() < 1e-15); // 4π/3 W(0) in the middle
/// ```
#[inline]
pub fn attraction(r: f64, h: f64) -> f64 {
    let q = r / h;
    if q >= SUPPORT {
        1.0 / (r * r * r)
    } else if q >= 1.0 {
        let cube = q * q * q;
        (8.0 / 3.0 - 3.0 * q + 1.2 * q * q - cube / 6.0 - 1.0 / (15.0 * cube)) / (h * h * h)
    } else {
        let square = q * q;
        (4.0 / 3.0 - 1.2 * square + 0.5 * square * q) / (h * h * h)
    }
}

/// The potential of that unit mass over `G`, units 1/length: `−1/r` from outside.
///
/// ```
/// use courant_simulation::gravity::potential;
/// assert_eq!(potential(4.0, 1.0), -0.25);
/// assert_eq!(potential(0.0, 1.0), -1.4);
/// ```
#[inline]
pub fn potential(r: f64, h: f64) -> f64 {
    let q = r / h;
    let square = q * q;
    if q >= SUPPORT {
        -1.0 / r
    } else if q >= 1.0 {
        let series = 4.0 / 3.0 - q + 0.3 * square - square * q / 30.0;
        (square * series - 1.6 + 1.0 / (15.0 * q)) / h
    } else {
        (square * (2.0 / 3.0 - 0.3 * square + 0.1 * square * q) - 1.4) / h
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particles::SmoothingKernel;
    use courant_analysis::kernel::Kernel;
    use std::f64::consts::PI;

    #[test]
    fn attraction_is_the_mass_inside_and_the_slope_of_the_potential() {
        let (h, kernel) = (0.7, SmoothingKernel::<3>::new(Kernel::CubicSpline));
        let (steps, mut mass) = (7000, 0.0);
        let width = 2.5 * h / f64::from(steps);
        for step in 0..steps {
            let middle = (f64::from(step) + 0.5) * width;
            let density = |r: f64| 4.0 * PI * r * r * kernel.value(r, h);
            // Simpson's rule on each shell.
            let [inner, outer] = [middle - 0.5 * width, middle + 0.5 * width];
            mass += width / 6.0 * (density(inner) + 4.0 * density(middle) + density(outer));
            let from_mass = mass / outer.powi(3);
            assert!((attraction(outer, h) - from_mass).abs() < 1e-8 * attraction(outer, h) + 1e-9);
            if step % 100 == 50 {
                let nudge = 1e-5;
                let slope = (potential(outer + nudge, h) - potential(outer - nudge, h)) / (2e-5);
                assert!((attraction(outer, h) * outer - slope).abs() < 1e-8, "{outer}");
            }
        }
        assert!((mass - 1.0).abs() < 1e-10);
    }
}
