//! Shock tubes: two uniform states and a diaphragm that vanishes at time 0.

use super::{Scene, conserved_density, mean_state};
use crate::boundary::Boundary;
use crate::riemann::{IdealGas, InvalidState, Solution, State, solve};

/// The plain numbers of a shock tube; [`ShockTube::new`] checks them.
#[derive(Debug, Clone, PartialEq)]
pub struct TubeData {
    /// A short name.
    pub name: String,
    /// Where the numbers come from.
    pub source: String,
    /// The ends of the tube.
    pub domain: [f64; 2],
    /// Where the diaphragm is.
    pub diaphragm: f64,
    /// Density, velocity and pressure on its left.
    pub left: [f64; 3],
    /// Density, velocity and pressure on its right.
    pub right: [f64; 3],
    /// The ratio of specific heats.
    pub gamma: f64,
    /// When to compare.
    pub end_time: f64,
    /// The customary number of particles or cells.
    pub particles: usize,
}

/// Why numbers are not a shock tube.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InvalidTube {
    /// The gas is not ideal.
    #[error(transparent)]
    Gas(InvalidState),
    /// The left state is not physical.
    #[error("left: {0}")]
    Left(InvalidState),
    /// The right state is not physical.
    #[error("right: {0}")]
    Right(InvalidState),
    /// A side without gas or without pressure: no particle can carry it.
    #[error("{side}: density and pressure must both be above 0")]
    Empty {
        /// `left` or `right`.
        side: &'static str,
    },
    /// The ends are not ascending finite numbers.
    #[error("domain = [{from}, {to}]: two ascending finite numbers are needed")]
    Domain {
        /// The left end.
        from: f64,
        /// The right end.
        to: f64,
    },
    /// The diaphragm is not inside.
    #[error("diaphragm = {position}: a number between {from} and {to} is needed")]
    Diaphragm {
        /// Where it was put.
        position: f64,
        /// The left end.
        from: f64,
        /// The right end.
        to: f64,
    },
    /// The end time is not a positive finite number.
    #[error("end time = {0}: a finite number above 0 is needed")]
    EndTime(f64),
    /// Too few particles.
    #[error("particles = {0}: at least {MIN_PARTICLES} are needed")]
    Particles(usize),
}

/// Fewer particles than this cannot hold three waves.
const MIN_PARTICLES: usize = 10;

/// A shock tube with transmissive ends and its exact solution.
///
/// ```
/// use courant_simulation::scene::{Scene, ShockTube};
/// let tube = ShockTube::standard("ferrari1").expect("it is in the list");
/// assert_eq!(tube.end_time(), 0.2);
/// assert!((tube.mass() - 0.3875).abs() < 1e-15);
/// assert_eq!(tube.exact(0.0, 0.2).density(), 1.0);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ShockTube {
    data: TubeData,
    gas: IdealGas,
    left: State,
    right: State,
    solution: Solution,
}

/// The names accepted by [`ShockTube::standard`].
pub const STANDARD_TUBES: [&str; 9] =
    ["ferrari1", "ferrari2", "ferrari3", "ferrari4", "sod", "toro4", "toro5", "toro6", "toro7"];

impl ShockTube {
    /// A tube from its numbers.
    ///
    /// # Errors
    /// [`InvalidTube`] names the first number that does not make sense.
    ///
    /// ```
    /// use courant_simulation::scene::{ShockTube, TubeData};
    /// let data = TubeData {
    ///     name: "mine".into(), source: "me".into(), domain: [0.0, 2.0], diaphragm: 1.0,
    ///     left: [1.0, 0.0, 1.0], right: [-0.5, 0.0, 0.1], gamma: 1.4, end_time: 0.3, particles: 50,
    /// };
    /// let error = ShockTube::new(data).unwrap_err().to_string();
    /// assert_eq!(error, "right: density = -0.5: a finite number, not negative, is needed");
    /// ```
    pub fn new(data: TubeData) -> Result<Self, InvalidTube> {
        let gas = IdealGas::new(data.gamma).map_err(InvalidTube::Gas)?;
        let state =
            |[density, velocity, pressure]: [f64; 3]| State::new(density, velocity, pressure);
        let left = state(data.left).map_err(InvalidTube::Left)?;
        let right = state(data.right).map_err(InvalidTube::Right)?;
        for (side, state) in [("left", &left), ("right", &right)] {
            if state.density() <= 0.0 || state.pressure() <= 0.0 {
                return Err(InvalidTube::Empty { side });
            }
        }
        let [from, to] = data.domain;
        if !(from.is_finite() && to.is_finite() && from < to) {
            return Err(InvalidTube::Domain { from, to });
        }
        if !(data.diaphragm > from && data.diaphragm < to) {
            return Err(InvalidTube::Diaphragm { position: data.diaphragm, from, to });
        }
        if !(data.end_time.is_finite() && data.end_time > 0.0) {
            return Err(InvalidTube::EndTime(data.end_time));
        }
        if data.particles < MIN_PARTICLES {
            return Err(InvalidTube::Particles(data.particles));
        }
        let solution = solve(gas, &left, &right);
        Ok(Self { data, gas, left, right, solution })
    }

