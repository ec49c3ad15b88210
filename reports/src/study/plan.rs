//! What a study looks at, as data.

use crate::report::Detail;
use courant_analysis::exact::rational::Rational;
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{Integrator, LatticeMethod, catalogue};
use courant_analysis::waves::sweep::SweepError;
use courant_simulation::advection::{AdvectionScheme, Discretisation};
use serde::de::{Deserialize, Deserializer, Error};
use std::f64::consts::PI;
use std::fmt::Display;
use std::str::FromStr;

/// A value that a file gives by its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<T>(pub T);

impl<'de, T: FromStr<Err: Display>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map(Self).map_err(|error| D::Error::custom(format!("`{text}`: {error}")))
    }
}

/// How much is done by how much of a report is made.
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ByDetail<T> {
    quick: T,
    standard: T,
    full: T,
}

impl<T> ByDetail<T> {
    /// What is done in such a report.
    pub fn at(&self, detail: Detail) -> &T {
        match detail {
            Detail::Quick => &self.quick,
            Detail::Standard => &self.standard,
            Detail::Full => &self.full,
        }
    }
}

/// A scheme on a lattice.
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// The scheme.
    pub scheme: Named<AdvectionScheme>,
    /// The kernel.
    pub kernel: Named<Kernel>,
    /// `l/Δξ`.
    pub ratio: Named<Rational>,
}

impl Case {
    /// The scheme with its sums.
    ///
    /// # Panics
    /// When the ratio is out of range: a fault of the file.
    pub fn discretisation(&self) -> Discretisation {
        discretisation(self.scheme.0, self.kernel.0, &self.ratio.0)
    }

    /// Whether a discretisation is of this case.
    pub fn is(&self, other: &Discretisation) -> bool {
        other.scheme() == self.scheme.0
            && other.kernel() == self.kernel.0
            && *other.ratio() == self.ratio.0
    }
}

/// A scheme with its sums.
///
/// # Panics
/// When the ratio is out of range: a fault of the file.
pub fn discretisation(scheme: AdvectionScheme, kernel: Kernel, ratio: &Rational) -> Discretisation {
    let found = Discretisation::new(scheme, kernel, ratio.clone());
    found.unwrap_or_else(|error| panic!("{scheme} with {kernel} at {ratio}: {error}"))
}

/// A particle method of the catalogue with the density that its particles sum.
///
/// # Errors
/// When the ratio is out of range.
pub fn lattice(name: &str, kernel: Kernel, at: &Rational) -> Result<LatticeMethod, SweepError> {
    let method = catalogue::method(name).expect("it is in the catalogue");
    Ok(LatticeMethod::new(method, kernel, at)?)
}

/// An integrator of the catalogue.
pub fn integrator(name: &str) -> &'static Integrator {
    Integrator::named(name).expect("it is in the catalogue")
}

/// `count` phases up to π, the first a `count`th of it.
pub fn phases(count: usize) -> Vec<f64> {
    (1..=count).map(|index| index as f64 * PI / count as f64).collect()
}

/// `(a) `, `(b) ` and so on.
pub(crate) fn letter(index: usize) -> String {
    format!("({}) ", char::from(b'a' + index as u8))
}
