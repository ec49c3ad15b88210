//! Tables, figures and reports: what turns computed results into documents.
//!
//! [`figure`] draws: plain data in, PNG or SVG bytes out. Writing files is left to the caller.

pub mod figure;
