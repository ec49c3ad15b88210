//! A gas in a box, from its tables.

use super::{Axes, Ends, Positive, Problem, SceneFile, place};
use crate::boundary::Boundary;
use crate::field::{FieldFlow, FieldScene, VORTEX_RADIUS};
use crate::lattice::Lattice;
use crate::scene::Material;
use serde::Deserialize;
use toml::Spanned;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ShearTable {
    density: Positive,
    speed: Positive,
    /// Of an ideal gas.
    pressure: Option<Spanned<Positive>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct VortexTable {
    density: Positive,
    pressure: Positive,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BlastTable {
    density: Positive,
    energy: Positive,
    pressure: Positive,
}

impl SceneFile {
    pub(super) fn field(&self, name: &str) -> Result<FieldScene, Problem> {
        let axes = match self.domain.as_ref().map(Spanned::get_ref) {
            Some(Axes::Box(axes)) => axes.as_slice(),
            Some(Axes::Line(_)) | None => &[],
        };
        let ascending = |[from, to]: &[f64; 2]| from.is_finite() && to.is_finite() && from < to;
        let dimension = axes.len();
        if !(2..=3).contains(&dimension) || !axes.iter().all(ascending) {
            let problem =
                "domain: an ascending interval [from, to] for each of two or three axes is needed";
            return Err((place(&self.domain), problem.into()));
        }
        let material = self.material()?;
        let flow = self.box_flow(material)?;
        let boundary = self.box_ends(dimension)?;
        let wrong = |problem: &str| Err((place(&self.domain), format!("domain: {problem}")));
        match flow {
            FieldFlow::Shear { .. } if boundary[1][0] != Boundary::Periodic => {
                let problem =
                    "boundary: along the second axis, that of the flow, a shear is periodic";
                return Err((place(&self.boundary), problem.into()));
            }
            FieldFlow::Shear { .. } => {}
            FieldFlow::Gresho { .. } if dimension != 2 => return wrong("a vortex has two axes"),
            FieldFlow::Gresho { .. } => {
                let holds = |[from, to]: &[f64; 2]| *from <= -VORTEX_RADIUS && *to >= VORTEX_RADIUS;
                if !axes.iter().all(holds) {
                    return wrong("the vortex reaches 0.4 from the origin on every side");
                }
            }
            FieldFlow::Blast { .. } if dimension != 3 => return wrong("a blast has three axes"),
            FieldFlow::Blast { .. } => {
                if !axes.iter().all(|[from, to]| *from < 0.0 && *to > 0.0) {
                    return wrong("the blast starts at the origin, which is to be inside");
                }
            }
        }
        let end = |side: usize| axes.iter().map(|axis| axis[side]).collect();
        let [name, description, source] = self.words(name);
        Ok(FieldScene {
            name,
            description,
            source,
            dimension,
            domain: [end(0), end(1)],
            boundary,
            lattice: self.lattice_of(dimension)?,
            gas: material,
            flow,
            end_time: self.end_time.0,
            particles: self.particles(2500, 100)?,
            method: self.method(),
        })
    }

    fn box_flow(&self, material: Material) -> Result<FieldFlow, Problem> {
        let isothermal = match material {
            Material::Isothermal(gas) => Some(gas.sound_speed),
            Material::Ideal(_) => None,
        };
        let needs_energy = |table: &str| match &self.sound_speed {
            Some(speed) => Err((speed.span().start, format!("sound_speed: a {table} needs gamma"))),
            None => Ok(()),
        };
        match (&self.shear, &self.vortex, &self.blast) {
            (Some(table), None, None) => {
                let ShearTable { density, speed, pressure } = table.get_ref();
                let pressure = match (isothermal, pressure) {
                    (Some(sound), None) => sound * sound * density.0,
                    (None, Some(pressure)) => pressure.get_ref().0,
                    (Some(_), Some(pressure)) => {
                        let problem =
                            "shear.pressure: that of an isothermal gas follows from its density";
                        return Err((pressure.span().start, problem.into()));
                    }
                    (None, None) => {
                        let problem =
                            "shear.pressure is missing: only an isothermal gas needs none";
                        return Err((table.span().start, problem.into()));
                    }
                };
                Ok(FieldFlow::Shear { density: density.0, speed: speed.0, pressure })
            }
            (None, Some(table), None) => {
                needs_energy("vortex")?;
                let VortexTable { density, pressure } = table.get_ref();
                Ok(FieldFlow::Gresho { density: density.0, pressure: pressure.0 })
            }
            (None, None, Some(table)) => {
                needs_energy("blast")?;
                let BlastTable { density, energy, pressure } = table.get_ref();
                Ok(FieldFlow::Blast { density: density.0, energy: energy.0, pressure: pressure.0 })
            }
            _ => {
                let places = [place(&self.shear), place(&self.vortex), place(&self.blast)];
                let last = places.into_iter().max().unwrap_or(0);
                Err((last, "one of the tables [shear], [vortex] and [blast] is accepted".into()))
            }
        }
    }

    fn box_ends(&self, dimension: usize) -> Result<Vec<[Boundary; 2]>, Problem> {
        let axes = match self.boundary.as_ref().map(Spanned::get_ref) {
            None => vec![[Boundary::Periodic; 2]; dimension],
            Some(Ends::Each(axes)) if axes.len() == dimension => {
                axes.iter().map(|axis| self.ends(axis)).collect::<Result<_, _>>()?
            }
            Some(Ends::Each(_)) => {
                let problem = format!(
                    "boundary: one word, or an entry for each of {dimension} axes, is needed"
                );
                return Err((place(&self.boundary), problem));
            }
            Some(word) => vec![self.ends(word)?; dimension],
        };
        match axes
            .as_flattened()
            .iter()
            .all(|end| matches!(end, Boundary::Periodic | Boundary::Mirror))
        {
            true => Ok(axes),
            false => Err((
                place(&self.boundary),
                "boundary: in a box, periodic and mirror are accepted".into(),
            )),
        }
    }

    fn lattice_of(&self, dimension: usize) -> Result<Lattice, Problem> {
        let fits = |lattice: &Lattice| lattice.dimension() == dimension;
        match &self.lattice {
            None => Ok(Lattice::ALL
                .into_iter()
                .find(fits)
                .expect("there is one in a plane and in space")),
            Some(lattice) if fits(lattice.get_ref()) => Ok(*lattice.get_ref()),
            Some(lattice) => {
                let fitting = Lattice::ALL.into_iter().filter(fits).map(Lattice::name);
                let names = fitting.collect::<Vec<_>>().join(", ");
                let problem = format!("lattice: in {dimension} dimensions accepted: {names}");
                Err((lattice.span().start, problem))
            }
        }
    }
}
