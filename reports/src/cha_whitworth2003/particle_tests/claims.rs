//! What the paper says of its one-dimensional tests, set against numbers.

use super::COMMAND;
use super::blast_shell::{Shell, pressure_ripple};
use super::collision::PenetrationCount;
use super::cost::{Cost, cost};
use super::rarefied_contact::ContactEnergy;
use super::runs::Runs;
use super::sound_wave::exact_peak;
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use courant_simulation::particles::{ParticleMethod, SolverChoice};

/// How a claim fares.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClaimVerdict {
    /// The numbers agree.
    Confirmed,
    /// They agree in part.
    Partly,
    /// They do not.
    NotConfirmed,
    /// What is compared differs by less than a clock scatters.
    NoDifference,
}

impl ClaimVerdict {
    /// As it stands in the table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Partly => "in part",
            Self::NotConfirmed => "not confirmed",
            Self::NoDifference => "no difference",
        }
    }

    /// Whether a share of the time of something else is less of it. Times of one program scatter by several per cent
    /// from run to run: a tenth either way decides nothing.
    fn faster(share: f64) -> Self {
        match share {
            share if share < 0.9 => Self::Confirmed,
            share if share <= 1.1 => Self::NoDifference,
            _ => Self::NotConfirmed,
        }
    }

    /// All, some or none of what a claim says holds.
    fn of(holds: &[bool]) -> Self {
        match holds.iter().filter(|&&holds| holds).count() {
            all if all == holds.len() => Self::Confirmed,
            0 => Self::NotConfirmed,
            _ => Self::Partly,
        }
    }
}

/// A statement of the paper and what was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// What is claimed, in our words.
    pub claim: &'static str,
    /// Where.
    pub place: &'static str,
    /// What was measured.
    pub number: String,
    /// How it fares: a rule on the numbers, no judgement by hand.
    pub verdict: ClaimVerdict,
}

const CASES: [ParticleMethod; 4] =
    [ParticleMethod::Gph1, ParticleMethod::Gph2, ParticleMethod::Gph3, ParticleMethod::Gph4];

pub(super) fn claims(
    runs: &Runs,
    shells: &[Shell],
    contacts: &[ContactEnergy],
    penetrations: &[PenetrationCount],
    costs: &[Cost],
) -> Vec<Claim> {
    let mut claims = sound_wave(runs).to_vec();
    claims.extend(tubes(runs, shells, costs));
    claims.extend(rarefaction(contacts));
    claims.extend(collisions(penetrations));
    claims.extend(time(costs));
    claims
}

/// L1 error of the density; infinite for a run that broke down.
fn density_error(runs: &Runs, scene: &str, method: ParticleMethod) -> f64 {
    let run = &runs.get(scene, method).run;
    run.errors.filter(|_| run.completed()).map_or(f64::INFINITY, |errors| errors.density)
}

/// Largest over smallest.
fn spread(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().fold(0.0, f64::max) / values.fold(f64::INFINITY, f64::min)
}

fn sound_wave(runs: &Runs) -> [Claim; 2] {
    let error = |method| density_error(runs, "sound-wave", method);
    let peak = |method| {
        let solved = runs.get("sound-wave", method);
        let largest = solved.run.profile.velocity.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        largest / exact_peak(solved)
    };
    let (gph, sph) = (error(ParticleMethod::Gph3), error(ParticleMethod::Sph1));
    let cases = spread(CASES[..3].iter().map(|&method| error(method)));
    let fourth = error(ParticleMethod::Gph4) / gph;
    [
        Claim {
            claim: "the sound wave is less distorted by GPH than by SPH",
            place: "5.1, Figs 6–10",
            number: format!(
                "L1 density {} (gph3) against {} (sph1); peak velocity {:.3} and {:.3} of the exact one",
                significant(gph, 3),
                significant(sph, 3),
                peak(ParticleMethod::Gph3),
                peak(ParticleMethod::Sph1)
            ),
            verdict: ClaimVerdict::of(&[gph < sph]),
        },
        Claim {
            claim: "no major difference between the cases in the sound wave",
            place: "5.1",
            number: format!(
                "cases 1–3 differ by {:.2} % in L1; case 4 has {fourth:.2} times their error (its Gaussian is wider)",
                100.0 * (cases - 1.0)
            ),
            verdict: ClaimVerdict::of(&[cases < 1.1, fourth < 1.1]),
        },
    ]
}

