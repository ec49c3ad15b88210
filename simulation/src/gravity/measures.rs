//! The numbers by which the run of a cloud is judged.

use super::cloud::{Cloud, Known};
use super::run::{CloudRun, Snapshot};
use crate::particles::dot;
use courant_analysis::golden_section::golden_section;
use std::collections::BTreeMap;

/// What a run has of the expansion wave at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveMeasures {
    /// The time simulated.
    pub time: f64,
    /// Where the mean infall of a shell falls below [`HEAD_SPEED`], over the place in the exact solution, if it does.
    ///
    /// It moves by `δ/|du/dr| ≈ δ t` where the gas there moves by `δ`.
    pub head: Option<f64>,
    /// The factor by which the radii of the exact solution are multiplied to fit the radial velocities best, by least squares over [`WAVE`].
    ///
    /// It moves as far as the head if all gas moves alike, but a swing is lost in the mean.
    pub stretch: f64,
    /// Mean radial velocity before the wave, for `1 < r/(c t) < 1.2`, in sound speeds. Exact: 0.
    pub before: f64,
    /// Root mean square of the radial velocities about those of their shells, in sound speeds, for `0.8 < r/(c t) < 1.2`.
    pub scatter: f64,
}

/// Infall that counts as arrived, in sound speeds: only a tenth of the way behind the head.
pub const HEAD_SPEED: f64 = 0.1;
/// Where velocities are fitted, in `r/(c t)`: the infall reaches 0.73 c.
pub const WAVE: [f64; 2] = [0.5, 1.2];
/// When the wave is looked at, in collapse times: well away from the sink and from the edge.
const WAVE_TIME: f64 = 0.3;
/// The accretion rate is that between these, in collapse times.
pub const RATE_WINDOW: [f64; 2] = [0.1, 0.45];
/// Shells in which velocities are averaged.
const SHELLS: usize = 60;

impl Cloud {
    /// When the wave is looked at, in the time simulated.
    pub(super) fn wave_time(&self) -> Option<f64> {
        Some(WAVE_TIME * self.collapse_time()? - self.wave_start()?)
    }

    /// When the wave reaches the edge, in the time simulated.
    fn edge_time(&self) -> Option<f64> {
        Some(self.radius / self.sound_speed()? - self.wave_start()?)
    }

    pub(super) fn wave_measures(&self, snapshot: &Snapshot) -> Option<WaveMeasures> {
        let sound = self.sound_speed()?;
        let reach = sound * (snapshot.time + self.wave_start()?);
        let mut all: Vec<_> =
            snapshot.radial().into_iter().map(|[r, u, _]| [r / reach, u / sound]).collect();
        all.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let between = |from: f64, to: f64| {
            let place = |x: f64| all.partition_point(|one| one[0] < x);
            &all[place(from)..place(to)]
        };
        let (fitted, before) = (between(WAVE[0], WAVE[1]), between(1.0, WAVE[1]));
        let exact = super::ExpansionWave::solution();
        let fit = |stretch: f64| -> f64 {
            -fitted.iter().map(|[x, u]| (u - exact.at(x / stretch).velocity).powi(2)).sum::<f64>()
        };
        let shells: Vec<_> = all.chunks(all.len().div_ceil(SHELLS).max(1)).map(Shell::of).collect();
        let (squares, count) = shells
            .iter()
            .filter(|shell| (0.8..1.2).contains(&shell.radius))
            .fold((0.0, 0), |(sum, count), shell| (sum + shell.squares, count + shell.count));
        let head = shells.windows(2).find(|pair| pair[1].velocity > -HEAD_SPEED).map(|pair| {
            let [near, far] = [&pair[0], &pair[1]];
            let part = (-HEAD_SPEED - near.velocity) / (far.velocity - near.velocity);
            near.radius + part.clamp(0.0, 1.0) * (far.radius - near.radius)
        });
        (!before.is_empty()).then(|| WaveMeasures {
            time: snapshot.time,
            head: head.map(|head| head / exact.infall(HEAD_SPEED)),
            stretch: largest(fit, [0.5, 1.5]),
            before: before.iter().map(|one| one[1]).sum::<f64>() / before.len() as f64,
            scatter: (squares / count.max(1) as f64).sqrt(),
        })
    }
}

