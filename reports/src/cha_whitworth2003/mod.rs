//! Cha & Whitworth 2003: "Implementations and tests of Godunov-type particle hydrodynamics", Monthly Notices of the
//! Royal Astronomical Society 340, 73–90.

pub mod dispersion;
pub mod particle_tests;

pub use crate::ferrari2008::{Detail, ReportError};

use crate::page::Section;
use courant_analysis::sweep::Progress;

/// The command that makes this report.
pub const COMMAND: &str = "courant report cha-whitworth2003";

/// The sections of the report, in the order of the paper.
///
/// # Errors
/// When the callback stops the work, or a figure cannot be composed.
pub fn sections(detail: Detail, progress: Progress<'_>) -> Result<Vec<Section>, ReportError> {
    let mut sections = dispersion::dispersion_sections(detail, progress)?;
    sections.extend(particle_tests::sections(detail, progress)?);
    Ok(sections)
}
