//! One-dimensional test problems with their exact solutions: Cha & Whitworth 2003, section 5.1–5.6,
//! and two harder ones.

use super::gas::IsothermalGas;
use crate::boundary::Boundary;
use crate::riemann::isothermal::{Expansion, Isothermal};
use crate::riemann::{IdealGas, State, solve};

/// The gas of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Material {
    /// No energy equation.
    Isothermal(IsothermalGas),
    /// An ideal gas.
    Ideal(IdealGas),
}

impl Material {
    /// The speed of sound in a state.
    pub fn sound_speed(self, state: &State) -> f64 {
        match self {
            Self::Isothermal(gas) => gas.sound_speed,
            Self::Ideal(gas) => gas.sound_speed(state.density(), state.pressure()),
        }
    }
}

/// How the gas moves at the start.
#[derive(Debug, Clone, PartialEq)]
pub enum Flow {
    /// Uniform states side by side, each up to the next edge: `(right edge, state)`.
    Layers(Vec<(f64, State)>),
    /// A uniform gas with the velocity `amplitude·c·exp(−(x/width)²)`.
    Pulse {
        /// The gas at rest.
        rest: State,
        /// In sound speeds.
        amplitude: f64,
        /// The distance at which the velocity has fallen to 1/e.
        width: f64,
    },
}

/// A flow of one gas on an interval.
///
/// ```
/// use courant_simulation::particles::ParticleScene;
/// let tube = ParticleScene::named("isothermal-tube").expect("it is in the list");
/// let star = tube.exact(0.05, 0.17).expect("a Riemann problem");
/// assert!((star.pressure() - 0.49662).abs() < 5e-6);
/// assert!((tube.two_shock(0.05, 0.17).expect("isothermal").pressure() - 0.5).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleScene {
    /// The name used on the command line and in files.
    pub name: &'static str,
    /// What happens, in a line.
    pub description: &'static str,
    /// Where the scene comes from, and what had to be chosen.
    pub source: &'static str,
    /// The gas.
    pub material: Material,
    /// The interval filled with particles at the start.
    pub extent: [f64; 2],
    /// What is beyond it.
    pub boundary: Boundary,
    /// Where the run is compared with the exact solution.
    pub window: [f64; 2],
    /// The initial state.
    pub flow: Flow,
    /// When to stop.
    pub end_time: f64,
    /// The customary number of particles.
    pub particles: usize,
    /// Whether the smoothing lengths stay constant.
    pub constant_smoothing: bool,
}

fn state([density, velocity, pressure]: [f64; 3]) -> State {
    State::new(density, velocity, pressure).expect("the scenes' numbers are physical")
}

fn ideal(gamma: f64) -> Material {
    Material::Ideal(IdealGas::new(gamma).expect("the scenes' gases are ideal"))
}

const ISOTHERMAL: Material = Material::Isothermal(IsothermalGas { sound_speed: 1.0 });

impl ParticleScene {
    /// A problem of two uniform states that meet at `x = 0`.
    fn riemann(name: &'static str, material: Material, left: [f64; 3], right: [f64; 3]) -> Self {
        let extent = [-0.5, 0.5];
        Self {
            name,
            description: "",
            source: "",
            material,
            extent,
            boundary: Boundary::Mirror,
            window: [-0.4, 0.4],
            flow: Flow::Layers(vec![(0.0, state(left)), (extent[1], state(right))]),
            end_time: 0.17,
            particles: 250,
            constant_smoothing: false,
        }
    }

    /// Two streams that meet or part: wide enough for the waves from the free ends to stay outside
    /// the window until the end.
    fn streams(self, half_width: f64, window: f64, end_time: f64, particles: usize) -> Self {
        let Flow::Layers(mut layers) = self.flow else { return self };
        layers[1].0 = half_width;
        Self {
            extent: [-half_width, half_width],
            boundary: Boundary::Open,
            window: [-window, window],
            flow: Flow::Layers(layers),
            end_time,
            particles,
            ..self
        }
    }