/// Where a function is largest: of some values at equal distances, then between the neighbours of the largest.
fn largest(function: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> f64 {
    const VALUES: u32 = 40;
    let width = (to - from) / f64::from(VALUES);
    let values = (0..=VALUES).map(|k| from + f64::from(k) * width).map(|at| (function(at), at));
    let (_, best) = values.max_by(|a, b| a.0.total_cmp(&b.0)).expect("there are some");
    golden_section(function, [best - width, best + width], 1e-6).1
}

/// Particles of about one radius.
struct Shell {
    radius: f64,
    velocity: f64,
    /// `Σ (u − ū)²`.
    squares: f64,
    count: usize,
}

impl Shell {
    fn of(members: &[[f64; 2]]) -> Self {
        let count = members.len() as f64;
        let mean = |axis: usize| members.iter().map(|one| one[axis]).sum::<f64>() / count;
        let velocity = mean(1);
        let squares = members.iter().map(|one| (one[1] - velocity).powi(2)).sum();
        Self { radius: mean(0), velocity, squares, count: members.len() }
    }
}

impl Snapshot {
    /// Distance from the centre, velocity away from it, and density of each particle.
    pub fn radial(&self) -> Vec<[f64; 3]> {
        let one = |((x, v), density): ((&[f64; 3], &[f64; 3]), &f64)| {
            let r = dot(x, x).sqrt();
            [r, dot(x, v) / r, *density]
        };
        self.position.iter().zip(&self.velocity).zip(&self.density).map(one).collect()
    }
}

impl CloudRun {
    /// Slope of the line through the core masses of [`RATE_WINDOW`] by least squares, in `c³/G`; `None` if the run ended
    /// before.
    pub fn accretion_rate(&self, cloud: &Cloud) -> Option<f64> {
        let (collapse, start) = (cloud.collapse_time()?, cloud.wave_start()?);
        let [from, to] = RATE_WINDOW.map(|part| part * collapse - start);
        if self.run.time < to {
            return None;
        }
        let window: Vec<_> =
            self.core.iter().filter(|core| core[0] >= from && core[0] <= to).collect();
        let count = window.len() as f64;
        let mean = |axis: usize| window.iter().map(|core| core[axis]).sum::<f64>() / count;
        let (time, mass) = (mean(0), mean(1));
        let (mut up, mut down) = (0.0, 0.0);
        for core in window {
            up += (core[0] - time) * (core[1] - mass);
            down += (core[0] - time).powi(2);
        }
        Some(cloud.constant / cloud.sound_speed()?.powi(3) * up / down)
    }

    /// The numbers of the scene: errors are relative, momenta in units of the cloud's mass, radius and gravity.
    pub fn measures(&self, cloud: &Cloud) -> BTreeMap<&'static str, f64> {
        let mut measures = BTreeMap::from([("angular_momentum", self.angular_momentum)]);
        let mut add = |name, value: Option<f64>| {
            measures.extend(value.filter(|value| value.is_finite()).map(|value| (name, value)));
        };
        add("energy", self.run.conservation.energy.map(f64::abs));
        add("least_entropy", self.least_entropy);
        let last = self.snapshots.last();
        match cloud.known {
            Some(Known::ExpansionWave) => {
                // Until the wave reaches the edge.
                let core = cloud.edge_time().and_then(|most| {
                    self.core.iter().rfind(|core| core[0] <= most * (1.0 + 1e-9)).copied()
                });
                let exact =
                    cloud.sink.zip(core).and_then(|(radius, core)| cloud.wave(radius, core[0]));
                add(
                    "core_mass_error",
                    core.zip(exact).map(|(core, e)| (core[1] / e.mass - 1.0).abs()),
                );
                add("accretion_rate", self.accretion_rate(cloud));
                let wave = self.wave;
                let head = wave.and_then(|wave| wave.head);
                add("head_position_error", head.map(|head| (head - 1.0).abs()));
                add("wave_position_error", wave.map(|wave| (wave.stretch - 1.0).abs()));
                add("motion_before_wave", wave.map(|wave| wave.before));
                add("head_scatter", wave.map(|wave| wave.scatter));
            }
            Some(Known::Static) => {
                let sound = cloud.sound_speed();
                let speed = last.map(|one| {
                    let square: f64 = one.velocity.iter().map(|v| dot(v, v)).sum();
                    (square / one.velocity.len() as f64).sqrt()
                });
                add("rms_velocity", speed.zip(sound).map(|(speed, sound)| speed / sound));
                let half = last.and_then(|one| radius_of_part(one, 0.5));
                let start = cloud.radius * cloud.distribution.radius_of(0.5);
                add("half_mass_radius_error", half.map(|half| (half / start - 1.0).abs()));
            }
            Some(Known::FreeFall) => {
                // The outer shells feel the edge, where gas expands.
                let inner = last.and_then(|one| radius_of_part(one, 0.1));
                let start = cloud.radius * cloud.distribution.radius_of(0.1);
                let exact = start * cloud.fallen(self.run.time);
                add("tenth_mass_radius_error", inner.map(|inner| (inner / exact - 1.0).abs()));
            }
            None => {
                let peak = self.energies.iter().filter_map(|e| e.thermal).reduce(f64::max);
                add("peak_thermal_energy", peak);
                add("half_mass_radius", last.and_then(|one| radius_of_part(one, 0.5)));
                add("core_mass", self.core.last().map(|core| core[1]));
            }
        }
        measures
    }
}

/// The radius that holds a part of the particles.
fn radius_of_part(snapshot: &Snapshot, part: f64) -> Option<f64> {
    let mut radii: Vec<f64> = snapshot.radial().iter().map(|one| one[0]).collect();
    radii.sort_by(f64::total_cmp);
    let at = part * radii.len() as f64 - 0.5;
    let index = at.max(0.0) as usize;
    let next = *radii.get(index + 1)?;
    Some(radii[index] + (at - index as f64) * (next - radii[index]))
}
