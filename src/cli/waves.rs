//! Particle methods as they are named on the command line, for everything about their waves.

use super::{Failure, names};
use clap::ValueEnum;
use courant::analysis::exact::rational::{Rational, integer, to_text};
use courant::analysis::kernel::Density;
use courant::analysis::scheme::integrator::Integrator;
use courant::analysis::waves::dispersion::{Form, WaveMethod};
use num_traits::Signed;

/// The largest coefficient of viscosity that is looked at.
const MAX_ALPHA: i64 = 1_000_000;

/// A method whose waves are known in closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// Smoothed particle hydrodynamics without viscosity.
    Sph,
    /// The same with the linear viscosity α.
    SphAv,
    /// Godunov particle hydrodynamics, cases 1 to 3.
    Gph,
}

/// Which density of the undisturbed lattice enters the relation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DensityName {
    /// What the particles see: ρ0 = M Σ W.
    Summation,
    /// The mass per spacing: ρ0 = M/Δ.
    #[value(alias = "mass-per-spacing")]
    Mass,
}

impl From<DensityName> for Density {
    fn from(name: DensityName) -> Self {
        match name {
            DensityName::Summation => Self::Summation,
            DensityName::Mass => Self::MassPerSpacing,
        }
    }
}

impl MethodName {
    /// All methods, in the order they are listed.
    pub const ALL: [Self; 3] = [Self::Sph, Self::SphAv, Self::Gph];

    /// The method with its viscosity and form; each is refused where the method has none.
    pub fn method(
        self,
        form: Option<Form>,
        alpha: Option<&Rational>,
    ) -> Result<WaveMethod, Failure> {
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
        Ok(match self {
            Self::Sph => WaveMethod::Sph,
            Self::SphAv => {
                WaveMethod::SphAv { alpha: alpha.cloned().unwrap_or_else(|| integer(1)) }
            }
            Self::Gph => WaveMethod::Gph { form: form.unwrap_or_default() },
        })
    }

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        self.example().name()
    }

    /// The method with the settings that are the default.
    pub fn example(self) -> WaveMethod {
        match self {
            Self::Sph => WaveMethod::Sph,
            Self::SphAv => WaveMethod::SphAv { alpha: integer(1) },
            Self::Gph => WaveMethod::Gph { form: Form::default() },
        }
    }
}

/// An integrator by name or alias.
pub fn integrator(text: &str) -> Result<Integrator, String> {
    text.parse()
        .map_err(|_| names::unknown("integrator", text, &Integrator::ALL.map(Integrator::name)))
}


/// A coefficient of viscosity.
pub fn alpha(text: &str) -> Result<Rational, String> {
    let value = super::numbers::number(text)?;
    if value.is_negative() || value > integer(MAX_ALPHA) {
        return Err(format!("it must be from 0 to {MAX_ALPHA}"));
    }
    Ok(value)
}
