//! Answers recorded before the redesign of the analysis still hold, but for the differences that
//! golden/explained.toml gives a reason for. Extra keys are free; golden/regenerate.sh records.

use rayon::prelude::*;
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::{self, Display};
use std::path::{Path, PathBuf};

/// What names a row, so that neither new rows nor a new order hide what changed in an old one.
const NAMES: &str =
    "scheme method form integrator alpha kernel ratio code cfl kappa mode branch offset growth";

#[derive(Deserialize)]
struct Golden {
    args: Vec<String>,
    exit: i32,
    answer: Value,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Explained {
    command: String,
    args: String,
    path: String,
    old: Value,
    new: Value,
    reason: String,
}

struct Difference {
    args: Vec<String>,
    path: String,
    old: Option<Value>,
    new: Option<Value>,
}

impl Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let show = |value: &Option<Value>| match value {
            Some(value) => value.to_string().chars().take(200).collect(),
            None => String::from("missing"),
        };
        writeln!(f, "courant {}", self.args.join(" "))?;
        writeln!(f, "  at  {}", self.path)?;
        writeln!(f, "  old {}", show(&self.old))?;
        write!(f, "  new {}", show(&self.new))
    }
}

impl Explained {
    fn covers(&self, difference: &Difference) -> bool {
        let path = &difference.path;
        let fits = |wanted: &Value, value: &Option<Value>| match (wanted.as_str(), value) {
            (Some("any"), _) | (Some("missing"), None) | (Some("null"), Some(Value::Null)) => true,
            (_, Some(value)) => same(path, wanted, value),
            (_, None) => false,
        };
        self.command == difference.args[0]
            && glob(&self.args, &difference.args[1..].join(" "), "")
            && glob(&self.path, path, "[]")
            && fits(&self.old, &difference.old)
            && fits(&self.new, &difference.new)
    }
}

/// Whether `text` fits `pattern`, in which `*` is any run of characters not in `barred`.
fn glob(pattern: &str, text: &str, barred: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == text,
        Some((head, tail)) => text.strip_prefix(head).is_some_and(|rest| {
            let run = rest.find(|c| barred.contains(c)).unwrap_or(rest.len());
            let mut ends = rest.char_indices().map(|(i, _)| i).chain([rest.len()]);
            ends.any(|end| end <= run && glob(tail, &rest[end..], barred))
        }),
    }
}

/// Relative and absolute tolerance of a number.
fn tolerance(path: &str) -> (f64, f64) {
    let key = path.rsplit('.').next().unwrap_or(path).split('[').next().unwrap_or(path);
    match key {
        // Particles really move: rounding over the amplitude of the wave, which is small for the
        // run to be linear. 1e-6 is what `validate` itself allows.
        _ if path.contains("measured") => (0.0, 1e-6),
        "error" | "max_error" | "max_wave_error" | "tolerance" => (0.0, 1e-6),
        // Where a maximum lies is known to the square root of the precision of its height.
        "critical_phase" | "double_multiplier_phase" => (0.0, 1e-6),
        // f64 sums over a stencil, then roots of a polynomial, which lose digits where branches
        // come near each other.
        "max_gain" | "growth_per_step" | "steps_to_double" | "gain" | "phase" | "omega_re"
        | "omega_im" | "predicted_omega" | "phase_error" | "amplitude" | "long_wave_speed" => {
            (1e-9, 1e-11)
        }
        _ => (1e-12, 0.0),
    }
}

fn same(path: &str, old: &Value, new: &Value) -> bool {
    let (Some(mut a), Some(mut b)) = (old.as_f64(), new.as_f64()) else { return old == new };
    if path.ends_with("steps_to_double") {
        // The inverse of a growth: 1e16 steps and 1e15 steps are both no growth.
        (a, b) = (1.0 / a, 1.0 / b);
    }
    let mut distance = (a - b).abs();
    if path.ends_with(".phase") {
        // The argument of a negative number is π or -π, as rounding has it.
        distance = distance.min((distance - TAU).abs());
    }
    let (relative, absolute) = tolerance(path);
    distance <= absolute.max(relative * a.abs().max(b.abs()))
}

fn word(row: &Value, key: &str) -> Option<String> {
    match row.get(key)? {
        Value::String(text) => Some(text.clone()),
        // A Courant number may be a limit halved, good to the last digit but one.
        Value::Number(number) => number.as_f64().map(|x| ((x * 1e9).round() / 1e9).to_string()),
        _ => None,
    }
}

fn name(row: &Value) -> String {
    NAMES.split(' ').filter_map(|key| word(row, key)).collect::<Vec<_>>().join(" ")
}

/// Whether nothing that names both rows tells them apart: a new row may have more or fewer names.
fn corresponds(old: &Value, new: &Value) -> bool {
    let apart = |key| word(old, key).zip(word(new, key)).is_some_and(|(old, new)| old != new);
    !NAMES.split(' ').any(apart)
}

