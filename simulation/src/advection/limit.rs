//! Stability limits found by running, beside the proved ones.

use super::growth::{Growth, GrowthPlan, GrowthVerdict, measure_growth, seed_with_noise};
use super::lattice_path::LatticePath;
use super::method::Method;
use super::modes::RingModes;
use super::scheme::Discretisation;
use courant_analysis::exact::rational::Rational;
use courant_analysis::stability::{Limit, SearchPlan, sampled_stability_limit};

/// The seed of the noise that runs start from.
const SEED: u64 = 20_080_101;

/// Where a scheme stops being stable, as its runs tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredLimit {
    /// The largest Courant number whose run did not grow; 0 when all grew.
    pub stable: f64,
    /// The smallest Courant number above it whose run grew.
    pub unstable: f64,
    /// Runs done.
    pub runs: u32,
    /// Steps of all runs together.
    pub steps: u64,
}

/// The ends of a bracket do not differ.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoBracket {
    /// The lower end grows.
    #[error("the run at C = {0} grows already")]
    LowerGrows(f64),
    /// The upper end does not grow.
    #[error("the run at C = {0} does not grow")]
    UpperDoesNotGrow(f64),
}

/// How the noise run of one Courant number ends.
fn noise_growth(
    discretisation: &Discretisation,
    courant_number: f64,
    particles: usize,
    plan: &GrowthPlan,
) -> Growth {
    let mut stepper = LatticePath::new(Method::of(discretisation, courant_number), particles);
    seed_with_noise(&mut stepper, SEED);
    measure_growth(&mut stepper, plan)
}

/// Bisects the Courant number at which runs on a ring of `particles` begin to grow, between `lower`
/// (0 counts as stable: nothing moves) and `upper`, to a width of `resolution`.
///
/// A ring holds the phases `2πm/N` only, so the answer is the limit of these modes: at least the
/// lattice's, by `O(1/N²)` where the long wave binds. Where the stable set has gaps, one of its ends
/// within the bracket is found. Each run must be long enough for the fastest mode to be left alone, which
/// near a limit may take some 100,000 steps: [`GrowthPlan::settling`] stops each run when it is. Where the modes that compete are all slow (long waves of
/// Lax–Wendroff SPH) windows of a thousand steps are needed to see their rates settle. A mode that grows by less than `1e-13` per step counts as stable.
///
/// # Errors
/// When the ends of the bracket do not differ.
pub fn measured_stability_limit(
    discretisation: &Discretisation,
    particles: usize,
    (lower, upper): (f64, f64),
    resolution: f64,
    plan: &GrowthPlan,
) -> Result<MeasuredLimit, NoBracket> {
    let (mut runs, mut steps) = (0, 0);
    let mut grows = |courant_number: f64| {
        runs += 1;
        let growth = noise_growth(discretisation, courant_number, particles, plan);
        steps += growth.steps();
        growth.verdict == GrowthVerdict::Growing
    };
    if lower > 0.0 && grows(lower) {
        return Err(NoBracket::LowerGrows(lower));
    }
    if !grows(upper) {
        return Err(NoBracket::UpperDoesNotGrow(upper));
    }
    let (mut stable, mut unstable) = (lower, upper);
    while unstable - stable > resolution {
        let middle = stable.midpoint(unstable);
        if middle <= stable || middle >= unstable {
            break;
        }
        if grows(middle) { unstable = middle } else { stable = middle }
    }
    Ok(MeasuredLimit { stable, unstable, runs, steps })
}

/// Proved, restricted to the modes of a ring, and measured on that ring.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitComparison {
    /// The limit of the infinite lattice.
    pub proved: Limit,
    /// The limit of the gain at the ring's phases `2πm/N`.
    pub ring: f64,
    /// The limit of the runs on the ring.
    pub measured: MeasuredLimit,
    /// Particles on the ring.
    pub particles: usize,
}

/// Bisects by runs about the limit that the gain has on a ring, and sets both beside the proved limit.
///
/// # Errors
/// When the runs 2 % below and above the ring's limit do not differ. A ring limit of 0 is approached from
/// `max_courant`.
pub fn compare_limits(
    discretisation: &Discretisation,
    particles: usize,
    max_courant: &Rational,
    resolution: f64,
    plan: &GrowthPlan,
) -> Result<LimitComparison, NoBracket> {
    let plan_of_proof = SearchPlan::default().up_to(max_courant.clone());
    let proved = discretisation.stable_set_by(&plan_of_proof).limit();
    let modes = RingModes::new(particles);
    let phases: Vec<f64> = (0..modes.count()).map(|mode| modes.phase(mode)).collect();
    let ring = sampled_stability_limit(&discretisation.margin(), &phases, max_courant).value();
    let end = courant_analysis::exact::rational::to_f64(max_courant);
    let bracket = if ring > 0.0 { (0.98 * ring, (1.02 * ring).min(end)) } else { (0.0, end) };
    let measured = measured_stability_limit(discretisation, particles, bracket, resolution, plan)?;
    Ok(LimitComparison { proved, ring, measured, particles })
}

/// A long noise run at one Courant number, with the growth that the gain predicts for the ring.
#[derive(Debug, Clone, PartialEq)]
pub struct LongRun {
    /// The Courant number.
    pub courant_number: f64,
    /// Particles on the ring.
    pub particles: usize,
    /// Steps done.
    pub steps: u64,
    /// The mode with the largest predicted gain, the mean excluded unless it grows.
    pub fastest_mode: usize,
    /// Its predicted gain per step.
    pub predicted_gain: f64,
    /// What the run did.
    pub growth: Growth,
}

/// Steps noise on the lattice path for `windows · steps_per_window` steps.
pub fn long_run(
    discretisation: &Discretisation,
    courant_number: f64,
    particles: usize,
    plan: &GrowthPlan,
) -> LongRun {
    let stencil = discretisation.stencil(courant_number);
    let modes = RingModes::new(particles);
    let gain = |mode| stencil.at_phase(modes.phase(mode)).norm();
    // The mean has gain 1 but for rounding where the scheme keeps constants, and leads only if it grows.
    let start = if gain(0) > 1.0 + 1e-12 || modes.count() == 1 { 0 } else { 1 };
    let (fastest_mode, predicted_gain) = (start..modes.count())
        .map(|mode| (mode, gain(mode)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .expect("the range holds at least one mode");
    let growth = noise_growth(discretisation, courant_number, particles, plan);
    let steps = growth.steps();
    LongRun { courant_number, particles, steps, fastest_mode, predicted_gain, growth }
}
