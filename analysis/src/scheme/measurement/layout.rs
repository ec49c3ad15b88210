//! How the numbers of a state lie in memory.

/// Numbers of a state at most: 800 MB are enough for a mistake.
pub const MOST_VALUES: usize = 100_000_000;

/// The values of a state on a periodic lattice: time levels (oldest first), unknowns, cells, the last axis fastest (C order).
///
/// ```
/// use courant_analysis::scheme::measurement::StateLayout;
/// let layout = StateLayout { levels: 1, unknowns: 2, size: vec![3, 4] };
/// assert_eq!((layout.cells(), layout.values(), layout.state_shape()), (12, 24, vec![2, 3, 4]));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StateLayout {
    /// Time levels that a step starts from.
    pub levels: usize,
    /// Unknowns of one level.
    pub unknowns: usize,
    /// Cells along each axis.
    pub size: Vec<usize>,
}

impl StateLayout {
    /// Cells of the lattice.
    pub fn cells(&self) -> usize {
        self.size.iter().product()
    }

    /// Numbers of a state.
    pub fn values(&self) -> usize {
        self.levels * self.unknowns * self.cells()
    }

    /// The shape of a state as an array: the axes of levels and of unknowns are left out where there is one.
    pub fn state_shape(&self) -> Vec<usize> {
        let leading = [self.levels, self.unknowns].into_iter().filter(|&count| count > 1);
        leading.chain(self.size.iter().copied()).collect()
    }

    /// The shape of the new level.
    pub fn answer_shape(&self) -> Vec<usize> {
        Self { levels: 1, ..self.clone() }.state_shape()
    }

    /// Whether a state has no more numbers than [`MOST_VALUES`].
    pub fn fits(&self) -> bool {
        let product = |all: usize, &size: &usize| all.checked_mul(size);
        let values = self.size.iter().try_fold(self.levels * self.unknowns, product);
        values.is_some_and(|all| all <= MOST_VALUES)
    }

    /// The state that is the same everywhere at all levels: one number for all unknowns, or one for each.
    pub fn uniform(&self, values: &[f64]) -> Vec<f64> {
        let blocks = (0..self.levels * self.unknowns).map(|block| values[block % values.len()]);
        blocks.flat_map(|value| std::iter::repeat_n(value, self.cells())).collect()
    }

    /// The cell of indices, which are taken round the lattice.
    pub(crate) fn cell(&self, indices: &[i64]) -> usize {
        self.size
            .iter()
            .zip(indices)
            .fold(0, |cell, (&size, index)| cell * size + index.rem_euclid(size as i64) as usize)
    }

    /// The indices of a cell.
    pub(crate) fn indices(&self, mut cell: usize) -> Vec<i64> {
        let mut indices = vec![0; self.size.len()];
        for (index, &size) in indices.iter_mut().zip(&self.size).rev() {
            *index = (cell % size) as i64;
            cell /= size;
        }
        indices
    }

    /// What is stored at `j` moves to `j + by`, for every level and unknown.
    pub(crate) fn shifted(&self, values: &[f64], by: &[i64]) -> Vec<f64> {
        let cells = self.cells();
        let mut moved = vec![0.0; values.len()];
        for (place, value) in values.iter().enumerate() {
            let indices = self.indices(place % cells);
            let to: Vec<i64> = indices.iter().zip(by).map(|(index, by)| index + by).collect();
            moved[place / cells * cells + self.cell(&to)] = *value;
        }
        moved
    }

    /// 1 in the middle of one unknown at one level.
    pub(crate) fn impulse(&self, block: usize) -> Vec<f64> {
        let mut state = vec![0.0; self.values()];
        state[block * self.cells() + self.middle()] = 1.0;
        state
    }

    /// The cell of impulses.
    pub(crate) fn middle(&self) -> usize {
        self.cell(&self.size.iter().map(|&size| size as i64 / 2).collect::<Vec<_>>())
    }

    /// Numbers in `[−1, 1)` with ten bits, the same on every run.
    pub(crate) fn random(&self) -> Vec<f64> {
        let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
        let next = || {
            // Steele, Lea & Flood 2014, splitmix64.
            seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mixed = (seed ^ (seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((mixed >> 54) as f64 - 512.0) / 512.0
        };
        std::iter::repeat_with(next).take(self.values()).collect()
    }
}
