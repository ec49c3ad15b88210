//! A gas in a box, from its tables.

use super::{Axes, Ends, Positive, Problem, SceneFile, ascends, place, wrong};
use crate::boundary::Boundary;
use crate::field::{FieldFlow, FieldScene, VORTEX_RADIUS};
use crate::lattice::Lattice;
use crate::particles::Gas;
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
        let (dimension, here) = (axes.len(), place(&self.domain));
        if !(2..=3).contains(&dimension) || !axes.iter().all(ascends) {
            let needed = "an ascending interval [from, to] for each of two or three axes is needed";
            return wrong(here, format!("domain: {needed}"));
        }
        let material = self.material()?;
        let flow = self.box_flow(material)?;
        let boundary = self.box_ends(dimension)?;
        let misfit = match flow {
            FieldFlow::Shear { .. } if boundary[1][0] != Boundary::Periodic => {
                let needed = "along the second axis, that of the flow, a shear is periodic";
                return wrong(place(&self.boundary), format!("boundary: {needed}"));
            }
            FieldFlow::Gresho { .. } if dimension != 2 => Some("a vortex has two axes"),
            FieldFlow::Gresho { .. } => {
                let holds = |[from, to]: &[f64; 2]| *from <= -VORTEX_RADIUS && *to >= VORTEX_RADIUS;
                let reach = "the vortex reaches 0.4 from the origin on every side";
                (!axes.iter().all(holds)).then_some(reach)
            }
            FieldFlow::Blast { .. } if dimension != 3 => Some("a blast has three axes"),
            FieldFlow::Blast { .. } => {
                let holds = |[from, to]: &[f64; 2]| *from < 0.0 && *to > 0.0;
                let start = "the blast starts at the origin, which is to be inside";
                (!axes.iter().all(holds)).then_some(start)
            }
            FieldFlow::Shear { .. } => None,
        };
        if let Some(problem) = misfit {
            return wrong(here, format!("domain: {problem}"));
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
        let needs_energy = |table: &str| match &self.sound_speed {
            Some(speed) => wrong(speed.span().start, format!("sound_speed: a {table} needs gamma")),
            None => Ok(()),
        };
        match (&self.shear, &self.vortex, &self.blast) {
            (Some(table), None, None) => {
                let ShearTable { density, speed, pressure } = table.get_ref();
                let follows = match material {
                    Material::Isothermal(gas) => gas.pressure(density.0, ()),
                    Material::Ideal(_) => 0.0,
                };
                let none = "that of an isothermal gas follows from its density";
                let (key, start) = ("shear.pressure", table.span().start);
                let pressure = self.of_ideal(material, key, pressure, start, follows, none)?;
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
                let last = place(&self.shear).max(place(&self.vortex)).max(place(&self.blast));
                wrong(last, "one of the tables [shear], [vortex] and [blast] is accepted")
            }
        }
    }

    fn box_ends(&self, dimension: usize) -> Result<Vec<[Boundary; 2]>, Problem> {
        let here = place(&self.boundary);
        let axes = match self.boundary.as_ref().map(Spanned::get_ref) {
            None => vec![[Boundary::Periodic; 2]; dimension],
            Some(Ends::Each(axes)) if axes.len() == dimension => {
                axes.iter().map(|axis| self.ends(axis)).collect::<Result<_, _>>()?
            }
            Some(Ends::Each(_)) => {
                let entries = format!("one word, or an entry for each of {dimension} axes");
                return wrong(here, format!("boundary: {entries}, is needed"));
            }
            Some(word) => vec![self.ends(word)?; dimension],
        };
        let closed = |end: &Boundary| matches!(end, Boundary::Periodic | Boundary::Mirror);
        match axes.as_flattened().iter().all(closed) {
            true => Ok(axes),
            false => wrong(here, "boundary: in a box, periodic and mirror are accepted"),
        }
    }

    fn lattice_of(&self, dimension: usize) -> Result<Lattice, Problem> {
        let fits = |lattice: &Lattice| lattice.dimension() == dimension;
        let fitting = || Lattice::ALL.into_iter().filter(fits);
        match &self.lattice {
            None => Ok(fitting().next().expect("there is one in a plane and in space")),
            Some(lattice) if fits(lattice.get_ref()) => Ok(*lattice.get_ref()),
            Some(lattice) => {
                let names = fitting().map(Lattice::name).collect::<Vec<_>>().join(", ");
                let problem = format!("lattice: in {dimension} dimensions accepted: {names}");
                wrong(lattice.span().start, problem)
            }
        }
    }
}
