//! Table 1: exact, as printed, and the recipe that links the two.

use super::text;
use crate::number::significant;
use crate::page::Item;
use crate::record::exact_latex;
use crate::table::Cell;
use crate::{cells, words};
use courant_analysis::exact::rational::{Rational, integer, parse, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::stability::margin::Margin;
use courant_analysis::stability::{ExactValue, Limit, phase_grid, sampled_stability_limit};
use courant_simulation::advection::{AdvectionScheme, Discretisation};

/// The phases the paper must have used, in radians: every value of its stability rows follows from this
/// step, and none from 28 or 33 equal cells (which its text does not say).
const PHASE_STEP: f64 = 0.1;

/// The grid on which the paper rounds a stability limit up.
const COURANT_STEP: f64 = 0.05;

/// Limits are looked for up to here; the largest printed value is 11.5.
const RANGE: i64 = 40;

/// Which condition a value answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitKind {
    /// (2.21): no wave grows.
    Stability,
    /// (2.24): no coefficient is negative.
    Monotonicity,
}

impl LimitKind {
    /// The word used in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stability => "stability",
            Self::Monotonicity => "monotonicity",
        }
    }
}

/// A value as printed.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedValue {
    /// Which condition.
    pub kind: LimitKind,
    /// The kernel.
    pub kernel: Kernel,
    /// `l/Δξ`.
    pub ratio: Rational,
    /// The Courant number, exactly as printed.
    pub courant: Rational,
}

/// The 24 printed values, in the order of the data file.
pub fn published_values() -> Vec<PublishedValue> {
    const DATA: &str = include_str!("../../data/ferrari2008_table1.csv");
    let number = |text: &str| parse(text).expect("the data file holds decimals");
    DATA.lines()
        .skip(2)
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            PublishedValue {
                kind: match fields[0] {
                    "stability" => LimitKind::Stability,
                    _ => LimitKind::Monotonicity,
                },
                kernel: fields[1].parse().expect("the data file names kernels"),
                ratio: number(fields[2]),
                courant: number(fields[3]),
            }
        })
        .collect()
}

/// The smallest multiple of 0.05 that is not below the limit seen by a set of phases: how the printed
/// stability limits come about.
pub fn recipe(margin: &Margin, phases: &[f64]) -> f64 {
    let sampled = sampled_stability_limit(margin, phases, &integer(RANGE)).value();
    // A limit that is a multiple itself must not be pushed up by its rounding.
    ((sampled / COURANT_STEP * (1.0 - 1e-12)).ceil()) * COURANT_STEP
}

/// One value of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// As printed.
    pub published: PublishedValue,
    /// The true limit.
    pub limit: Limit,
    /// What the recipe gives; only for stability.
    pub recipe: Option<f64>,
    /// How far the printed value is above the limit, in percent of the limit.
    pub difference_percent: f64,
    /// `max |g| − 1` at the printed Courant number; only for stability.
    pub growth_at_published: Option<f64>,
}

/// Table 1 for Godunov SPH, recomputed.
#[derive(Debug, Clone, PartialEq)]
pub struct Table1 {
    /// The entries in the order of the data file.
    pub entries: Vec<Entry>,
}

impl Table1 {
    /// Computes all limits.
    pub fn compute() -> Self {
        let phases = phase_grid(PHASE_STEP);
        let entries = published_values().into_iter().map(|published| {
            let scheme = AdvectionScheme::GodunovSph;
            let discretisation =
                Discretisation::new(scheme, published.kernel, published.ratio.clone())
                    .expect("the printed ratios are within range");
            let margin = discretisation.margin();
            let printed = to_f64(&published.courant);
            let stability = published.kind == LimitKind::Stability;
            let limit = if stability {
                discretisation.stable_set().limit()
            } else {
                discretisation.monotone_set().limit()
            };
            let growth = || discretisation.gain_extremes(&[printed]).growth[0];
            Entry {
                difference_percent: 100.0 * (printed / limit.value() - 1.0),
                recipe: stability.then(|| recipe(&margin, &phases)),
                growth_at_published: stability.then(growth),
                limit,
                published,
            }
        });
        Self { entries: entries.collect() }
    }

