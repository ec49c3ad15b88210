//! Limits as people read them.

use courant::analysis::exact::rational::{decimal_below, from_f64};
use courant::analysis::stability::{Cause, Condition, Evidence, Limit, StableSet, Wave};
use courant::reports::number::significant;
use courant::reports::record::{direction_of, exact_latex};
use courant::reports::table::Cell;
use std::f64::consts::PI;

/// Digits shown when no number of them is asked for.
pub const DEFAULT_DIGITS: usize = 11;

/// The names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The longest closed form that a column has room for.
const LONGEST_EXACT: usize = 18;

/// The longest equation that is shown below a table; longer ones are in the JSON.
const LONGEST_EQUATION: usize = 160;

/// A limit in digits: none is rounded up, so that what is printed may be used.
pub fn digits(limit: &Limit, asked: Option<usize>, otherwise: usize) -> String {
    if limit.evidence() == Evidence::Undecided {
        return match limit.lower() {
            0.0 => "undecided".into(),
            lower => format!("≥ {}", below(lower, otherwise)),
        };
    }
    let shown = match asked {
        Some(digits) => limit.decimal(digits),
        None => limit.proved_decimal(otherwise),
    };
    match shown {
        Some(digits) => digits,
        None if limit.is_unbounded() => "∞".into(),
        None => format!("≥ {}", significant(limit.lower(), 6)),
    }
}

/// The first digits of a number, cut off.
fn below(value: f64, digits: usize) -> String {
    from_f64(value).map_or_else(|| value.to_string(), |exact| decimal_below(&exact, digits))
}

/// The closed form where it is short enough to be read.
pub fn exact(limit: &Limit) -> Cell {
    match (limit.closed_form(), limit.equation(), exact_latex(limit)) {
        (Some(text), ..) if text.chars().count() > LONGEST_EXACT => "(below)".into(),
        (Some(text), _, Some(latex)) => Cell::with_latex(text, latex),
        (Some(text), ..) => text.into(),
        (None, Some(root), _) => format!("root, degree {}", root.degree()).into(),
        _ => "".into(),
    }
}

/// The closed form that [`exact`] has no room for, or the equation the limit solves: what stands below the table.
pub fn exact_below(limit: &Limit, symbol: &str) -> Option<String> {
    match (limit.closed_form(), limit.equation()) {
        (Some(text), _) if text.chars().count() <= LONGEST_EXACT => None,
        (Some(text), _) if text.len() <= LONGEST_EQUATION => Some(format!("{symbol} = {text}")),
        (Some(text), _) => {
            Some(format!("{symbol} is a fraction of {} digits: see --format json", text.len() - 1))
        }
        (None, Some(root)) => {
            let text = root.equation(symbol);
            Some(if text.len() <= LONGEST_EQUATION {
                format!("{symbol} solves {text}")
            } else {
                let degree = root.degree();
                format!("{symbol} is a root of a polynomial of degree {degree}: see --format json")
            })
        }
        (None, None) => None,
    }
}

/// The wave that binds, by its length in spacings and, in several dimensions, its direction.
pub fn wave(limit: &Limit) -> String {
    let (Some(cause), Some(wave)) = (limit.cause(), limit.critical_wave()) else {
        return "–".into();
    };
    let long = wave.phases().iter().all(|phase| *phase == 0.0);
    let length = if long { String::new() } else { format!(", {} Δ", wavelength(wave)) };
    let direction = direction(wave).map_or_else(String::new, |text| format!(" {text}"));
    format!("{}{length}{direction}", cause.name())
}

/// From crest to crest, in spacings.
pub fn wavelength(wave: &Wave) -> String {
    match wave.phase() {
        Some(phase) => length(phase),
        None => significant(wave.wavelength(), 4),
    }
}

/// Along which direction a wave of several dimensions varies: `along x`, `along the diagonal`, `along (0.8, 0.6)`.
pub fn direction(wave: &Wave) -> Option<String> {
    let direction = direction_of(wave)?;
    let same = |a: f64, b: f64| (a.abs() - b.abs()).abs() < 1e-6;
    let active: Vec<usize> = (0..direction.len()).filter(|&a| direction[a].abs() > 1e-6).collect();
    let equal = active.iter().all(|&axis| same(direction[axis], direction[active[0]]));
    Some(match active.as_slice() {
        [axis] => format!("along {}", AXES[*axis]),
        all if equal && all.len() == direction.len() => "along the diagonal".into(),
        all if equal => {
            let plane: String = all.iter().map(|&axis| AXES[axis]).collect();
            format!("along the {plane} diagonal")
        }
        _ => {
            let parts: Vec<String> = direction.iter().map(|x| significant(*x, 3)).collect();
            format!("along ({})", parts.join(", "))
        }
    })
}

/// The length of a wave in spacings.
pub fn length(phase: f64) -> String {
    if phase >= PI { "2".into() } else { significant(2.0 * PI / phase, 4) }
}

