//! What a method leaves open beside kernel, ratio and Courant number.

use crate::cli::numbers::{Names, Numbers};
use crate::cli::{Failure, numbers, waves};
use clap::{Args, ValueEnum};
use courant::analysis::exact::rational::to_f64;
use courant::analysis::scheme::Integrator;
use courant::simulation::lagrangian::flux::{ContactViscosity, ModifiedRoe, RoeMean};
use courant::simulation::particles::{PairWork, SolverChoice, Work};

/// The options, each a list; each is refused by methods that do not have it.
#[derive(Debug, Clone, Args)]
pub struct Choices {
    /// sph1, sph2, sph-adke: linear viscosity α (default: 1).
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, value_parser = numbers::alphas)]
    pub alpha: Option<Numbers>,
    /// sph1, sph2, sph-adke: quadratic viscosity β (default: 2).
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, value_parser = numbers::alphas)]
    pub beta: Option<Numbers>,
    /// gph1 to gph4: Riemann solver (default: published).
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',')]
    pub riemann: Vec<SolverName>,
    /// gph1 to gph4, sph1, sph2, sph-adke: see `courant list integrators` (default: centred-euler; SPH rk2-heun,
    /// sph-adke rk2-midpoint).
    #[arg(long, value_name = "NAMES", value_parser = |text: &str| numbers::names(text, waves::integrator))]
    pub integrator: Option<Names<&'static Integrator>>,
    /// gph1 to gph4, sph1, sph2, sph-adke: the velocity at which forces work (default: centred; SPH published).
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',')]
    pub work: Vec<WorkName>,
    /// gph1 to gph4: the velocity of a pair at which its force works (default: as printed, mean for gph1 and gph2, star for
    /// gph3 and gph4; under gravity shared for these).
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',')]
    pub pair_work: Vec<PairWorkName>,
    /// lagrangian-roe: what the mean state is the mean of (default: density).
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',')]
    pub roe_mean: Vec<MeanName>,
    /// lagrangian-roe: viscosity of the contact over the largest velocity (default: 0.1).
    #[arg(long, value_name = "FACTORS", allow_hyphen_values = true, value_parser = numbers::running_non_negative)]
    pub contact: Option<Numbers>,
    /// lagrangian-roe: form of that viscosity (default: printed).
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',')]
    pub contact_form: Vec<ContactName>,
}

/// Riemann solvers by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SolverName {
    /// As in Cha & Whitworth 2003: van Leer's iteration with its stopping rule; isothermal (27).
    Published,
    /// Van Leer's iteration to convergence; isothermal exact.
    Converged,
    /// Exact.
    Exact,
}

/// Velocities at which forces work, by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum WorkName {
    /// The mean of those before and after the step: total energy is conserved to round-off.
    Centred,
    /// That of each stage, as printed for GPH 1 and 2 and SPH: an error of the time steps, which strong shocks keep.
    Published,
}

/// Velocities of a pair at which its force works, by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PairWorkName {
    /// The mean of the two: both heat alike.
    Mean,
    /// That of the star state: heat flows down the slope of the pressure, also where gravity holds it.
    Star,
    /// The mean for a pair that approaches; of one that parts each end cools in proportion to its pressure.
    Shared,
}

/// Roe means by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MeanName {
    /// Of the densities, as printed in Ferrari et al. 2008 (3.14).
    Density,
    /// Of the specific volumes: consistent in the sense of Roe.
    Volume,
}

/// Forms of the contact's viscosity by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ContactName {
    /// A velocity, Ferrari et al. 2008 (3.15).
    Printed,
    /// Times the mean density: a mass flux, as the other eigenvalues are.
    MassFlux,
}

/// The value of an option where a case has one.
pub fn one<T>(list: &Option<Names<T>>) -> Option<&T> {
    list.as_ref().and_then(|list| list.0.first())
}

impl Choices {
    /// Refuses the first option given that is not in `has`, for a method or family called `name`.
    pub fn only(&self, has: &[&str], name: &str) -> Result<(), Failure> {
        let given = [
            ("--alpha", self.alpha.is_some()),
            ("--beta", self.beta.is_some()),
            ("--riemann", !self.riemann.is_empty()),
            ("--integrator", self.integrator.is_some()),
            ("--work", !self.work.is_empty()),
            ("--pair-work", !self.pair_work.is_empty()),
            ("--roe-mean", !self.roe_mean.is_empty()),
            ("--contact", self.contact.is_some()),
            ("--contact-form", !self.contact_form.is_empty()),
        ];
        match given.into_iter().find(|(option, given)| *given && !has.contains(option)) {
            Some((option, _)) => {
                let all = if has.is_empty() { "none of this kind".into() } else { has.join(", ") };
                Err(Failure::Message(format!(
                    "{option}: {name} has no such option; accepted: {all}"
                )))
            }
            None => Ok(()),
        }
    }

    /// α, or what it is otherwise.
    pub fn alpha(&self, otherwise: f64) -> f64 {
        one(&self.alpha).map_or(otherwise, to_f64)
    }

    /// β, or what it is otherwise.
    pub fn beta(&self, otherwise: f64) -> f64 {
        one(&self.beta).map_or(otherwise, to_f64)
    }

    /// The solver, or what it is otherwise.
    pub fn solver(&self, otherwise: SolverChoice) -> SolverChoice {
        match self.riemann.first() {
            None => otherwise,
            Some(SolverName::Published) => SolverChoice::Published,
            Some(SolverName::Converged) => SolverChoice::Converged,
            Some(SolverName::Exact) => SolverChoice::Exact,
        }
    }

    /// The integrator, or what it is otherwise.
    pub fn integrator(&self, otherwise: &'static Integrator) -> &'static Integrator {
        one(&self.integrator).copied().unwrap_or(otherwise)
    }

    /// The velocity at which forces work, or what it is otherwise.
    pub fn work(&self, otherwise: Work) -> Work {
        match self.work.first() {
            None => otherwise,
            Some(WorkName::Centred) => Work::TimeCentred,
            Some(WorkName::Published) => Work::Instantaneous,
        }
    }

    /// The velocity of a pair at which its force works, or what it is otherwise.
    pub fn pair_work(&self, otherwise: PairWork) -> PairWork {
        match self.pair_work.first() {
            None => otherwise,
            Some(PairWorkName::Mean) => PairWork::Mean,
            Some(PairWorkName::Star) => PairWork::Star,
            Some(PairWorkName::Shared) => PairWork::Shared,
        }
    }

    /// The flux with the choices made.
    pub fn roe(&self, otherwise: ModifiedRoe) -> ModifiedRoe {
        let mean = match self.roe_mean.first() {
            None => otherwise.mean,
            Some(MeanName::Density) => RoeMean::Density,
            Some(MeanName::Volume) => RoeMean::Volume,
        };
        let (printed, usual) = match otherwise.contact {
            ContactViscosity::Printed(factor) => (true, factor),
            ContactViscosity::MassFlux(factor) => (false, factor),
        };
        let factor = one(&self.contact).map_or(usual, to_f64);
        let printed =
            self.contact_form.first().map_or(printed, |form| *form == ContactName::Printed);
        let contact = match printed {
            true => ContactViscosity::Printed(factor),
            false => ContactViscosity::MassFlux(factor),
        };
        ModifiedRoe { mean, contact }
    }
}
