//! The largest root of `χ` for eight values of a parameter together.

use super::largest_excess;
use crate::waves::envelope::{LANES, Lanes};
use crate::waves::roots::roots;
use num_complex::Complex64;

/// Iterations from the roots of the neighbouring wave; where they do not do, the roots are taken one value after another.
const ITERATIONS: usize = 8;

/// A step of that part of a root has found it: the next would be rounding.
const SETTLED: f64 = 1e-10;

/// Roots nearer to each other, in parts of their size, are taken one value after another: they would move as one.
const APART: f64 = 1e-3;

/// Complex numbers in lanes.
#[derive(Debug, Clone, Copy)]
struct Complex {
    re: Lanes,
    im: Lanes,
}

const ZERO: Complex = Complex { re: [0.0; LANES], im: [0.0; LANES] };

impl Complex {
    #[inline(always)]
    fn by_lane(of: impl Fn(usize) -> (f64, f64)) -> Self {
        let mut value = ZERO;
        for lane in 0..LANES {
            (value.re[lane], value.im[lane]) = of(lane);
        }
        value
    }

    #[inline(always)]
    fn times(&self, other: &Self) -> Self {
        Self::by_lane(|l| {
            let (a, b, c, d) = (self.re[l], self.im[l], other.re[l], other.im[l]);
            (a * c - b * d, a * d + b * c)
        })
    }

    #[inline(always)]
    fn over(&self, other: &Self) -> Self {
        Self::by_lane(|l| {
            let (a, b, c, d) = (self.re[l], self.im[l], other.re[l], other.im[l]);
            let inverse = 1.0 / (c * c + d * d);
            ((a * c + b * d) * inverse, (b * c - a * d) * inverse)
        })
    }

    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        Self::by_lane(|l| (self.re[l] + other.re[l], self.im[l] + other.im[l]))
    }

    #[inline(always)]
    fn minus(&self, other: &Self) -> Self {
        Self::by_lane(|l| (self.re[l] - other.re[l], self.im[l] - other.im[l]))
    }

    #[inline(always)]
    fn norm_sqr(&self) -> Lanes {
        std::array::from_fn(|l| self.re[l] * self.re[l] + self.im[l] * self.im[l])
    }

    #[inline(always)]
    fn negated(&self) -> Self {
        ZERO.minus(self)
    }

    /// The principal root.
    #[inline(always)]
    fn sqrt(&self) -> Self {
        Self::by_lane(|l| {
            let (re, im) = (self.re[l], self.im[l]);
            let modulus = (re * re + im * im).sqrt();
            let long = (0.5 * (modulus + re.abs())).sqrt();
            let short = if long > 0.0 { 0.5 * im.abs() / long } else { 0.0 };
            let (re, size) = if re >= 0.0 { (long, short) } else { (short, long) };
            (re, if im < 0.0 { -size } else { size })
        })
    }

    /// `|1 + y|² − 1`.
    #[inline(always)]
    fn excess(&self) -> Lanes {
        let norms = self.norm_sqr();
        std::array::from_fn(|l| 2.0 * self.re[l] + norms[l])
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> Complex64 {
        Complex64::new(self.re[lane], self.im[lane])
    }
}

/// Follows the roots from wave to wave.
pub(super) struct LargestRoots {
    coefficients: Vec<Complex>,
    /// The roots of the wave before.
    roots: Vec<Complex>,
}

impl LargestRoots {
    pub(super) fn new(degree: usize) -> Self {
        Self { coefficients: vec![ZERO; degree + 1], roots: vec![ZERO; degree] }
    }

    /// `|z|² − 1` of the largest multiplier, from the coefficients of `χ(1 + y)` in powers of `t`.
    #[inline(always)]
    pub(super) fn excess(&mut self, values: &[Complex64], powers: usize, t: &Lanes) -> Lanes {
        for (sum, values) in self.coefficients.iter_mut().zip(values.chunks_exact(powers)) {
            *sum = ZERO;
            for value in values.iter().rev() {
                for (lane, t) in t.iter().enumerate() {
                    sum.re[lane] = sum.re[lane] * t + value.re;
                    sum.im[lane] = sum.im[lane] * t + value.im;
                }
            }
        }
        let (mut excess, open) = match self.coefficients.as_slice() {
            [constant, slope] => (constant.over(slope).negated().excess(), [false; LANES]),
            [c, b, a] => (quadratic(a, b, c), [false; LANES]),
            _ => self.follow(),
        };
        for lane in 0..LANES {
            if open[lane] || !excess[lane].is_finite() {
                excess[lane] = largest_excess(values, powers, t[lane]);
            }
        }
        excess
    }

