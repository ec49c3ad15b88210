//! Arrays that stand for one shape, as NumPy's rules say, without a copy.

use crate::error::bad;
use ndarray::{ArrayViewD, IxDyn};
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;

/// Views of arrays that have one shape.
pub struct Broadcast<'a> {
    pub shape: Vec<usize>,
    views: Vec<ArrayViewD<'a, f64>>,
}

impl<'a> Broadcast<'a> {
    /// # Errors
    /// When the shapes do not go together.
    pub fn new(arrays: &'a [PyReadonlyArrayDyn<'_, f64>]) -> PyResult<Self> {
        let mut shape: Vec<usize> = Vec::new();
        for array in arrays {
            let own = array.as_array();
            let own = own.shape();
            let axes = shape.len().max(own.len());
            let at = |shape: &[usize], axis: usize| {
                (axis + shape.len()).checked_sub(axes).map_or(1, |axis| shape[axis])
            };
            shape = (0..axes)
                .map(|axis| match (at(&shape, axis), at(own, axis)) {
                    (1, length) | (length, 1) => Ok(length),
                    (a, b) if a == b => Ok(a),
                    (a, b) => Err(bad(format!("axes of {a} and {b} values do not go together"))),
                })
                .collect::<PyResult<_>>()?;
        }
        let views = arrays.iter().map(PyReadonlyArrayDyn::as_array).collect();
        Ok(Self { shape, views })
    }

    /// How many points the shape has.
    pub fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// How many arrays there are.
    pub fn arrays(&self) -> usize {
        self.views.len()
    }

    /// The values of all arrays at a point, counted in C order.
    pub fn at(&self, point: usize, values: &mut [f64]) {
        for (value, view) in values.iter_mut().zip(&self.views) {
            let (mut rest, mut index) = (point, vec![0; view.ndim()]);
            for (axis, &length) in self.shape.iter().enumerate().rev() {
                let along = rest % length;
                rest /= length;
                if let Some(own) = (axis + view.ndim()).checked_sub(self.shape.len())
                    && view.shape()[own] > 1
                {
                    index[own] = along;
                }
            }
            *value = view[IxDyn(&index)];
        }
    }
}
