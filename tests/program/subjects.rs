//! Any linear scheme as a user names it: equations, files, spaces with integrators, particle methods.

use super::courant;
use serde_json::Value;
use std::time::{Duration, Instant};

const LEAPFROG: &str = "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])";
const DOWNWIND: &str = "u[n+1,j] + C*(u[n+1,j+1]-u[n+1,j]) = u[n,j]";

fn shown(arguments: &[&str]) -> String {
    let output = courant(arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    super::json(&[arguments, &["--format", "json"]].concat())
}

fn first_row(arguments: &[&str]) -> Value {
    json(arguments)["rows"][0].clone()
}

#[test]
fn an_equation_has_its_proved_limit_and_the_wave_that_meets_another() {
    let row = first_row(&["limits", "--equation", LEAPFROG]);
    let limit = &row["stability"];
    assert_eq!((&limit["exact"], &limit["evidence"]), (&"1".into(), &"proved".into()));
    assert_eq!((&limit["included"], &row["limit_included"]), (&false.into(), &false.into()));
    assert_eq!((&row["parameter"], &row["scheme"]), (&"C".into(), &LEAPFROG.into()));
    assert!((limit["critical_phase"].as_f64().unwrap() - std::f64::consts::FRAC_PI_2).abs() < 1e-6);
    let text = shown(&["limits", "--equation", LEAPFROG]);
    assert!(text.contains("two multipliers") && text.contains("the wave of 4.000 Δ"), "{text}");
}

#[test]
fn schemes_without_a_limit_say_so_and_why() {
    let rows = json(&["limits", "--scheme", "crank-nicolson,dufort-frankel,leapfrog-diffusion"]);
    for row in &rows["rows"].as_array().unwrap()[..2] {
        let limit = &row["stability"];
        assert!(limit["value"].is_null() && limit["unbounded"] == true, "{row}");
        assert_eq!((&limit["without_end"], &limit["evidence"]), (&true.into(), &"proved".into()));
    }
    // Diffusion at the middle level of leapfrog: unstable whatever the step.
    let last = &rows["rows"][2];
    assert_eq!(
        (&last["stability"]["value"], &last["stability"]["exact"]),
        (&0.0.into(), &"0".into())
    );
    let text = shown(&["limits", "--scheme", "crank-nicolson"]);
    assert!(text.contains("stable without limit, proved"), "{text}");
}

#[test]
fn stable_sets_that_do_not_begin_at_zero_are_shown() {
    let row = first_row(&["limits", "--equation", DOWNWIND]);
    assert_eq!(row["stability"]["value"], 0.0);
    let set = row["stable_set"].as_array().unwrap();
    let ends = |index: usize| (set[index]["from"].as_f64(), set[index]["to"].as_f64());
    assert_eq!((ends(0), ends(1)), ((Some(0.0), Some(0.0)), (Some(1.0), None)));
    let singular = &row["singular"][0];
    assert_eq!((&singular["exact"], &singular["value"]), (&"1/2".into(), &0.5.into()));
    let text = shown(&["limits", "--equation", DOWNWIND]);
    assert!(text.contains("{0} ∪ [1, ∞)") && text.contains("singular at C = 1/2"), "{text}");
    let window = shown(&["limits", "--scheme", "lagrange-upwind-3"]);
    assert!(window.contains("{0} ∪ [1, 2]"), "{window}");
}

#[test]
fn spaces_and_integrators_make_a_two_way_table_of_proved_limits() {
    let lists = [
        "limits",
        "--space",
        "upwind-1,upwind-2,upwind-3,upwind-5,upwind-7,central-2,central-4,central-6",
        "--integrator",
        "forward-euler,rk2,rk3,rk4,rk5,rk6,rk7",
    ];
    let start = Instant::now();
    let rows = json(&lists)["rows"].as_array().unwrap().clone();
    // Two seconds on a quiet machine.
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    assert_eq!(rows.len(), 56);
    let exact = |space: &str, integrator: &str| {
        let row = rows.iter().find(|row| row["space"] == space && row["integrator"] == integrator);
        let limit = &row.unwrap()["stability"];
        assert_eq!(limit["evidence"], "proved", "{space} {integrator}");
        limit["exact"].clone()
    };
    assert_eq!(exact("upwind-3", "rk2-midpoint"), "(2/3)^(1/3)");
    assert_eq!(exact("upwind-5", "rk5"), "12^(1/5)");
    assert_eq!(exact("central-2", "rk3-ssp"), "sqrt(3)");
    assert_eq!(exact("central-2", "rk4"), "sqrt(8)");
    // Growth of order φ^6 and less: no sample sees it.
    for (space, integrator) in [("central-2", "rk5"), ("central-4", "rk6"), ("upwind-7", "rk5")] {
        assert_eq!(exact(space, integrator), "0");
    }
    assert!(rows.iter().all(|row| row["stability"]["evidence"] == "proved"));
    let text = shown(&lists);
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.iter().all(|line| line.chars().count() <= 100), "{text}");
    let head = lines.iter().find(|line| line.starts_with("space")).unwrap();
    assert!(head.contains("rk2-midpoint") && head.contains("rk7"), "{text}");
    let central = lines.iter().find(|line| line.starts_with("central-2 ")).unwrap();
    let cells: Vec<&str> = central.split_whitespace().collect();
    assert_eq!(&cells[1..6], ["0", "0", "1.73205", "2.82842", "0"], "{text}");
    assert!(text.contains("12^(1/5)") && text.contains("all proved"), "{text}");
}

