//! What the paper says of its one-dimensional tests: the measures by the names that the claims use.

use super::blast_shell::{Shell, pressure_ripple};
use super::collision::PenetrationCount;
use super::rarefied_contact::ContactEnergy;
use super::runs::Runs;
use super::sound_wave::peak;
use super::text;
use crate::claim::{Claims, rows};
use crate::page::Item;
use courant_simulation::particles::{ParticleMethod, SolverChoice};

/// What the claims rest on.
pub(super) struct Evidence<'a> {
    pub runs: &'a Runs,
    pub shells: &'a [Shell],
    pub contacts: &'a [ContactEnergy],
    pub penetrations: &'a [PenetrationCount],
}

/// The table of claims.
pub(super) fn item(evidence: &Evidence<'_>) -> Item {
    let claims = Claims::from_toml(include_str!("../../../papers/cha_whitworth2003/claims.toml"))
        .expect("the file of claims is read by a test");
    let found = claims
        .judge(|_, name, arguments, member| evidence.measure(name, arguments, member))
        .expect("the claims are judged by a test");
    text().table("particle_claims", &[], rows(&found))
}

impl Evidence<'_> {
    /// A number of one method; not a number where there is none.
    fn measure(&self, name: &str, arguments: &[&str], member: &str) -> Option<f64> {
        let method = ParticleMethod::ALL.into_iter().find(|method| method.name() == member)?;
        let shell = || self.shells.iter().find(|shell| shell.method == method);
        Some(match (name, arguments) {
            ("density-error", [scene]) => {
                self.runs.get(scene, method).density_error().unwrap_or(f64::INFINITY)
            }
            ("ripple", [scene]) => pressure_ripple(self.runs, scene, method),
            ("interactions" | "searches" | "iterations", [scene]) => {
                let counters = &self.runs.get(scene, method).run.counters;
                let pairs = counters.interactions as f64;
                match name {
                    "interactions" => pairs,
                    "searches" => counters.evaluations as f64,
                    _ => counters.riemann_iterations as f64 / pairs,
                }
            }
            ("sound-peak", []) => peak(self.runs.get("sound-wave", method)),
            ("shell-density", []) => shell()?.mean_density,
            ("shell-density-error", []) => (shell()?.mean_density - 1.0).abs(),
            ("shell-peak", []) => shell()?.largest_density,
            ("shell-overshoot", []) => shell()?.velocity_overshoot,
            ("plateau", []) => {
                // Between the waves, where nothing but the star state counts.
                let profile = &self.runs.get("isothermal-tube", method).run.profile;
                let order = profile.inside([-0.05, 0.2]);
                order.iter().map(|&i| profile.pressure[i]).sum::<f64>() / order.len() as f64
            }
            ("cavity-completed", []) => {
                let mut of_method = self.contacts.iter().filter(|contact| contact.method == method);
                f64::from(u8::from(of_method.all(|contact| contact.energy.is_some())))
            }
            ("cavity-energy", [solver]) => {
                let solver = match *solver {
                    "published" => SolverChoice::Published,
                    "exact" => SolverChoice::Exact,
                    _ => return None,
                };
                // The runs at the paper's resolution come before the finer ones.
                let mut contacts = self.contacts.iter();
                let found = contacts.find(|c| c.method == method && c.solver == solver)?;
                found.energy.map_or(f64::NAN, |energy| energy / found.exact)
            }
            ("passed" | "broke-down" | "penetrated", [smoothing, fastest]) => {
                let fastest: f64 = fastest.parse().ok()?;
                let constant = *smoothing == "constant";
                let of_method = self.penetrations.iter().filter(|count| {
                    count.method == method
                        && count.constant_smoothing == constant
                        && count.approach <= fastest
                });
                let counted = of_method.filter(|count| match name {
                    "passed" => count.largest.is_some_and(|largest| largest > 0),
                    "broke-down" => count.largest.is_none(),
                    _ => count.largest != Some(0),
                });
                counted.count() as f64
            }
            _ => return None,
        })
    }
}
