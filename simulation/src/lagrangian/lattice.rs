//! The uniform lattice in mass coordinates.

use courant_analysis::kernel::Kernel;

/// The weights of a kernel on the uniform lattice of spacing Δξ: `w_k = Δξ² |W'(kΔξ)|` for the
/// offsets `k = 1, 2, …`, without units. With `W' = w'(q)/l²` and `q = kΔξ/l` this is
/// `|w'(k/ratio)|/ratio²` for `ratio = l/Δξ`.
///
/// ```
/// use courant_analysis::kernel::Kernel;
/// use courant_simulation::lagrangian::Lattice;
/// let lattice = Lattice::new(Kernel::CubicSpline, 2.0)?;
/// // The paper's choice reaches three neighbours: the fourth is on the edge of the support.
/// assert_eq!(lattice.offsets(), &[(1, 5.0 / 32.0), (2, 1.0 / 8.0), (3, 1.0 / 32.0)]);
/// # Ok::<(), courant_simulation::lagrangian::InvalidLattice>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice {
    offsets: Vec<(usize, f64)>,
}

/// Why a ratio does not make a lattice.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum InvalidLattice {
    /// Not a positive number, or so large that the work is quadratic.
    #[error("ratio = {0}: a number above 0 and at most {MAX_RATIO} is needed")]
    Ratio(f64),
    /// The kernel does not reach the next particle.
    #[error("ratio = {ratio}: the kernel `{kernel}` does not reach the next particle")]
    Alone {
        /// The kernel.
        kernel: Kernel,
        /// The smoothing length over the spacing.
        ratio: f64,
    },
}

/// The largest `l/Δξ`: beyond it nothing is resolved and the work is quadratic.
const MAX_RATIO: f64 = 100.0;

impl Lattice {
    /// The lattice of a kernel with `ratio = l/Δξ`.
    ///
    /// # Errors
    /// [`InvalidLattice`], when the ratio is no positive number, too large, or so small that no
    /// particle meets another.
    pub fn new(kernel: Kernel, ratio: f64) -> Result<Self, InvalidLattice> {
        if !(ratio > 0.0 && ratio <= MAX_RATIO) {
            return Err(InvalidLattice::Ratio(ratio));
        }
        let last = (kernel.support() * ratio).floor() as usize;
        let offsets: Vec<_> = (1..=last)
            .map(|k| (k, -kernel.slope(k as f64 / ratio) / (ratio * ratio)))
            .filter(|&(_, weight)| weight > 0.0)
            .collect();
        if offsets.is_empty() {
            return Err(InvalidLattice::Alone { kernel, ratio });
        }
        Ok(Self { offsets })
    }

    /// The offsets `k` with their weights `w_k > 0`, ascending.
    pub fn offsets(&self) -> &[(usize, f64)] {
        &self.offsets
    }

    /// The largest offset.
    pub fn reach(&self) -> usize {
        self.offsets.last().map_or(0, |&(k, _)| k)
    }
}