#[test]
fn every_list_gives_a_row_for_each_combination() {
    let count = |arguments: &[&str]| json(arguments)["rows"].as_array().unwrap().len();
    let method = ["limits", "--method", "sph,gph", "--integrator", "kdk,rk4", "--ratio", "1.2,2"];
    assert_eq!(count(&method), 8);
    let more = ["--kernel", "cubic,c2", "--eos", "isothermal,ideal:7/5,tait:0"];
    assert_eq!(count(&[&method[..5], &["--ratio", "1.2"], &more].concat()), 24);
    let set = ["limits", "--scheme", "advection-diffusion-ftcs", "--set", "r=0.1:0.5:0.1"];
    let rows = json(&set)["rows"].clone();
    assert_eq!(rows.as_array().unwrap().len(), 5);
    assert_eq!(
        (&rows[0]["parameters"]["r"], &rows[0]["stability"]["exact"]),
        (&"1/10".into(), &"sqrt(1/5)".into())
    );
    // The other parameter, at a fixed Courant number: C²/2 ≤ r ≤ 1/2.
    let other = first_row(&["limits", "--scheme", "advection-diffusion-ftcs", "--set", "C=1/2"]);
    assert_eq!(other["parameter"], "r");
    // At r = 0 nothing damps the central difference: 0 is no stable value.
    assert_eq!(other["stable_set"][0]["from"], 0.125);
    let alpha = ["limits", "--method", "sph-av", "--integrator", "kdk", "--ratio", "1.2"];
    assert_eq!(count(&[&alpha[..], &["--alpha", "0,1/2,1"]].concat()), 3);
}

#[test]
fn particle_methods_state_what_they_assume() {
    let plain = ["limits", "--method", "sph", "--integrator", "leapfrog", "--ratio", "1.2"];
    let limit = |more: &[&str]| first_row(&[&plain[..], more].concat());
    let value = |row: &Value| row["stability"]["value"].as_f64().unwrap();
    let isothermal = limit(&[]);
    for (key, wanted) in [("eos", "isothermal"), ("density", "summation"), ("lattice", "line")] {
        assert_eq!(isothermal[key], wanted);
    }
    assert_eq!(isothermal["dimension"], 1);
    assert!((value(&isothermal) - 1.0632).abs() < 5e-5);
    assert!((value(&limit(&["--eos", "ideal:7/5"])) - 1.2207).abs() < 5e-5);
    assert!((value(&limit(&["--eos", "tait:0"])) - 1.8946).abs() < 5e-5);
    let continuity = limit(&["--density", "continuity"]);
    assert!(continuity["density"] == "continuity" && value(&continuity) != value(&isothermal));
    let text = shown(&plain);
    for word in ["one dimension", "isothermal", "density by summation", "linear"] {
        assert!(text.contains(word), "{text}");
    }
}

