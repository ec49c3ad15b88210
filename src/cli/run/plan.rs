//! What is to be run: a scene, a method, and what was asked of both.

use super::particle_options::{self, invalid};
use super::{Arguments, advection, boxes, methods};
use crate::cli::Failure;
use courant::analysis::exact::rational::{to_f64, to_text};
use courant::reports::run_record::RunReport;
use courant::reports::{advection_profile, cloud_profile, field_profile, gas_run, step_limit};
use courant::simulation::advection::{RunPlan, run_with};
use courant::simulation::field::{FieldScene, run_field};
use courant::simulation::gravity::{Cloud, cloud_options, run_cloud};
use courant::simulation::lagrangian::LagrangianOptions;
use courant::simulation::lagrangian::flux::Flux;
use courant::simulation::method::Method;
use courant::simulation::particles::{MethodOptions, ParticleMethod, StepSharing};
use courant::simulation::run::InvalidOptions;
use courant::simulation::scene::{AnyScene, Scene};
use std::ops::ControlFlow;
use std::time::Instant;

/// A run that can start, by the kind of its scene.
pub enum Plan {
    Advection(RunPlan),
    Line(Scene, Method),
    Field(FieldScene, MethodOptions),
    Cloud(Cloud, MethodOptions),
}

impl Plan {
    pub fn new(arguments: &Arguments, scene: AnyScene) -> Result<Self, Failure> {
        let method = methods::chosen(arguments, &scene)?.to_string();
        let flat = matches!(scene, AnyScene::Advection(_) | AnyScene::Line(_));
        refuse(
            arguments,
            !matches!(scene, AnyScene::Advection(_)),
            flat || matches!(scene, AnyScene::Cloud(_)),
        )?;
        let refused = |error: &InvalidOptions| invalid(error, arguments, &method);
        match scene {
            AnyScene::Advection(scene) => {
                let plan = advection::plan(arguments, &scene, &method)?;
                plan.check().map_err(|error| refused(&error))?;
                Ok(Self::Advection(plan))
            }
            AnyScene::Line(mut scene) => {
                scene.particles = arguments.particles().unwrap_or(scene.particles);
                let method = on_a_line(arguments, &method)?;
                method.check(&scene, scene.particles).map_err(|error| refused(&error))?;
                Ok(Self::Line(scene, method))
            }
            AnyScene::Field(mut scene) => {
                let mut options = scene.options(particles(&method));
                particle_options::choose(arguments, &mut options)?;
                boxes::choose(arguments, &mut scene, &mut options)?;
                scene.particles = in_space(arguments, scene.particles, &options)?;
                Ok(Self::Field(scene, options))
            }
            AnyScene::Cloud(mut cloud) => {
                let mut options = cloud_options(&cloud, MethodOptions::new(particles(&method)));
                let customary = options.integrator;
                particle_options::choose(arguments, &mut options)?;
                if options.integrator != customary {
                    // Blocks have one integrator.
                    options.sharing = StepSharing::Global;
                }
                cloud.particles = in_space(arguments, cloud.particles, &options)?;
                Ok(Self::Cloud(cloud, options))
            }
        }
    }

    /// The name of the scene, and when it ends.
    pub fn scene(&self) -> (&str, f64) {
        match self {
            Self::Advection(plan) => (&plan.scene.name, plan.scene.end_time),
            Self::Line(scene, _) => (&scene.name, scene.end_time),
            Self::Field(scene, _) => (&scene.name, scene.end_time),
            Self::Cloud(cloud, _) => (&cloud.name, cloud.end_time),
        }
    }

    /// What is said before it starts: a step beyond the proved limit.
    pub fn beyond_limit(&self, arguments: &Arguments) -> Option<String> {
        let (gas, method) = match self {
            Self::Advection(plan) => return step_limit::advection(plan),
            Self::Line(scene, method) => (scene.material, *method),
            Self::Field(scene, options) => (scene.gas, Method::Particles(*options)),
            Self::Cloud(cloud, options) => (cloud.material, Method::Particles(*options)),
        };
        step_limit::gas(gas, &method, arguments.ratio())
    }

