//! All tubes by all methods: L1 errors and the other measures. `cargo run --example survey [N]`
use courant_simulation::comparison::Comparison;
use courant_simulation::method::Method;
use courant_simulation::scene::{STANDARD_TUBES, Scene, ShockTube};
fn main() {
    let n = std::env::args().nth(1).map_or(100, |a| a.parse().expect("a number"));
    let dump = std::env::args().nth(2);
    for name in STANDARD_TUBES {
        let tube = ShockTube::standard(name).expect("listed");
        for method in Method::NAMES {
            let start = std::time::Instant::now();
            let run = Method::named(method).expect("listed").run(&tube, n).expect("valid");
            let took = start.elapsed().as_secs_f64();
            let c = Comparison::new(&tube, &run);
            println!(
                "{name} {method:18} steps {:5} {:.4}s L1 r {:.3e} v {:.3e} p {:.3e} e {:.3e} | cons p {:.1e} E {:.1e} V {:.0e} | in {} order {} | over r {:.3} v {:.3} p {:.3} e {:.3} | TV v {:.3} p {:.3} e {:.3} | width {:.4} glitch {:.4} | {}",
                run.steps,
                took,
                c.l1.density,
                c.l1.velocity,
                c.l1.pressure,
                c.l1.energy,
                run.conservation.momentum,
                run.conservation.energy,
                run.conservation.volume.unwrap_or(0.0),
                c.inside,
                c.order_preserved,
                c.overshoot.density,
                c.overshoot.velocity,
                c.overshoot.pressure,
                c.overshoot.energy,
                c.excess_variation.velocity,
                c.excess_variation.pressure,
                c.excess_variation.energy,
                c.contact_width.unwrap_or(f64::NAN),
                c.glitch.unwrap_or(f64::NAN),
                run.failure.map_or(String::new(), |f| f.to_string()),
            );
            for w in &c.waves {
                print!("   {:?} {:.4} {:+.4}", w.kind, w.exact, w.error().unwrap_or(f64::NAN));
            }
            println!();
            if let Some(dir) = &dump {
                let p = &run.profile;
                let mut t = String::new();
                for i in 0..p.len() {
                    let s = tube.exact(p.x[i], run.time);
                    t += &format!(
                        "{} {} {} {} {} {} {} {}\n",
                        p.x[i],
                        p.density[i],
                        p.velocity[i],
                        p.pressure[i],
                        p.energy[i],
                        s.density(),
                        s.velocity(),
                        s.pressure()
                    );
                }
                std::fs::write(format!("{dir}/{name}-{method}.txt"), t).expect("writable");
            }
        }
    }
}
