//! What the reports on all papers have in common.

use crate::publish::PublishError;
use courant_analysis::waves::sweep::SweepError;

/// How much of a report to make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// A coarse grid: for a first look and for tests.
    Quick,
    /// Everything, long studies at modest sizes.
    Standard,
    /// Long studies at their full sizes.
    Full,
}

/// Why a report has no result.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A sweep stopped.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A figure could not be composed or drawn.
    #[error(transparent)]
    Figure(#[from] crate::figure::FigureError),
    /// A finished section could not be written.
    #[error(transparent)]
    Publish(#[from] PublishError),
}
