//! A particle method of the catalogue with its kernel, smoothing ratio, density and values: all that its waves depend on but the step.

use super::catalogue::SchemeFile;
use super::{Integrator, KernelLattice, Lines, SchemeError, Step};
use crate::exact::rational::{Rational, to_text};
use crate::kernel::lattice::RatioOutOfRange;
use crate::kernel::{Density, Kernel};

/// The time step of particle methods: `c Δt/h`.
pub const COURANT: &str = "C";

/// A particle method on a lattice.
///
/// ```
/// use courant_analysis::{exact::rational::integer, kernel::Kernel};
/// use courant_analysis::scheme::{Integrator, LatticeMethod, catalogue};
/// // At h = Δ the cubic spline has ω0² = 4(1 − cos φ) − sin²φ ≤ 8 c²/Δ²: the leapfrog needs ω0 Δt ≤ 2.
/// let sph = catalogue::method("sph").unwrap();
/// let lattice = LatticeMethod::new(sph, Kernel::CubicSpline, &integer(1))?;
/// let step = lattice.step(Integrator::for_particles("leapfrog").unwrap())?;
/// assert_eq!(step.limit("C")?.exact().unwrap().to_string(), "sqrt(1/2)");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct LatticeMethod {
    file: &'static SchemeFile,
    kernel: Kernel,
    density: Density,
    lattice: KernelLattice,
    values: Vec<(String, Rational)>,
}

impl LatticeMethod {
    /// With the summation density and the values of the file: isothermal, `P = ρ0 c²`.
    ///
    /// # Errors
    /// When the ratio is not in `(0, 50]`.
    pub fn new(
        file: &'static SchemeFile,
        kernel: Kernel,
        ratio: &Rational,
    ) -> Result<Self, RatioOutOfRange> {
        let lattice = KernelLattice::new(kernel, ratio)?;
        Ok(Self { file, kernel, density: Density::default(), lattice, values: Vec::new() })
    }

    /// With another value of a parameter.
    #[must_use]
    pub fn with(mut self, name: &str, value: &Rational) -> Self {
        self.values.retain(|(known, _)| known != name);
        self.values.push((name.into(), value.clone()));
        self
    }

    /// With the density of the undisturbed lattice that the equations use.
    #[must_use]
    pub fn with_density(self, density: Density) -> Self {
        Self { density, lattice: self.lattice.with_density(density), ..self }
    }

    /// At another smoothing ratio.
    ///
    /// # Errors
    /// When the ratio is not in `(0, 50]`.
    pub fn at_ratio(&self, ratio: &Rational) -> Result<Self, RatioOutOfRange> {
        let lattice = KernelLattice::new(self.kernel, ratio)?.with_density(self.density);
        Ok(Self { lattice, ..self.clone() })
    }

    /// The equations.
    pub fn file(&self) -> &'static SchemeFile {
        self.file
    }

    /// The kernel.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    /// The density that the equations use.
    pub fn density(&self) -> Density {
        self.density
    }

    /// `h/Δ`.
    pub fn ratio(&self) -> &Rational {
        &self.lattice.ratio
    }

    /// The value of a parameter: the one set, or that of the file.
    pub fn value(&self, name: &str) -> Option<&Rational> {
        let set = self.values.iter().find(|(known, _)| known == name).map(|(_, value)| value);
        set.or_else(|| self.file.parameters.get(name))
    }

    /// "SPH with viscosity, α = 1".
    pub fn title(&self) -> String {
        match self.value("alpha") {
            Some(alpha) => format!("{}, α = {}", self.file.title, to_text(alpha)),
            None => self.file.title.clone(),
        }
    }

    /// The equations of lines, with the step free.
    ///
    /// # Errors
    /// When the equations are none of lines, or there is no such parameter.
    pub fn lines(&self) -> Result<Lines, SchemeError> {
        self.file.lines(Some(&self.lattice), &self.values, Some(COURANT))
    }

    /// One step, with its length `c Δt/h` free.
    ///
    /// # Errors
    /// As [`lines`](Self::lines), and when the integrator does not serve.
    pub fn step(&self, integrator: &Integrator) -> Result<Step, SchemeError> {
        Step::lines(&self.lines()?, integrator)
    }
}
