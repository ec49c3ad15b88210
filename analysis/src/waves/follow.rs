//! Roots followed along a direction by continuity, through crossings and past places where two of them meet.

use super::CompiledStep;
use super::branches::scaled;
use num_complex::Complex64;

/// Steps along the phase at most, so that no argument turns far in one.
const LONGEST: f64 = 0.02;
/// A step this short does not tell roots apart that meet.
const SHORTEST: f64 = 1e-6;
/// A root is the continuation when the next one is this many times farther from where it is expected.
const CLEAR: f64 = 5.0;
/// Roots nearer to each other than this share of their size are the same one.
const SAME: f64 = 1e-7;

/// All roots at one modulus of the phase, and where they are going.
pub(super) struct Follower<'a> {
    step: &'a CompiledStep,
    direction: &'a [f64],
    modulus: f64,
    roots: Vec<Complex64>,
    /// Change by the modulus, over the last step.
    rates: Vec<Complex64>,
}

impl<'a> Follower<'a> {
    pub(super) fn new(
        step: &'a CompiledStep,
        direction: &'a [f64],
        modulus: f64,
        roots: Vec<Complex64>,
    ) -> Self {
        let rates = step.slopes(&[], &scaled(direction, modulus), direction, &roots);
        let known = |rate: Complex64| if rate.is_finite() { rate } else { Complex64::ZERO };
        Self { step, direction, modulus, roots, rates: rates.into_iter().map(known).collect() }
    }

    /// The roots by branch where it stands.
    pub(super) fn here(&self) -> &[Complex64] {
        &self.roots
    }

    /// The roots by branch at a modulus ahead; `visit` sees them wherever they were known by continuity on the way.
    pub(super) fn to(
        &mut self,
        target: f64,
        mut visit: impl FnMut(&[Complex64]),
    ) -> Vec<Complex64> {
        while target > self.modulus {
            let left = target - self.modulus;
            let whole = left.min(LONGEST).min(self.modulus);
            let mut by = whole;
            let mut found = self.ahead(by);
            while found.is_none() && by > SHORTEST {
                by *= 0.5;
                found = self.ahead(by);
            }
            if found.is_none() {
                if left <= SHORTEST {
                    // Two meet here: nothing is learned, and the way goes on from where they were apart.
                    return self.nearest(left);
                }
                // Analytic branches that cross are apart again behind the crossing, where they were going.
                let leaps =
                    (1..).map(|k| SHORTEST * f64::from(k * k * k)).take_while(|by| *by <= whole);
                found = leaps.into_iter().find_map(|leap| {
                    by = leap;
                    self.ahead(leap)
                });
            }
            match found {
                Some(roots) => {
                    let change = roots.iter().zip(&self.roots).map(|(new, old)| (new - old) / by);
                    let known =
                        |rate: Complex64| if rate.is_finite() { rate } else { Complex64::ZERO };
                    self.rates = change.map(known).collect();
                    self.roots = roots;
                }
                None => {
                    // They met and turned: a root of a root, whose direction there says nothing of what follows.
                    by = SHORTEST.min(left);
                    self.roots = self.nearest(by);
                    self.rates = vec![Complex64::ZERO; self.roots.len()];
                }
            }
            self.modulus = if by == left { target } else { self.modulus + by };
            visit(&self.roots);
        }
        self.roots.clone()
    }

    fn expected(&self, by: f64) -> Vec<Complex64> {
        self.roots.iter().zip(&self.rates).map(|(y, rate)| y + rate * by).collect()
    }

    fn roots_ahead(&self, by: f64) -> Vec<Complex64> {
        self.step.differences(&[], &scaled(self.direction, self.modulus + by))
    }

    /// The roots ahead by branch, where each is clearly the continuation of one.
    fn ahead(&self, by: f64) -> Option<Vec<Complex64>> {
        let roots = self.roots_ahead(by);
        let mut taken = vec![false; roots.len()];
        let mut found = Vec::with_capacity(roots.len());
        for expected in self.expected(by) {
            let (mut best, mut least) = (None, f64::INFINITY);
            for (index, root) in roots.iter().enumerate().filter(|(index, _)| !taken[*index]) {
                let far = distance(*root, expected);
                if far < least {
                    (best, least) = (Some(index), far);
                }
            }
            let best = best?;
            let same = |root: &Complex64| {
                distance(*root, roots[best]) <= SAME * roots[best].norm().min(1.0)
            };
            let others = roots.iter().filter(|root| !same(root));
            if others.into_iter().any(|other| distance(*other, expected) < CLEAR * least) {
                return None;
            }
            taken[best] = true;
            found.push(roots[best]);
        }
        Some(found)
    }

    /// The roots ahead by branch, each the nearest that is left; of two that are about as near the larger multiplier.
    fn nearest(&self, by: f64) -> Vec<Complex64> {
        let mut left = self.roots_ahead(by);
        let of = |expected: Complex64, left: &[Complex64]| {
            let least = left.iter().map(|y| distance(*y, expected)).fold(f64::INFINITY, f64::min);
            let near = left.iter().enumerate();
            let near = near.filter(|(_, y)| distance(**y, expected) <= 1.5 * least + SHORTEST);
            near.max_by(|(_, a), (_, b)| (*a + 1.0).norm().total_cmp(&(*b + 1.0).norm()))
                .map_or(0, |(index, _)| index)
        };
        let expected = self.roots.clone();
        expected.into_iter().map(|y| left.swap_remove(of(y, &left))).collect()
    }
}

/// On the Riemann sphere, so that a root may pass infinity; the ordinary distance between small numbers.
fn distance(a: Complex64, b: Complex64) -> f64 {
    let size = |y: Complex64| (1.0 + y.norm_sqr()).sqrt();
    match (a.is_finite(), b.is_finite()) {
        (true, true) => (a - b).norm() / (size(a) * size(b)),
        (true, false) => 1.0 / size(a),
        (false, true) => 1.0 / size(b),
        (false, false) => 0.0,
    }
}