#[test]
fn a_work_budget_of_one_box_leaves_everything_undecided() {
    for subject in [
        &["--scheme", "leapfrog"][..],
        &["--scheme", "lax-wendroff-sph", "--ratio", "1.3"],
        &["--space", "upwind-3", "--integrator", "rk3"],
        &["--method", "sph", "--integrator", "kdk", "--ratio", "1.5"],
    ] {
        let row = first_row(&[&["limits"], subject, &["--budget", "1"]].concat());
        assert_eq!(row["stability"]["evidence"], "undecided", "{subject:?}");
        assert!(!row["undecided"].as_array().unwrap().is_empty());
        let check = [&["check"], subject, &["--cfl", "0.9", "--budget", "1"]].concat();
        assert_eq!(json(&check)["verdict"], "undecided", "{subject:?}");
        assert_eq!(courant(&check).status.code(), Some(1));
    }
}

#[test]
fn growth_like_the_number_of_steps_is_marginal_and_named() {
    let driven = ["--equation", "u[n+1,j]=u[n,j]; v[n+1,j]=v[n,j]+C*(u[n,j]-u[n,j-1])"];
    let check = [&["check"], &driven[..], &["--cfl", "1/2"]].concat();
    let found = json(&check);
    assert_eq!((&found["verdict"], courant(&check).status.code()), (&"marginal".into(), Some(0)));
    assert_eq!(found["double_multiplier_phase"], std::f64::consts::PI);
    let limits = [&["limits"], &driven[..]].concat();
    assert_eq!(first_row(&limits)["double_multiplier_phase"], std::f64::consts::PI);
    let text = shown(&limits);
    assert!(text.contains("marginal at best") && text.contains("that of 2 Δ"), "{text}");
}

#[test]
fn whatever_is_typed_tables_and_rows_keep_their_shape() {
    let long = "p[n+1,j] = p[n,j] - C/2*(v[n,j+1] - v[n,j-1]) + C/2*(p[n,j+1] - 2*p[n,j] + p[n,j-1]); \
                v[n+1,j] = v[n,j] - C/2*(p[n,j+1] - p[n,j-1]) + C/2*(v[n,j+1] - 2*v[n,j] + v[n,j-1])";
    let tiny = ["limits", "--scheme", "advection-diffusion-ftcs", "--set", "r=1e-300,1/3"];
    for arguments in [&["limits", "--equation", long][..], &tiny] {
        let text = shown(arguments);
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    }
    assert!(shown(&tiny).contains("1e-300 "));
    let listed = shown(&["list", "schemes", "--format", "csv"]);
    let all = json(&["list", "schemes"])["schemes"].as_array().unwrap().len();
    assert_eq!(listed.lines().count(), 1 + all);
}

#[test]
fn maps_of_different_equations_have_different_files() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().to_str().unwrap();
    let axes = ["--x", "r=0:1:0.5", "--y", "C=0:1:0.5", "--out", out];
    for sign in ["+", "*"] {
        let equation = format!("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]) + (2{sign}r)*u[n,j]");
        shown(&[&["map", "--equation", &equation], &axes[..]].concat());
    }
    let pictures = std::fs::read_dir(place.path())
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().path().extension().is_some_and(|end| end == "png"));
    assert_eq!(pictures.count(), 2);
}