    /// Runs it.
    pub fn run(
        &self,
        arguments: &Arguments,
        mut observe: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<RunReport, Failure> {
        let start = Instant::now();
        let seconds = || start.elapsed().as_secs_f64();
        let refused = |error: &InvalidOptions| {
            let method = match self {
                Self::Advection(plan) => plan.discretisation.scheme().name(),
                Self::Line(_, method) => method.name(),
                Self::Field(_, options) | Self::Cloud(_, options) => options.method.name(),
            };
            invalid(error, arguments, method)
        };
        let ratio = |used| particle_options::ratio(arguments, used);
        match self {
            Self::Advection(plan) => {
                let result = run_with(plan, observe).map_err(|error| refused(&error))?;
                Ok(advection_profile::report(plan, &result, seconds()))
            }
            Self::Line(scene, method) => {
                let run = method.run_with(scene, scene.particles, observe);
                let (run, seconds) = (run.map_err(|error| refused(&error))?, seconds());
                let ratio = match method {
                    Method::FiniteVolume(_) => String::new(),
                    Method::Lagrangian(options) => ratio(options.ratio),
                    Method::Particles(options) => ratio(options.eta),
                };
                Ok(gas_run::report(scene, method, &ratio, scene.particles, &run, seconds))
            }
            Self::Field(scene, options) => {
                let run = run_field(scene, scene.particles, options, &mut observe);
                let (run, seconds) = (run.map_err(|error| refused(&error))?, seconds());
                Ok(field_profile::report(scene, options, &ratio(options.eta), &run, seconds))
            }
            Self::Cloud(cloud, options) => {
                let count = cloud.particles;
                let run = run_cloud(cloud, count, options, &[], &mut observe);
                let (run, seconds) = (run.map_err(|error| refused(&error))?, seconds());
                Ok(cloud_profile::report(cloud, options, &ratio(options.eta), count, &run, seconds))
            }
        }
    }
}

/// Refuses options of other kinds of scenes.
fn refuse(arguments: &Arguments, not_advection: bool, not_box: bool) -> Result<(), Failure> {
    let advection = arguments.advection.given();
    let advection = advection.iter().filter(|_| not_advection).map(|one| (one, "advection scenes"));
    let boxes = arguments.boxes.given();
    let boxes = boxes.iter().filter(|_| not_box).map(|one| (one, "gases in a box, like shear"));
    match advection.chain(boxes).find(|((_, given), _)| *given) {
        Some(((option, _), family)) => Err(Failure::Message(format!(
            "{option}: scene {} has no such option; it belongs to {family}",
            arguments.scene()
        ))),
        None => Ok(()),
    }
}

fn particles(method: &str) -> ParticleMethod {
    ParticleMethod::named(method).expect("the name is one of these methods")
}

/// How many particles, where the options make sense.
fn in_space(
    arguments: &Arguments,
    usual: usize,
    options: &MethodOptions,
) -> Result<usize, Failure> {
    let particles = arguments.particles().unwrap_or(usual);
    let least = 100;
    let few = (particles < least).then_some(InvalidOptions::Particles { particles, least });
    few.map_or_else(|| options.check().map(|_| ()), Err)
        .map_err(|error| invalid(&error, arguments, options.method.name()))?;
    Ok(particles)
}

/// The method for a gas on a line.
fn on_a_line(arguments: &Arguments, name: &str) -> Result<Method, Failure> {
    let mut method = Method::named(name).expect("the name is one of these methods");
    let choices = &arguments.choices;
    let has: &[&str] = match &method {
        Method::Particles(options) => particle_options::accepted(options.method),
        Method::Lagrangian(LagrangianOptions { flux: Flux::ModifiedRoe(_), .. }) => {
            &["--roe-mean", "--contact", "--contact-form"]
        }
        Method::FiniteVolume(_) | Method::Lagrangian(_) => &[],
    };
    choices.only(has, name)?;
    let cfl = arguments.cfl().map(to_f64);
    match &mut method {
        Method::FiniteVolume(options) => {
            let unused = |option: &str, value: &str| {
                Failure::Message(format!(
                    "{option} {value}: `{name}` has no kernel; it takes --particles, --cfl and --time"
                ))
            };
            if let Some(kernel) = arguments.kernel() {
                return Err(unused("--kernel", kernel.name()));
            }
            if let Some(ratio) = arguments.ratio() {
                return Err(unused("--ratio", &to_text(ratio)));
            }
            options.cfl = cfl.unwrap_or(options.cfl);
        }
        Method::Lagrangian(options) => {
            options.cfl = cfl.unwrap_or(options.cfl);
            options.kernel = arguments.kernel().unwrap_or(options.kernel);
            options.ratio = arguments.ratio().map_or(options.ratio, to_f64);
            if let Flux::ModifiedRoe(roe) = &mut options.flux {
                *roe = choices.roe(*roe);
            }
        }
        Method::Particles(options) => particle_options::choose(arguments, options)?,
    }
    Ok(method)
}
