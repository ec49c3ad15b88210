//! The named scenes: files in the format of a user's, embedded.

use super::Scene;
use std::sync::LazyLock;

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../scenes/", $name, ".toml")))),*]
    };
}

/// Names and texts, in the order of listings: shock tubes, then those of Cha & Whitworth 2003 in the order of the paper, hard ones last.
const FILES: &[(&str, &str)] = files![
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
];

static SCENES: LazyLock<Vec<Scene>> = LazyLock::new(|| {
    let parsed = |(name, text): &(&str, &str)| {
        Scene::parse(text, name).unwrap_or_else(|error| panic!("scenes/{name}.toml, {error}"))
    };
    FILES.iter().map(parsed).collect()
});

impl Scene {
    /// Every named scene.
    pub fn all() -> &'static [Self] {
        &SCENES
    }

    /// The scene of that name.
    pub fn named(name: &str) -> Option<Self> {
        SCENES.iter().find(|scene| scene.name == name).cloned()
    }
}
