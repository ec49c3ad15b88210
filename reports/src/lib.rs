//! Tables, figures and reports: what turns computed results into documents.
//!
//! [`figure`] draws: plain data in, PNG or SVG bytes out. [`table`] sets numbers, [`page`] puts both into a
//! report, [`publish`] writes files whole or not at all. [`study`] looks at schemes and scenes for any report; each paper has a
//! module of its own for what is special to it.

pub mod advection_profile;
pub mod advection_validation;
pub mod certificate_file;
pub mod cha_whitworth2003;
pub mod claim;
pub mod cloud_profile;
pub mod equation_validation;
pub mod ferrari2008;
pub mod field_profile;
pub mod figure;
pub mod gas_run;
pub mod latex;
pub mod level_set;
mod markup;
pub mod npy;
pub mod number;
pub mod page;
pub mod paper_text;
pub mod part;
pub mod particle_profile;
pub mod particle_validation;
pub mod plane_map;
pub mod publish;
pub mod record;
pub mod report;
pub mod run_record;
pub mod stability_map;
pub mod step_limit;
pub mod step_map;
pub mod study;
pub mod subject;
pub mod symbol;
pub mod table;
pub mod timing;
pub mod wave_curves;
pub mod wave_map;

/// A table or figure of a report, for listing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CatalogueItem<'a> {
    /// The name of its files.
    pub name: &'a str,
    /// What it shows.
    pub description: &'a str,
    /// The paper and its number there.
    pub source: &'a str,
}