fn tubes(runs: &Runs, shells: &[Shell], costs: &[Cost]) -> Vec<Claim> {
    let spread_of = |scene| spread(CASES.iter().map(|&method| density_error(runs, scene, method)));
    let sod = spread_of("sod-sph");
    let ripples = CASES.map(|method| pressure_ripple(runs, "sod-sph", method));
    let percent = |value: f64| format!("{:.1} %", 100.0 * value);
    let shell = |method| {
        shells.iter().find(|shell| shell.method == method).expect("every method has a shell")
    };
    let [one, two, three, four] = CASES.map(shell);
    let fourth_cost = |value: &dyn Fn(&Cost) -> f64| {
        value(cost(costs, "sod-sph", ParticleMethod::Gph4))
            / value(cost(costs, "sod-sph", ParticleMethod::Gph3))
    };
    let fourth_pairs = fourth_cost(&|cost| cost.interactions as f64);
    let per_pair = |scene| {
        let cost = cost(costs, scene, ParticleMethod::Gph3);
        cost.seconds / cost.interactions as f64
    };
    let isothermal = per_pair("isothermal-tube") / per_pair("sod-sph");
    let isothermal_spread = spread_of("isothermal-tube");
    let pressure = {
        // The plateau between the waves, where nothing but the star state counts.
        let solved = runs.get("isothermal-tube", ParticleMethod::Gph3);
        let order = solved.run.profile.inside([-0.05, 0.2]);
        order.iter().map(|&i| solved.run.profile.pressure[i]).sum::<f64>() / order.len() as f64
    };
    let relative = (pressure / 0.496_62 - 1.0).abs();
    vec![
        Claim {
            claim: "no significant difference between the versions in the shock tube",
            place: "5.2, Figs 11–14",
            number: format!("largest L1 density of the four is {sod:.2} times the smallest"),
            verdict: ClaimVerdict::of(&[sod < 1.25]),
        },
        Claim {
            claim: "the broken feature at the contact is weaker in cases 3 and 4 than in 1 and 2",
            place: "5.2",
            number: format!(
                "largest |P/P* − 1| at the contact, cases 1 to 4: {}",
                ripples.map(percent).join(", ")
            ),
            verdict: ClaimVerdict::of(&[
                ripples[2] < ripples[0].min(ripples[1]),
                ripples[3] < ripples[0].min(ripples[1]),
            ]),
        },
        Claim {
            claim: "case 4 takes more time than case 3",
            place: "Fig. 14",
            number: format!(
                "{fourth_pairs:.2} times the pair interactions (judged), {:.2} times the seconds",
                fourth_cost(&|cost| cost.seconds)
            ),
            verdict: ClaimVerdict::of(&[fourth_pairs > 1.0]),
        },
        Claim {
            claim: "case 1 underestimates the density of the blast's shell by a few per cent",
            place: "Fig. 15",
            number: format!(
                "mean density {} of the exact one; beside the contact up to {}",
                percent(one.mean_density),
                percent(one.largest_density)
            ),
            verdict: ClaimVerdict::of(&[(0.9..0.99).contains(&one.mean_density)]),
        },
        Claim {
            claim: "the density of case 2 is worse, and its velocity overshoots at the shock",
            place: "Fig. 16",
            number: format!(
                "mean density {}; L1 density {} against {} (case 1); overshoot {} against {}",
                percent(two.mean_density),
                significant(density_error(runs, "strong-blast", two.method), 3),
                significant(density_error(runs, "strong-blast", one.method), 3),
                percent(two.velocity_overshoot),
                percent(one.velocity_overshoot)
            ),
            verdict: ClaimVerdict::of(&[
                density_error(runs, "strong-blast", two.method)
                    > density_error(runs, "strong-blast", one.method),
                two.velocity_overshoot > 0.005,
            ]),
        },
        Claim {
            claim: "case 3 has a better density than 1 and 2 and a smaller ripple at the contact",
            place: "Fig. 17",
            number: format!(
                "mean density {}; ripple of the pressure {} against {} and {}",
                percent(three.mean_density),
                percent(three.pressure_ripple),
                percent(one.pressure_ripple),
                percent(two.pressure_ripple)
            ),
            verdict: ClaimVerdict::of(&[
                (three.mean_density - 1.0).abs()
                    < (one.mean_density - 1.0).abs().min((two.mean_density - 1.0).abs()),
                three.pressure_ripple < one.pressure_ripple.min(two.pressure_ripple),
            ]),
        },
        Claim {
            claim: "case 4 is very similar to case 3 in the blast",
            place: "Fig. 18",
            number: format!(
                "mean density {} against {}; L1 density {} against {}",
                percent(four.mean_density),
                percent(three.mean_density),
                significant(density_error(runs, "strong-blast", four.method), 3),
                significant(density_error(runs, "strong-blast", three.method), 3)
            ),
            verdict: ClaimVerdict::of(&[
                density_error(runs, "strong-blast", four.method)
                    < 1.25 * density_error(runs, "strong-blast", three.method),
                (four.mean_density - three.mean_density).abs() < 0.02,
            ]),
        },
        Claim {
            claim: "in the isothermal tube all versions have a clean pressure and meet the analytic solution",
            place: "5.4, Figs 19–22",
            number: format!(
                "plateau of gph3 {pressure:.4}, exact 0.4966, two-shock 0.5; largest L1 of the four {isothermal_spread:.2} times the smallest"
            ),
            verdict: ClaimVerdict::of(&[relative < 0.01, isothermal_spread < 1.25]),
        },
        Claim {
            claim: "isothermal GPH is faster, its solver does not iterate",
            place: "5.4",
            number: format!(
                "seconds per pair {isothermal:.2} of those with van Leer's solver (gph3); 0.9 to 1.1 is no difference"
            ),
            verdict: ClaimVerdict::faster(isothermal),
        },
    ]
}

