//! The two frequencies of a mode, by formulas without cancellation, as two branches that are continuous
//! from the sound waves `ω = ±cκ`.

use num_complex::Complex64;

/// What the two waves of a mode do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// They travel, `Re ω ≠ 0`, and do not grow. Of a single wave: it does.
    Propagating,
    /// `b² > 4ω0² > 0`: both decay without travelling. Not an instability — Cha & Whitworth 2003 blacken
    /// this region in their Figure 3 and call it unstable.
    OverDamped,
    /// `b² = 4ω0²`: both decay with the same rate.
    CriticallyDamped,
    /// `ω0² = 0`: a displacement feels no force and stays. Without damping the mode drifts with constant
    /// velocity; that is what the equations say and no failure of a time step. `κ = 0` is always one.
    ZeroFrequency,
    /// One wave grows.
    Growing,
}

impl Regime {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Propagating => "propagating",
            Self::OverDamped => "over-damped",
            Self::CriticallyDamped => "critically-damped",
            Self::ZeroFrequency => "zero-frequency",
            Self::Growing => "growing",
        }
    }
}

/// One of the two waves of a mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Branch {
    /// Continuous from `ω = cκ`.
    Forward,
    /// Continuous from `ω = −cκ`.
    Backward,
}

impl Branch {
    /// Both, forward first.
    pub const ALL: [Self; 2] = [Self::Forward, Self::Backward];

    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
        }
    }
}

/// The frequencies of the two waves of a mode, in units of `c/Δ`.
///
/// Where both stop travelling the branches meet, and either continuation is continuous: the forward one
/// is then the wave that lasts longer. It is the only one that can grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frequencies {
    /// The wave continuous from `ω = cκ`.
    pub forward: Complex64,
    /// The wave continuous from `ω = −cκ`.
    pub backward: Complex64,
    /// What the pair does: growing as soon as one of them grows.
    pub regime: Regime,
}

impl Frequencies {
    /// The roots of `ω² + i b ω − ω0² = 0` with `b ≥ 0`.
    ///
    /// ```
    /// use courant_analysis::waves::dispersion::{Frequencies, Regime};
    /// // 1e-8 beside 1: the difference of the textbook formula would have half its digits.
    /// let waves = Frequencies::of(1e-16, 1.0);
    /// assert_eq!(waves.regime, Regime::OverDamped);
    /// assert!((waves.forward.im / -1e-16 - 1.0).abs() < 1e-15);
    /// ```
    pub fn of(restoring: f64, damping: f64) -> Self {
        let imaginary = |value: f64| Complex64::new(0.0, value);
        if restoring < 0.0 {
            // One root grows, whatever the damping.
            let reach = damping + (damping * damping - 4.0 * restoring).sqrt();
            return Self {
                forward: imaginary(-2.0 * restoring / reach),
                backward: imaginary(-0.5 * reach),
                regime: Regime::Growing,
            };
        }
        if restoring == 0.0 {
            return Self {
                forward: Complex64::ZERO,
                backward: imaginary(-damping),
                regime: Regime::ZeroFrequency,
            };
        }
        let frequency = restoring.sqrt();
        // 4ω0² − b² as a product: exact to rounding where the two are close.
        let discriminant = (2.0 * frequency - damping) * (2.0 * frequency + damping);
        if discriminant > 0.0 {
            let real = 0.5 * discriminant.sqrt();
            return Self {
                forward: Complex64::new(real, -0.5 * damping),
                backward: Complex64::new(-real, -0.5 * damping),
                regime: Regime::Propagating,
            };
        }
        let reach = damping + (-discriminant).sqrt();
        Self {
            forward: imaginary(-2.0 * restoring / reach),
            backward: imaginary(-0.5 * reach),
            regime: if discriminant == 0.0 { Regime::CriticallyDamped } else { Regime::OverDamped },
        }
    }

    /// The frequency of one branch.
    pub fn branch(&self, branch: Branch) -> Complex64 {
        match branch {
            Branch::Forward => self.forward,
            Branch::Backward => self.backward,
        }
    }

    /// What one of the two waves does. It differs from what the pair does where only the other one grows.
    ///
    /// ```
    /// use courant_analysis::waves::dispersion::{Branch, Frequencies, Regime};
    /// let waves = Frequencies::of(-1.0, 0.5);
    /// assert_eq!(waves.regime_of(Branch::Forward), Regime::Growing);
    /// assert_eq!(waves.regime_of(Branch::Backward), Regime::OverDamped);
    /// ```
    pub fn regime_of(&self, branch: Branch) -> Regime {
        let omega = self.branch(branch);
        match self.regime {
            Regime::Growing if omega.im > 0.0 => Regime::Growing,
            Regime::Growing if omega.re != 0.0 => Regime::Propagating,
            Regime::Growing => Regime::OverDamped,
            other => other,
        }
    }

    /// The larger growth rate `Im ω` of the two, in units of `c/Δ`.
    pub fn growth_rate(&self) -> f64 {
        self.forward.im.max(self.backward.im)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_roots_solve_the_relation(restoring in -3.0f64..9.0, damping in 0.0f64..6.0) {
            let waves = Frequencies::of(restoring, damping);
            for omega in Branch::ALL.map(|branch| waves.branch(branch)) {
                let residual = omega * omega + Complex64::new(0.0, damping) * omega - restoring;
                prop_assert!(residual.norm() < 1e-13 * (1.0 + omega.norm_sqr() + damping * damping));
            }
            prop_assert!(waves.forward.re >= waves.backward.re);
            prop_assert!(waves.forward.im >= waves.backward.im);
            prop_assert_eq!(waves.regime == Regime::Growing, waves.growth_rate() > 0.0);
            for branch in Branch::ALL {
                let grows = waves.regime_of(branch) == Regime::Growing;
                prop_assert_eq!(grows, waves.branch(branch).im > 0.0);
            }
        }

        #[test]
        fn a_path_around_critical_damping_is_continuous(scale in 0.1f64..3.0) {
            // Through b = 2ω0 in small steps: both branches move by at most √(step) there.
            let mut last = Frequencies::of(scale, 0.0);
            for index in 1..=4000 {
                let damping = f64::from(index) * 1e-3 * scale.sqrt();
                let next = Frequencies::of(scale, damping);
                let reach = 0.1 * scale.sqrt();
                prop_assert!((next.forward - last.forward).norm() < reach);
                prop_assert!((next.backward - last.backward).norm() < reach);
                last = next;
            }
        }
    }

    #[test]
    fn regimes_are_named() {
        assert_eq!(Frequencies::of(1.0, 2.0).regime, Regime::CriticallyDamped);
        assert_eq!(Frequencies::of(1.0, 2.1).regime, Regime::OverDamped);
        assert_eq!(Frequencies::of(0.0, 0.0).regime, Regime::ZeroFrequency);
        assert_eq!(Frequencies::of(0.0, 1.0).backward, Complex64::new(0.0, -1.0));
        assert_eq!(Frequencies::of(-1.0, 0.0).forward, Complex64::new(0.0, 1.0));
    }
}
