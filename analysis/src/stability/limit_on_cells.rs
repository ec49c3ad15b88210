//! What a periodic run of `N` cells may do where long waves grow at every step: its longest wave has the phase `2π/N`.

use super::conditions::Condition;
use super::decision::Demands;
use super::inequality::Inequality;
use super::margin::Margin;
use crate::exact::rational::{Rational, integer, ratio, to_f64};
use crate::scheme::{SchemeError, Step};
use crate::stability::critical::negative_intervals;
use num_traits::{Signed, Zero};
use std::f64::consts::TAU;

/// How a parameter must fall under refinement where no value is stable on an unbounded lattice.
#[derive(Debug, Clone, PartialEq)]
pub enum Refinement {
    /// Long waves grow; on a ring of cells none may.
    OfLongWaves(LimitOnCells),
    /// Waves of every length grow, `|g|² − 1 ~ p^power` for small values `p` of the parameter: bounded by `e^{KT}` up to a time `T` where
    /// `p^power ≤ 2KΔt`.
    OfAllWaves {
        /// The power.
        power: usize,
    },
}

/// No wave of a ring of `N` cells grows up to about `factor (2π/N)^exponent`, for large `N`.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitOnCells {
    /// The exponent.
    pub exponent: Rational,
    /// The factor, rounded.
    pub factor: f64,
}

impl LimitOnCells {
    /// The limit on a ring of `N` cells, to leading order.
    pub fn at(&self, cells: usize) -> f64 {
        self.factor * (TAU / cells as f64).powf(to_f64(&self.exponent))
    }
}

impl Step {
    /// How the limit falls with the number of cells, where no value is stable on an unbounded lattice because long waves grow, or how growth
    /// stays bounded where all waves grow; `None` where neither is so.
    ///
    /// Near `s = sin²(φ/2) = 0` and `t = C^stride = 0` the condition is `Σ p_ij s^i t^j`: the lowest edge of its Newton polygon on which it
    /// changes sign, `t = κ s^μ`, is where a wave begins to grow.
    ///
    /// ```
    /// use courant_analysis::exact::rational::ratio;
    /// use courant_analysis::scheme::{Integrator, catalogue};
    /// use courant_analysis::stability::Refinement;
    /// // Fifth-order upwind with RK2: C ≤ K N^(−2/3), that is Δt ≤ K' Δx^(5/3).
    /// let rk2 = Integrator::named("rk2");
    /// let step = catalogue::space("upwind-5").unwrap().step(None, rk2, &[], Some("C"))?;
    /// let Some(Refinement::OfLongWaves(rule)) = step.refinement_rule("C")? else { panic!() };
    /// assert_eq!(rule.exponent, ratio(2, 3));
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    ///
    /// # Errors
    /// When the parameter does not occur or another has no value.
    pub fn refinement_rule(&self, parameter: &str) -> Result<Option<Refinement>, SchemeError> {
        Ok(match self.inequalities(parameter, &Rational::zero())? {
            Demands::All(all) => refinement(&all),
            _ => None,
        })
    }
}

fn refinement(all: &[Inequality]) -> Option<Refinement> {
    let mut lowest: Option<LimitOnCells> = None;
    for margin in all.iter().map(|one| &one.margin).filter(|margin| margin.is_exact()) {
        match on_cells(margin) {
            Onset::Never => {}
            Onset::AtOnce => {
                // One multiplier: its square minus 1 is the condition. Two on the circle part like the root of theirs.
                let [one] = all else { return None };
                let power = margin.courant_power();
                let single = one.condition == Condition::Minor(1) && !one.on_circle && power > 1;
                return single.then_some(Refinement::OfAllWaves { power });
            }
            Onset::At(found) => {
                let before = |known: &LimitOnCells| {
                    (&found.exponent, -found.factor) > (&known.exponent, -known.factor)
                };
                if lowest.as_ref().is_none_or(before) {
                    lowest = Some(found);
                }
            }
        }
    }
    lowest.map(Refinement::OfLongWaves)
}

/// When long waves violate a condition as the parameter grows from 0.
enum Onset {
    /// Not for small values.
    Never,
    /// At every value.
    AtOnce,
    At(LimitOnCells),
}

