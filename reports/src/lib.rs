//! Tables, figures and reports: what turns computed results into documents.
//!
//! [`figure`] draws: plain data in, PNG or SVG bytes out. [`table`] sets numbers, [`page`] puts both into a
//! report, [`publish`] writes files whole or not at all. Each paper has a module of its own.

pub mod advection_profile;
pub mod advection_validation;
pub mod certificate_file;
pub mod ferrari2008;
pub mod figure;
pub mod gas_run;
pub mod npy;
pub mod number;
pub mod page;
pub mod publish;
pub mod record;
pub mod run_record;
pub mod stability_map;
pub mod table;
pub mod wave_map;

/// A table or figure of a report, for listing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CatalogueItem {
    /// The name of its files.
    pub name: &'static str,
    /// What it shows.
    pub description: &'static str,
    /// The paper and its number there.
    pub source: &'static str,
}

/// The lists of the reports' parts.
const LISTS: &[&[CatalogueItem]] = &[ferrari2008::CATALOGUE, ferrari2008::section_3::CATALOGUE];

/// Every table and figure a report makes.
pub const CATALOGUE: &[CatalogueItem] = &joined::<{ total(LISTS) }>(LISTS);

const fn total(lists: &[&[CatalogueItem]]) -> usize {
    let (mut count, mut i) = (0, 0);
    while i < lists.len() {
        count += lists[i].len();
        i += 1;
    }
    count
}

/// The lists one after the other; iterators are not for constants.
const fn joined<const N: usize>(lists: &[&[CatalogueItem]]) -> [CatalogueItem; N] {
    let mut all = [lists[0][0]; N];
    let (mut next, mut i) = (0, 0);
    while i < lists.len() {
        let mut j = 0;
        while j < lists[i].len() {
            all[next] = lists[i][j];
            next += 1;
            j += 1;
        }
        i += 1;
    }
    all
}
