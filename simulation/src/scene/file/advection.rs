//! An advected quantity, from its tables.

use super::{Problem, SceneFile};
use crate::advection::{AdvectionScene, Piece};

impl SceneFile {
    pub(super) fn advection(&self, name: &str) -> Result<AdvectionScene, Problem> {
        let domain @ [from, to] = self.interval()?;
        let velocity = match &self.velocity {
            None => 1.0,
            Some(velocity) => match *velocity.get_ref() {
                speed if speed.is_finite() && speed != 0.0 => speed,
                speed => {
                    let problem =
                        format!("velocity = {speed}: a finite number other than 0 is needed");
                    return Err((velocity.span().start, problem));
                }
            },
        };
        let mut edge = from;
        let mut profile = Vec::new();
        for table in self.layer.iter().flatten() {
            let (end, value) = (&table.get_ref().to, &table.get_ref().value);
            let (place, layer_end) = (end.span().start, *end.get_ref());
            if layer_end.is_nan() || layer_end <= edge {
                return Err((place, format!("to = {layer_end}: a number above {edge} is needed")));
            }
            edge = layer_end;
            let value =
                value.as_ref().ok_or((place, "value is missing in this layer".to_string()))?;
            if let Some(problem) = value.get_ref().problem(false) {
                return Err((value.span().start, format!("value = {problem}")));
            }
            profile.push(Piece { to: edge, value: value.get_ref().clone() });
        }
        if profile.is_empty() || edge != to {
            let place = self.layer.iter().flatten().last().map_or(0, |table| table.span().start);
            return Err((
                place,
                format!("layer: tables [[layer]] with to and value, up to {to}, are needed"),
            ));
        }
        let [name, description, source] = self.words(name);
        Ok(AdvectionScene {
            name,
            description,
            source,
            domain,
            velocity,
            profile,
            end_time: self.end_time.0,
            particles: self.particles(200, 1)?,
            method: self.method(),
        })
    }
}
