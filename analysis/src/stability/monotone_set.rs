//! Where every coefficient of an explicit scheme is non-negative, so that new values are averages of old ones:
//! Ferrari et al. 2008 (2.24). All comparisons of roots are exact.

use super::{Evidence, ExactValue, Limit, SearchPlan, StableInterval, StableSet};
use crate::exact::algebraic_number::AlgebraicNumber;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{
    Rational, compare, greatest_divisor, integer, reduced, to_f64_above, to_f64_below,
};
use crate::exact::real_roots::{RealRoot, SturmChain, power_of_two, real_roots};
use crate::scheme::{OffsetCoefficient, SchemeError, Step};
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use std::cmp::Ordering;

/// Roots are enclosed to this many bits of their size: more than the enclosures of the Gaussian settle.
const ROOT_BITS: u32 = 200;

/// The least or the greatest that a coefficient may be, in whole numbers: without the power of the parameter and the positive factor that
/// divide it.
struct Coefficient {
    offset: Vec<i64>,
    polynomial: Polynomial<Rational>,
}

/// A positive parameter where a coefficient changes its sign.
#[derive(Clone)]
struct End<'a> {
    root: RealRoot,
    of: &'a Coefficient,
}

/// An interval of positive length; absent ends are 0 and the end of the range.
#[derive(Clone)]
struct Stretch<'a> {
    from: Option<End<'a>>,
    to: Option<End<'a>>,
}

impl Step {
    /// All values of a parameter, within the range of the plan, for which no coefficient of the scheme is negative; ends name the
    /// [coefficient that binds](Limit::binding_offset). `None` when the scheme is not explicit, for one unknown and between two levels:
    /// positivity of other schemes is not one of coefficients.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// use courant_analysis::stability::SearchPlan;
    /// let beam_warming = "u[n+1,j] = u[n,j] - C/2*(3*u[n,j] - 4*u[n,j-1] + u[n,j-2]) \
    ///                     + C^2/2*(u[n,j] - 2*u[n,j-1] + u[n,j-2])";
    /// let set = Step::from_text(beam_warming)?.monotone_set("C", &SearchPlan::default())?.unwrap();
    /// // c_{-1} = C (2 − C), c_{-2} = C (C − 1)/2 and c_0 = (C − 1)(C − 2)/2 agree nowhere on an interval.
    /// assert!(set.intervals.is_empty() && set.limit().value() == 0.0);
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    ///
    /// # Errors
    /// When the parameter does not occur or another has no value.
    pub fn monotone_set(
        &self,
        parameter: &str,
        plan: &SearchPlan,
    ) -> Result<Option<StableSet>, SchemeError> {
        self.variable(parameter)?;
        let open: Vec<String> =
            self.free_parameters().into_iter().filter(|name| name != parameter).collect();
        if !open.is_empty() {
            return Err(SchemeError::NotSet(open));
        }
        let Some(coefficients) = self.coefficients(parameter) else { return Ok(None) };
        let exact = coefficients.iter().all(OffsetCoefficient::is_exact);
        let evidence = if exact { Evidence::Proved } else { Evidence::Enclosed };
        let open: Vec<_> =
            coefficients.iter().filter(|one| !one.is_plainly_non_negative()).collect();
        let bound = |of: fn(&OffsetCoefficient) -> Polynomial<BigInt>| {
            let bounds = open.iter().map(|one| Coefficient::new(one.offset.clone(), of(one)));
            // Coefficients that are negative at once come first: most often they end the search.
            let mut bounds: Vec<_> = bounds.collect();
            bounds.sort_by_key(|bound| !bound.starts_negative());
            bounds
        };
        let (least, most) = (bound(OffsetCoefficient::least), bound(OffsetCoefficient::most));
        let certain = non_negative(&least, plan);
        let possible = match evidence {
            Evidence::Proved => certain.clone(),
            _ => non_negative(&most, plan),
        };
        let mut set = StableSet {
            immediate_offset: most
                .first()
                .filter(|c| c.starts_negative())
                .map(|c| c.offset.clone()),
            at_zero: open.iter().all(|one| !one.least().coefficient(0).is_negative()),
            ..StableSet::empty(evidence)
        };
        for whole in &possible {
            let inside: Vec<_> = certain.iter().filter(|part| whole.holds(part, plan)).collect();
            enclose(&mut set, whole, &inside, plan);
        }
        if let Some(last) = set.intervals.last_mut()
            && open.is_empty()
        {
            last.to = Limit::unbounded(&plan.max, evidence);
        }
        Ok(Some(set.of_step(self)))
    }
}

