//! Schemes for tests.

use crate::exact::rational::{Rational, to_text};
use crate::exact::stencil::Stencil;
use crate::kernel::Kernel;
use crate::scheme::{Step, catalogue};
use num_traits::Zero;

/// The advection schemes with kernel sums.
pub(crate) const SPH: [&str; 3] = ["euler-sph", "lax-wendroff-sph", "godunov-sph"];

/// A scheme of the catalogue with a kernel.
pub(crate) fn sph(scheme: &str, kernel: Kernel, ratio: &Rational) -> Step {
    catalogue::scheme(scheme).unwrap().with_kernel(kernel, ratio).unwrap()
}

/// `u_j^{n+1} = Σ_p C^p (S_p u^n)_j` from `[S_0, S_1, …]`, by way of its text.
pub(crate) fn step_of(stencils: &[Stencil<Rational>]) -> Step {
    let mut text = String::from("u[n+1,j] = 0*C*u[n,j]");
    for (power, stencil) in stencils.iter().enumerate() {
        for (offset, value) in stencil.terms().filter(|(_, value)| !value.is_zero()) {
            text.push_str(&format!(" + ({})*C^{power}*u[n,j{offset:+}]", to_text(value)));
        }
    }
    Step::from_text(&text).unwrap()
}
