//! The advection schemes of section 2, run: Figure 2, predicted against measured, growth at the printed
//! Courant numbers, limits by run, disorder, and speed against error.

mod disorder;
mod figure_2;
mod limits_by_run;
mod predicted_measured;
mod printed_growth;
mod speed;

use super::{Detail, text};
use crate::page::Section;
use crate::part::Part;
use courant_analysis::exact::rational::Rational;
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::{AdvectionScheme, Discretisation};

/// The parts of these sections.
pub fn parts(detail: Detail) -> [Part; 6] {
    let section = |make: fn(Detail) -> Section| move || Ok(vec![make(detail)]);
    [
        Part::new("Figure 2", section(|_| figure_2::section())),
        Part::new("predicted against measured", section(predicted_measured::section)),
        Part::new("growth at printed limits", section(|_| printed_growth::section())),
        Part::new("limits by run", section(limits_by_run::section)),
        Part::new("disordered positions", section(disorder::section)),
        Part::new("work against error", section(speed::section)),
    ]
}

/// The kernels looked at.
fn kernels(detail: Detail) -> &'static [Kernel] {
    match detail {
        Detail::Quick => &[Kernel::CubicSpline, Kernel::Gaussian],
        Detail::Standard | Detail::Full => &Kernel::ALL,
    }
}

/// A discretisation whose ratio is written in the source.
fn discretisation(scheme: AdvectionScheme, kernel: Kernel, ratio: Rational) -> Discretisation {
    Discretisation::new(scheme, kernel, ratio).expect("the ratio is within [1/100, 50]")
}
