//! One value for each of density, velocity, pressure and energy.

/// One value for each column of a profile.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Columns<T> {
    /// For the density.
    pub density: T,
    /// For the velocity.
    pub velocity: T,
    /// For the pressure.
    pub pressure: T,
    /// For the specific internal energy.
    pub energy: T,
}

impl<T> Columns<T> {
    /// The same function of each.
    pub fn map<U>(self, mut function: impl FnMut(T) -> U) -> Columns<U> {
        Columns {
            density: function(self.density),
            velocity: function(self.velocity),
            pressure: function(self.pressure),
            energy: function(self.energy),
        }
    }
}

impl Columns<f64> {
    /// Each over its scale.
    pub(super) fn over(self, scale: &Self) -> Self {
        Self {
            density: self.density / scale.density,
            velocity: self.velocity / scale.velocity,
            pressure: self.pressure / scale.pressure,
            energy: self.energy / scale.energy,
        }
    }
}

/// A measure of each column from the values found and something exact.
pub(super) fn per_column<T>(
    found: &Columns<Vec<f64>>,
    exact: &Columns<T>,
    measure: impl Fn(&[f64], &T) -> f64,
) -> Columns<f64> {
    Columns {
        density: measure(&found.density, &exact.density),
        velocity: measure(&found.velocity, &exact.velocity),
        pressure: measure(&found.pressure, &exact.pressure),
        energy: measure(&found.energy, &exact.energy),
    }
}
