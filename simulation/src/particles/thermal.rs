//! The thermal part of a particle's state: nothing at all, or an energy.

/// A thermal state and, by the same type, its rate of change. For `()` every operation vanishes at compile time.
pub trait ThermalState:
    Copy + Default + PartialEq + std::fmt::Debug + Send + Sync + 'static
{
    /// From a specific energy, which is not computed where there is nowhere to put it.
    fn from_energy(energy: impl FnOnce() -> f64) -> Self;

    /// The specific energy, if there is one.
    fn energy(self) -> Option<f64>;

    /// `self + factor·rate`.
    fn plus_scaled(self, factor: f64, rate: Self) -> Self;

    /// Whether the state is one of a gas: an energy must be finite and not negative.
    fn is_physical(self) -> bool;
}

impl ThermalState for () {
    #[inline]
    fn from_energy(_: impl FnOnce() -> f64) {}

    #[inline]
    fn energy(self) -> Option<f64> {
        None
    }

    #[inline]
    fn plus_scaled(self, _: f64, (): ()) {}

    #[inline]
    fn is_physical(self) -> bool {
        true
    }
}

impl ThermalState for f64 {
    #[inline]
    fn from_energy(energy: impl FnOnce() -> f64) -> Self {
        energy()
    }

    #[inline]
    fn energy(self) -> Option<f64> {
        Some(self)
    }

    #[inline]
    fn plus_scaled(self, factor: f64, rate: Self) -> Self {
        self + factor * rate
    }

    #[inline]
    fn is_physical(self) -> bool {
        self.is_finite() && self >= 0.0
    }
}