#[test]
fn a_step_that_cannot_be_solved_is_named() {
    let row = first_row(&["limits", "--equation", "C*u[n+1,j] = u[n,j]"]);
    let singular = &row["singular"];
    assert_eq!((&singular[0]["exact"], singular.as_array().unwrap().len()), (&"0".into(), 1));
    assert!(singular[0]["phase"].is_null() && singular[0]["reason"].is_string());
    let text = shown(&["limits", "--equation", "(2*C-1)*u[n+1,j] = u[n,j]"]);
    assert!(text.contains("C = 1/2: the step cannot be solved for any wave"), "{text}");
}

#[test]
fn a_check_decides_exactly_and_measures_growth_finely() {
    let check =
        |subject: &[&str], cfl: &str| json(&[&["check"], subject, &["--cfl", cfl]].concat());
    let leapfrog = ["--equation", LEAPFROG];
    assert_eq!(check(&leapfrog, "0.999")["verdict"], "stable");
    let limit = check(&leapfrog, "1");
    assert_eq!(limit["verdict"], "marginal");
    assert!(
        (limit["double_multiplier_phase"].as_f64().unwrap() - std::f64::consts::FRAC_PI_2).abs()
            < 1e-9
    );
    assert_eq!(check(&leapfrog, "1.0000000000000000001")["verdict"], "weakly-unstable");
    // Just beyond a proved limit: a narrow band of waves.
    for (ratio, kernel, integrator, cfl, growth) in
        [("1.5", "cubic", "kdk", "1.1866", 0.01297), ("4", "wendland-c2", "kdk", "1.1637", 0.0257)]
    {
        let subject =
            ["--method", "sph", "--integrator", integrator, "--kernel", kernel, "--ratio", ratio];
        let found = check(&subject, cfl);
        assert_eq!(found["verdict"], "unstable", "{found}");
        let measured = found["growth_per_step"].as_f64().unwrap();
        assert!((measured - growth).abs() < 1e-4, "{found}");
    }
    // One parameter set, the other judged, in lists.
    let many =
        ["check", "--scheme", "advection-diffusion-ftcs", "--set", "r=1/4", "--set", "C=1/2,0.9"];
    let rows = json(&many);
    let verdicts: Vec<&Value> =
        rows["rows"].as_array().unwrap().iter().map(|row| &row["verdict"]).collect();
    assert_eq!(verdicts, ["stable", "unstable"]);
    assert_eq!(courant(&many).status.code(), Some(1));
}

#[test]
fn the_symbol_of_any_scheme_has_its_characteristic_polynomial() {
    let record = json(&["symbol", "--equation", LEAPFROG, "--matrix"]);
    assert_eq!(record["characteristic_text"], "z^2 + (-E^-1 C + E C) z - 1 = 0");
    assert!(record["characteristic"].as_str().unwrap().contains("z^{2}"));
    assert!(record["coefficients"].is_null() && record["matrix"][0][0].is_string());
    let upwind = json(&["symbol", "--scheme", "upwind"]);
    assert_eq!(
        upwind["coefficients"][0],
        serde_json::json!({"offset": -1, "polynomial": ["0", "1"]})
    );
    assert_eq!(
        (&upwind["order"]["overall"], &upwind["keeps_constants"]),
        (&1.into(), &true.into())
    );
    let heat = json(&["symbol", "--scheme", "heat-ftcs"]);
    assert_eq!(heat["order"], serde_json::json!({"space": 2, "time": 1, "overall": 2}));
    let fourth = serde_json::json!({"derivative": 4, "coefficient": "r (1 - 6 r)/12"});
    assert_eq!((&heat["modified_equation"][1], &heat["dissipation"]), (&fourth, &fourth));
    assert_eq!(heat["special_values"][0]["exact"], "1/6");
    assert_eq!(heat["special_values"][0]["order"], 4);
    let there = ["symbol", "--scheme", "heat-ftcs", "--set", "r=1/6", "--terms", "3"];
    let there = json(&there);
    assert_eq!(there["order"]["overall"], 4);
    assert_eq!(there["modified_equation"][1]["coefficient"], "-1/3240");
    assert_eq!(there["modified_equation"].as_array().unwrap().len(), 3);
    let latex = shown(&["symbol", "--scheme", "lax-wendroff", "--format", "latex"]);
    assert!(latex.contains("\\partial_x^{3} u"), "{latex}");
    // Parameters may stay open: nothing is decided.
    let drifts = json(&["symbol", "--equation", "u[n+1,j] = A*u[n,j] + B*u[n,j-1]"]);
    assert!(drifts["order"].is_null() && drifts["modified_equation"].is_null());
    assert!(drifts["modified_equation_reason"].as_str().unwrap().contains("the mean drifts"));
    assert!(shown(&["symbol", "--equation", "u[n+1,j] = A*u[n,j] + B*u[n,j-1]"]).contains("χ(z)"));
}