    /// Aberth's iteration from the roots of the wave before; lanes that do not settle are open.
    #[inline(always)]
    fn follow(&mut self) -> (Lanes, [bool; LANES]) {
        let degree = self.roots.len();
        let mut moved = [f64::INFINITY; LANES];
        for _ in 0..ITERATIONS {
            moved = [0.0; LANES];
            for i in 0..degree {
                let y = self.roots[i];
                let (mut value, mut slope) = (ZERO, ZERO);
                for coefficient in self.coefficients.iter().rev() {
                    slope = slope.times(&y).plus(&value);
                    value = value.times(&y).plus(coefficient);
                }
                // p/(p' − p Σ 1/(y − y_j))
                let mut inverse = slope;
                for (_, other) in self.roots.iter().enumerate().filter(|(j, _)| *j != i) {
                    inverse = inverse.minus(&value.over(&y.minus(other)));
                }
                let step = value.over(&inverse);
                self.roots[i] = y.minus(&step);
                let (steps, sizes) = (step.norm_sqr(), self.roots[i].norm_sqr());
                for lane in 0..LANES {
                    let share = steps[lane] / (sizes[lane] + SETTLED * SETTLED);
                    // What is no number has not settled.
                    moved[lane] = if share <= moved[lane] { moved[lane] } else { share };
                }
            }
            if moved.iter().all(|&share| share <= SETTLED * SETTLED) {
                break;
            }
        }
        let mut excess = [-1.0f64; LANES];
        for root in &self.roots {
            let of = root.excess();
            for lane in 0..LANES {
                excess[lane] = if of[lane] > excess[lane] { of[lane] } else { excess[lane] };
            }
        }
        let mut open = moved.map(|share| share.is_nan() || share > SETTLED * SETTLED);
        for (lane, open) in open.iter_mut().enumerate() {
            if *open || self.are_close(lane) {
                *open = true;
                self.restart(lane);
            }
        }
        (excess, open)
    }

    /// Whether two roots of a lane are close to each other.
    fn are_close(&self, lane: usize) -> bool {
        self.roots.iter().enumerate().any(|(i, one)| {
            self.roots[..i].iter().any(|other| {
                let (one, other) = (one.get(lane), other.get(lane));
                (one - other).norm_sqr() <= APART * APART * one.norm_sqr().max(other.norm_sqr())
            })
        })
    }

    /// Takes the roots of one lane anew.
    fn restart(&mut self, lane: usize) {
        let coefficients: Vec<Complex64> =
            self.coefficients.iter().map(|value| value.get(lane)).collect();
        for (root, value) in self.roots.iter_mut().zip(roots(&coefficients)) {
            (root.re[lane], root.im[lane]) = (value.re, value.im);
        }
    }
}

/// The larger `|1 + y|² − 1` of both roots of `a y² + b y + c`.
#[inline(always)]
fn quadratic(a: &Complex, b: &Complex, c: &Complex) -> Lanes {
    let half = Complex::by_lane(|l| (0.5 * b.re[l], 0.5 * b.im[l]));
    let root = half.times(&half).minus(&a.times(c)).sqrt();
    // The sign that adds to the half: their scalar product is not negative.
    let sum = Complex::by_lane(|l| {
        let along = half.re[l] * root.re[l] + half.im[l] * root.im[l];
        let sign = if along < 0.0 { -1.0 } else { 1.0 };
        (half.re[l] + sign * root.re[l], half.im[l] + sign * root.im[l])
    });
    let (one, other) = (sum.over(a).negated().excess(), c.over(&sum).negated().excess());
    // Where the sum is zero both roots are, and the other is no number.
    std::array::from_fn(|l| if other[l] > one[l] { other[l] } else { one[l] })
}
