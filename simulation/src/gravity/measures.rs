//! The numbers by which the run of a cloud is judged.

use super::cloud::{Cloud, Known};
use super::run::{CloudRun, Snapshot};
use crate::particles::dot;
use std::collections::BTreeMap;

/// The expansion wave at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Head {
    /// The time simulated.
    pub time: f64,
    /// The factor by which the radii of the exact solution are multiplied to fit the radial velocities best, by least squares over [`WAVE`].
    ///
    /// The place where the mean infall is some small part of `c` would measure the motion of the gas there instead: it moves by
    /// `δ/|du/dr| ≈ δ t` where all moves by `δ`. The fit moves as far if all moves alike, but a swing is lost in the mean.
    pub stretch: f64,
    /// Mean radial velocity before the wave, for `1 < r/(c t) < 1.2`, in sound speeds. Exact: 0.
    pub before: f64,
    /// Root mean square of the radial velocities about those of their shells, in sound speeds, for `0.8 < r/(c t) < 1.2`.
    pub scatter: f64,
}

/// Where velocities are fitted, in `r/(c t)`: the infall reaches 0.73 c.
pub const WAVE: [f64; 2] = [0.5, 1.2];
/// When the head is looked at, in collapse times: well away from the sink and from the edge.
const HEAD_TIME: f64 = 0.3;
/// The accretion rate is that between these, in collapse times.
pub const RATE_WINDOW: [f64; 2] = [0.1, 0.45];
/// Shells in which velocities are averaged.
const SHELLS: usize = 60;

impl Cloud {
    /// When the head of the wave is looked at, in the time simulated.
    pub(super) fn head_time(&self) -> Option<f64> {
        Some(HEAD_TIME * self.collapse_time()? - self.wave_start()?)
    }

    /// When the wave reaches the edge, in the time simulated.
    fn edge_time(&self) -> Option<f64> {
        Some(self.radius / self.sound_speed()? - self.wave_start()?)
    }

    pub(super) fn head(&self, snapshot: &Snapshot) -> Option<Head> {
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
        let wave = super::ExpansionWave::solution();
        let misfit = |stretch: f64| -> f64 {
            fitted.iter().map(|[x, u]| (u - wave.at(x / stretch).velocity).powi(2)).sum()
        };
        let shells = all.chunks(all.len().div_ceil(SHELLS).max(1)).map(Shell::of);
        let (squares, count) = shells
            .filter(|shell| (0.8..1.2).contains(&shell.radius))
            .fold((0.0, 0), |(sum, count), shell| (sum + shell.squares, count + shell.count));
        (!before.is_empty()).then(|| Head {
            time: snapshot.time,
            stretch: least(misfit, [0.5, 1.5]),
            before: before.iter().map(|one| one[1]).sum::<f64>() / before.len() as f64,
            scatter: (squares / count.max(1) as f64).sqrt(),
        })
    }
}

/// Where a function is least: of some values at equal distances, then between the neighbours of the least by the golden section.
fn least(function: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> f64 {
    const VALUES: u32 = 40;
    let width = (to - from) / f64::from(VALUES);
    let at = |k: u32| from + f64::from(k) * width;
    let best = (0..=VALUES).map(at).min_by(|a, b| function(*a).total_cmp(&function(*b)));
    let best = best.expect("there are some");
    let (mut low, mut high) = (best - width, best + width);
    let golden = 0.5 * (5_f64.sqrt() - 1.0);
    while high - low > 1e-6 {
        let part = golden * (high - low);
        if function(high - part) < function(low + part) {
            high = low + part
        } else {
            low = high - part
        }
    }
    0.5 * (low + high)
}

/// Particles of about one radius.
struct Shell {
    radius: f64,
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
        Self { radius: mean(0), squares, count: members.len() }
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
                add("wave_position_error", self.head.map(|head| (head.stretch - 1.0).abs()));
                add("motion_before_wave", self.head.map(|head| head.before));
                add("head_scatter", self.head.map(|head| head.scatter));
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
