//! Exact arithmetic: rationals, balls, Laurent polynomials, real roots, Bernstein coefficients.

pub mod algebraic_number;
pub mod bernstein;
pub mod common_factor;
pub mod cosine_series;
pub mod descartes;
pub mod discriminant;
pub mod enclosed_series;
pub mod factored;
pub mod fixed_point;
pub mod float;
pub mod interval;
pub mod laurent;
pub mod matrix;
pub mod modular;
pub mod polynomial;
pub mod rational;
pub mod rational_function;
pub mod real_roots;
pub mod stencil;
pub mod tensor;
pub(crate) mod torus_series;
pub(crate) mod unit_interval;
