//! A shock tube from a TOML file:
//!
//! ```toml
//! name = "mine"            # optional; default: the file name
//! gamma = 1.4
//! domain = [0.0, 1.0]
//! diaphragm = 0.5
//! end_time = 0.2
//! particles = 100          # optional
//! method = "lagrangian-roe" # optional; --method comes first
//!
//! [left]
//! density = 1.0
//! velocity = 0.0
//! pressure = 1.0
//!
//! [right]
//! density = 0.125
//! velocity = 0.0
//! pressure = 0.1
//! ```

use crate::cli::{Failure, names};
use courant::simulation::method::Method;
use courant::simulation::scene::{InvalidTube, ShockTube, TubeData};
use serde::Deserialize;
use std::path::Path;
use toml::Spanned;

/// What a file says.
pub struct TubeFile {
    /// The scene.
    pub tube: ShockTube,
    /// The method, where one is named.
    pub method: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tube {
    name: Option<String>,
    gamma: Spanned<f64>,
    domain: Spanned<[f64; 2]>,
    diaphragm: Spanned<f64>,
    end_time: Spanned<f64>,
    particles: Option<Spanned<usize>>,
    method: Option<Spanned<String>>,
    left: Side,
    right: Side,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Side {
    density: Spanned<f64>,
    velocity: Spanned<f64>,
    pressure: Spanned<f64>,
}

impl Side {
    fn numbers(&self) -> [f64; 3] {
        [&self.density, &self.velocity, &self.pressure].map(|value| *value.get_ref())
    }
}

/// What a file has to hold, for messages.
const KEYS: &str = "the keys gamma, domain = [from, to], diaphragm, end_time, the tables [left] and \
                    [right] with density, velocity and pressure each, and if you like name, \
                    particles, method";

/// Customary number of particles.
const PARTICLES: usize = 100;

/// Reads a file; every complaint names file, line and what is accepted.
pub fn read(path: &str) -> Result<TubeFile, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        Failure::Message(format!("SCENE {path}: {error}; accepted: a TOML file with {KEYS}"))
    })?;
    let stem = Path::new(path).file_stem().map_or("tube".into(), |stem| stem.to_string_lossy());
    parse(&text, &stem).map_err(|(line, problem)| {
        Failure::Message(format!("SCENE {path}, line {line}: {problem}"))
    })
}

