//! From the names in the options to the types of a run.

use super::gas::Gas;
use super::godunov::Godunov;
use super::method::{MethodOptions, ParticleMethod, SolverChoice};
use super::pair_loops::PairLoops;
use super::pair_weight::{Convolution, OwnKernels, Product, SumOfSquares};
use super::viscous::{PressureForm, Smoothed};
use crate::riemann::isothermal::{Expansion, Isothermal};
use crate::riemann::{ExactIdeal, StarSolver, Stopping, VanLeer};
use crate::scene::Material;

/// What is to be done in `D` dimensions with a gas and a pair force, whichever they are.
pub(crate) trait Task<const D: usize> {
    type Output;

    fn run<G: Gas>(self, gas: G, force: Box<dyn PairLoops<D>>) -> Self::Output;
}

/// Does it with the gas of a scene and the pair force of a method.
pub(crate) fn dispatch<const D: usize, T: Task<D>>(
    material: Material,
    options: &MethodOptions,
    task: T,
) -> T::Output {
    let force = pair_force(material, options);
    match material {
        Material::Isothermal(gas) => task.run(gas, force),
        Material::Ideal(gas) => task.run(gas, force),
    }
}

/// The pair force of a method for a gas.
pub(super) fn pair_force<const D: usize>(
    material: Material,
    options: &MethodOptions,
) -> Box<dyn PairLoops<D>> {
    match (material, options.solver) {
        (Material::Isothermal(gas), solver) => {
            let expansion = match solver {
                SolverChoice::Published => Expansion::AsShock,
                SolverChoice::Converged | SolverChoice::Exact => Expansion::Exact,
            };
            with_solver(options, Isothermal { sound_speed: gas.sound_speed, expansion })
        }
        (Material::Ideal(gas), SolverChoice::Published) => {
            with_solver(options, VanLeer { gas, stopping: Stopping::Published })
        }
        (Material::Ideal(gas), SolverChoice::Converged) => {
            with_solver(options, VanLeer { gas, stopping: Stopping::Converged })
        }
        (Material::Ideal(gas), SolverChoice::Exact) => with_solver(options, ExactIdeal(gas)),
    }
}

fn with_solver<const D: usize, S: StarSolver>(
    options: &MethodOptions,
    solver: S,
) -> Box<dyn PairLoops<D>> {
    let work = options.pair_work;
    let smoothed = |form| Box::new(Smoothed { form, viscosity: options.viscosity });
    match options.method {
        ParticleMethod::Gph1 => Box::new(Godunov { weight: SumOfSquares, solver, work }),
        ParticleMethod::Gph2 => Box::new(Godunov { weight: Product, solver, work }),
        ParticleMethod::Gph3 => Box::new(Godunov { weight: OwnKernels, solver, work }),
        ParticleMethod::Gph4 => Box::new(Godunov { weight: Convolution, solver, work }),
        ParticleMethod::Sph1 | ParticleMethod::Adke => smoothed(PressureForm::Sum),
        ParticleMethod::Sph2 => smoothed(PressureForm::Geometric),
    }
}
