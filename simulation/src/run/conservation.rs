//! Conservation: what a run lost or gained.

/// The drift of the conserved quantities: the change since the start less the flow through
/// the ends, over a scale that does not vanish.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Conservation {
    /// Over the mass at the start. Zero by construction where particles carry their mass.
    pub mass: f64,
    /// Over `Σ m (|v| + c)` at the start.
    pub momentum: f64,
    /// Over the total energy at the start.
    pub energy: f64,
    /// The drift of the volume `Σ m V` over the volume at the start, for methods that advance the
    /// specific volume.
    pub volume: Option<f64>,
}

/// Totals of mass (or, in mass coordinates, volume), momentum and energy.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Totals(pub [f64; 3]);

impl Totals {
    /// The sum in the given order; the same for any number of threads.
    pub fn sum(parts: impl Iterator<Item = [f64; 3]>) -> Self {
        let mut total = [0.0; 3];
        for part in parts {
            for (sum, value) in total.iter_mut().zip(part) {
                *sum += value;
            }
        }
        Self(total)
    }

    /// `(self − start − inflow)/scale`, each.
    pub fn drift(self, start: Self, inflow: Self, scale: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| (self.0[k] - start.0[k] - inflow.0[k]) / scale[k])
    }
}