/// The tube, or the line (from 1) and what is wrong there.
fn parse(text: &str, stem: &str) -> Result<TubeFile, (usize, String)> {
    let line_of = |offset: usize| 1 + text[..offset.min(text.len())].matches('\n').count();
    let read: Tube = toml::from_str(text).map_err(|error| {
        let line = error.span().map_or(1, |span| line_of(span.start));
        let message = error.message().replace('\n', " ");
        (line, format!("{}; accepted: {KEYS}", message.trim()))
    })?;
    if let Some(method) = &read.method
        && Method::named(method.get_ref()).is_none()
    {
        let name = method.get_ref();
        let problem = names::unknown("method", name, &Method::NAMES);
        return Err((line_of(method.span().start), format!("method = \"{name}\": {problem}")));
    }
    for (side, state) in [("left", &read.left), ("right", &read.right)] {
        let [density, velocity, pressure] = [&state.density, &state.velocity, &state.pressure];
        for (name, value, positive) in [
            ("density", density, true),
            ("velocity", velocity, false),
            ("pressure", pressure, true),
        ] {
            let number = *value.get_ref();
            if !number.is_finite() || (positive && number <= 0.0) {
                let needed = if positive { "a finite number above 0" } else { "a finite number" };
                let problem = format!("{side}.{name} = {number}: {needed} is accepted");
                return Err((line_of(value.span().start), problem));
            }
        }
    }
    let data = TubeData {
        name: read.name.clone().unwrap_or_else(|| stem.into()),
        source: "a file of your own".into(),
        domain: *read.domain.get_ref(),
        diaphragm: *read.diaphragm.get_ref(),
        left: read.left.numbers(),
        right: read.right.numbers(),
        gamma: *read.gamma.get_ref(),
        end_time: *read.end_time.get_ref(),
        particles: read.particles.as_ref().map_or(PARTICLES, |count| *count.get_ref()),
    };
    let tube = ShockTube::new(data).map_err(|error| {
        let offset = match &error {
            InvalidTube::Gas(_) => read.gamma.span().start,
            InvalidTube::Left(_) | InvalidTube::Empty { side: "left" } => {
                read.left.density.span().start
            }
            InvalidTube::Right(_) | InvalidTube::Empty { .. } => read.right.density.span().start,
            InvalidTube::Domain { .. } => read.domain.span().start,
            InvalidTube::Diaphragm { .. } => read.diaphragm.span().start,
            InvalidTube::EndTime(_) => read.end_time.span().start,
            InvalidTube::Particles(_) => {
                read.particles.as_ref().map_or(0, |count| count.span().start)
            }
        };
        (line_of(offset), error.to_string())
    })?;
    Ok(TubeFile { tube, method: read.method.map(Spanned::into_inner) })
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "gamma = 1.4\ndomain = [0, 1]\ndiaphragm = 0.5\nend_time = 0.2\n\
                        [left]\ndensity = 1.0\nvelocity = 0\npressure = 1.0\n\
                        [right]\ndensity = 0.125\nvelocity = 0.0\npressure = 0.1\n";

    fn problem(text: &str) -> (usize, String) {
        parse(text, "mine").err().expect("the file is bad")
    }

    #[test]
    fn the_example_is_sods_tube() {
        let text = include_str!("../../../examples/tube.toml");
        let read = parse(text, "mine").unwrap_or_else(|(line, text)| panic!("{line}: {text}"));
        let (data, sod) = (read.tube.data(), ShockTube::standard("sod").expect("it is there"));
        assert_eq!((data.left, data.right), (sod.data().left, sod.data().right));
        assert_eq!((data.name.as_str(), read.method.as_deref()), ("tube", Some("lagrangian-roe")));
    }

    #[test]
    fn a_good_file_is_the_tube_it_describes() {
        let read = parse(GOOD, "mine").unwrap_or_else(|(line, text)| panic!("{line}: {text}"));
        let sod = ShockTube::standard("sod").expect("it is in the list");
        assert_eq!(read.tube.data().left, sod.data().left);
        assert_eq!(read.tube.data().right, sod.data().right);
        assert_eq!((read.tube.data().name.as_str(), read.method), ("mine", None));
    }

    #[test]
    fn complaints_name_the_line() {
        let (line, text) = problem(&GOOD.replace("density = 0.125", "density = -0.125"));
        assert_eq!(
            (line, text.as_str()),
            (10, "right.density = -0.125: a finite number above 0 is accepted")
        );
        let (line, text) = problem(&GOOD.replace("gamma = 1.4", "gamma = 0.9"));
        assert!(line == 1 && text.contains("above 1"), "{text}");
        let (line, text) = problem(&GOOD.replace("diaphragm = 0.5", "diaphragm = 2"));
        assert!(line == 3 && text.contains("between 0 and 1"), "{text}");
        let (line, text) = problem(&GOOD.replace("end_time = 0.2", "end_time = \"soon\""));
        assert!(line == 4 && text.contains("accepted"), "{text}");
        let (_, text) = problem(&GOOD.replace("diaphragm = 0.5\n", ""));
        assert!(text.contains("diaphragm"), "{text}");
        let (line, text) = problem(&GOOD.replace("pressure = 0.1", "presure = 0.1"));
        assert!(line == 12 && text.contains("presure") && text.contains("pressure"), "{text}");
        let (line, text) = problem(&format!("method = \"lagrangian-row\"\n{GOOD}"));
        assert!(
            line == 1 && text.contains("`lagrangian-roe`") && text.contains("sph-adke"),
            "{text}"
        );
        let (line, _) = problem(&GOOD.replace("[right]", "[right"));
        assert_eq!(line, 9);
    }
}
