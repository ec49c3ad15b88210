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

    /// Column by column with another.
    pub(super) fn zip<U>(self, other: Columns<U>) -> Columns<(T, U)> {
        Columns {
            density: (self.density, other.density),
            velocity: (self.velocity, other.velocity),
            pressure: (self.pressure, other.pressure),
            energy: (self.energy, other.energy),
        }
    }

    /// Each by reference.
    pub(super) fn each(&self) -> Columns<&T> {
        let Self { density, velocity, pressure, energy } = self;
        Columns { density, velocity, pressure, energy }
    }
}