/// Adds what is known of one interval of possibly monotone parameters from the certainly monotone ones inside it.
fn enclose(set: &mut StableSet, whole: &Stretch, inside: &[&Stretch], plan: &SearchPlan) {
    let exact = set.evidence == Evidence::Proved;
    let (mut open_from, zero) = (whole.from.as_ref(), Rational::zero());
    let Some(last) = inside.len().checked_sub(1) else {
        let to = whole.to.as_ref().map_or(&plan.max, |to| &to.root.upper);
        let from = open_from.map_or(&zero, |from| &from.root.lower);
        set.undecided.push((to_f64_below(from), to_f64_above(to)));
        return;
    };
    for (index, part) in inside.iter().enumerate() {
        let from = match (open_from, &part.from) {
            (_, None) => Limit::exactly(ExactValue::Fraction(Rational::zero()), set.evidence),
            (Some(outer), Some(inner)) if index == 0 => outer.limit(inner, exact, set.evidence),
            (outer, Some(inner)) => {
                // Perhaps it begins earlier: only the uncertainty of the data speaks against it.
                let lower = to_f64_below(outer.map_or(&zero, |outer| &outer.root.lower));
                let upper = to_f64_above(&inner.root.upper);
                set.undecided.push((lower, upper));
                Limit::between(lower, upper, Evidence::Undecided).at_offset(inner.of.offset.clone())
            }
        };
        let to = match (&part.to, &whole.to) {
            (None, _) => Limit::beyond(&plan.max, set.evidence),
            (Some(inner), Some(outer)) if index == last => inner.limit(outer, exact, set.evidence),
            (Some(inner), _) => {
                let next = inside.get(index + 1).and_then(|next| next.from.as_ref());
                let upper = next.map_or(f64::INFINITY, |next| to_f64_above(&next.root.upper));
                let lower = to_f64_below(&inner.root.lower);
                if next.is_none() {
                    set.undecided.push((lower, to_f64_above(&plan.max)));
                }
                Limit::between(lower, upper, Evidence::Undecided).at_offset(inner.of.offset.clone())
            }
        };
        set.intervals.push(StableInterval { from, to });
        open_from = part.to.as_ref();
    }
}

/// Where no coefficient is negative, isolated points left out.
fn non_negative<'a>(coefficients: &'a [Coefficient], plan: &SearchPlan) -> Vec<Stretch<'a>> {
    let mut all = vec![Stretch { from: None, to: None }];
    for coefficient in coefficients {
        if all.is_empty() {
            break;
        }
        let own = coefficient.non_negative(plan);
        let pairs = all.iter().flat_map(|a| own.iter().map(move |b| a.and(b)));
        all = pairs.flatten().collect();
    }
    all
}

impl Coefficient {
    fn new(offset: Vec<i64>, polynomial: Polynomial<BigInt>) -> Self {
        let values = polynomial.into_coefficients().into_iter().skip_while(Zero::is_zero);
        let values: Vec<BigInt> = values.collect();
        let divisor = values.iter().fold(BigInt::zero(), |all, one| greatest_divisor(&all, one));
        let polynomial = values.into_iter().map(|value| Rational::from(value / &divisor)).collect();
        Self { offset, polynomial: Polynomial::new(polynomial) }
    }

    /// Whether it is negative for every small positive parameter.
    fn starts_negative(&self) -> bool {
        self.polynomial.coefficients().first().is_some_and(Signed::is_negative)
    }

    fn non_negative<'a>(&'a self, plan: &SearchPlan) -> Vec<Stretch<'a>> {
        let roots = self.roots(plan);
        let mut stretches = Vec::new();
        let mut open = (!self.starts_negative()).then_some(None);
        for (index, root) in roots.iter().enumerate() {
            let negative = match self.polynomial.coefficients() {
                [_, slope] => slope.is_negative(),
                _ => {
                    let next = roots.get(index + 1).map_or(&plan.max, |next| &next.lower);
                    let beyond = (&root.upper + next) / integer(2);
                    self.polynomial.evaluate(&beyond).is_negative()
                }
            };
            let end = Some(End { root: root.clone(), of: self });
            open = match (open, negative) {
                (Some(from), true) => {
                    stretches.push(Stretch { from, to: end });
                    None
                }
                (None, false) => Some(end),
                (unchanged, _) => unchanged,
            };
        }
        stretches.extend(open.map(|from| Stretch { from, to: None }));
        stretches
    }

    /// The roots strictly within the range, told apart from one another and from its end.
    fn roots(&self, plan: &SearchPlan) -> Vec<RealRoot> {
        if let [constant, slope] = self.polynomial.coefficients() {
            let root = reduced(-constant.numer() * slope.denom(), constant.denom() * slope.numer());
            let inside = root.is_positive() && compare(&root, &plan.max).is_lt();
            return inside
                .then(|| RealRoot { lower: root.clone(), upper: root })
                .into_iter()
                .collect();
        }
        if self.polynomial.coefficients().iter().all(|value| !value.is_positive()) {
            return Vec::new();
        }
        let mut bits = ROOT_BITS.max(plan.bits);
        loop {
            let mut roots = real_roots(&self.polynomial, &Rational::zero(), &plan.max, bits);
            if roots.last().is_some_and(|last| last.lower == plan.max) {
                roots.pop();
            }
            let apart = roots.windows(2).all(|pair| pair[0].upper < pair[1].lower);
            if apart && roots.last().is_none_or(|last| last.upper < plan.max) {
                return roots;
            }
            bits *= 2;
        }
    }
}