type Place = (String, Option<Value>, Option<Value>);

fn compare(path: &str, old: &Value, new: Option<&Value>, found: &mut Vec<Place>) {
    match (old, new) {
        (Value::Object(old), Some(Value::Object(new))) => {
            for (key, value) in old {
                let below = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                compare(&below, value, new.get(key), found);
            }
        }
        (Value::Array(old), Some(Value::Array(new))) if old.iter().any(|x| !name(x).is_empty()) => {
            let mut left: Vec<&Value> = new.iter().collect();
            for row in old {
                let at = left.iter().position(|new| corresponds(row, new));
                let now = at.map(|at| left.remove(at));
                compare(&format!("{path}[{}]", name(row)), row, now, found);
            }
            for row in left {
                found.push((format!("{path}[{}]", name(row)), None, Some(row.clone())));
            }
        }
        (Value::Array(old), Some(Value::Array(new))) if old.len() == new.len() => {
            for (index, (old, new)) in old.iter().zip(new).enumerate() {
                compare(&format!("{path}[{index}]"), old, Some(new), found);
            }
        }
        (old, Some(new)) if same(path, old, new) => {}
        (old, new) => found.push((path.to_owned(), Some(old.clone()), new.cloned())),
    }
}

/// Undoes the tables of regenerate.sh: a row is what all share and its cells, at dotted paths.
fn expand(table: &Value) -> Option<Value> {
    let all = table.get("all")?.as_object()?;
    let columns = table.get("columns")?.as_array()?;
    let rows = table.get("each")?.as_array()?.iter().map(|cells| {
        let mut row = Value::Object(Map::new());
        let names = columns.iter().filter_map(Value::as_str);
        let cells = names.zip(cells.as_array().unwrap()).filter(|(_, cell)| *cell != "absent");
        for (path, value) in all.iter().map(|(path, value)| (path.as_str(), value)).chain(cells) {
            *path.split('.').fold(&mut row, |at, key| &mut at[key]) = value.clone();
        }
        row
    });
    Some(rows.collect())
}

fn differences(golden: &Golden) -> Vec<Difference> {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_courant"))
        .args(&golden.args)
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .unwrap();
    let mut old = golden.answer.clone();
    for key in ["rows", "waves"] {
        if let Some(rows) = old.get(key).and_then(expand) {
            old[key] = rows;
        }
    }
    let mut found = Vec::new();
    let exit = output.status.code().map(Value::from);
    compare("exit", &Value::from(golden.exit), exit.as_ref(), &mut found);
    if !old.is_null() {
        let new: Option<Value> = serde_json::from_slice(&output.stdout).ok();
        compare("", &old, new.as_ref(), &mut found);
    }
    let differ = |(path, old, new)| Difference { args: golden.args.clone(), path, old, new };
    found.into_iter().map(differ).collect()
}

fn stored(directory: &Path) -> Vec<Golden> {
    let files = directory.read_dir().unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|end| end == "jsonl")).collect();
    files.sort();
    let texts = files.iter().map(|path| std::fs::read_to_string(path).unwrap());
    texts.flat_map(|text| text.lines().map(parse).collect::<Vec<_>>()).collect()
}

fn parse(line: &str) -> Golden {
    serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}"))
}

#[test]
fn golden_answers_hold() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let golden = stored(&directory);
    assert!(golden.len() > 500, "{} golden answers", golden.len());
    let text = std::fs::read_to_string(directory.join("explained.toml")).unwrap();
    let entries: BTreeMap<String, Vec<Explained>> = toml::from_str(&text).unwrap();
    let explained: Vec<Explained> = entries.into_values().flatten().collect();

    let found: Vec<Difference> = golden.par_iter().flat_map(differences).collect();
    let (_, open): (Vec<_>, Vec<_>) =
        found.iter().partition(|x| explained.iter().any(|entry| entry.covers(x)));
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    for difference in &open {
        let path =
            difference.path.split('[').map(|part| part.split_once(']').map_or(part, |x| x.1));
        *places.entry(path.collect::<Vec<_>>().join("[*]")).or_default() += 1;
    }
    let mut report: Vec<String> = open.iter().take(20).map(ToString::to_string).collect();
    report.extend(places.iter().map(|(path, count)| format!("{count:6} at {path}")));
    for entry in explained {
        if entry.reason.trim().is_empty() || !found.iter().any(|x| entry.covers(x)) {
            let Explained { command, args, path, .. } = entry;
            report.push(format!("explains nothing, or not why: {command} {args} at {path}"));
        }
    }
    assert!(report.is_empty(), "{} differences:\n{}", open.len(), report.join("\n"));
}
