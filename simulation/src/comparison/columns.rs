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

/// A measure of each column from the values found, the exact ones and a scale.
pub(super) fn per_column(
    found: &Columns<Vec<f64>>,
    exact: &Columns<Vec<f64>>,
    scale: &Columns<f64>,
    measure: impl Fn(&[f64], &[f64], f64) -> f64,
) -> Columns<f64> {
    Columns {
        density: measure(&found.density, &exact.density, scale.density),
        velocity: measure(&found.velocity, &exact.velocity, scale.velocity),
        pressure: measure(&found.pressure, &exact.pressure, scale.pressure),
        energy: measure(&found.energy, &exact.energy, scale.energy),
    }
}
