//! The particle methods whose linear waves are known in closed form.

use crate::exact::rational::Rational;

/// Which dispersion relation of Godunov particle hydrodynamics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub enum Form {
    /// `ω² + i c D ω − ω_SPH² = 0`: what the scheme does, with the left and the right state of each
    /// Riemann problem chosen by position.
    #[default]
    Resolved,
    /// `ω² + c S ω − ω_SPH² = 0`: (61)–(64) as printed, which takes the particle itself as the left state
    /// towards every neighbour. No running scheme does that.
    Published,
}

impl Form {
    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Resolved => "resolved",
            Self::Published => "published",
        }
    }
}

impl std::str::FromStr for Form {
    type Err = UnknownForm;
    fn from_str(text: &str) -> Result<Self, UnknownForm> {
        let wanted = text.trim().to_ascii_lowercase();
        [Self::Resolved, Self::Published]
            .into_iter()
            .find(|form| form.name() == wanted)
            .ok_or_else(|| UnknownForm(text.into()))
    }
}

/// A name that is no form's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no form `{0}`; write resolved or published")]
pub struct UnknownForm(pub String);

/// A particle method and what its waves depend on.
///
/// Per mode `Ẋ = V, V̇ = F X + G V` with `F = −ω_SPH²`, `ω_SPH² = 2(P/ρ)T + (c² − 2P/ρ)S²`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum WaveMethod {
    /// Smoothed particle hydrodynamics without viscosity, `G = 0`: Cha & Whitworth 2003 (51).
    Sph,
    /// With the linear term of the usual artificial viscosity, applied to approaching and receding pairs:
    /// `G = −α h c B`, (58)–(60) with the denominator `(a − b)Δ` that its damping needs.
    SphAv {
        /// The coefficient α.
        alpha: Rational,
    },
    /// Godunov particle hydrodynamics, cases 1–3: `G = −c D` resolved, `G = i c S` as published.
    Gph {
        /// Which relation.
        form: Form,
    },
}

impl WaveMethod {
    /// The name used on the command line and in files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Sph => "sph",
            Self::SphAv { .. } => "sph-av",
            Self::Gph { .. } => "gph",
        }
    }

    /// The name for titles and captions.
    pub fn title(&self) -> String {
        match self {
            Self::Sph => "SPH".into(),
            Self::SphAv { alpha } => {
                format!("SPH with viscosity, α = {}", crate::exact::rational::to_text(alpha))
            }
            Self::Gph { form } => format!("GPH ({})", form.name()),
        }
    }

    /// The dispersion relation in plain text.
    pub fn relation(&self) -> &'static str {
        match self {
            Self::Sph => "ω² = c²(2T − S²)",
            Self::SphAv { .. } => "ω² + i α h c B ω − ω_SPH² = 0",
            Self::Gph { form: Form::Resolved } => "ω² + i c D ω − ω_SPH² = 0",
            Self::Gph { form: Form::Published } => "ω² + c S ω − ω_SPH² = 0",
        }
    }

    /// Where the relation comes from.
    pub fn source(&self) -> &'static str {
        match self {
            Self::Sph => "Cha & Whitworth 2003 (51)",
            Self::SphAv { .. } => {
                "Cha & Whitworth 2003 (58)-(60), sign of the denominator repaired"
            }
            Self::Gph { form: Form::Resolved } => {
                "Cha & Whitworth 2003 (27), (43), (44), left and right by position"
            }
            Self::Gph { form: Form::Published } => "Cha & Whitworth 2003 (61)-(64) as printed",
        }
    }

    /// The form, for Godunov particle hydrodynamics.
    pub fn form(&self) -> Option<Form> {
        match self {
            Self::Gph { form } => Some(*form),
            _ => None,
        }
    }

    /// The viscosity coefficient, where there is one.
    pub fn alpha(&self) -> Option<&Rational> {
        match self {
            Self::SphAv { alpha } => Some(alpha),
            _ => None,
        }
    }
}
