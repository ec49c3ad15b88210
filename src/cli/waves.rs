//! Particle methods as they are named on the command line, for everything about their waves.

use super::subject::Kind;
use super::{Failure, names};
use clap::ValueEnum;
use courant::analysis::exact::rational::{Rational, integer, to_f64, to_text};
use courant::analysis::kernel::{Density, Kernel};
use courant::analysis::scheme::{Integrator, LatticeMethod, catalogue};
use courant::analysis::spelling::spells;
use courant::reports::cha_whitworth2003::published;

/// A method whose waves are known in closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MethodName {
    /// Smoothed particle hydrodynamics without viscosity.
    Sph,
    /// The same with the linear viscosity α.
    SphAv,
    /// Godunov particle hydrodynamics, cases 1 to 3.
    Gph,
}

/// Which relation of Godunov particle hydrodynamics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// What the scheme does: left and right by position.
    Resolved,
    /// As printed.
    Published,
}

impl Form {
    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Resolved => "resolved",
            Self::Published => "published",
        }
    }
}

/// A method with its viscosity and form.
#[derive(Debug, Clone)]
pub struct Relation {
    /// The method.
    pub method: MethodName,
    /// Only of gph.
    pub form: Option<Form>,
    alpha: Option<Rational>,
}

impl Relation {
    /// Whether it is the one that no scheme has.
    pub fn is_published(&self) -> bool {
        self.form == Some(Form::Published)
    }

    /// The viscosity coefficient, where there is one.
    pub fn alpha(&self) -> Option<f64> {
        self.alpha.as_ref().map(to_f64)
    }

    /// On a lattice.
    pub fn lattice(
        &self,
        kernel: Kernel,
        ratio: &Rational,
        density: Density,
    ) -> Result<LatticeMethod, Failure> {
        let file = match self.is_published() {
            true => published::equations(),
            false => catalogue::method(self.method.name()).expect("it is in the catalogue"),
        };
        let lattice = LatticeMethod::new(file, kernel, ratio)
            .map_err(|error| Failure::Message(format!("--ratio: {error}")))?
            .with_density(density);
        Ok(match &self.alpha {
            Some(alpha) => lattice.with("alpha", alpha),
            None => lattice,
        })
    }

    /// The name for titles and captions.
    pub fn title(&self) -> String {
        match (self.method, &self.alpha, self.form) {
            (MethodName::SphAv, Some(alpha), _) => {
                format!("SPH with viscosity, α = {}", to_text(alpha))
            }
            (MethodName::Gph, _, Some(form)) => format!("GPH ({})", form.name()),
            _ => "SPH".into(),
        }
    }
}

impl MethodName {
    /// All methods, in the order they are listed.
    pub const ALL: [Self; 3] = [Self::Sph, Self::SphAv, Self::Gph];

    /// The method with its viscosity and form; each is refused where the method has none.
    pub fn method(self, form: Option<Form>, alpha: Option<&Rational>) -> Result<Relation, Failure> {
        if let (Some(alpha), Self::Sph | Self::Gph) = (alpha, self) {
            return Err(Failure::Message(format!(
                "--alpha {}: {} has no viscosity coefficient; only sph-av takes it",
                to_text(alpha),
                self.name()
            )));
        }
        if let (Some(form), Self::Sph | Self::SphAv) = (form, self) {
            return Err(Failure::Message(format!(
                "--form {}: {} has one form; only gph takes it",
                form.name(),
                self.name()
            )));
        }
        let is = |method| self == method;
        Ok(Relation {
            method: self,
            form: is(Self::Gph).then(|| form.unwrap_or(Form::Resolved)),
            alpha: is(Self::SphAv).then(|| alpha.cloned().unwrap_or_else(|| integer(1))),
        })
    }

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sph => "sph",
            Self::SphAv => "sph-av",
            Self::Gph => "gph",
        }
    }
}

/// A method by name.
pub fn method(text: &str) -> Result<MethodName, String> {
    let found = MethodName::ALL.into_iter().find(|method| spells(text, method.name()));
    found.ok_or_else(|| match names::elsewhere(text, Some(Kind::Method)) {
        Some(what) => what,
        None => names::unknown("method", text, &MethodName::ALL.map(MethodName::name)),
    })
}

/// An integrator by name, alias or file.
pub fn integrator(text: &str) -> Result<&'static Integrator, String> {
    // An argument, read once: it lives as long as the program.
    names::integrator(text, true).map(|found| &*Box::leak(Box::new((*found).clone())))
}
