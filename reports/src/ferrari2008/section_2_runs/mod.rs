//! The advection schemes of section 2, run: Figure 2, predicted against measured, growth at the printed
//! Courant numbers, limits by run, disorder, and speed against error.

mod disorder;
mod figure_2;
mod limits_by_run;
mod predicted_measured;
mod printed_growth;
mod speed;

use super::{Detail, ReportError};
use crate::page::{Publish, Section};
use courant_analysis::exact::rational::Rational;
use courant_analysis::kernel::Kernel;
use courant_analysis::waves::sweep::{Progress, SweepError};
use courant_simulation::advection::{AdvectionScheme, Discretisation};

/// The stages of these sections, for the progress bar.
const STAGES: usize = 6;

/// Hands over the sections as they are finished.
///
/// # Errors
/// When the callback stops the work, a figure cannot be composed or a section cannot be published.
pub fn publish_sections(
    detail: Detail,
    progress: Progress<'_>,
    publish: &mut Publish<'_>,
) -> Result<(), ReportError> {
    type Stage = fn(Detail) -> Result<Section, ReportError>;
    let stages: [Stage; STAGES] = [
        figure_2::section,
        predicted_measured::section,
        printed_growth::section,
        limits_by_run::section,
        disorder::section,
        // The last: its times are taken alone.
        speed::section,
    ];
    for (done, stage) in stages.into_iter().enumerate() {
        if progress(done, STAGES).is_break() {
            return Err(SweepError::Cancelled.into());
        }
        publish(stage(detail)?)?;
    }
    if progress(STAGES, STAGES).is_break() {
        return Err(SweepError::Cancelled.into());
    }
    Ok(())
}

/// The kernels looked at.
fn kernels(detail: Detail) -> &'static [Kernel] {
    match detail {
        Detail::Full => &Kernel::ALL,
        Detail::Quick => &[Kernel::CubicSpline, Kernel::Gaussian],
    }
}

/// A discretisation whose ratio is written in the source.
fn discretisation(scheme: AdvectionScheme, kernel: Kernel, ratio: Rational) -> Discretisation {
    Discretisation::new(scheme, kernel, ratio).expect("the ratio is within [1/100, 50]")
}
