//! All scenes, whatever is in them; the named ones are files in the format of a user's, embedded.

use super::{InvalidFile, Scene};
use crate::advection::AdvectionScene;
use crate::field::FieldScene;
use crate::gravity::Cloud;
use std::str::FromStr;
use std::sync::LazyLock;

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../scenes/", $name, ".toml")))),*]
    };
}

/// Names and texts, in the order of listings: advection, shock tubes, those of Cha & Whitworth 2003 in the order of the paper,
/// hard ones; boxes, spheres.
const FILES: &[(&str, &str)] = files![
    "advection-step",
    "advection-gaussian",
    "advection-square",
    "advection-waves",
    "ferrari1",
    "ferrari2",
    "ferrari3",
    "ferrari4",
    "sod",
    "toro1",
    "toro2",
    "toro3",
    "toro4",
    "toro5",
    "toro6",
    "toro7",
    "leblanc",
    "shu-osher",
    "simple-wave",
    "sound-wave",
    "sod-sph",
    "strong-blast",
    "isothermal-tube",
    "sjogreen",
    "collision-subsonic",
    "collision-supersonic",
    "noh",
    "woodward-colella",
    "shear",
    "gresho",
    "sedov",
    "sis-collapse",
    "bonnor-ebert",
    "cold-sphere",
    "evrard",
];

/// A name that no scene of that kind has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no scene `{name}` that is {kind}")]
pub struct UnknownScene {
    name: String,
    kind: &'static str,
}

static SCENES: LazyLock<Vec<AnyScene>> = LazyLock::new(|| {
    let parsed = |(name, text): &(&str, &str)| {
        AnyScene::parse(text, name).unwrap_or_else(|error| panic!("scenes/{name}.toml, {error}"))
    };
    FILES.iter().map(parsed).collect()
});

macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident($scene:ty), $what:literal;)*) => {
        /// A scene of any kind.
        ///
        /// ```
        /// use courant_simulation::scene::AnyScene;
        /// let shear = AnyScene::named("shear").expect("it is in the list");
        /// assert_eq!((shear.dimension(), shear.particles()), (2, 2500));
        /// let error = AnyScene::parse("end_time = 1\nsound_sped = 1", "mine").unwrap_err();
        /// assert_eq!(error.line, 2);
        /// ```
        #[derive(Debug, Clone, PartialEq)]
        pub enum AnyScene {
            $($(#[$doc])* $kind($scene),)*
        }

        impl AnyScene {
            /// The name used on the command line and in files.
            pub fn name(&self) -> &str {
                match self { $(Self::$kind(scene) => &scene.name,)* }
            }

            /// What happens, in a line.
            pub fn description(&self) -> &str {
                match self { $(Self::$kind(scene) => &scene.description,)* }
            }

            /// Where the scene comes from, and what had to be chosen.
            pub fn source(&self) -> &str {
                match self { $(Self::$kind(scene) => &scene.source,)* }
            }

            /// The customary method, if the file names one.
            pub fn method(&self) -> Option<&str> {
                match self { $(Self::$kind(scene) => scene.method.as_deref(),)* }
            }

            /// The customary number of particles.
            pub fn particles(&self) -> usize {
                match self { $(Self::$kind(scene) => scene.particles,)* }
            }

            /// When to stop.
            pub fn end_time(&self) -> f64 {
                match self { $(Self::$kind(scene) => scene.end_time,)* }
            }

            /// Stops at another time.
            pub fn set_end_time(&mut self, time: f64) {
                match self { $(Self::$kind(scene) => scene.end_time = time,)* }
            }

            /// What kind of scene it is, in words.
            pub fn kind(&self) -> &'static str {
                match self { $(Self::$kind(_) => $what,)* }
            }
        }

        $(impl $scene {
            /// Every named scene of this kind.
            pub fn all() -> impl Iterator<Item = &'static Self> {
                AnyScene::all().iter().filter_map(|scene| match scene {
                    AnyScene::$kind(scene) => Some(scene),
                    _ => None,
                })
            }

            /// The scene of that name in the tree, if it is of this kind.
            pub fn named(name: &str) -> Option<Self> {
                match AnyScene::named(name)? {
                    AnyScene::$kind(scene) => Some(scene),
                    _ => None,
                }
            }

            /// A scene of this kind from the text of a file; `name` is its name where the file gives none.
            ///
            /// # Errors
            /// [`InvalidFile`] names the line and what is accepted there.
            pub fn parse(text: &str, name: &str) -> Result<Self, InvalidFile> {
                match AnyScene::parse(text, name)? {
                    AnyScene::$kind(scene) => Ok(scene),
                    other => {
                        let problem = format!("it is {}, not {}", other.kind(), $what);
                        Err(InvalidFile { line: 1, problem })
                    }
                }
            }
        }

        impl FromStr for $scene {
            type Err = UnknownScene;

            fn from_str(name: &str) -> Result<Self, UnknownScene> {
                Self::named(name).ok_or_else(|| UnknownScene { name: name.into(), kind: $what })
            }
        })*
    };
}

kinds! {
    /// A quantity that is carried along, with period.
    Advection(AdvectionScene), "an advection scene";
    /// A gas in one dimension.
    Line(Scene), "a gas on a line";
    /// A gas in a box in two or three dimensions.
    Field(FieldScene), "a gas in a box";
    /// A sphere of gas.
    Cloud(Cloud), "a sphere";
}

impl AnyScene {
    /// Every named scene.
    pub fn all() -> &'static [Self] {
        &SCENES
    }

    /// The scene of that name.
    pub fn named(name: &str) -> Option<Self> {
        SCENES.iter().find(|scene| scene.name() == name).cloned()
    }

    /// How many dimensions it has.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Advection(_) | Self::Line(_) => 1,
            Self::Field(scene) => scene.dimension,
            Self::Cloud(_) => 3,
        }
    }
}
