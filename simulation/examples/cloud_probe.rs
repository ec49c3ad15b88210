use courant_simulation::gravity::*;
use courant_simulation::particles::*;
use std::ops::ControlFlow;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let mut cloud = Cloud::named(&args[1]).unwrap();
    let method = ParticleMethod::named(&args[2]).unwrap();
    let count: usize = args[3].parse().unwrap();
    let mut options = cloud_options(MethodOptions::new(method));
    for arg in &args[4..] {
        let (key, value) = arg.split_once('=').unwrap();
        match key {
            "levels" => {
                options.sharing = if value == "global" {
                    StepSharing::Global
                } else {
                    StepSharing::Block { levels: value.parse().unwrap() }
                }
            }
            "end" => cloud.end_time = value.parse().unwrap(),
            "courant" => options.courant = value.parse().unwrap(),
            "eta" => options.eta = value.parse().unwrap(),
            "outside" => cloud.outside = value.parse().ok(),
            "rs" => {
                RELAXATION_STEPS.store(value.parse().unwrap(), std::sync::atomic::Ordering::Relaxed)
            }
            "relax" => cloud.equilibrium = value == "yes",
            "integrator" => {
                options.integrator = Integrator::named(value.to_string().leak()).unwrap()
            }
            _ => panic!("{key}"),
        }
    }
    let start = std::time::Instant::now();
    let mut last = 0.0;
    let end = cloud.end_time;
    let times: Vec<f64> = (1..10).map(|k| f64::from(k) * 0.1 * end).collect();
    let run = run_cloud(&cloud, count, &options, &times, &mut |t| {
        if t > last {
            eprintln!("t {t:.4} wall {:.1}", start.elapsed().as_secs_f64());
            last += end / 20.0;
        }
        ControlFlow::Continue(())
    })
    .unwrap();
    println!(
        "steps {} time {} failure {:?} pairs {:.3e} attractions {:.3e} wall {:.1}",
        run.steps,
        run.time,
        run.failure.map(|f| f.to_string()),
        run.counters.interactions as f64,
        run.attractions as f64,
        start.elapsed().as_secs_f64()
    );
    println!("momentum {:.2e} angular {:.2e}", run.momentum, run.angular_momentum);
    for e in run.energies.iter().step_by(5).chain(run.energies.last()) {
        println!(
            "E t {:.3} K {:.4} U {:?} W {:.4} total {:?}",
            e.time,
            e.kinetic,
            e.thermal,
            e.potential,
            e.total()
        );
    }
    if let Some(rs) = cloud.sink {
        let wave = ExpansionWave::solution();
        for s in run.core.iter().step_by((run.core.len() / 20).max(1)) {
            println!(
                "core t {:.4} M {:.5} exact {:.5}",
                s[0],
                s[1],
                wave.state(rs, s[0] + rs).mass
            );
        }
        for s in &run.snapshots {
            println!(
                "snapshot {:.3} n {} sink at {:?}",
                s.time,
                s.position.len(),
                s.sink.map(|s| s.position)
            );
            let mut all: Vec<(f64, f64, f64, f64)> = (0..s.position.len())
                .map(|i| {
                    let x = s.position[i];
                    let v = s.velocity[i];
                    let r = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
                    let u = (x[0] * v[0] + x[1] * v[1] + x[2] * v[2]) / r;
                    (r, u, s.density[i], v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - u * u)
                })
                .collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            for chunk in all.chunks(all.len().div_ceil(16)) {
                let n = chunk.len() as f64;
                let r = chunk.iter().map(|c| c.0).sum::<f64>() / n;
                let u = chunk.iter().map(|c| c.1).sum::<f64>() / n;
                let su = (chunk.iter().map(|c| (c.1 - u).powi(2)).sum::<f64>() / n).sqrt();
                let vt = (chunk.iter().map(|c| c.3).sum::<f64>() / n).sqrt();
                let e = wave.state(r, s.time + rs);
                let d =
                    chunk.iter().map(|c| c.2 / wave.state(c.0, s.time + rs).density).sum::<f64>()
                        / n;
                let sd = (chunk
                    .iter()
                    .map(|c| (c.2 / wave.state(c.0, s.time + rs).density - d).powi(2))
                    .sum::<f64>()
                    / n)
                    .sqrt();
                println!(
                    "  r {r:.3} u {u:+.3} exact {:+.3} scatter {su:.3} across {vt:.3} density/exact {d:.3} ± {sd:.3}",
                    e.velocity
                );
            }
        }
    } else {
        for s in &run.snapshots {
            let mut r: Vec<f64> = s
                .position
                .iter()
                .map(|x| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt())
                .collect();
            r.sort_by(f64::total_cmp);
            let v = (s.velocity.iter().map(|v| v.iter().map(|v| v * v).sum::<f64>()).sum::<f64>()
                / r.len() as f64)
                .sqrt();
            println!(
                "t {:.3} r10 {:.4} r50 {:.4} r90 {:.4} max {:.4} v rms {v:.4} rho max {:.3}",
                s.time,
                r[r.len() / 10],
                r[r.len() / 2],
                r[r.len() * 9 / 10],
                r[r.len() - 1],
                s.density.iter().fold(0.0_f64, |a, &b| a.max(b))
            );
        }
    }
}