fn on_cells(margin: &Margin) -> Onset {
    // [power of t][power of s]
    let rows: Vec<Vec<Rational>> = (0..margin.powers())
        .map(|power| margin.coefficient(power).in_powers_of_s().coefficients().to_vec())
        .collect();
    let first = |row: &[Rational]| row.iter().position(|value| !value.is_zero());
    let Some((mut j, mut i)) = (0..rows.len()).find_map(|j| Some((j, first(&rows[j])?))) else {
        return Onset::Never;
    };
    if rows[j][i].is_negative() {
        return Onset::AtOnce;
    }
    while i > 0 {
        // The edge that leaves (i, j) with t = κ s^μ, the largest μ: it comes first from t = 0.
        let slope =
            |(k, power): (usize, usize)| Some(ratio(i.checked_sub(k)? as i64, (power - j) as i64));
        let points = (j + 1..rows.len()).filter_map(|power| Some((first(&rows[power])?, power)));
        let Some(mu) = points.filter_map(slope).max() else { break };
        let on_edge = |power: usize| -> Option<(usize, f64)> {
            let k = integer(i as i64) - &mu * integer((power - j) as i64);
            // Between two powers of s: below the edge there is nothing.
            let k = usize::try_from(k.floor().to_integer()).ok()?;
            Some((k, rows[power].get(k).map_or(0.0, to_f64)))
        };
        let edge: Vec<f64> =
            (j..rows.len()).map(|power| on_edge(power).map_or(0.0, |(_, value)| value)).collect();
        // A root beyond this would make t large at once.
        let largest = edge.iter().map(|value| (value / edge[0]).abs()).fold(1.0, f64::max);
        if let Some((kappa, _)) = negative_intervals(&edge, 1e6 * largest).first() {
            let stride = integer(margin.stride() as i64);
            let exponent = integer(2) * &mu / &stride;
            // s = φ²/4
            let t = kappa * 0.25f64.powf(to_f64(&mu));
            return Onset::At(LimitOnCells { exponent, factor: t.powf(1.0 / to_f64(&stride)) });
        }
        let Some((power, k)) = (j + 1..rows.len())
            .filter_map(|power| {
                on_edge(power).filter(|(_, value)| *value != 0.0).map(|(k, _)| (power, k))
            })
            .next_back()
        else {
            break;
        };
        (i, j) = (k, power);
    }
    Onset::Never
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::{Integrator, catalogue};
    use crate::stability::testing;

    /// The largest parameter at which the margin is not negative on the longest wave of a ring.
    fn on_ring(margin: &Margin, cells: usize) -> f64 {
        // In powers of s, which keep the digits of long waves.
        let s = (0.5 * TAU / cells as f64).sin().powi(2);
        let at = |power| margin.coefficient(power).in_powers_of_s().map(to_f64).evaluate(&s);
        let powers: Vec<f64> = (0..margin.powers()).map(at).collect();
        negative_intervals(&powers, 1.0)[0].0.powf(1.0 / margin.stride() as f64)
    }

    #[test]
    fn rings_have_the_limit_of_their_longest_wave() {
        for (space, integrator, exponent) in [
            ("upwind-5", "rk2", ratio(2, 3)),
            ("upwind-3", "forward-euler", integer(2)),
            ("upwind-7", "rk2", ratio(4, 3)),
            ("upwind-9", "rk2", integer(2)),
        ] {
            let (space_file, integrator) =
                (catalogue::space(space).unwrap(), Integrator::named(integrator));
            let step = space_file.step(None, integrator, &[], Some("C")).unwrap();
            let Some(Refinement::OfLongWaves(rule)) = step.refinement_rule("C").unwrap() else {
                panic!("{space}")
            };
            let margin = step.gain_margin("C", &integer(0)).unwrap().unwrap();
            assert_eq!(rule.exponent, exponent, "{space}");
            // The next term is smaller by φ² or by C: 2π/1000 squared, or its power.
            let found = on_ring(&margin, 1000);
            let tolerance = 3.0 * rule.at(1000).max(4e-5);
            assert!((rule.at(1000) / found - 1.0).abs() < tolerance, "{space}: {found} {rule:?}");
        }
        // Upwind is stable; with central differences and Euler |g|² = 1 + C² sin² φ.
        for (text, expected) in [
            ("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])", None),
            (
                "u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1])",
                Some(Refinement::OfAllWaves { power: 2 }),
            ),
        ] {
            assert_eq!(Step::from_text(text).unwrap().refinement_rule("C").unwrap(), expected);
        }
    }

    #[test]
    fn the_edges_of_the_polygon_are_followed_to_the_first_change_of_sign() {
        let none = Rational::zero();
        assert!(matches!(on_cells(&testing::margin(&[&[0]], &none)), Onset::Never));
        assert!(matches!(on_cells(&testing::margin(&[&[0, -1], &[1]], &none)), Onset::AtOnce));
        // s⁵ + s³ t + s² t² − t³: the edge t = κ s² has no change of sign, the next one is s³ = t².
        let margin =
            testing::margin(&[&[0, 0, 0, 0, 0, 1], &[0, 0, 0, 1], &[0, 0, 1], &[-1]], &none);
        let Onset::At(rule) = on_cells(&margin) else { panic!() };
        assert_eq!((rule.exponent.clone(), rule.factor), (integer(3), 0.125));
        // The next terms are smaller by the root of s.
        assert!((rule.at(10_000) / on_ring(&margin, 10_000) - 1.0).abs() < 1e-3);
        // Where several conditions are lost the first is, whichever is asked first: t = s, t = 4s, and t = s².
        let lost = |series: &[i64]| {
            testing::inequality(Condition::PlusOne, testing::margin(&[series, &[-1]], &none))
        };
        let [early, late, earliest] = [lost(&[0, 1]), lost(&[0, 4]), lost(&[0, 0, 1])];
        let kept =
            testing::inequality(Condition::PlusOne, testing::margin(&[&[0, 1], &[1]], &none));
        for (all, exponent, factor) in [
            ([&early, &late], 2, 0.25),
            ([&late, &early], 2, 0.25),
            ([&late, &earliest], 4, 0.0625),
            ([&earliest, &late], 4, 0.0625),
            ([&kept, &late], 2, 1.0),
        ] {
            let exponent = integer(exponent);
            assert_eq!(
                refinement(&all.map(Clone::clone)),
                Some(Refinement::OfLongWaves(LimitOnCells { exponent, factor }))
            );
        }
        // A condition that fails at once says how fast waves grow only where it is that of the only multiplier.
        let at_once = |condition| {
            let falling = testing::margin(&[&[0], &[0], &[-1, 1]], &none);
            refinement(&[testing::inequality(condition, falling)])
        };
        assert_eq!(at_once(Condition::Minor(1)), Some(Refinement::OfAllWaves { power: 2 }));
        assert_eq!(at_once(Condition::MinusOne), None);
        // Positive on all edges.
        assert!(matches!(on_cells(&testing::margin(&[&[0, 1], &[1]], &none)), Onset::Never));
    }

    #[test]
    fn the_rule_is_said_only_where_it_is_known() {
        let rule = |text: &str| Step::from_text(text).unwrap().refinement_rule("C").unwrap();
        // Backwards in time: |g|² − 1 falls with C like Δt alone.
        assert_eq!(rule("u[n+1,j] = u[n,j] - C*(u[n,j+1] - 2*u[n,j] + u[n,j-1])"), None);
        // A number that is no fraction leaves its sign at single values open.
        assert_eq!(rule("u[n+1,j] = u[n,j] - pi*C/2*(u[n,j+1] - u[n,j-1])"), None);
        // z − 1/z grows like C, though the condition has C²: two multipliers.
        let wave = "u[n+1,j] = 2*u[n,j] - u[n-1,j] - C^2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
        assert_eq!(rule(wave), None);
        // The same, implicit: (1 − C² s)(z² + 1) = 2 (1 + C² s) z, z ≈ 1 + 2C √s, under the only condition −16 C² s.
        let difference =
            |level: &str| format!("(u[{level},j+1] - 2*u[{level},j] + u[{level},j-1])");
        let [new, now, old] = ["n+1", "n", "n-1"].map(difference);
        let implicit =
            format!("u[n+1,j] + C^2/4*{new} = 2*u[n,j] - u[n-1,j] - C^2/2*{now} - C^2/4*{old}");
        let demands =
            Step::from_text(&implicit).unwrap().inequalities("C", &Rational::zero()).unwrap();
        assert!(matches!(demands, Demands::All(all) if all.len() == 1 && all[0].on_circle));
        assert_eq!(rule(&implicit), None);
    }
}
