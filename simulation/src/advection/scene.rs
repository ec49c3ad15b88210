//! What is carried along a periodic line, and the exact solutions.

use crate::scene::Quantity;

/// A quantity up to an edge.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// The right edge.
    pub to: f64,
    /// The quantity.
    pub value: Quantity,
}

/// `u_t + a u_x = 0` on a periodic interval, as data.
///
/// ```
/// use courant_simulation::advection::AdvectionScene;
/// let step = AdvectionScene::named("advection-step").expect("it is in the list");
/// assert_eq!((step.initial(0.25), step.initial(0.75), step.initial(1.25)), (1.0, 0.25, 1.0));
/// assert_eq!((step.exact(0.1, 0.25), step.periods()), (0.25, 1.0));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct AdvectionScene {
    /// The name used on the command line and in files.
    pub name: String,
    /// What happens, in a line.
    pub description: String,
    /// Where the scene comes from, and what had to be chosen.
    pub source: String,
    /// The period.
    pub domain: [f64; 2],
    /// `a`.
    pub velocity: f64,
    /// The quantity at the start, from left to right.
    pub profile: Vec<Piece>,
    /// When to stop.
    pub end_time: f64,
    /// The customary number of particles.
    pub particles: usize,
    /// The customary method, if the file names one.
    pub method: Option<String>,
}

impl AdvectionScene {
    /// The length of the period.
    pub fn length(&self) -> f64 {
        self.domain[1] - self.domain[0]
    }

    /// How many periods are travelled until the end.
    pub fn periods(&self) -> f64 {
        self.velocity.abs() * self.end_time / self.length()
    }

    /// The place of a part of the way around the period, in the direction of the motion.
    pub(super) fn place(&self, part: f64) -> f64 {
        match self.velocity > 0.0 {
            true => self.domain[0] + part * self.length(),
            false => self.domain[1] - part * self.length(),
        }
    }

    /// The quantity at the start, continued periodically. At an edge it is that beyond it.
    pub fn initial(&self, x: f64) -> f64 {
        let part = (x - self.domain[0]) / self.length();
        let x = self.domain[0] + (part - part.floor()) * self.length();
        let piece = self.profile.iter().find(|piece| x < piece.to).or(self.profile.last());
        piece.map_or(f64::NAN, |piece| piece.value.at(x))
    }

    /// The exact solution `u_0(x − a t)`. Within rounding of a jump the side is open.
    pub fn exact(&self, x: f64, time: f64) -> f64 {
        self.initial(x - self.velocity * time)
    }
}
