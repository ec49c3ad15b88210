//! What the equation itself does to a wave in one step: the exponent that files state as `exact`, as a number with its slope.

use crate::scheme::language::parse_expression;
use crate::scheme::language::syntax::{Expression, Node};
use crate::scheme::{SchemeError, Step};
use crate::waves::long_waves::NoSeries;
use num_complex::Complex64;

/// A phase at which a long wave does what the leading term says.
const LONG: f64 = 1e-4;

/// The exponent `λ(φ)` of one exact step, `u(t + Δt) = e^λ u(t)`, along any direction.
///
/// ```
/// use courant_analysis::scheme::Step;
/// use courant_analysis::waves::exact_wave::ExactWave;
/// let wave = Step::from_text("u[n+1,j] = 2*u[n,j] - u[n-1,j] + C^2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])")?
///     .with("C", &courant_analysis::exact::rational::ratio(1, 2))?;
/// // Two waves: to the right, e^{−iωΔt} with ω > 0, and to the left.
/// let waves = ExactWave::stated("±I*C*phi", &wave)?;
/// assert_eq!(waves.len(), 2);
/// let (exponent, slope) = waves[0].exponent(&[1.0], 0.3);
/// assert!((exponent.im + 0.15).abs() < 1e-15 && (slope.im + 0.5).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct ExactWave(Form);

#[derive(Debug, Clone)]
enum Form {
    Stated {
        expression: Expression,
        values: Vec<(String, f64)>,
    },
    /// `c (iφ)^m` along the first axis.
    Leading {
        coefficient: Complex64,
        power: i32,
    },
}

impl ExactWave {
    /// From a text such as `-I*C*phi` or `-r*(phi_x^2 + phi_y^2)`, with the values that the step has; `±` makes two waves, that of the
    /// lower sign first.
    ///
    /// # Errors
    /// When the text is not understood or a name in it has no value.
    pub fn stated(text: &str, step: &Step) -> Result<Vec<Self>, NoSeries> {
        let refuse = |reason: String| NoSeries::Exact(text.into(), reason);
        let number = |value| crate::exact::rational::to_f64(value);
        let values: Vec<(String, f64)> =
            step.set_parameters().iter().map(|(name, v)| (name.clone(), number(v))).collect();
        let signs: &[&str] = if text.contains('±') { &["-", "+"] } else { &[""] };
        let waves = signs.iter().map(|sign| {
            // The language has no sign in front that does nothing.
            let plain = match (*sign, text.trim_start().starts_with('±')) {
                ("+", true) => text.replacen('±', "", 1).replace('±', "+"),
                _ => text.replace('±', sign),
            };
            let expression = parse_expression(&plain).map_err(|error| refuse(error.to_string()))?;
            let wave = Self(Form::Stated { expression, values: values.clone() });
            let axes = if step.dimension() == 1 { 1 } else { step.dimension() };
            match wave.unknown_name(axes) {
                Some(name) => Err(refuse(format!("`{name}` is no phase and has no value"))),
                None => Ok(wave),
            }
        });
        waves.collect()
    }

    /// The leading term at long waves of the only branch that begins at 1: what a consistent scheme in one dimension approximates.
    ///
    /// # Errors
    /// When it is not clear which branch that is.
    pub fn leading(step: &Step) -> Result<Vec<Self>, NoSeries> {
        if step.dimension() > 1 {
            return Err(NoSeries::Scheme(SchemeError::Dimension(step.dimension())));
        }
        let series = step.long_waves(None, 0)?;
        let power = series.leading_power() as i32;
        let coefficient = series.evaluate(&[], 1.0) / Complex64::I.powi(power);
        let rightward = Self(Form::Leading { coefficient, power });
        let leftward = Self(Form::Leading { coefficient: -coefficient, power });
        let (expected, _) = leftward.exponent(&[1.0], LONG);
        let roots = step.compile()?.differences(&[], &[LONG]);
        let both = roots.iter().any(|y| (y - expected).norm() < 0.1 * expected.norm());
        Ok(if both { vec![rightward, leftward] } else { vec![rightward] })
    }

    /// `λ` at the phases `φ = modulus · direction`, and its derivative by the modulus.
    pub fn exponent(&self, direction: &[f64], modulus: f64) -> (Complex64, Complex64) {
        match &self.0 {
            Form::Stated { expression, values } => {
                evaluate(expression, &Place { direction, modulus, values })
            }
            Form::Leading { coefficient, power } => {
                let x = Complex64::new(0.0, modulus);
                let below = coefficient * x.powi(power - 1);
                (below * x, below * Complex64::I * f64::from(*power))
            }
        }
    }

    /// A name that is neither a phase nor has a value.
    fn unknown_name(&self, axes: usize) -> Option<String> {
        let Form::Stated { expression, values } = &self.0 else { return None };
        let mut found = None;
        names(expression, &mut |name| {
            let is_phase = axis(name).is_some_and(|axis| axis < axes);
            if name != "I" && !is_phase && values.iter().all(|(known, _)| known != name) {
                found = Some(name.to_string());
            }
        });
        found
    }
}

fn axis(name: &str) -> Option<usize> {
    match name {
        "phi" | "phi_x" => Some(0),
        "phi_y" => Some(1),
        "phi_z" => Some(2),
        _ => None,
    }
}

