//! The cells of a torus and its waves.

use super::SteppingError;
use num_complex::Complex64;
use num_integer::Integer;
use serde::{Serialize, Serializer};
use std::f64::consts::TAU;
use std::ops::Deref;

/// One value for each axis; a single one is serialised as itself, several as a list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PerAxis<T>(pub Vec<T>);

impl<T> Deref for PerAxis<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T: Serialize> Serialize for PerAxis<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0.as_slice() {
            [one] => one.serialize(serializer),
            several => several.serialize(serializer),
        }
    }
}

impl<T: ToString> PerAxis<T> {
    /// All values with something between them.
    pub fn joined(&self, between: &str) -> String {
        self.0.iter().map(T::to_string).collect::<Vec<_>>().join(between)
    }
}

/// A periodic lattice in one, two or three dimensions; cells are counted with the last axis fastest.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Lattice {
    points: PerAxis<usize>,
}

impl Lattice {
    pub fn new(points: &[usize]) -> Result<Self, SteppingError> {
        if points.iter().product::<usize>() == 0 {
            return Err(SteppingError::NoCells);
        }
        Ok(Self { points: PerAxis(points.to_vec()) })
    }

    /// How many cells along each axis.
    pub fn points(&self) -> &PerAxis<usize> {
        &self.points
    }

    /// How many cells.
    pub fn cells(&self) -> usize {
        self.points.iter().product()
    }

    /// The cell so many cells away.
    pub fn neighbour(&self, cell: usize, offset: [i32; 3]) -> usize {
        if offset == [0; 3] {
            // Most terms stay in their line.
            return cell;
        }
        let (mut rest, mut stride, mut place) = (cell, 1, 0);
        for (&points, offset) in self.points.iter().zip(offset).rev() {
            let moved = (rest % points) as i64 + i64::from(offset);
            place += stride * moved.rem_euclid(points as i64) as usize;
            (rest, stride) = (rest / points, stride * points);
        }
        place
    }

    /// Adds `factor` times each cell's neighbour at an offset, line by line along the last axis.
    pub fn add_neighbours(&self, sum: &mut [f64], factor: f64, values: &[f64], offset: [i32; 3]) {
        let axis = self.points.len() - 1;
        let length = self.points[axis];
        let mut across = offset;
        across[axis] = 0;
        let turn = i64::from(offset[axis]).rem_euclid(length as i64) as usize;
        for (line, sums) in sum.chunks_exact_mut(length).enumerate() {
            let start = self.neighbour(line * length, across);
            let (left, right) = values[start..start + length].split_at(turn);
            for (sum, value) in sums.iter_mut().zip(right.iter().chain(left)) {
                *sum += factor * value;
            }
        }
    }

    /// The waves, each by how many of it there are along each axis, from `−N/2` to `N/2`; of a wave and its conjugate one.
    pub fn modes(&self) -> Vec<PerAxis<i64>> {
        let modes = (0..self.cells()).filter_map(|cell| {
            let (mut rest, mut mode, mut conjugate) = (cell, Vec::new(), Vec::new());
            for &points in self.points.iter().rev() {
                mode.insert(0, rest % points);
                conjugate.insert(0, (points - rest % points) % points);
                rest /= points;
            }
            let signed = mode.iter().zip(self.points.iter()).map(|(&mode, &points)| {
                if 2 * mode > points { mode as i64 - points as i64 } else { mode as i64 }
            });
            (mode <= conjugate).then(|| PerAxis(signed.collect()))
        });
        modes.collect()
    }

    /// `φ_a = 2π mode_a/N_a`.
    pub fn phase(&self, mode: &[i64]) -> PerAxis<f64> {
        let phases = mode.iter().zip(self.points.iter());
        PerAxis(phases.map(|(&mode, &points)| TAU * mode as f64 / points as f64).collect())
    }

    /// `e^{iφ·j}` at each cell.
    pub fn wave(&self, mode: &[i64]) -> impl Iterator<Item = Complex64> {
        // Turns over a common denominator, so that one rounding is left.
        let common = self.points.iter().fold(1, |common: usize, points| common.lcm(points)) as i64;
        (0..self.cells()).map(move |cell| {
            let (mut rest, mut turns) = (cell, 0);
            for (&mode, &points) in mode.iter().zip(self.points.iter()).rev() {
                let (along, points_) = ((rest % points) as i64, points as i64);
                turns += mode * along % points_ * (common / points_);
                rest /= points;
            }
            Complex64::from_polar(1.0, TAU * (turns.rem_euclid(common) as f64 / common as f64))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_go_around_each_axis() {
        let torus = Lattice::new(&[3, 4]).unwrap();
        let cell = |i: usize, j: usize| 4 * i + j;
        assert_eq!(torus.neighbour(cell(2, 3), [1, 1, 0]), cell(0, 0));
        assert_eq!(torus.neighbour(cell(0, 1), [-4, -6, 0]), cell(2, 3));
        let values: Vec<f64> = (0..12).map(f64::from).collect();
        let mut sum = vec![0.0; 12];
        torus.add_neighbours(&mut sum, 2.0, &values, [-1, 2, 0]);
        let expected: Vec<f64> =
            (0..12).map(|place| 2.0 * torus.neighbour(place, [-1, 2, 0]) as f64).collect();
        assert_eq!(sum, expected);
        assert_eq!(Lattice::new(&[3, 0]).err(), Some(SteppingError::NoCells));
    }

    #[test]
    fn one_value_is_written_as_itself() {
        assert_eq!(serde_json::to_string(&PerAxis(vec![3])).unwrap(), "3");
        assert_eq!(serde_json::to_string(&PerAxis(vec![3, -1])).unwrap(), "[3,-1]");
        assert_eq!(PerAxis(vec![12, 10]).joined(" × "), "12 × 10");
    }
}
