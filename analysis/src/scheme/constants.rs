//! Whether a scheme keeps what is the same everywhere.

use crate::exact::cosine_series::CosineSeries;
use crate::exact::laurent::Variable;
use crate::exact::rational::Rational;
use crate::scheme::{SchemeError, Step};
use num_traits::One;

impl Step {
    /// Whether a state that is the same everywhere and at every level solves the equations, whatever the parameters without a value:
    /// `χ(1) = 0` at `φ = 0`. Never said of sums that are only enclosed, unless they cancel.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// let keeps = |text: &str| Step::from_text(text).unwrap().keeps_constants().unwrap();
    /// assert!(keeps("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])"));
    /// assert!(!keeps("u[n+1,j] = u[n,j] - C*u[n,j-1]"));
    /// ```
    ///
    /// # Errors
    /// When the equations have no characteristic polynomial.
    pub fn keeps_constants(&self) -> Result<bool, SchemeError> {
        let one = Rational::one();
        let axes = (0..3).map(Variable::axis);
        let mut rest = std::iter::once(Variable::TIME)
            .chain(axes)
            .fold(self.characteristic()?, |rest, variable| rest.at_fraction(variable, &one));
        for (variable, letter) in self.names.letters() {
            if letter.value.is_exact() {
                let center: CosineSeries<Rational> = letter.value.center();
                rest = rest.at_fraction(variable, &center.coefficients().iter().sum());
            }
        }
        Ok(self.names.reduce(rest).is_zero())
    }
}
