//! The state of all particles or cells at one time.

/// Columns of equal length, in the order of the particles at the start (cells: from left to right).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Profile {
    /// Positions.
    pub x: Vec<f64>,
    /// Densities.
    pub density: Vec<f64>,
    /// Velocities.
    pub velocity: Vec<f64>,
    /// Pressures.
    pub pressure: Vec<f64>,
    /// Specific internal energies; none for an isothermal gas.
    pub energy: Vec<f64>,
    /// Masses of particles; none for cells.
    pub mass: Vec<f64>,
    /// Smoothing lengths, of methods that have them.
    pub smoothing: Vec<f64>,
}

impl Profile {
    /// How many particles there are.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Whether the particles still stand in the order in which they started: none has passed
    /// another.
    pub fn order_preserved(&self) -> bool {
        self.x.windows(2).all(|pair| pair[0] < pair[1])
    }

    /// The indices of the particles in `[from, to]`, in ascending order of position.
    pub fn inside(&self, [from, to]: [f64; 2]) -> Vec<usize> {
        let mut indices: Vec<usize> =
            (0..self.len()).filter(|&i| self.x[i] >= from && self.x[i] <= to).collect();
        indices.sort_by(|&a, &b| self.x[a].total_cmp(&self.x[b]));
        indices
    }
}
