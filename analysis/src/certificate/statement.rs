//! What a certificate is about: equations as they were typed and everything that completes them.

use super::Exact;
use crate::kernel::Density;
use crate::scheme::{Coefficient, Integrator, IntegratorForm, KernelLattice, Step};
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;

/// A scheme and the parameter whose limit is certified.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Subject {
    /// The equations in the language of schemes.
    pub equations: String,
    /// The kernel of their sums.
    #[serde(deserialize_with = "super::stated")]
    pub kernel: Option<KernelStatement>,
    /// The integrator that completes equations with `u[j]'`.
    #[serde(deserialize_with = "super::stated")]
    pub integrator: Option<IntegratorStatement>,
    /// The values of the other parameters.
    #[serde(deserialize_with = "once")]
    pub values: BTreeMap<String, Exact>,
    /// The sought one.
    pub parameter: String,
}

/// A kernel on its lattice.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KernelStatement {
    /// Such as `cubic-spline`.
    pub name: String,
    /// The smoothing ratio `l/Δξ`.
    pub ratio: Exact,
    /// What `rho` means: `summation` or `mass-per-spacing`.
    pub density: String,
}

/// The numbers of an integrator, each a fraction or an expression with square roots.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum IntegratorStatement {
    /// A Butcher table.
    RungeKutta {
        /// The matrix by rows; what is missing at the end of one is zero.
        #[serde(rename = "A")]
        a: Vec<Vec<String>>,
        /// The weights.
        b: Vec<String>,
    },
    /// Two rows of coefficients.
    Multistep {
        /// Of values.
        alpha: Vec<String>,
        /// Of rates.
        beta: Vec<String>,
    },
    /// The table of a method for positions and velocities.
    Nystrom {
        /// How far each stage drifts.
        c: Vec<String>,
        /// Accelerations in positions of stages.
        position: Vec<Vec<String>>,
        /// Accelerations in velocities of stages.
        velocity: Vec<Vec<String>>,
        /// Accelerations in the new position.
        position_weights: Vec<String>,
        /// Accelerations in the new velocity.
        velocity_weights: Vec<String>,
    },
}

impl From<&Integrator> for IntegratorStatement {
    fn from(integrator: &Integrator) -> Self {
        let row = |row: &Vec<Coefficient>| row.iter().map(|c| c.text().to_owned()).collect();
        let table = |table: &[Vec<Coefficient>]| table.iter().map(row).collect();
        match &integrator.form {
            IntegratorForm::RungeKutta { a, b } => Self::RungeKutta { a: table(a), b: row(b) },
            IntegratorForm::Multistep { alpha, beta } => {
                Self::Multistep { alpha: row(alpha), beta: row(beta) }
            }
            IntegratorForm::Nystrom(nystrom) => Self::Nystrom {
                c: row(&nystrom.c),
                position: table(&nystrom.position),
                velocity: table(&nystrom.velocity),
                position_weights: row(&nystrom.position_weights),
                velocity_weights: row(&nystrom.velocity_weights),
            },
        }
    }
}

impl Subject {
    /// Of a step made of these equations, kernel and integrator, with the values it was given. `None` where the kernel has no name or another
    /// density than the two that have one: nobody could derive its weights again.
    pub fn new(
        equations: &str,
        lattice: Option<&KernelLattice>,
        integrator: Option<&Integrator>,
        step: &Step,
        parameter: &str,
    ) -> Option<Self> {
        let kernel = match lattice {
            None => None,
            Some(lattice) => Some(KernelStatement {
                name: lattice.kernel?.name().into(),
                ratio: lattice.ratio.clone().into(),
                density: density_of(lattice)?.name().into(),
            }),
        };
        let values = step.set_parameters().iter();
        Some(Self {
            equations: equations.trim().into(),
            kernel,
            integrator: integrator.map(IntegratorStatement::from),
            values: values.map(|(name, value)| (name.clone(), value.clone().into())).collect(),
            parameter: parameter.into(),
        })
    }

    /// In one line, for statements.
    pub(super) fn name(&self) -> String {
        let mut name = self.equations.split_whitespace().collect::<Vec<_>>().join(" ");
        if let Some(kernel) = &self.kernel {
            name += &format!(" with {} at ratio {}", kernel.name, kernel.ratio.0);
        }
        for (parameter, value) in &self.values {
            name += &format!(", {parameter} = {}", value.0);
        }
        name
    }
}

fn density_of(lattice: &KernelLattice) -> Option<Density> {
    let matches = |density: &Density| {
        lattice.kernel.is_some_and(|kernel| {
            crate::kernel::relative_density(kernel, &lattice.ratio, *density)
                .is_ok_and(|value| value == lattice.density())
        })
    };
    [Density::Summation, Density::MassPerSpacing].into_iter().find(matches)
}

/// A map in which no key stands twice.
fn once<'de, D: Deserializer<'de>>(source: D) -> Result<BTreeMap<String, Exact>, D::Error> {
    struct Values;
    impl<'de> Visitor<'de> for Values {
        type Value = BTreeMap<String, Exact>;
        fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            formatter.write_str("values by name")
        }
        fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
            let mut values = BTreeMap::new();
            while let Some((name, value)) = entries.next_entry::<String, Exact>()? {
                if values.insert(name, value).is_some() {
                    return Err(A::Error::custom("a name stands twice"));
                }
            }
            Ok(values)
        }
    }
    source.deserialize_map(Values)
}
