use courant_analysis::kernel::Kernel;
use courant_simulation::boundary::Boundary;
use courant_simulation::gravity::*;
use courant_simulation::particles::*;
use courant_simulation::riemann::isothermal::*;
fn probe<F: PairForce>(
    name: &str,
    force: F,
    n: usize,
    eta: f64,
    relax_steps: usize,
    kernel: Kernel,
) {
    let places = ball(Distribution::PowerLaw(2.0), n);
    let r = |x: &[f64; 3]| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
    let particles = Particles {
        velocity: vec![[0.0; 3]; n],
        mass: vec![2.0 / n as f64; n],
        thermal: vec![(); n],
        smoothing: places
            .iter()
            .map(|x| eta * r(x) * 1.6 / (n as f64 * r(x) + 0.5).cbrt())
            .collect(),
        position: places,
    };
    let mut s = ParticleSystem::new(
        IsothermalGas { sound_speed: 1.0 },
        particles,
        Domain::new([-1.0; 3], [1.0; 3], Boundary::Open),
        SmoothingKernel::new(kernel),
        Smoothing::adaptive(eta),
        &force,
    );
    relax(&mut s, &force, relax_steps).unwrap();
    let mut rates = Rates::default();
    s.rates(&force, &mut rates).unwrap();
    let mut g = SelfGravity::new(1.0, ());
    g.update(&s.particles, |_| true);
    let mut all: Vec<_> = (0..n)
        .map(|i| {
            let x = s.particles.position[i];
            let q = r(&x);
            let dot = |a: &[f64; 3]| (a[0] * x[0] + a[1] * x[1] + a[2] * x[2]) / q * q / 2.0;
            (
                q,
                dot(&rates.acceleration[i]),
                dot(&g.acceleration(i)),
                s.density()[i] * q * q * 2.0 * std::f64::consts::PI,
                s.particles.smoothing[i] / q,
            )
        })
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    println!("{name} n {n} eta {eta} relax {relax_steps}");
    for (a, b) in [
        (0.03, 0.06),
        (0.06, 0.1),
        (0.1, 0.15),
        (0.15, 0.2),
        (0.2, 0.3),
        (0.3, 0.4),
        (0.4, 0.5),
        (0.5, 0.6),
        (0.6, 0.7),
        (0.7, 0.8),
        (0.8, 0.9),
        (0.9, 1.0),
    ] {
        let c: Vec<_> = all.iter().filter(|c| c.0 >= a && c.0 < b).collect();
        let m = |f: &dyn Fn(&(f64, f64, f64, f64, f64)) -> f64| {
            c.iter().map(|c| f(c)).sum::<f64>() / c.len() as f64
        };
        let p = m(&|c| c.1);
        let sp = m(&|c| (c.1 - p).powi(2)).sqrt();
        println!(
            "  r {:.3} press {:.3} ± {:.3} grav {:.3} dens {:.3} ± {:.3} h/r {:.3}",
            m(&|c| c.0),
            p,
            sp,
            m(&|c| c.2),
            m(&|c| c.3),
            m(&|c| (c.3 - m(&|c| c.3)).powi(2)).sqrt(),
            m(&|c| c.4)
        );
    }
}
fn main() {
    let pe = 0.15915494309189535;
    let solver = Isothermal { sound_speed: 1.0, expansion: Expansion::AsShock };
    let v = Viscosity::STANDARD;
    for n in [3000, 20000] {
        probe(
            "gph3",
            Confined { force: Godunov { weight: OwnKernels, solver }, pressure: pe },
            n,
            1.145,
            60,
            Kernel::CubicSpline,
        );
        probe(
            "sph1",
            Confined { force: Smoothed { form: PressureForm::Sum, viscosity: v }, pressure: pe },
            n,
            1.145,
            60,
            Kernel::CubicSpline,
        );
    }
    probe(
        "gph1",
        Confined { force: Godunov { weight: SumOfSquares, solver }, pressure: pe },
        3000,
        1.145,
        60,
        Kernel::CubicSpline,
    );
    probe(
        "gph3",
        Confined { force: Godunov { weight: OwnKernels, solver }, pressure: pe },
        3000,
        1.0,
        60,
        Kernel::CubicSpline,
    );
}
