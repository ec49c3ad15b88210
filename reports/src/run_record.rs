//! A run as the JSON object that scripts rely on: `courant.run/1`.

use serde::Serialize;

/// Error norms `Σ|e_i|/N` over the particles inside the scene's comparison window; a variable the scene
/// does not have is `null`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct ErrorNorms {
    /// The advected quantity of an advection scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Density.
    pub density: Option<f64>,
    /// Velocity.
    pub velocity: Option<f64>,
    /// Pressure.
    pub pressure: Option<f64>,
    /// Specific internal energy.
    pub energy: Option<f64>,
}

impl ErrorNorms {
    /// Whether all four norms of a gas are there.
    pub fn is_complete(&self) -> bool {
        [self.density, self.velocity, self.pressure, self.energy].iter().all(Option::is_some)
    }
}

/// Relative change of a total over the run; `null` where the scene has no such total.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct ConservationRecord {
    /// Mass, or the mean of an advected quantity.
    pub mass: Option<f64>,
    /// Momentum.
    pub momentum: Option<f64>,
    /// Total energy.
    pub energy: Option<f64>,
}

impl ConservationRecord {
    /// Whether all three drifts are there.
    pub fn is_complete(&self) -> bool {
        [self.mass, self.momentum, self.energy].iter().all(Option::is_some)
    }
}

/// Why a run that did not reach its end has no norms.
pub const BROKEN: &str = "the run broke down";

/// One run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunRecord {
    /// The scene's name.
    pub scene: String,
    /// The method's name.
    pub method: String,
    /// How many particles or cells.
    pub particles: usize,
    /// Time steps taken.
    pub steps: usize,
    /// Steps that broke and were repeated with half their length.
    pub rejected_steps: usize,
    /// The time reached.
    pub time: f64,
    /// Whether the end time was reached.
    pub completed: bool,
    /// Why not.
    pub failure: Option<String>,
    /// What the user should know before believing the numbers.
    pub warnings: Vec<String>,
    /// Error norms.
    pub l1: ErrorNorms,
    /// Why norms are `null`, where some are.
    pub l1_note: Option<String>,
    /// Drift of the conserved totals.
    pub conservation: ConservationRecord,
    /// Why drifts are `null`, where some are.
    pub conservation_note: Option<String>,
    /// Wall-clock time of the stepping in seconds.
    pub wall_seconds: f64,
}
