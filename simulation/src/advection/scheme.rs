//! The schemes that run here, and what the analysis says of each.

use courant_analysis::exact::rational::{Rational, from_f64, integer, to_f64};
use courant_analysis::exact::stencil::Stencil;
use courant_analysis::kernel::Kernel;
use courant_analysis::kernel::lattice::RatioOutOfRange;
use courant_analysis::scheme::catalogue::{self, SchemeFile};
use courant_analysis::scheme::{OneStep, Step};
use courant_analysis::stability::margin::Margin;
use courant_analysis::stability::{Limit, SearchPlan, StableSet};
use courant_analysis::waves::GainExtremes;

/// The advection schemes of Ferrari et al. 2008, section 2: which running code advances. What each is stands in the catalogue.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AdvectionScheme {
    /// Central sums: (2.9).
    EulerSph,
    /// With the second derivative: (2.17).
    LaxWendroffSph,
    /// Upwind sums: (2.18), (2.19).
    GodunovSph,
}

/// A name that is no scheme's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no scheme `{0}`")]
pub struct UnknownScheme(pub String);

/// The name of the Courant number in the catalogue.
const COURANT_NUMBER: &str = "C";

impl AdvectionScheme {
    /// All schemes, in the order they are listed to people.
    pub const ALL: [Self; 3] = [Self::EulerSph, Self::LaxWendroffSph, Self::GodunovSph];

    /// The name used on the command line, in files and in the catalogue.
    pub fn name(self) -> &'static str {
        match self {
            Self::EulerSph => "euler-sph",
            Self::LaxWendroffSph => "lax-wendroff-sph",
            Self::GodunovSph => "godunov-sph",
        }
    }

    /// Its page in the catalogue.
    pub fn file(self) -> &'static SchemeFile {
        catalogue::scheme(self.name()).expect("the catalogue has the schemes that run here")
    }

    /// The name for titles and captions.
    pub fn title(self) -> &'static str {
        &self.file().title
    }

    /// The scheme with a kernel at `ratio = l/Δξ`, its Courant number `C` left free.
    ///
    /// # Errors
    /// When the ratio is out of range.
    pub fn step(self, kernel: Kernel, ratio: &Rational) -> Result<Step, RatioOutOfRange> {
        RatioOutOfRange::check(ratio)?;
        Ok(self.file().with_kernel(kernel, ratio).expect("its equations step with any kernel"))
    }
}

impl std::fmt::Display for AdvectionScheme {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.pad(self.name())
    }
}

impl std::str::FromStr for AdvectionScheme {
    type Err = UnknownScheme;
    fn from_str(text: &str) -> Result<Self, UnknownScheme> {
        let wanted = text.trim().to_ascii_lowercase();
        let found = Self::ALL.into_iter().find(|scheme| scheme.name() == wanted);
        found.ok_or_else(|| UnknownScheme(text.into()))
    }
}

/// A scheme with its kernel and smoothing ratio `l/Δξ`: everything but the time step.
///
/// ```
/// use courant_analysis::{exact::rational::ratio, kernel::Kernel};
/// use courant_simulation::advection::{AdvectionScheme, Discretisation};
/// let scheme = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, ratio(2, 1));
/// assert_eq!(scheme.unwrap().stable_set().limit().exact().unwrap().to_string(), "15/8");
/// ```
#[derive(Debug, Clone)]
pub struct Discretisation {
    scheme: AdvectionScheme,
    kernel: Kernel,
    ratio: Rational,
    step: Step,
}

impl PartialEq for Discretisation {
    /// The step follows from the rest.
    fn eq(&self, other: &Self) -> bool {
        (self.scheme, self.kernel, &self.ratio) == (other.scheme, other.kernel, &other.ratio)
    }
}

impl Discretisation {
    /// The scheme on the lattice.
    ///
    /// # Errors
    /// When the ratio is out of range.
    pub fn new(
        scheme: AdvectionScheme,
        kernel: Kernel,
        ratio: Rational,
    ) -> Result<Self, RatioOutOfRange> {
        let step = scheme.step(kernel, &ratio)?;
        Ok(Self { scheme, kernel, ratio, step })
    }

    /// The update rule.
    pub fn scheme(&self) -> AdvectionScheme {
        self.scheme
    }

    /// The kernel.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    /// The smoothing ratio `l/Δξ`.
    pub fn ratio(&self) -> &Rational {
        &self.ratio
    }

    /// The scheme, its Courant number `C` left free.
    pub fn step(&self) -> &Step {
        &self.step
    }

    /// Its coefficients in powers of the Courant number.
    pub fn one_step(&self) -> OneStep {
        self.step().one_step(COURANT_NUMBER).expect("the schemes here are explicit")
    }

    /// Its coefficients at one Courant number, which is what multiplies `e^{iφj}` in a step.
    ///
    /// # Panics
    /// When the number is not finite.
    pub fn stencil(&self, courant_number: f64) -> Stencil<f64> {
        let value = from_f64(courant_number).expect("a Courant number is finite");
        self.one_step().stencil_at(&value).map(to_f64)
    }

    /// `1 − |g|²`.
    pub fn margin(&self) -> Margin {
        let margin = self.step().gain_margin(COURANT_NUMBER, &integer(0));
        margin.ok().flatten().expect("the schemes here are explicit")
    }

    /// The extreme gains over all waves at many Courant numbers.
    pub fn gain_extremes(&self, courant_numbers: &[f64]) -> GainExtremes {
        let extremes = self.step().gain_extremes(COURANT_NUMBER, courant_numbers);
        extremes.expect("only the Courant number is free")
    }

    /// Courant numbers up to `10 + 4 l/Δξ` are looked at, far beyond any limit, about `1.2 l/Δξ`.
    pub fn plan(&self) -> SearchPlan {
        SearchPlan::default().up_to(integer(10) + &self.ratio * integer(4))
    }

    /// The stable Courant numbers.
    pub fn stable_set(&self) -> StableSet {
        self.stable_set_by(&self.plan())
    }

    /// The stable Courant numbers, looked for in one's own way.
    pub fn stable_set_by(&self, plan: &SearchPlan) -> StableSet {
        self.step().stable_set(COURANT_NUMBER, plan).expect("only the Courant number is free")
    }

    /// The largest Courant numbers with permitted growths, ascending, looked for in one's own way.
    pub fn limits_by(&self, plan: &SearchPlan, growths: &[Rational]) -> Vec<Limit> {
        let limits = self.step().limits_by(COURANT_NUMBER, plan, growths);
        limits.expect("only the Courant number is free")
    }

    /// The Courant numbers at which no coefficient is negative.
    pub fn monotone_set(&self) -> StableSet {
        let set = self.step().monotone_set(COURANT_NUMBER, &self.plan());
        set.ok().flatten().expect("the schemes here are explicit")
    }
}
