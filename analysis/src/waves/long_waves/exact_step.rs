//! The exponent of one exact step, as files state it: what a scheme is compared with.

use super::NoSeries;
use crate::exact::laurent::{Laurent, VARIABLES, Variable};
use crate::exact::rational::Rational;
use crate::exact::rational_function::RationalFunction;
use crate::scheme::language::parse_expression;
use crate::scheme::{Name, Names, Step, constant};
use num_traits::{One, Zero};

/// How a parameter scales with the step and the spacing: `Δt^s Δx^t`.
pub(crate) type Weight = (i32, i32);

/// `Σ_m e_m x^m` with `x = iφ`, and what follows for its parameters.
#[derive(Debug, Clone)]
pub(crate) struct ExactStep {
    /// `[e_0, e_1, …]`.
    pub(crate) coefficients: Vec<RationalFunction>,
    /// `e_m = p`, with `p ∝ Δt/Δx^m` as the equation does not know the lattice; `None` where that does not follow.
    pub(crate) weights: Option<Vec<(Variable, Weight)>>,
}

/// `i` stands where `z` stood, which no series contains.
pub(crate) const ROOT: Variable = Variable::TIME;

impl ExactStep {
    /// Reads `-I*C*phi - r*phi^2`; of `±` the lower sign, which is the wave to the right.
    pub(crate) fn new(text: &str, step: &Step) -> Result<Self, NoSeries> {
        let refuse = |reason: String| NoSeries::Exact(text.into(), reason);
        let plain = text.replace('±', "-");
        let mut names = Names::default();
        let expression = parse_expression(&plain).map_err(|error| refuse(error.to_string()))?;
        let fraction = constant(&expression, &plain, &mut names);
        let fraction = fraction.map_err(|error| refuse(error.to_string()))?;
        let Some(below) = fraction.denominator.as_constant() else {
            return Err(refuse("it divides by a name".into()));
        };
        let mut exact = Self { coefficients: Vec::new(), weights: Some(Vec::new()) };
        for (exponents, value) in fraction.numerator.terms() {
            let mut factor = Rational::new(value.clone(), below.clone());
            let mut monomial = [0i16; VARIABLES];
            let (mut turns, mut power) = (0, 0);
            let mut free = Vec::new();
            for (name, exponent) in names.all().iter().zip(&exponents[4..]) {
                let Name::Parameter(name) = name else {
                    return Err(refuse("it contains an irrational number".into()));
                };
                let axis = match name.as_str() {
                    _ if *exponent == 0 => continue,
                    "I" => {
                        turns += exponent;
                        continue;
                    }
                    "phi" | "phi_x" => Some(0),
                    "phi_y" => Some(1),
                    "phi_z" => Some(2),
                    _ => None,
                };
                let set = step.set_parameters().iter().find(|(known, _)| known == name);
                match (axis, set, step.names().parameter(name)) {
                    (Some(axis), ..) => {
                        power += exponent;
                        if step.dimension() > 1 {
                            monomial[Variable::axis(axis).0] = *exponent;
                        }
                    }
                    (_, Some((_, value)), _) => factor *= value.pow(i32::from(*exponent)),
                    (_, _, Some(variable)) => {
                        monomial[variable.0] = *exponent;
                        free.push((variable, *exponent));
                    }
                    _ => return Err(refuse(format!("`{name}` is not in the equations"))),
                }
            }
            exact.add(factor, monomial, turns, power as usize);
            exact.weigh(&free, power);
        }
        Ok(exact)
    }

    /// One term `factor · monomial · i^turns φ^power`, with `φ = −i x`.
    fn add(&mut self, factor: Rational, mut monomial: [i16; VARIABLES], turns: i16, power: usize) {
        let turns = (turns as usize + 3 * power) % 4;
        monomial[ROOT.0] = (turns % 2) as i16;
        let sign = if turns < 2 { Rational::one() } else { -Rational::one() };
        let term = RationalFunction::from(Laurent::monomial(monomial, One::one()));
        if self.coefficients.len() <= power {
            self.coefficients.resize(power + 1, RationalFunction::zero());
        }
        let place = &mut self.coefficients[power];
        *place = place.clone() + term * RationalFunction::from(factor * sign);
    }

    /// The only parameter of a term of this power scales as `Δt/Δx^power`.
    fn weigh(&mut self, free: &[(Variable, i16)], power: i16) {
        let weight = (1, -i32::from(power));
        let fits = match (free, &mut self.weights) {
            ([(variable, 1)], Some(weights)) => {
                let known = weights.iter().find(|(known, _)| known == variable);
                let fits = known.is_none_or(|(_, known)| *known == weight);
                if known.is_none() {
                    weights.push((*variable, weight));
                }
                fits
            }
            _ => false,
        };
        if !fits {
            self.weights = None;
        }
    }

    /// The leading term of a series taken as what it approximates; `square` is that of its root.
    pub(crate) fn of_leading(power: usize, value: &RationalFunction, square: &Laurent) -> Self {
        let mut coefficients = vec![RationalFunction::zero(); power + 1];
        coefficients[power] = value.clone();
        let mut exact = Self { coefficients, weights: Some(Vec::new()) };
        let free = |p: &Laurent| -> Vec<(Variable, i16)> {
            let exponents = p.as_monomial().map_or([0; VARIABLES], |(exponents, _)| *exponents);
            let names = std::iter::once(0).chain(4..VARIABLES);
            names.map(|v| (Variable(v), exponents[v])).filter(|(_, power)| *power != 0).collect()
        };
        let simple = value.denominator().as_constant().is_some();
        let mut names = free(value.numerator());
        if square.as_constant().is_some() {
            // The root of a number scales with nothing.
            names.retain(|(variable, _)| *variable != ROOT);
        }
        match (names.as_slice(), free(square).as_slice()) {
            // λ = −sqrt(p) x: p ∝ Δt²/Δx².
            ([(ROOT, 1)], [(variable, 1)]) if simple => {
                let (s, t) = (1, -(power as i32));
                exact.weights = Some(vec![(ROOT, (s, t)), (*variable, (2 * s, 2 * t))]);
            }
            (names, _) if simple => exact.weigh(names, power as i16),
            _ => exact.weights = None,
        }
        exact
    }

    /// `e_m`.
    pub(crate) fn coefficient(&self, power: usize) -> RationalFunction {
        self.coefficients.get(power).cloned().unwrap_or_else(RationalFunction::zero)
    }

    /// The lowest power with its coefficient; `None` where nothing moves.
    pub(crate) fn leading(&self) -> Option<(usize, &RationalFunction)> {
        self.coefficients.iter().enumerate().find(|(_, value)| !value.is_zero())
    }

    /// Whether `i` occurs.
    pub(crate) fn is_complex(&self) -> bool {
        self.coefficients.iter().any(|value| value.numerator().contains(ROOT))
    }

    /// Whether it has one term only.
    pub(crate) fn is_homogeneous(&self) -> bool {
        self.coefficients.iter().filter(|value| !value.is_zero()).count() <= 1
    }
}