    /// The two kernels of the table, in its order.
    fn rows(&self) -> impl Iterator<Item = (LimitKind, Kernel, Vec<&Entry>)> {
        [LimitKind::Stability, LimitKind::Monotonicity].into_iter().flat_map(move |kind| {
            [Kernel::Gaussian, Kernel::CubicSpline].into_iter().map(move |kernel| {
                let entries = self.entries.iter().filter(|entry| {
                    entry.published.kind == kind && entry.published.kernel == kernel
                });
                (kind, kernel, entries.collect())
            })
        })
    }

    fn by_ratio(&self, name: &str, rows: impl IntoIterator<Item = Vec<Cell>>) -> Item {
        let (_, _, entries) = self.rows().next().expect("the table has rows");
        let columns: Vec<String> =
            entries.iter().map(|entry| format!("l/Δξ = {}", entry.published.ratio)).collect();
        text().wide_table(name, &[], &columns, rows)
    }

    /// The three tables.
    pub fn tables(&self) -> [Item; 3] {
        [self.exact_table(), self.published_table(), self.difference_table()]
    }

    /// The exact limits: decimals, and the fractions beside them where the data are rational.
    fn exact_table(&self) -> Item {
        let rows = self.rows().flat_map(|(kind, kernel, entries)| {
            let head = |what| row_head(kind, kernel, what);
            let mut decimals = head(entries[0].limit.evidence().name());
            decimals.extend(
                entries.iter().map(|e| Cell::from(e.limit.decimal(11).unwrap_or_default())),
            );
            let mut rows = vec![decimals];
            if entries.iter().all(|entry| entry.limit.exact().is_some()) {
                let mut fractions = head("exactly");
                fractions.extend(entries.iter().map(|entry| {
                    let text = entry.limit.exact().map_or_else(String::new, ToString::to_string);
                    match exact_latex(&entry.limit) {
                        Some(latex) => Cell::with_latex(text, latex),
                        None => text.into(),
                    }
                }));
                rows.push(fractions);
            }
            rows
        });
        self.by_ratio("table_1_exact", rows)
    }

    /// The printed values and the recipe that reproduces them.
    fn published_table(&self) -> Item {
        let rows = self.rows().flat_map(|(kind, kernel, entries)| {
            let head = |what| row_head(kind, kernel, what);
            let mut printed = head("printed");
            printed.extend(
                entries.iter().map(|e| Cell::from(format!("{:.2}", to_f64(&e.published.courant)))),
            );
            let mut rows = vec![printed];
            if kind == LimitKind::Stability {
                let mut recipe = head("recipe");
                recipe.extend(
                    entries
                        .iter()
                        .map(|e| Cell::from(format!("{:.2}", e.recipe.unwrap_or(f64::NAN)))),
                );
                rows.push(recipe);
            }
            rows
        });
        self.by_ratio("table_1_published", rows)
    }

    /// Printed against exact, and what the printed value does.
    fn difference_table(&self) -> Item {
        let rows = self.entries.iter().map(|entry| {
            let growth = entry.growth_at_published;
            let grows = growth.filter(|growth| *growth > 0.0);
            let rate = match growth {
                None => "–".into(),
                Some(_) => grows.map_or_else(|| "0".into(), |growth| significant(growth, 3)),
            };
            cells![
                entry.published.kind.name(),
                entry.published.kernel.title(),
                entry.published.ratio,
                six_decimals(&entry.limit),
                format!("{:.2}", to_f64(&entry.published.courant)),
                format!("{:+.2} %", entry.difference_percent),
                rate,
                grows.map_or_else(|| "–".into(), |g| format!("{:.0}", 2f64.ln() / g.ln_1p())),
            ]
        });
        text().table("table_1_difference", &[], rows)
    }

