//! Section 5.8: collapse of the singular isothermal sphere, Table 5 and Figures 29 to 34.

use super::text;
use crate::cloud_profile::{cloud_csv, core_csv, core_panels, density_panel, radial_flow_panel};
use crate::figure::Figure;
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::or_dash;
use crate::report::Detail;
use crate::{cells, words};
use courant_simulation::gravity::{
    Cloud, CloudRun, ExpansionWave, RATE_WINDOW, Snapshot, cloud_options, run_cloud,
};
use courant_simulation::particles::{MethodOptions, ParticleMethod};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// Method, its name in captions, and its figures: core, flow, densities.
const METHODS: [(ParticleMethod, &str, [&str; 3]); 2] = [
    (ParticleMethod::Gph3, "GPH case 3", ["figure_29", "figure_31", "figure_33"]),
    (ParticleMethod::Sph1, "SPH", ["figure_30", "figure_32", "figure_34"]),
];
/// When densities are shown, in collapse times; the flow is shown at the fourth.
const TIMES: [f64; 6] = [0.05, 0.1, 0.2, 0.3, 0.4, 0.47];
const FLOW: usize = 3;

/// Particles of the runs that show how results depend on them; the figures show the last.
fn counts(detail: Detail) -> &'static [usize] {
    match detail {
        Detail::Quick => &[400],
        Detail::Standard => &[600, 2400],
        Detail::Full => &[2400, 10_000, 50_000],
    }
}

fn cloud() -> Cloud {
    Cloud::named("sis-collapse").expect("it is in the list")
}

fn run(cloud: &Cloud, method: ParticleMethod, count: usize) -> CloudRun {
    let (collapse, start) = (cloud.collapse_time(), cloud.wave_start());
    let (collapse, start) = collapse.zip(start).expect("it is isothermal and has a sink");
    let times = TIMES.map(|time| time * collapse - start);
    let options = cloud_options(cloud, MethodOptions::new(method));
    run_cloud(cloud, count, &options, &times, &mut |_| ControlFlow::Continue(()))
        .expect("the report's options are in range")
}

/// The section.
pub fn sections(detail: Detail) -> Vec<Section> {
    let scene = cloud();
    let collapse = scene.collapse_time().expect("it is isothermal");
    // The paper's figures go on to one collapse time, long after the wave has reached the edge.
    let long = Cloud { end_time: collapse - scene.wave_start().expect("it has a sink"), ..scene };
    let runs: Vec<(usize, usize, CloudRun)> = counts(detail)
        .iter()
        .flat_map(|&count| (0..METHODS.len()).map(move |method| (count, method)))
        .map(|(count, method)| (count, method, run(&long, METHODS[method].0, count)))
        .collect();
    let largest = counts(detail)[counts(detail).len() - 1];
    let mut items =
        vec![explained(&long, counts(detail)[0]), table_5(&long), results(&long, &runs)];
    let shown = runs.iter().filter(|(count, ..)| *count == largest);
    for kind in 0..3 {
        for (count, method, run) in shown.clone() {
            items.push(figure(&long, METHODS[*method], kind, *count, run));
        }
    }
    vec![text().section("title_collapse", items)]
}

/// What was chosen, and what shrinks at the start.
fn explained(scene: &Cloud, count: usize) -> Item {
    let edge = |outside: Option<f64>| {
        let short = Cloud { outside, end_time: 0.1, ..scene.clone() };
        let run = run(&short, ParticleMethod::Gph3, count);
        let end = run.snapshots.last().map(edge_velocity);
        significant(end.unwrap_or(f64::NAN), 2)
    };
    text().paragraph(
        "collapse_explained",
        words!["pressure" = edge(scene.outside), "vacuum" = edge(None), "particles" = count],
    )
}

/// Mean radial velocity of the outermost twentieth of the particles.
fn edge_velocity(snapshot: &Snapshot) -> f64 {
    let mut all = snapshot.radial();
    all.sort_by(|a, b| b[0].total_cmp(&a[0]));
    let some = &all[..all.len() / 20];
    some.iter().map(|one| one[1]).sum::<f64>() / some.len() as f64
}

