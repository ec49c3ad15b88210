//! Lattices of particles that fill a periodic box.

#[cfg(test)]
mod tests;

use serde::Deserialize;

/// A lattice with a rectangular cell.
///
/// ```
/// use courant_simulation::lattice::Lattice;
/// let filling = Lattice::Hexagonal.fill([0.0, 0.0], [1.0, 1.0], 2500).expect("a lattice of the plane");
/// // 47 columns on a unit length; the box is as high as 54 rows of equilateral triangles are.
/// assert_eq!(filling.positions.len(), 47 * 54);
/// assert!((filling.upper[1] - 27.0 * 3f64.sqrt() / 47.0).abs() < 1e-15 && filling.upper[0] == 1.0);
/// assert!(Lattice::Cubic.fill([0.0, 0.0], [1.0, 1.0], 2500).is_none());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lattice {
    /// The corners of squares.
    Square,
    /// The corners of equilateral triangles, in rows along the first axis.
    Hexagonal,
    /// The corners of cubes.
    Cubic,
    /// Corners and centres of cubes.
    #[serde(rename = "bcc")]
    BodyCentred,
    /// Corners and centres of the faces of cubes: close packing in layers ABC.
    #[serde(rename = "fcc")]
    FaceCentred,
    /// Close packing in layers AB, hexagonal in the first two axes.
    #[serde(rename = "hcp")]
    HexagonalClose,
}

/// Positions that fill a box, and the box.
#[derive(Debug, Clone, PartialEq)]
pub struct Filling<const D: usize> {
    /// The positions, last axis fastest by cells.
    pub positions: Vec<[f64; D]>,
    /// The upper corner: periods of the lattice away from the lower one.
    pub upper: [f64; D],
}

impl Lattice {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Square,
        Self::Hexagonal,
        Self::Cubic,
        Self::BodyCentred,
        Self::FaceCentred,
        Self::HexagonalClose,
    ];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Square => "square",
            Self::Hexagonal => "hexagonal",
            Self::Cubic => "cubic",
            Self::BodyCentred => "bcc",
            Self::FaceCentred => "fcc",
            Self::HexagonalClose => "hcp",
        }
    }

    /// The dimension of the space it fills.
    pub fn dimension(self) -> usize {
        match self {
            Self::Square | Self::Hexagonal => 2,
            _ => 3,
        }
    }

    /// The edges of its smallest rectangular cell, the first one 1.
    fn cell(self) -> [f64; 3] {
        match self {
            Self::Hexagonal => [1.0, 3f64.sqrt(), 1.0],
            Self::HexagonalClose => [1.0, 3f64.sqrt(), (8.0 / 3f64).sqrt()],
            _ => [1.0; 3],
        }
    }

    /// The points in a cell, in parts of its edges.
    fn points(self) -> &'static [[f64; 3]] {
        const SIXTH: f64 = 1.0 / 6.0;
        match self {
            Self::Square | Self::Cubic => &[[0.0; 3]],
            Self::Hexagonal => &[[0.0; 3], [0.5, 0.5, 0.0]],
            Self::BodyCentred => &[[0.0; 3], [0.5; 3]],
            Self::FaceCentred => &[[0.0; 3], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]],
            Self::HexagonalClose => {
                &[[0.0; 3], [0.5, 0.5, 0.0], [0.0, 2.0 * SIXTH, 0.5], [0.5, 5.0 * SIXTH, 0.5]]
            }
        }
    }

    /// Fills a periodic box with about `count` particles: whole cells along each axis. The first edge of the box is
    /// kept, the others become the nearest multiples of the cell. `None` for a lattice of another dimension.
    ///
    /// The points of a cell lie about its middle, so that no particle is at the edge of the box.
    pub fn fill<const D: usize>(
        self,
        lower: [f64; D],
        upper: [f64; D],
        count: usize,
    ) -> Option<Filling<D>> {
        if self.dimension() != D {
            return None;
        }
        let (cell, points) = (self.cell(), self.points());
        let edge = |axis: usize| upper[axis] - lower[axis];
        let volume: f64 = (0..D).map(|axis| edge(axis) / cell[axis]).product();
        let wanted = (volume * points.len() as f64 / count.max(1) as f64).powf(1.0 / D as f64);
        let whole = |length: f64| length.round().max(1.0);
        let first = whole(edge(0) / (wanted * cell[0]));
        let scale = edge(0) / (first * cell[0]);
        let cells: [f64; D] = std::array::from_fn(|axis| {
            if axis == 0 { first } else { whole(edge(axis) / (scale * cell[axis])) }
        });
        let mean =
            |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / points.len() as f64;
        let offset: [f64; D] = std::array::from_fn(|axis| 0.5 - mean(axis));
        let number: usize = cells.iter().map(|&along| along as usize).product();
        let mut positions = Vec::with_capacity(number * points.len());
        for index in 0..number {
            let mut rest = index;
            let mut corner = [0.0; D];
            for axis in (0..D).rev() {
                let along = cells[axis] as usize;
                corner[axis] = (rest % along) as f64;
                rest /= along;
            }
            positions.extend(points.iter().map(|point| {
                std::array::from_fn(|axis| {
                    let place = corner[axis] + point[axis] + offset[axis];
                    lower[axis] + place * scale * cell[axis]
                })
            }));
        }
        let end = |axis: usize| {
            if axis == 0 { upper[0] } else { lower[axis] + cells[axis] * scale * cell[axis] }
        };
        Some(Filling { positions, upper: std::array::from_fn(end) })
    }
}