fn names(expression: &Expression, look: &mut impl FnMut(&str)) {
    match &expression.node {
        Node::Name(name) => look(name),
        Node::Add(a, b) | Node::Subtract(a, b) | Node::Multiply(a, b) | Node::Divide(a, b) => {
            names(a, look);
            names(b, look);
        }
        Node::SquareRoot(a) | Node::Negative(a) | Node::Power(a, _) => names(a, look),
        _ => {}
    }
}

struct Place<'a> {
    direction: &'a [f64],
    modulus: f64,
    values: &'a [(String, f64)],
}

/// Value and derivative by the modulus.
fn evaluate(expression: &Expression, at: &Place) -> (Complex64, Complex64) {
    let constant = |value: Complex64| (value, Complex64::ZERO);
    let two = |a: &Expression, b: &Expression| (evaluate(a, at), evaluate(b, at));
    match &expression.node {
        Node::Number(number) => constant(crate::exact::rational::to_f64(number).into()),
        Node::Pi => constant(std::f64::consts::PI.into()),
        Node::Name(name) => match axis(name) {
            Some(axis) => {
                let along = at.direction.get(axis).copied().unwrap_or(0.0);
                ((along * at.modulus).into(), along.into())
            }
            None if name == "I" => constant(Complex64::I),
            None => {
                let known = at.values.iter().find(|(known, _)| known == name);
                constant(known.map_or(f64::NAN, |(_, value)| *value).into())
            }
        },
        Node::Negative(a) => {
            let (value, slope) = evaluate(a, at);
            (-value, -slope)
        }
        Node::Add(a, b) => {
            let (a, b) = two(a, b);
            (a.0 + b.0, a.1 + b.1)
        }
        Node::Subtract(a, b) => {
            let (a, b) = two(a, b);
            (a.0 - b.0, a.1 - b.1)
        }
        Node::Multiply(a, b) => {
            let (a, b) = two(a, b);
            (a.0 * b.0, a.1 * b.0 + a.0 * b.1)
        }
        Node::Divide(a, b) => {
            let (a, b) = two(a, b);
            (a.0 / b.0, (a.1 * b.0 - a.0 * b.1) / (b.0 * b.0))
        }
        Node::Power(base, exponent) => {
            let (value, slope) = evaluate(base, at);
            match exponent {
                0 => constant(Complex64::ONE),
                n => (value.powi(*n), slope * value.powi(n - 1) * f64::from(*n)),
            }
        }
        Node::SquareRoot(argument) => {
            let (value, slope) = evaluate(argument, at);
            let root = value.sqrt();
            (root, slope / (2.0 * root))
        }
        // None of these is in an expression without unknowns.
        Node::Unknown(_) | Node::Weight { .. } | Node::Sum { .. } => {
            constant(Complex64::new(f64::NAN, f64::NAN))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use crate::scheme::catalogue;
    use proptest::prelude::*;

    proptest! {
        /// Every exact step of the catalogue: its slope is the limit of differences.
        #[test]
        fn slopes_are_those_of_differences(which in 0usize..200, angle in 0.1f64..1.4, modulus in 0.2f64..2.5) {
            let files: Vec<_> = catalogue::schemes().iter().filter(|file| file.exact.is_some()).collect();
            let file = files[which % files.len()];
            prop_assume!(!file.needs_kernel());
            let mut step = file.step(None, None, &[], None).unwrap();
            for name in step.free_parameters() {
                step = step.with(&name, &ratio(2, 7)).unwrap();
            }
            let direction = [angle.cos(), 0.8 * angle.sin(), 0.6 * angle.sin()];
            let direction = match step.dimension() { 1 => &[1.0][..], 2 => &[0.6, 0.8], _ => &direction };
            for wave in ExactWave::stated(file.exact.as_deref().unwrap(), &step).unwrap() {
                let (_, slope) = wave.exponent(direction, modulus);
                let h = 1e-5;
                let differ = wave.exponent(direction, modulus + h).0 - wave.exponent(direction, modulus - h).0;
                prop_assert!((slope - differ / (2.0 * h)).norm() < 1e-8, "{} {slope}", file.name);
            }
        }
    }

    #[test]
    fn names_without_a_value_are_refused() {
        let step = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])").unwrap();
        for text in ["-I*C*phi", "-I*phi_y", "-I*K", "-I*("] {
            assert!(matches!(ExactWave::stated(text, &step), Err(NoSeries::Exact(..))), "{text}");
        }
    }

    #[test]
    fn the_leading_term_is_what_the_scheme_approximates() {
        let set = |text: &str, name: &str| {
            Step::from_text(text).unwrap().with(name, &ratio(1, 4)).unwrap()
        };
        let upwind = set("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])", "C");
        let heat = set("u[n+1,j] = u[n,j] + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])", "r");
        let wave = set("u[n+1,j] = 2*u[n,j] - u[n-1,j] + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])", "r");
        let at = |step: &Step| -> Vec<Complex64> {
            ExactWave::leading(step).unwrap().iter().map(|w| w.exponent(&[1.0], 0.4).0).collect()
        };
        let near = |a: Complex64, re: f64, im: f64| (a - Complex64::new(re, im)).norm() < 1e-15;
        assert!(matches!(at(&upwind)[..], [one] if near(one, 0.0, -0.1)));
        assert!(matches!(at(&heat)[..], [one] if near(one, -0.04, 0.0)));
        assert!(
            matches!(at(&wave)[..], [a, b] if near(a, 0.0, -0.2) && near(b, 0.0, 0.2)),
            "{:?}",
            at(&wave)
        );
    }
}