    /// All scenes, in the order of the paper; the hard cases last.
    pub fn all() -> [Self; 9] {
        let (air, still) = (ideal(1.4), [1.0, 0.0, 1.0]);
        let collision = |name, description, speed: f64, end_time| {
            let streams = ([1.0, 0.5 * speed, 1.0], [1.0, -0.5 * speed, 1.0]);
            let scene = Self::riemann(name, ISOTHERMAL, streams.0, streams.1);
            let source = "Cha & Whitworth 2003, 5.6; v_app taken as the relative velocity";
            Self { description, source, ..scene.streams(0.5, 0.25, end_time, 200) }
        };
        let layer = |edge, pressure| (edge, state([1.0, 0.0, pressure]));
        [
            Self {
                description: "isothermal pulse of 0.01 c between mirrors",
                source: "Cha & Whitworth 2003, 5.1; width and number of particles chosen",
                window: [-0.5, 0.5],
                flow: Flow::Pulse { rest: state(still), amplitude: 0.01, width: 0.05 },
                end_time: 0.8,
                particles: 200,
                constant_smoothing: true,
                ..Self::riemann("sound-wave", ISOTHERMAL, still, still)
            },
            Self {
                description: "shock tube (1, 0, 1 | 0.25, 0, 0.1795), γ = 1.4",
                source: "Cha & Whitworth 2003, Table 1",
                ..Self::riemann("sod-sph", air, still, [0.25, 0.0, 0.1795])
            },
            Self {
                description: "pressure ratio 3e10, γ = 1.4",
                source: "Cha & Whitworth 2003, Table 2",
                end_time: 5e-3,
                ..Self::riemann("strong-blast", air, [1.0, 0.0, 3e3], [1.0, 0.0, 1e-7])
            },
            Self {
                description: "isothermal shock tube (1, 0 | 0.25, 0)",
                source: "Cha & Whitworth 2003, Table 3",
                ..Self::riemann("isothermal-tube", ISOTHERMAL, still, [0.25, 0.0, 0.25])
            },
            Self {
                description: "two strong rarefactions, near vacuum between, γ = 1.4",
                source: "Cha & Whitworth 2003, Table 4; number of particles chosen",
                ..Self::riemann("sjogreen", air, [1.0, -2.0, 0.4], [1.0, 2.0, 0.4])
                    .streams(0.5, 0.5, 0.18, 250)
            },
            collision("collision-subsonic", "isothermal streams meeting at 0.6 c", 0.6, 0.1),
            collision("collision-supersonic", "isothermal streams meeting at 1.2 c", 1.2, 0.05),
            Self {
                description: "cold streams meeting, infinitely strong shocks, γ = 5/3",
                source: "Noh 1987, plane; background pressure 1e-6",
                ..Self::riemann("noh", ideal(5.0 / 3.0), [1.0, 1.0, 1e-6], [1.0, -1.0, 1e-6])
                    .streams(1.0, 0.35, 0.6, 400)
            },
            Self {
                description: "two interacting blast waves between mirrors, γ = 1.4",
                source: "Woodward & Colella 1984: no exact solution",
                extent: [0.0, 1.0],
                window: [0.0, 1.0],
                flow: Flow::Layers(vec![layer(0.1, 1000.0), layer(0.9, 0.01), layer(1.0, 100.0)]),
                end_time: 0.038,
                particles: 400,
                ..Self::riemann("woodward-colella", air, still, still)
            },
        ]
    }

