//! The box the particles live in, and the images its boundaries make of them.

use super::vector::Vector;
use crate::boundary::Boundary;

/// A box with a boundary on each axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Domain<const D: usize> {
    /// The lower corner.
    pub lower: Vector<D>,
    /// The upper corner.
    pub upper: Vector<D>,
    /// The boundaries at the lower and the upper end of each axis; periodic at both or at none. To particles a
    /// transmissive end is an open one: the gas beyond it is particles too.
    pub boundary: [[Boundary; 2]; D],
}

/// The map `x ↦ flip·x + shift` (by components) from a particle to one of its images.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Image<const D: usize> {
    /// `+1` or `−1` on each axis; velocities and forces are mapped by it alone.
    pub flip: Vector<D>,
    /// The displacement.
    pub shift: Vector<D>,
}

impl<const D: usize> Image<D> {
    /// A particle itself.
    pub const IDENTITY: Self = Self { flip: [1.0; D], shift: [0.0; D] };

    /// Where the image is.
    #[inline]
    pub fn position(&self, x: &Vector<D>) -> Vector<D> {
        std::array::from_fn(|axis| self.flip[axis] * x[axis] + self.shift[axis])
    }

    /// `image of b − a`. The particles' positions are subtracted before the shift is added, so that
    /// on a lattice the differences across a boundary are rounded like those inside.
    #[inline]
    pub fn displacement(&self, a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
        std::array::from_fn(|axis| (self.flip[axis] * b[axis] - a[axis]) + self.shift[axis])
    }

    /// A vector attached to the particle, as the image shows it. Its own inverse.
    #[inline]
    pub fn reflect(&self, v: &Vector<D>) -> Vector<D> {
        std::array::from_fn(|axis| self.flip[axis] * v[axis])
    }

    /// Whether the image is a reflection, behind which there is a wall and not a particle.
    pub fn reflects(&self) -> bool {
        self.flip.iter().any(|&flip| flip < 0.0)
    }
}

impl<const D: usize> Domain<D> {
    /// A box with the same boundary everywhere.
    pub fn new(lower: Vector<D>, upper: Vector<D>, boundary: Boundary) -> Self {
        Self { lower, upper, boundary: [[boundary; 2]; D] }
    }

    /// The position inside the domain on its periodic axes: whole periods away.
    pub(crate) fn wrap(&self, x: &Vector<D>) -> Vector<D> {
        std::array::from_fn(|axis| {
            let length = self.upper[axis] - self.lower[axis];
            if self.boundary[axis].contains(&Boundary::Periodic) {
                x[axis] - ((x[axis] - self.lower[axis]) / length).floor() * length
            } else {
                x[axis]
            }
        })
    }

    /// All images that can come within `reach` of particles in the box from `low` to `high`,
    /// the identity first. Positions need not be wrapped into the domain.
    pub(super) fn images(
        &self,
        low: &Vector<D>,
        high: &Vector<D>,
        reach: f64,
        images: &mut Vec<Image<D>>,
    ) {
        images.clear();
        images.push(Image::IDENTITY);
        for axis in 0..D {
            // Products of the images found for the axes before this one.
            let known = images.len();
            let mut add = |flip: f64, shift: f64| {
                for index in 0..known {
                    let mut image = images[index];
                    image.flip[axis] = flip;
                    image.shift[axis] = shift;
                    images.push(image);
                }
            };
            let length = self.upper[axis] - self.lower[axis];
            let ends = self.boundary[axis];
            if ends.contains(&Boundary::Periodic) {
                let most = ((high[axis] - low[axis] + reach) / length).floor() as i32;
                for n in 1..=most {
                    add(1.0, f64::from(n) * length);
                    add(1.0, -f64::from(n) * length);
                }
            }
            for (end, wall) in ends.into_iter().zip([self.lower[axis], self.upper[axis]]) {
                if end == Boundary::Mirror {
                    add(-1.0, 2.0 * wall);
                }
            }
        }
    }
}
