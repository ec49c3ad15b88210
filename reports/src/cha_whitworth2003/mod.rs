//! Cha & Whitworth 2003: "Implementations and tests of Godunov-type particle hydrodynamics", Monthly Notices of the
//! Royal Astronomical Society 340, 73–90.

mod collapse;
pub mod dispersion;
pub mod particle_tests;
pub mod published;
mod shear;

use crate::paper_text::PaperText;
use crate::part::Part;
use crate::report::Detail;
use std::sync::LazyLock;

/// The words of the report, and what it shows.
pub fn text() -> &'static PaperText {
    static TEXT: LazyLock<PaperText> = LazyLock::new(|| {
        PaperText::from_toml(include_str!("../../papers/cha_whitworth2003/items.toml"))
            .expect("the words are read by a test")
    });
    &TEXT
}

/// The parts of the report in the order of its page.
pub fn parts(detail: Detail) -> Vec<Part> {
    let mut parts = dispersion::parts(detail);
    parts.push(Part::new("particle tests", move || Ok(particle_tests::sections(detail))));
    parts.push(Part::new("shear", move || Ok(shear::sections(detail))));
    parts.push(Part::new("collapse", move || Ok(collapse::sections(detail))));
    parts
}