/// Table 5 with what follows from its own definitions, in cgs units and in those of the runs.
fn table_5(scene: &Cloud) -> Item {
    // Newton's constant, the mass of the sun, a parsec, Boltzmann's constant, in cgs units.
    let (g, m, r, k) = (6.674e-8, 1.989e33, 3.0857e16, 1.380_649e-16);
    let m0 = ExpansionWave::solution().core_mass();
    let sound = (0.5_f64 * g * m / r).sqrt();
    let density = m / (4.0 * PI * r.powi(3));
    let hydrogen = 1.6735e-24;
    let weight = k * 57.3219 / (sound * sound) / hydrogen;
    let here = |value: f64| significant(value, 5);
    let edge = scene.edge_pressure().expect("it is isothermal");
    let rows = vec![
        cells!["mass of the cloud", "1.0 solar masses", "1.989e33 g", here(scene.mass)],
        cells!["its radius", "10⁻² pc", "3.0857e16 cm", here(scene.radius)],
        cells![
            "temperature",
            "57.3219 K",
            format!("with {weight:.2} hydrogen masses a molecule"),
            "–"
        ],
        cells!["sound speed √(GM/2R)", "4.63586e4 cm/s", format!("{sound:.5e} cm/s"), "1"],
        cells![
            "density at the edge",
            "5.38773e-18 g/cm³",
            format!("{density:.5e} g/cm³"),
            here(edge)
        ],
        cells![
            "pressure at the edge",
            "1.15789e-8 dyn/cm²",
            format!("{:.5e} dyn/cm²", density * sound * sound),
            here(edge)
        ],
        cells!["radius of the sink", "0.03 R", "–", here(scene.sink.expect("it has one"))],
        cells!["m0", "0.975", here(m0), here(m0)],
        cells![
            "collapse time GM/(m0 c³)",
            "1.36532e12 s",
            format!("{:.5e} s", g * m / (m0 * sound.powi(3))),
            here(scene.collapse_time().expect("it is isothermal"))
        ],
    ];
    text().table("table_5", &[], rows)
}

fn results(scene: &Cloud, runs: &[(usize, usize, CloudRun)]) -> Item {
    let rows = runs.iter().map(|(count, method, run)| {
        let measures = run.measures(scene);
        let of = |name: &str| or_dash(measures.get(name).copied(), 3);
        cells![
            METHODS[*method].0.name(),
            *count,
            of("accretion_rate"),
            of("core_mass_error"),
            of("wave_position_error"),
            of("motion_before_wave"),
            of("head_scatter"),
            significant(run.run.conservation.momentum, 2),
            of("angular_momentum"),
            run.run.steps,
            run.run.counters.interactions,
            run.run.counters.attractions,
        ]
    });
    let [from, to] = RATE_WINDOW;
    let m0 = significant(ExpansionWave::solution().core_mass(), 4);
    text().table("collapse_results", words!["m0" = m0, "from" = from, "to" = to], rows)
}

fn figure(
    scene: &Cloud,
    (_, title, names): (ParticleMethod, &str, [&str; 3]),
    kind: usize,
    count: usize,
    run: &CloudRun,
) -> Item {
    let name = names[kind];
    let since = |snapshot: &Snapshot| {
        let start = scene.wave_start().expect("it has a sink");
        (snapshot.time + start) / scene.collapse_time().expect("it is isothermal")
    };
    let file = |what: &str| format!("{name}_{what}.csv");
    let (figure, data) = match kind {
        0 => {
            let panels = core_panels(scene, run).expect("it has a sink");
            let figure = Figure::grid(2, 1).size(4.6, 5.6).title(title).panels(panels);
            (figure, vec![(file("core"), core_csv(run))])
        }
        1 => {
            let snapshot = &run.snapshots[FLOW.min(run.snapshots.len() - 1)];
            let panel = radial_flow_panel(scene, snapshot)
                .title(format!("{title}, t = {:.2} t collapse", since(snapshot)));
            let figure = Figure::single(panel).size(5.2, 3.6);
            (figure, vec![(file("flow"), cloud_csv(scene, snapshot))])
        }
        _ => {
            let times = &run.snapshots[..TIMES.len().min(run.snapshots.len())];
            let panels = times.iter().map(|snapshot| {
                density_panel(scene, snapshot)
                    .title(format!("t = {:.2} t collapse", since(snapshot)))
            });
            let figure = Figure::grid(3, 2).size(6.6, 7.6).title(title).panels(panels);
            let data = times.iter().enumerate();
            let data = data.map(|(k, s)| (file(&k.to_string()), cloud_csv(scene, s))).collect();
            (figure, data)
        }
    };
    let mut caption = words!["method" = title, "particles" = count].to_vec();
    if kind == 0 {
        caption.push(("rate", or_dash(run.accretion_rate(scene), 3)));
    }
    text().figure(name, &caption, figure, data)
}