fn rarefaction(contacts: &[ContactEnergy]) -> [Claim; 2] {
    let energies = |solver: SolverChoice| {
        contacts
            .iter()
            .filter(move |c| c.method.is_godunov() && c.solver == solver && c.particles < 500)
            .filter_map(|c| Some(c.energy? / c.exact))
    };
    let list = |solver| energies(solver).map(|u| format!("{u:.2}")).collect::<Vec<_>>().join(", ");
    let completed = contacts.iter().all(|contact| contact.energy.is_some());
    let wrong = energies(SolverChoice::Published).filter(|&u| u > 1.2).count() == CASES.len();
    // Had the solver been at fault, the exact one would be right.
    let cured =
        energies(SolverChoice::Exact).filter(|&u| (u - 1.0).abs() < 0.2).count() == CASES.len();
    let sph = contacts
        .iter()
        .find(|c| c.method == ParticleMethod::Sph1)
        .and_then(|c| Some(c.energy? / c.exact))
        .unwrap_or(f64::NAN);
    [
        Claim {
            claim: "pressure protection lets GPH through the cavity, with a large error of the energy at the centre",
            place: "5.5, Figs 23–26",
            number: format!(
                "every run complete: {}; u at the centre over exact, cases 1 to 4: {}",
                if completed { "yes" } else { "no" },
                list(SolverChoice::Published)
            ),
            verdict: ClaimVerdict::of(&[completed, wrong]),
        },
        Claim {
            claim: "that error is probably the fault of the iterative Riemann solver",
            place: "5.5",
            number: format!(
                "with the exact solver: {}; SPH, which has none: {sph:.2}",
                list(SolverChoice::Exact)
            ),
            verdict: ClaimVerdict::of(&[cured]),
        },
    ]
}

