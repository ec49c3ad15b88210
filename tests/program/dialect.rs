//! One dialect of comma-separated values.

use super::{courant, text};

/// What holds for comma-separated values of every command and file.
fn assert_dialect(table: &str, whence: &str) -> Vec<String> {
    let mut lines = table.lines();
    let names: Vec<String> =
        lines.next().unwrap_or_default().split(',').map(String::from).collect();
    for (index, name) in names.iter().enumerate() {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        assert!(!name.is_empty() && name.chars().all(plain), "{whence}: `{name}`");
        assert!(!names[..index].contains(name), "{whence}: `{name}` twice");
    }
    for cell in lines.flat_map(|line| line.split(',')) {
        let number = cell.parse::<f64>();
        assert!(cell != "–" && !cell.starts_with('−'), "{whence}: {cell}");
        assert!(number.is_err() || !cell.contains(['e', 'E', 'N']), "{whence}: {cell}");
    }
    names
}

#[test]
fn all_commands_and_files_speak_one_dialect_for_machines() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().to_str().unwrap();
    let heads = |command: &str| {
        let words: Vec<&str> = command.split(' ').chain(["--format", "csv"]).collect();
        let output = courant(&words);
        assert!(output.status.success(), "{command}: {}", text(&output.stderr));
        assert_dialect(&text(&output.stdout), command)
    };
    let sph = "--method sph-av --ratio 1.2 --integrator kdk --kernel cubic";
    let short = "--particles 8 --steps 4 --cfl 0.1";
    let validated = [
        heads(&format!("validate --scheme godunov-sph --ratio 2 --kernel cubic {short}")),
        heads(&format!("validate --scheme upwind {short}")),
        heads(&format!("validate {sph} {short}")),
    ];
    assert!(validated.iter().all(|names| *names == validated[0]));
    let dispersion = heads(&format!("dispersion {sph} --cfl 0.1 --kappa 0,1"));
    let run = heads(&format!("run advection-step --particles 20 --out {out}"));
    for name in ["method", "kernel", "ratio", "cfl"] {
        assert!(dispersion.iter().any(|known| known == name), "{name}");
        assert!(run.iter().any(|known| known == name), "{name}");
        assert!(name == "method" || validated[0].iter().any(|known| known == name), "{name}");
    }
    assert!(run.iter().any(|name| name == "l1_value"));
    heads(&format!("run sod --method sph-adke --particles 20 --out {out}"));
    heads(&format!("run sod-sph --method gph1 --particles 20 --out {out}"));
    heads("list");
    heads("symbol --scheme upwind");
    heads("limits --scheme upwind --growth 1e-9");
    heads("check --scheme upwind --cfl 1/2");
    for map in [
        "map --scheme godunov-sph --ratio 1/4,1,2 --cfl 0:2:1",
        "map --scheme upwind --x C=0:1:1/2 --y C=0:1:1/2",
        "map --method sph --kappa 1,2,3 --ratio 1.1,1.2,1.3",
        "map --method sph-av --integrator kdk --ratio 1.1,1.2 --alpha 0,1",
    ] {
        let words: Vec<&str> = map.split(' ').chain(["--out", out]).collect();
        let output = courant(&words);
        // The axes of a map are two.
        assert_eq!(output.status.success(), !map.contains("y C"), "{}", text(&output.stderr));
    }
    let mut files = 0;
    for entry in std::fs::read_dir(out).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|end| end == "csv") {
            files += 1;
            let table = std::fs::read_to_string(&path).unwrap();
            assert_dialect(&table, path.to_str().unwrap());
        }
    }
    assert_eq!(files, 7);
}