    /// The scene of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|scene| scene.name == name)
    }

    /// The state at `x` before the motion.
    pub fn initial(&self, x: f64) -> State {
        match &self.flow {
            Flow::Layers(layers) => {
                layers.iter().find(|(edge, _)| x < *edge).unwrap_or(&layers[layers.len() - 1]).1
            }
            Flow::Pulse { rest, amplitude, width } => {
                let scaled = x / width;
                let velocity =
                    amplitude * self.material.sound_speed(rest) * (-scaled * scaled).exp();
                State::trusted(rest.density(), rest.velocity() + velocity, rest.pressure())
            }
        }
    }

    /// The two states of a Riemann problem.
    fn two_states(&self) -> Option<(&State, &State)> {
        match &self.flow {
            Flow::Layers(layers) => match layers.as_slice() {
                [(_, left), (_, right)] => Some((left, right)),
                _ => None,
            },
            Flow::Pulse { .. } => None,
        }
    }

    /// The exact solution (for the pulse, that of linear acoustics), if there is one.
    pub fn exact(&self, x: f64, time: f64) -> Option<State> {
        if time <= 0.0 {
            return Some(self.initial(x));
        }
        match (&self.flow, self.material) {
            (Flow::Pulse { rest, amplitude, width }, material) => {
                Some(self.waves(rest, material.sound_speed(rest), *amplitude, *width, x, time))
            }
            (Flow::Layers(_), Material::Ideal(gas)) => {
                let (left, right) = self.two_states()?;
                Some(solve(gas, left, right).sample(x / time))
            }
            (Flow::Layers(_), Material::Isothermal(_)) => {
                self.isothermal(Expansion::Exact, x, time)
            }
        }
    }

    /// The solution that takes the rarefactions of an isothermal problem for shocks.
    pub fn two_shock(&self, x: f64, time: f64) -> Option<State> {
        self.isothermal(Expansion::AsShock, x, time)
    }

    fn isothermal(&self, expansion: Expansion, x: f64, time: f64) -> Option<State> {
        let (left, right) = self.two_states()?;
        let Material::Isothermal(gas) = self.material else { return None };
        let solver = Isothermal { sound_speed: gas.sound_speed, expansion };
        Some(solver.sample(left, right, x / time))
    }

    /// d'Alembert's solution, `v = [g(x − ct) + g(x + ct)]/2` and `δρ/ρ = [g(x − ct) − g(x + ct)]/2c`, with `g`
    /// continued beyond mirrors so that the velocity is odd there.
    fn waves(&self, rest: &State, c: f64, amplitude: f64, width: f64, x: f64, time: f64) -> State {
        let [from, to] = self.extent;
        let pulse = |x: f64| {
            let scaled = x / width;
            amplitude * c * (-scaled * scaled).exp()
        };
        let profile = |x: f64| match self.boundary {
            Boundary::Open | Boundary::Transmissive => pulse(x),
            Boundary::Periodic => pulse(from + (x - from).rem_euclid(to - from)),
            Boundary::Mirror => {
                let folded = (x - from).rem_euclid(2.0 * (to - from));
                if folded <= to - from {
                    pulse(from + folded)
                } else {
                    -pulse(from + 2.0 * (to - from) - folded)
                }
            }
        };
        let (right, left) = (profile(x - c * time), profile(x + c * time));
        let density = rest.density() * (1.0 + 0.5 * (right - left) / c);
        State::trusted(density, rest.velocity() + 0.5 * (right + left), c * c * density)
    }

    /// Positions and masses of particles of (nearly) equal mass: each layer gets its share of
    /// `count`, at least one, half a spacing away from its edges.
    pub fn place(&self, count: usize) -> Vec<(f64, f64)> {
        let layers: Vec<(f64, f64)> = match &self.flow {
            Flow::Layers(layers) => layers.iter().map(|(edge, s)| (*edge, s.density())).collect(),
            Flow::Pulse { rest, .. } => vec![(self.extent[1], rest.density())],
        };
        let mut start = self.extent[0];
        let mut total = 0.0;
        let mut edges = Vec::with_capacity(layers.len());
        for (edge, density) in layers {
            edges.push((start, edge, density, total));
            total += density * (edge - start);
            start = edge;
        }
        let mut placed = Vec::with_capacity(count);
        for (from, to, density, before) in edges {
            let share = |mass: f64| (count as f64 * mass / total).round() as usize;
            let mass = density * (to - from);
            let number = (share(before + mass) - share(before)).max(1);
            let spacing = (to - from) / number as f64;
            placed.extend(
                (0..number).map(|k| (from + (k as f64 + 0.5) * spacing, density * spacing)),
            );
        }
        placed
    }
}
