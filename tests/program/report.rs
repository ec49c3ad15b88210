//! The report: whole, as listed, and the same again.

use super::{courant, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Every file below a directory by its path from there.
fn files(place: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut open = vec![place.to_owned()];
    while let Some(directory) = open.pop() {
        for entry in std::fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                let bytes = std::fs::read(&path).unwrap();
                found.insert(path.strip_prefix(place).unwrap().to_owned(), bytes);
            }
        }
    }
    found
}

/// A file of comma-separated values without its columns of wall-clock time, and whether it has any.
fn without_times(csv: &[u8]) -> (Vec<Vec<String>>, bool) {
    let is_time = |name: &str| {
        name.split('_').any(|word| ["seconds", "milliseconds", "ms"].contains(&word))
            || name == "million_pairs_s"
    };
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(csv);
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let times: Vec<bool> = rows[0].iter().map(is_time).collect();
    let kept = |row: &csv::StringRecord| {
        let cells = row.iter().zip(&times).filter(|(_, time)| !**time);
        cells.map(|(cell, _)| cell.to_string()).collect()
    };
    (rows.iter().map(kept).collect(), times.contains(&true))
}

#[test]
fn one_table_is_made_alone_and_a_wrong_name_is_one_clear_line() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("out");
    let report = |only: &str| {
        courant(&["report", "--quick", "--only", only, "--out", out.to_str().unwrap()])
    };
    for (wrong, said) in [
        ("table_1_exakt", "did you mean `table_1_exact`"),
        ("figure_02", "in several papers: ferrari2008/figure_02, cha-whitworth2003/figure_02"),
    ] {
        let refused = report(wrong);
        assert_eq!(refused.status.code(), Some(2));
        let line = super::text(&refused.stderr);
        assert!(line.contains("--only") && line.contains(wrong) && line.contains(said), "{line}");
        assert!(!out.exists());
    }
    assert!(report("table_1_exact,cha-whitworth2003/integrator_table").status.success());
    let names: Vec<PathBuf> = files(&out).into_keys().collect();
    let wanted = ["cha-whitworth2003/integrator_table", "ferrari2008/table_1_exact"];
    let wanted = wanted
        .iter()
        .flat_map(|name| ["csv", "md", "tex"].map(|end| format!("quick/{name}.{end}")));
    assert_eq!(names, wanted.map(PathBuf::from).collect::<Vec<_>>());
}

#[test]
fn two_reports_differ_in_times_alone_and_show_what_is_listed() {
    let places = [(); 2].map(|()| tempfile::tempdir().unwrap());
    for (place, threads) in places.iter().zip(["1", "2"]) {
        let out = place.path().to_str().unwrap();
        let output = courant(&["report", "--quick", "--threads", threads, "--out", out]);
        assert!(output.status.success(), "{}", super::text(&output.stderr));
        // A line for each part where there is no bar.
        assert!(super::text(&output.stdout).lines().any(|line| line.starts_with("Figure 1: ")));
    }
    let [first, second] = places.each_ref().map(|place| files(place.path()));
    assert!(first.keys().eq(second.keys()));
    // Tables with times, and the pages that show them.
    let mut timed: Vec<PathBuf> = Vec::new();
    for (path, bytes) in first.iter().filter(|(path, _)| path.extension() == Some("csv".as_ref())) {
        let ((one, has_times), (other, _)) = (without_times(bytes), without_times(&second[path]));
        assert_eq!(one, other, "{}", path.display());
        if has_times {
            timed.push(path.with_extension(""));
        }
    }
    assert!(timed.len() > 4);
    for (path, bytes) in &first {
        let is_text = ["csv", "md", "tex"].iter().any(|end| path.extension() == Some(end.as_ref()));
        let shows_times = path.file_stem() == Some("index".as_ref())
            || is_text && timed.contains(&path.with_extension(""));
        assert!(shows_times || *bytes == second[path], "{}", path.display());
        if path.extension() == Some("tex".as_ref()) {
            // Whatever fonts the reader's LaTeX has.
            assert!(bytes.is_ascii(), "{}", path.display());
        }
    }
    let claims = &first[Path::new("quick/cha-whitworth2003/particle_claims.csv")];
    let (claims, _) = without_times(claims);
    assert_eq!(claims.len(), 1 + 17);
    let verdict = |row: &Vec<String>| row.last().cloned().unwrap();
    assert!(!claims.iter().any(|row| verdict(row) == "not decided"), "{claims:?}");
    for entry in json(&["list", "figures", "--format", "json"])["figures"].as_array().unwrap() {
        let name = entry["name"].as_str().unwrap();
        let named = |path: &PathBuf| path.with_extension("").ends_with(name);
        assert!(first.keys().any(named), "{name} is listed and not there");
    }
}
