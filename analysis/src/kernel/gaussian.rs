//! The Gaussian kernel as Ferrari et al. 2008 (2.8) use it: cut at `q = 3`, the point `q = 3`
//! included, and not renormalised (its integral is `erf 3 = 0.99997791`).

use std::f64::consts::PI;

/// Where the Gaussian is cut, in smoothing lengths. The end point belongs to the support.
pub const GAUSSIAN_CUT: i64 = 3;

const CUT: f64 = GAUSSIAN_CUT as f64;

pub(super) fn value(q: f64) -> f64 {
    if q <= CUT { (-q * q).exp() / PI.sqrt() } else { 0.0 }
}

pub(super) fn slope(q: f64) -> f64 {
    -2.0 * q * value(q)
}

pub(super) fn curvature(q: f64) -> f64 {
    (4.0 * q * q - 2.0) * value(q)
}

/// `√(1/2 − 3e^{−9}/(√π erf 3))`, from integrating `q² e^{−q²}` by parts over `[−3, 3]`.
pub(super) fn standard_deviation() -> f64 {
    const ERF_3: f64 = 0.999_977_909_503_001_4;
    (0.5 - CUT * (-CUT * CUT).exp() / (PI.sqrt() * ERF_3)).sqrt()
}
