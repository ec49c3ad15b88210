//! Lists the files of the catalogue, so that to add a scheme is to add a file.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?;
    let mut code = String::new();
    let folders = [
        ("SCHEMES", "schemes"),
        ("SPACES", "schemes/spaces"),
        ("INTEGRATORS", "schemes/integrators"),
        ("METHODS", "schemes/methods"),
    ];
    for (constant, folder) in folders {
        println!("cargo::rerun-if-changed={folder}");
        let mut files: Vec<_> = fs::read_dir(Path::new(&root).join(folder))?
            .filter_map(|entry| entry.ok().map(|entry| entry.path()))
            .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
            .collect();
        files.sort();
        let _ = writeln!(code, "/// The files of `{folder}`, by name and text.");
        let _ = writeln!(code, "pub(crate) static {constant}: &[(&str, &str)] = &[");
        for path in files {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            // By the place of the checkout at compile time: a folder that was moved with its build directory still compiles.
            let inside = format!("/{folder}/{name}.toml");
            let _ = writeln!(
                code,
                "    ({name:?}, include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), {inside:?}))),"
            );
        }
        code.push_str("];\n");
    }
    let target = env::var("OUT_DIR").map_err(io::Error::other)?;
    fs::write(Path::new(&target).join("catalogue.rs"), code)
}
