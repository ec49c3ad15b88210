//! From the names in the options to the types of a run.

use super::gas::Gas;
use super::godunov::Godunov;
use super::method::{MethodOptions, ParticleMethod, SolverChoice};
use super::pair_force::PairForce;
use super::pair_weight::{Convolution, OwnKernels, Product, SumOfSquares};
use super::scene::Material;
use super::viscous::{PressureForm, Smoothed};
use crate::riemann::isothermal::{Expansion, Isothermal};
use crate::riemann::{ExactIdeal, StarSolver, Stopping, VanLeer};

/// What is to be done with a gas and a pair force, whichever they are.
pub(crate) trait Task {
    type Output;

    fn run<G: Gas, F: PairForce>(self, gas: G, force: F) -> Self::Output;
}

/// Does it with the gas of a scene and the pair force of a method.
pub(crate) fn dispatch<T: Task>(material: Material, options: &MethodOptions, task: T) -> T::Output {
    match material {
        Material::Isothermal(gas) => {
            let expansion = match options.solver {
                SolverChoice::Published => Expansion::AsShock,
                SolverChoice::Converged | SolverChoice::Exact => Expansion::Exact,
            };
            let solver = Isothermal { sound_speed: gas.sound_speed, expansion };
            with_solver(options, gas, solver, task)
        }
        Material::Ideal(gas) => {
            let van_leer = |stopping| VanLeer { gas, stopping };
            match options.solver {
                SolverChoice::Published => {
                    with_solver(options, gas, van_leer(Stopping::Published), task)
                }
                SolverChoice::Converged => {
                    with_solver(options, gas, van_leer(Stopping::Converged), task)
                }
                SolverChoice::Exact => with_solver(options, gas, ExactIdeal(gas), task),
            }
        }
    }
}

fn with_solver<G: Gas, S: StarSolver, T: Task>(
    options: &MethodOptions,
    gas: G,
    solver: S,
    task: T,
) -> T::Output {
    let smoothed = |form| Smoothed { form, viscosity: options.viscosity };
    match options.method {
        ParticleMethod::Gph1 => task.run(gas, Godunov { weight: SumOfSquares, solver }),
        ParticleMethod::Gph2 => task.run(gas, Godunov { weight: Product, solver }),
        ParticleMethod::Gph3 => task.run(gas, Godunov { weight: OwnKernels, solver }),
        ParticleMethod::Gph4 => {
            task.run(gas, Godunov { weight: Convolution(options.volume), solver })
        }
        ParticleMethod::Sph1 => task.run(gas, smoothed(PressureForm::Sum)),
        ParticleMethod::Sph2 => task.run(gas, smoothed(PressureForm::Geometric)),
    }
}