/// `-1`, or `(-1, 0)`.
fn offset(offset: &[i64]) -> String {
    match offset {
        [k] => k.to_string(),
        all => format!("({})", all.iter().map(i64::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// A wave by its length in spacings and its direction: `4.2 Δ along the diagonal`.
pub fn wave_words(wave: &Wave) -> String {
    let direction = direction(wave).map_or_else(String::new, |text| format!(" {text}"));
    match wave.phases().iter().all(|phase| *phase == 0.0) {
        true => format!("long{direction}"),
        false => format!("{} Δ{direction}", wavelength(wave)),
    }
}

/// The same with its phases.
pub fn wave_and_phase(wave: &Wave) -> String {
    let phases: Vec<String> = wave.phases().iter().map(|phase| significant(*phase, 5)).collect();
    let phases = match phases.as_slice() {
        [phase] => phase.clone(),
        all => format!("({})", all.join(", ")),
    };
    format!("{} (φ = {phases} rad)", wave_words(wave))
}

/// Why stability ends where it does, in one sentence; `None` where no wave is known to end it.
pub fn reason(limit: &Limit) -> Option<String> {
    let (binding, wave) = (limit.binding()?, limit.critical_wave()?);
    let does =
        if limit.is_positive() { ["bind", "binds"] } else { ["grow at once", "grows at once"] };
    let who = match (limit.cause()?, direction(wave)) {
        (Cause::LongWave, None) => format!("long waves {}", does[0]),
        (Cause::LongWave, Some(direction)) => format!("long waves {direction} {}", does[0]),
        _ => format!("the wave of {} {}", wave_words(wave), does[1]),
    };
    let how = match binding.condition {
        _ if binding.whatever_the_step => "is unstable whatever the step".into(),
        Condition::PlusOne => "a multiplier passes +1".into(),
        Condition::MinusOne => "a multiplier passes −1".into(),
        Condition::Inner(_) if binding.on_circle => {
            "two multipliers meet on the unit circle".into()
        }
        Condition::Inner(_) => "a pair of multipliers leaves the unit circle".into(),
        Condition::Minor(1) if !binding.on_circle => "|z| passes 1".into(),
        Condition::Minor(_) if binding.on_circle => {
            "two multipliers meet on the unit circle".into()
        }
        Condition::Minor(size) => format!("|z| passes 1, Schur–Cohn minor {size}"),
    };
    Some(format!("{who}: {how}"))
}

/// All values of a set: `{0} ∪ [1, ∞)`.
pub fn set(set: &StableSet) -> String {
    let end = |limit: &Limit| match limit.closed_form() {
        Some(text) if text.len() <= LONGEST_EXACT => text,
        _ => limit.proved_decimal(8).unwrap_or_else(|| significant(limit.lower(), 8)),
    };
    let zero = (set.limit().upper() == 0.0 && set.at_zero).then(|| "{0}".to_string());
    let stretches = set.intervals.iter().map(|interval| {
        let (from, to) = (&interval.from, &interval.to);
        let open = if from.is_included() { '[' } else { '(' };
        let begin = format!("{open}{}", if from.upper() == 0.0 { "0".into() } else { end(from) });
        if to.is_unbounded() {
            return format!("{begin}, ∞)");
        }
        if to.upper().is_infinite() {
            return format!("{begin}, at least {}]", significant(to.lower(), 6));
        }
        format!("{begin}, {}{}", end(to), if to.is_included() { ']' } else { ')' })
    });
    let all: Vec<String> = zero.into_iter().chain(stretches).collect();
    if all.is_empty() && set.undecided.is_empty() {
        "without an interval".into()
    } else if all.is_empty() {
        "nothing decided".into()
    } else {
        all.join(" ∪ ")
    }
}

/// Whether a set is more than what its limit says: not one stretch from 0.
pub fn has_gaps(set: &StableSet) -> bool {
    let nowhere = set.limit().upper() == 0.0 && !set.at_zero && set.undecided.is_empty();
    nowhere
        || set.intervals.len() > 1
        || set.intervals.first().is_some_and(|first| first.from.upper() > 0.0)
}

/// A limit in one line.
pub fn describe(limit: &Limit, symbol: &str, asked: Option<usize>) -> String {
    if limit.value().is_infinite() {
        return match limit.evidence() {
            Evidence::Undecided => {
                format!("undecided beyond {symbol} = {}", significant(limit.lower(), 6))
            }
            evidence if limit.is_unbounded() => {
                format!("none, however large, {}", evidence.name())
            }
            _ => format!("none up to {symbol} = {}", significant(limit.lower(), 6)),
        };
    }
    let exact = limit
        .closed_form()
        .filter(|text| text.len() <= 24 && text.contains(['/', '(']))
        .map_or_else(String::new, |text| format!(" = {text}"));
    let wave = match limit.critical_wave() {
        Some(_) => format!(", {}", wave(limit)),
        None => limit
            .binding_offset()
            .map_or_else(String::new, |k| format!(", coefficient of offset {}", offset(k))),
    };
    let digits = digits(limit, asked, 12);
    format!("{digits}{exact} ({}{wave})", limit.evidence().name())
}