    /// One of [`STANDARD_TUBES`]: the four tests of Ferrari et al. 2008, Table 2, under their
    /// numbers there, the tube of Sod 1978, and those tests of Toro 1999 that are not among them:
    /// a blast to the left (4), the slow contact (5), a contact at rest (6) and a drifting one (7).
    pub fn standard(name: &str) -> Option<Self> {
        let table = "Ferrari et al. 2008, Table 2";
        #[rustfmt::skip]
        let (source, left, right, diaphragm, end_time) = match name {
            "ferrari1" => (table, [1.0, 0.75, 1.0], [0.125, 0.0, 0.1], 0.3, 0.2),
            "ferrari2" => (table, [1.0, -2.0, 0.4], [1.0, 2.0, 0.4], 0.5, 0.15),
            "ferrari3" => (table, [1.0, 0.0, 1000.0], [1.0, 0.0, 0.01], 0.5, 0.012),
            "ferrari4" => (table, [5.99924, 19.5975, 460.894], [5.99242, -6.19633, 46.095], 0.4, 0.035),
            "sod" => ("Sod 1978", [1.0, 0.0, 1.0], [0.125, 0.0, 0.1], 0.5, 0.2),
            "toro4" => ("Toro 1999, chapter 4, test 4", [1.0, 0.0, 0.01], [1.0, 0.0, 100.0], 0.5, 0.035),
            "toro5" => ("Toro 1999, chapter 6, test 5", [1.0, -19.59745, 1000.0], [1.0, -19.59745, 0.01], 0.8, 0.012),
            "toro6" => ("Toro 1999, chapter 10, test 6", [1.4, 0.0, 1.0], [1.0, 0.0, 1.0], 0.5, 2.0),
            "toro7" => ("Toro 1999, chapter 10, test 7", [1.4, 0.1, 1.0], [1.0, 0.1, 1.0], 0.5, 2.0),
            _ => return None,
        };
        let data = TubeData {
            name: name.into(),
            source: source.into(),
            domain: [0.0, 1.0],
            diaphragm,
            left,
            right,
            gamma: 1.4,
            end_time,
            particles: 100,
        };
        Some(Self::new(data).expect("the standard tubes are physical"))
    }

    /// The state left of the diaphragm.
    pub fn left(&self) -> &State {
        &self.left
    }

    /// The state right of the diaphragm.
    pub fn right(&self) -> &State {
        &self.right
    }

    /// Where the diaphragm was.
    pub fn diaphragm(&self) -> f64 {
        self.data.diaphragm
    }

    /// The numbers of the tube.
    pub fn data(&self) -> &TubeData {
        &self.data
    }
}

impl Scene for ShockTube {
    fn name(&self) -> &str {
        &self.data.name
    }

    fn source(&self) -> &str {
        &self.data.source
    }

    fn gas(&self) -> IdealGas {
        self.gas
    }

    fn domain(&self) -> [f64; 2] {
        self.data.domain
    }

    fn boundary(&self) -> Boundary {
        Boundary::Transmissive
    }

    fn end_time(&self) -> f64 {
        self.data.end_time
    }

    fn particles(&self) -> usize {
        self.data.particles
    }

    fn mass(&self) -> f64 {
        let [from, to] = self.data.domain;
        self.left.density() * (self.data.diaphragm - from)
            + self.right.density() * (to - self.data.diaphragm)
    }

    fn inflow(&self) -> [f64; 2] {
        let entering =
            |state: &State, speed: f64| state.density() * speed.max(0.0) * self.data.end_time;
        [entering(&self.left, self.left.velocity()), entering(&self.right, -self.right.velocity())]
    }

    fn position_at_mass(&self, mass: f64) -> f64 {
        let left_mass = self.left.density() * (self.data.diaphragm - self.data.domain[0]);
        if mass <= left_mass {
            self.data.domain[0] + mass / self.left.density()
        } else {
            self.data.diaphragm + (mass - left_mass) / self.right.density()
        }
    }

    /// A cell or particle that straddles the diaphragm gets the mean of the conserved
    /// quantities, so that mass, momentum and energy of the whole are those of the tube.
    fn average(&self, from: f64, to: f64) -> State {
        let part = (self.data.diaphragm - from) / (to - from);
        if part >= 1.0 {
            self.left
        } else if part <= 0.0 {
            self.right
        } else {
            let left = conserved_density(self.gas, &self.left);
            let right = conserved_density(self.gas, &self.right);
            mean_state(self.gas, [0, 1, 2].map(|k| part * left[k] + (1.0 - part) * right[k]))
        }
    }

    fn exact(&self, x: f64, time: f64) -> State {
        let distance = x - self.data.diaphragm;
        if time > 0.0 {
            self.solution.sample(distance / time)
        } else if distance < 0.0 {
            self.left
        } else {
            self.right
        }
    }

    fn riemann(&self) -> Option<(&Solution, f64)> {
        Some((&self.solution, self.data.diaphragm))
    }
}