impl<'a> Stretch<'a> {
    /// The intersection, if it has a length.
    fn and(&self, other: &Self) -> Option<Self> {
        let from = match (&self.from, &other.from) {
            (Some(a), Some(b)) => Some(if b.order(a).is_gt() { b } else { a }),
            (one, None) | (None, one) => one.as_ref(),
        };
        let to = match (&self.to, &other.to) {
            (Some(a), Some(b)) => Some(if b.order(a).is_lt() { b } else { a }),
            (one, None) | (None, one) => one.as_ref(),
        };
        let empty = matches!((from, to), (Some(from), Some(to)) if !from.order(to).is_lt());
        (!empty).then(|| Self { from: from.cloned(), to: to.cloned() })
    }

    /// Whether another, which has no point in common with the rest of the set, lies inside.
    fn holds(&self, part: &Stretch, plan: &SearchPlan) -> bool {
        let lower = part.from.as_ref().map_or_else(Rational::zero, |end| end.root.upper.clone());
        let upper = part.to.as_ref().map_or(&plan.max, |end| &end.root.lower);
        let middle = (lower + upper) / integer(2);
        self.from.as_ref().is_none_or(|from| from.root.lower <= middle)
            && self.to.as_ref().is_none_or(|to| middle <= to.root.upper)
    }
}

impl End<'_> {
    /// Which root comes first: decided by narrower enclosures, or by a common root.
    fn order(&self, other: &Self) -> Ordering {
        let (mut a, mut b) = (self.root.clone(), other.root.clone());
        let mut bits = ROOT_BITS;
        loop {
            if let (Some(a), Some(b)) = (a.exact(), b.exact()) {
                return compare(a, b);
            }
            if a.upper < b.lower {
                return Ordering::Less;
            }
            if b.upper < a.lower {
                return Ordering::Greater;
            }
            let product = self.of.polynomial.clone() * other.of.polynomial.clone();
            let upper = a.upper.clone().max(b.upper.clone());
            let lower =
                a.lower.clone().min(b.lower.clone()) - &upper * power_of_two(-i64::from(bits));
            if SturmChain::new(&product).count(&lower, &upper) == 1 {
                return Ordering::Equal;
            }
            bits *= 2;
            a = narrower(a, self.of, bits);
            b = narrower(b, other.of, bits);
        }
    }

    /// A limit between this root and another, which are one where the coefficients are exact.
    fn limit(&self, other: &Self, exact: bool, evidence: Evidence) -> Limit {
        let limit = if exact {
            self.exact_limit(evidence)
        } else {
            let lower = self.root.lower.clone().min(other.root.lower.clone());
            let upper = self.root.upper.clone().max(other.root.upper.clone());
            Limit::enclosed(lower, upper, evidence)
        };
        limit.at_offset(self.of.offset.clone())
    }

    fn exact_limit(&self, evidence: Evidence) -> Limit {
        if let Some(value) = self.root.exact() {
            return Limit::exactly(ExactValue::Fraction(value.clone()), evidence);
        }
        if let [a, none, b] = self.of.polynomial.coefficients()
            && none.is_zero()
        {
            return Limit::exactly(ExactValue::square_root(-a / b), evidence);
        }
        let integers = self.of.polynomial.map(Rational::to_integer);
        let RealRoot { lower, upper } = self.root.clone();
        match AlgebraicNumber::between(integers, lower.clone(), upper.clone()) {
            Some(number) => Limit::root_of(number, evidence),
            None => Limit::enclosed(lower, upper, evidence),
        }
    }
}

fn narrower(root: RealRoot, of: &Coefficient, bits: u32) -> RealRoot {
    match root.exact() {
        Some(_) => root,
        None => real_roots(&of.polynomial, &root.lower, &root.upper, bits).pop().unwrap_or(root),
    }
}

#[cfg(test)]
mod tests;