fn collisions(penetrations: &[PenetrationCount]) -> [Claim; 2] {
    let published = |count: &&PenetrationCount| !count.constant_smoothing && count.approach <= 1.2;
    let clean = |count: &PenetrationCount| count.largest == Some(0);
    let as_published = penetrations.iter().filter(published).all(clean);
    let adaptive = |found: fn(Option<usize>) -> bool| {
        let counts = penetrations.iter().filter(|count| !count.constant_smoothing);
        counts.filter(|count| found(count.largest)).count()
    };
    let passed = adaptive(|largest| largest.is_some_and(|largest| largest > 0));
    let broken = adaptive(|largest| largest.is_none());
    let godunov = |count: &&PenetrationCount| count.method.is_godunov();
    let anywhere = penetrations.iter().filter(godunov).all(clean);
    let offenders: Vec<String> = penetrations
        .iter()
        .filter(godunov)
        .filter(|count| !clean(count))
        .map(|count| {
            let h = if count.constant_smoothing { "constant" } else { "adaptive" };
            let how = if count.largest.is_none() { " (broke down)" } else { "" };
            format!("{} at {} c, {h} h{how}", count.method.name(), count.approach)
        })
        .collect();
    let (shown, more) = (offenders.len().min(3), offenders.len().saturating_sub(3));
    [
        Claim {
            claim: "no particle passes another in the collisions, with GPH or SPH",
            place: "5.6, Fig. 27",
            number: format!(
                "out of order at 0.6 c and 1.2 c: {}; up to 10 c with adaptive h: in {passed} of {} runs \
                 ({broken} broke down)",
                if as_published { "none" } else { "some" },
                penetrations.iter().filter(|count| !count.constant_smoothing).count()
            ),
            verdict: ClaimVerdict::of(&[as_published]),
        },
        Claim {
            claim: "particles do not penetrate in GPH",
            place: "section 6",
            number: if offenders.is_empty() {
                "none up to 10 c, whatever h".into()
            } else {
                let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
                format!("passed: {}{rest}", offenders[..shown].join("; "))
            },
            verdict: ClaimVerdict::of(&[as_published, anywhere]),
        },
    ]
}

fn time(costs: &[Cost]) -> [Claim; 2] {
    let ratio = |scene: &str, value: &dyn Fn(&Cost) -> f64| {
        let sph = value(cost(costs, scene, ParticleMethod::Sph1));
        CASES.map(|method| value(cost(costs, scene, method)) / sph)
    };
    let text = |cases: [f64; 4]| cases.map(|case| format!("{case:.2}")).join(", ");
    let seconds = ratio("sod-sph", &|cost| cost.seconds);
    let isothermal = ratio("isothermal-tube", &|cost| cost.seconds);
    let pairs =
        ["sod-sph", "isothermal-tube"].map(|scene| ratio(scene, &|cost| cost.interactions as f64));
    let searches = cost(costs, "sod-sph", ParticleMethod::Sph1).searches as f64
        / cost(costs, "sod-sph", ParticleMethod::Gph3).searches as f64;
    let mut all = [&pairs[0][..3], &pairs[1][..3]].concat();
    all.sort_by(f64::total_cmp);
    let median = 0.5 * (all[2] + all[3]);
    [
        Claim {
            claim: "GPH takes about 70 per cent of the processor time of SPH",
            place: "section 6",
            number: format!(
                "pair interactions over SPH 1, cases 1 to 4: {} (shock tube), {} (isothermal tube), median of cases 1 to 3 \
                 {median:.2} (judged: about 70 per cent, and less); seconds: {}; {}",
                text(pairs[0]),
                text(pairs[1]),
                text(seconds),
                text(isothermal)
            ),
            verdict: ClaimVerdict::of(&[(0.6..0.8).contains(&median), median < 1.0]),
        },
        Claim {
            claim: "SPH searches neighbours twice as often, because it is second order in time",
            place: "section 6",
            number: format!("{searches:.2} times as many searches as gph3 on the shock tube"),
            verdict: ClaimVerdict::of(&[(1.9..2.1).contains(&searches)]),
        },
    ]
}

pub(super) fn table(claims: &[Claim]) -> Item {
    let mut table = Table::new(
        "Claims of the paper about its one-dimensional tests and our numbers. Every verdict is a rule applied to the \
         numbers, at the settings of the tables above; the paper does not state kernel, h/Δx and step. Where work is claimed, \
         pair interactions are judged, which are the same on every machine; seconds stand beside them.",
        &[
            ("claim", Align::Left),
            ("where", Align::Left),
            ("our numbers", Align::Left),
            ("verdict", Align::Left),
        ],
    );
    for claim in claims {
        table.push([
            claim.claim.to_string(),
            claim.place.into(),
            claim.number.clone(),
            claim.verdict.name().into(),
        ]);
    }
    Item::Table { name: "particle_claims".into(), table, command: COMMAND.into() }
}

#[cfg(test)]
mod tests {
    use super::ClaimVerdict;

    #[test]
    fn times_that_hardly_differ_decide_nothing() {
        let verdicts =
            [0.5, 0.89, 0.95, 1.0, 1.05, 1.2].map(|share| ClaimVerdict::faster(share).name());
        let no = "no difference";
        assert_eq!(verdicts, ["confirmed", "confirmed", no, no, no, "not confirmed"]);
    }
}