    /// What the comparison shows, with its numbers computed.
    pub fn explanation(&self) -> String {
        let stability = || self.entries.iter().filter(|e| e.published.kind == LimitKind::Stability);
        let reproduced = stability()
            .filter(|e| e.recipe.is_some_and(|r| (r - to_f64(&e.published.courant)).abs() < 1e-9))
            .count();
        let largest = stability().map(|e| e.difference_percent).fold(0.0, f64::max);
        let growth = stability().filter_map(|e| e.growth_at_published).fold(0.0, f64::max);
        let growing = stability().filter(|e| e.growth_at_published.is_some_and(|g| g > 0.0));
        let exact: Vec<String> = stability()
            .filter(|e| {
                matches!(e.limit.exact(), Some(ExactValue::Fraction(limit)) if *limit == e.published.courant)
            })
            .map(|e| format!("{} at l/Δξ = {}", e.published.kernel.title(), e.published.ratio))
            .collect();
        let monotone = self
            .entries
            .iter()
            .filter(|e| e.published.kind == LimitKind::Monotonicity)
            .map(|e| (e.limit.value() - to_f64(&e.published.courant)).abs())
            .fold(0.0, f64::max);
        text().text(
            "explanation",
            words![
                "all" = stability().count(),
                "growing" = growing.count(),
                "largest" = format!("{largest:.1}"),
                "growth" = format!("{:.1}", 100.0 * growth),
                "exact" = exact.join(", "),
                "reproduced" = reproduced,
                "monotone" = format!("{monotone:.3}"),
            ],
        )
    }
}

/// A limit cut off after six decimals.
fn six_decimals(limit: &Limit) -> String {
    let whole_digits = format!("{:.0}", limit.lower().floor()).len();
    limit.decimal(6 + whole_digits).unwrap_or_default()
}

/// The first cells of a row.
fn row_head(kind: LimitKind, kernel: Kernel, what: &str) -> Vec<Cell> {
    vec![kind.name().into(), kernel.title().into(), what.into()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_recipe_reproduces_every_printed_stability_limit() {
        for entry in Table1::compute().entries {
            let printed = to_f64(&entry.published.courant);
            match entry.recipe {
                Some(recipe) => assert!((recipe - printed).abs() < 1e-9, "{entry:?}"),
                None => assert!((entry.limit.value() - printed).abs() <= 0.01, "{entry:?}"),
            }
        }
    }

    #[test]
    fn equal_cells_reproduce_it_from_29_to_32_and_not_beside() {
        let reproduces = |cells: u32| {
            let phases: Vec<f64> = (0..=cells)
                .map(|i| f64::from(i) * std::f64::consts::PI / f64::from(cells))
                .collect();
            published_values().iter().filter(|value| value.kind == LimitKind::Stability).all(
                |value| {
                    let scheme = AdvectionScheme::GodunovSph;
                    let margin = Discretisation::new(scheme, value.kernel, value.ratio.clone())
                        .unwrap()
                        .margin();
                    (recipe(&margin, &phases) - to_f64(&value.courant)).abs() < 1e-9
                },
            )
        };
        for cells in 29..=32 {
            assert!(reproduces(cells), "{cells}");
        }
        assert!(!reproduces(28) && !reproduces(33));
    }

    #[test]
    fn a_printed_limit_grows_by_at_most_the_stated_rate() {
        let table = Table1::compute();
        let growth = table.entries.iter().filter_map(|e| e.growth_at_published).fold(0.0, f64::max);
        assert!(growth > 0.013 && growth < 0.015, "{growth}");
        let text = table.explanation();
        assert!(text.contains("12 of the 12"), "{text}");
        assert!(text.contains("Of the 12 printed stability limits 11 are too high"), "{text}");
        assert!(text.contains("Exact as printed: cubic B-spline at l/Δξ = 1."), "{text}");
    }
}
