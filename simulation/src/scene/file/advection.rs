//! An advected quantity, from its tables.

use super::line::LayerTable;
use super::{Problem, SceneFile, wrong};
use crate::advection::{AdvectionScene, Piece};

impl SceneFile {
    pub(super) fn advection(&self, name: &str) -> Result<AdvectionScene, Problem> {
        let domain = self.interval()?;
        let velocity = match &self.velocity {
            None => 1.0,
            Some(velocity) => match *velocity.get_ref() {
                speed if speed.is_finite() && speed != 0.0 => speed,
                speed => {
                    let needed = "a finite number other than 0 is needed";
                    return wrong(velocity.span().start, format!("velocity = {speed}: {needed}"));
                }
            },
        };
        let pieces = self.layers(domain)?.into_iter();
        let pieces = pieces.map(|LayerTable { to, value, .. }| match value {
            None => wrong(to.span().start, "value is missing in this layer"),
            Some(value) => match value.get_ref().problem(false) {
                Some(problem) => wrong(value.span().start, format!("value = {problem}")),
                None => Ok(Piece { to: *to.get_ref(), value: value.get_ref().clone() }),
            },
        });
        let [name, description, source] = self.words(name);
        Ok(AdvectionScene {
            name,
            description,
            source,
            domain,
            velocity,
            profile: pieces.collect::<Result<_, _>>()?,
            end_time: self.end_time.0,
            particles: self.particles(200, 1)?,
            method: self.method(),
        })
    }
}
