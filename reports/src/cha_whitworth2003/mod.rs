//! Cha & Whitworth 2003: "Implementations and tests of Godunov-type particle hydrodynamics", Monthly Notices of the
//! Royal Astronomical Society 340, 73–90.

pub mod dispersion;
pub mod particle_tests;
pub mod published;

pub use crate::ferrari2008::{Detail, ReportError};

use crate::page::Publish;
use courant_analysis::waves::sweep::Progress;

/// The command that makes this report.
pub const COMMAND: &str = "courant report cha-whitworth2003";

/// Hands over the sections of the report as they are finished.
///
/// # Errors
/// When the callback stops the work, a figure cannot be composed or a section cannot be published.
pub fn publish_sections(
    detail: Detail,
    progress: Progress<'_>,
    publish: &mut Publish<'_>,
) -> Result<(), ReportError> {
    dispersion::publish_sections(detail, progress, publish)?;
    particle_tests::publish_sections(detail, progress, publish)
}