#[test]
fn any_scheme_is_validated_by_its_own_equations() {
    for subject in [
        &["--equation", LEAPFROG][..],
        &["--space", "upwind-3", "--integrator", "rk3"],
        &["--scheme", "crank-nicolson,box,dufort-frankel"],
    ] {
        let record =
            json(&[&["validate"], subject, &["--particles", "12", "--steps", "10"]].concat());
        assert_eq!(record["passed"], true, "{}", record["failures"]);
        let row = &record["rows"][0];
        assert!(row["predicted"]["gain"].is_number() && row["measured"]["phase"].is_number());
        assert!(record["max_error"].as_f64().unwrap() < 1e-6);
    }
}

#[test]
fn files_of_ones_own_are_schemes_and_integrators() {
    let place = tempfile::tempdir().unwrap();
    let scheme = place.path().join("mine.toml");
    let text = "name = \"mine\"\nequations = \"u[n+1,j] = u[n,j] - D*(u[n,j] - u[n,j-1])\"\nparameter = \"D\"\n";
    std::fs::write(&scheme, text).unwrap();
    let row = first_row(&["limits", "--scheme", scheme.to_str().unwrap()]);
    assert_eq!((&row["scheme"], &row["parameter"]), (&"mine".into(), &"D".into()));
    assert_eq!(row["stability"]["exact"], "1");
    let integrator = place.path().join("heun.toml");
    std::fs::write(
        &integrator,
        "name = \"my-heun\"\n[runge-kutta]\nA = [[], [\"1\"]]\nb = [\"1/2\", \"1/2\"]\n",
    )
    .unwrap();
    let lines = ["limits", "--space", "u[j]' = -C*(u[j] - u[j-1])", "--integrator"];
    let row = first_row(&[&lines[..], &[integrator.to_str().unwrap()]].concat());
    assert_eq!((&row["integrator"], &row["stability"]["exact"]), (&"my-heun".into(), &"1".into()));
    std::fs::write(&scheme, "name = \"mine\"\nequation = \"\"\n").unwrap();
    let output = courant(&["limits", "--scheme", scheme.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn machines_get_one_set_of_columns() {
    let heads = |arguments: &[&str]| {
        let text = shown(&[arguments, &["--format", "csv"]].concat());
        let lines: Vec<String> = text.lines().map(String::from).collect();
        let names: Vec<String> = lines[0].split(',').map(String::from).collect();
        assert!(names.iter().all(|name| {
            name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
        }));
        (names, lines.len() - 1)
    };
    let (scheme, rows) = heads(&["limits", "--scheme", "upwind,leapfrog"]);
    assert_eq!(rows, 2);
    let (method, _) =
        heads(&["limits", "--method", "sph", "--integrator", "kdk", "--ratio", "1.2"]);
    assert_eq!(scheme, method);
    let (check, _) = heads(&["check", "--scheme", "upwind", "--cfl", "1/2"]);
    for column in
        ["scheme", "parameter", "value", "lower", "upper", "exact", "evidence", "critical_phase"]
    {
        assert!(scheme.iter().any(|name| name == column), "{column}");
        assert!(check.iter().any(|name| name == column), "{column}");
    }
}

#[test]
fn bad_subjects_are_one_line_that_names_the_option() {
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("misspelt.toml");
    std::fs::write(&file, "name = 'x'\nequation = 'u[n+1,j] = u[n,j-1]'\n").unwrap();
    let misspelt = file.to_str().unwrap();
    for (arguments, words) in [
        (vec!["limits", "--equation", "u[n+1,j] = u[n,j]*u[n,j]"], vec!["--equation", "»", "«"]),
        (
            vec!["limits", "--equation", "u[n+1,j] = u[n,j] - C*(u[n,j] - v[n,j-1])"],
            vec!["--equation", "u, v"],
        ),
        (
            vec!["limits", "--equation", "u[n+1,j] = A*u[n,j] + B*u[n,j-1]"],
            vec!["--set A", "--set B", "--parameter"],
        ),
        (vec!["limits", "--equation", LEAPFROG, "--parameter", "D"], vec!["--parameter D", "C"]),
        (
            vec!["limits", "--scheme", "upwnd"],
            vec!["--scheme", "did you mean `upwind`", "courant list schemes"],
        ),
        (vec!["limits", "--scheme", "no/such.toml"], vec!["--scheme", "cannot be read"]),
        (vec!["limits", "--space", "upwind-3"], vec!["--integrator", "required"]),
        (
            vec!["limits", "--space", "upwind-3", "--integrator", "rk44"],
            vec!["--integrator", "`rk4`"],
        ),
        (
            vec!["limits", "--space", "upwind-3", "--integrator", "kdk"],
            vec!["--integrator leapfrog-kdk", "positions"],
        ),
        (
            vec!["limits", "--scheme", "upwind", "--integrator", "rk4"],
            vec!["--integrator", "by themselves"],
        ),
        (vec!["limits", "--scheme", "upwind", "--ratio", "2"], vec!["--ratio", "kernel"]),
        (vec!["limits", "--scheme", "upwind", "--eos", "isothermal"], vec!["--eos", "--method"]),
        (vec!["limits", "--scheme", "upwind", "--set", "r=1"], vec!["--set r=1", "no parameter"]),
        (vec!["limits", "--scheme", "upwind", "--set", "C"], vec!["--set", "NAME=VALUES"]),
        (vec!["limits", "--scheme", "upwind", "--set", "C=1"], vec!["--set C", "leave it out"]),
        (vec!["check", "--scheme", "upwind"], vec!["--cfl", "--set C"]),
        (vec!["check", "--scheme", "upwind", "--set", "C=-1"], vec!["--set C", "from 0 to"]),
        (
            vec!["check", "--scheme", "upwind", "--cfl", "1", "--set", "C=1"],
            vec!["--cfl", "--set C"],
        ),
        (
            vec![
                "limits",
                "--method",
                "sph",
                "--integrator",
                "kdk",
                "--ratio",
                "1",
                "--eos",
                "ideal:0",
            ],
            vec!["--eos", "GAMMA"],
        ),
        (
            vec![
                "limits",
                "--method",
                "sph",
                "--integrator",
                "kdk",
                "--ratio",
                "1",
                "--dimension",
                "2",
            ],
            vec!["--dimension", "1"],
        ),
        (vec!["limits", "--scheme", misspelt], vec!["`equation`", "did you mean `equations`"]),
        (vec!["list", "schem"], vec!["did you mean `schemes`"]),
        (
            vec!["check", "--equation", "(2*C-1)*u[n+1,j]=u[n,j]", "--cfl", "1/2"],
            vec!["--cfl", "C = 1/2", "cannot be solved"],
        ),
        (vec!["limits", "--scheme", "upwind", "--budget", "0"], vec!["--budget", "whole number"]),
    ] {
        let output = courant(&arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert_eq!(error.trim_end().lines().count(), 1, "{arguments:?}: {error}");
        assert!(output.stdout.is_empty());
        for word in words {
            assert!(error.contains(word), "{arguments:?}: {error} lacks {word}");
        }
    }
}
