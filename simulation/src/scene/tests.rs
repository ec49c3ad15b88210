//! Scenes against independent sums and the equations of motion, and what is said of bad files.

use super::{AnyScene, ExactSolution, Flow, Layer, MassLattice, Scene, conserved_density};
use crate::boundary::Boundary;
use crate::riemann::{IdealGas, State};

fn named(name: &str) -> Scene {
    Scene::named(name).expect("it is in the list")
}

fn ideal(scene: &Scene) -> IdealGas {
    scene.material.ideal().expect("an ideal gas")
}

const TUBE: &str = "gamma = 1.4\ndomain = [0, 1]\ndiaphragm = 0.5\nend_time = 0.2\n\
                    [left]\ndensity = 1.0\nvelocity = 0\npressure = 1.0\n\
                    [right]\ndensity = 0.125\nvelocity = 0.0\npressure = 0.1\n";

#[test]
fn every_named_scene_is_in_its_file_under_its_name() {
    for scene in Scene::all() {
        // The customary end is one at which the comparison is fair.
        let exact = scene.exact_solution() != ExactSolution::None;
        assert!(!exact || scene.holds_until() >= scene.end_time, "{}", scene.name);
    }
    assert_eq!(Scene::named("toro99"), None);
    for scene in AnyScene::all() {
        assert_eq!(AnyScene::named(scene.name()).as_ref(), Some(scene));
        assert!(!scene.description().is_empty() && !scene.source().is_empty(), "{}", scene.name());
    }
}

#[test]
fn the_short_form_is_two_layers() {
    let short = Scene::parse(TUBE, "sod").expect("a tube");
    let sod = named("sod");
    assert_eq!((&short.flow, short.boundary, short.window), (&sod.flow, sod.boundary, sod.window));
    let example = include_str!("../../../examples/tube.toml");
    let example = Scene::parse(example, "mine").expect("a tube");
    assert_eq!(
        (example.flow, example.method.as_deref()),
        (sod.flow.clone(), Some("lagrangian-roe"))
    );
    let table = |to, [density, velocity, pressure]: [f64; 3]| {
        format!(
            "[[layer]]\nto = {to}\ndensity = {density}\nvelocity = {velocity}\npressure = {pressure}\n"
        )
    };
    let head = "gamma = 1.4\ndomain = [0, 1]\nend_time = 0.2\n";
    let long = format!("{head}{}{}", table(0.5, [1.0, 0.0, 1.0]), table(1.0, [0.125, 0.0, 0.1]));
    assert_eq!(Scene::parse(&long, "sod").expect("a tube").flow, sod.flow);
}

#[test]
fn the_page_on_scenes_shows_files_that_are_read() {
    let page = include_str!("../../../docs/scenes.md");
    let blocks: Vec<&str> =
        page.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert!(blocks.len() >= 6);
    for block in blocks {
        AnyScene::parse(block, "mine").unwrap_or_else(|error| panic!("{error}: {block}"));
    }
}

/// One changed line of the tube or of a file in the tree, and what is said of it.
#[test]
fn complaints_name_the_line_and_what_is_accepted_for_all_kinds_of_scenes() {
    let file = |name: &str| {
        if name == "tube" {
            return TUBE.to_string();
        }
        let path = format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(path).expect("it is in the tree")
    };
    // Scene | what stands there | what is put there | a part of the line that is named, if another | words of the complaint.
    let table = r#"
            tube | density = 0.125 | density = -0.125 |  | right.density = -0.125: a finite number, not negative
            tube | gamma = 1.4 | gamma = 0.9 |  | above 1
            tube | gamma = 1.4 | gamma = 1.4⏎sound_speed = 1 | sound_speed = 1 | not both
            tube | diaphragm = 0.5 | diaphragm = 2 |  | between 0 and 1
            tube | diaphragm = 0.5⏎ |  | gamma = 1.4 | diaphragm
            tube | domain = [0, 1] | domain = [1, 0] |  | ascending
            tube | end_time = 0.2 | end_time = "soon" |  | accepted
            tube | end_time = 0.2 | end_time = 0.0 |  | above 0
            tube | end_time = 0.2 | particles = 3⏎end_time = 0.2 |  | at least 10
            tube | end_time = 0.2 | boundary = "wal"⏎end_time = 0.2 |  | mirror
            tube | end_time = 0.2 | boundary = ["periodic", "open"]⏎end_time = 0.2 |  | both ends
            tube | pressure = 0.1 | presure = 0.1 |  | presure
            tube | pressure = 0.1 | pressure = { mean = 1 } |  | a sine
            tube | pressure = 0.1⏎ |  | density = 0.125 | right.pressure is missing
            tube | density = 0.125 | density = 0 |  | vacuum
            tube | [right] | [right |  | expected `]`
            advection-step | velocity = 1.0 | velocity = 0 |  | velocity = 0: a finite number other
            advection-step | to = 1.0 | to = 0.9 |  | the last layer ends with the domain, at 1
            advection-step | to = 1.0 | to = 0.4 |  | to = 0.4: a number above 0.5
            advection-step | value = 1.0 | density = 1.0 | to = 0.5 | value is missing
            advection-step | velocity = 1.0 | gamma = 1.4 |  | gamma: an advection scene has no such key
            advection-waves | waves = 8 | waves = 0 |  | waves = 0: a whole number
            advection-step | "advection" | "euler" |  | expected `gas` or `advection`
            shear | dimension = 2 | dimension = 3 |  | dimension = 3: a gas in a box has 2
            shear | "square" | "cubic" |  | in 2 dimensions accepted: square, hexagonal
            shear | speed = 1.0 | speed = 0.0 |  | speed = 0: a finite number above 0
            shear | sound_speed = 1.0 | gamma = 1.0 |  | above 1
            shear | sound_speed = 1.0 | gamma = 1.4 | [shear] | shear.pressure is missing
            shear | [0.0, 1.0], [0.0 | [1.0, 0.0], [0.0 |  | an ascending interval
            shear | lattice = | boundary = "open"⏎lattice = | boundary = "open" | periodic and mirror
            shear | lattice = | boundary = "mirror"⏎lattice = | boundary = "mirror" | a shear is periodic
            shear | [shear] | [sheer] |  | unknown field `sheer`
            shear | [shear] | [sink]⏎radius = 1⏎[shear] | [sink] | sink: a gas in a box has no such key
            gresho | gamma = 1.6666666666666667 | sound_speed = 1 |  | a vortex needs gamma
            gresho | [-0.5, 0.5], [ | [-0.3, 0.5], [ |  | the vortex reaches 0.4
            sis-collapse | mass = 2.0 | mass = -2.0 |  | mass = -2: a finite number above 0
            sis-collapse | mass = 2.0 | mass = 3.0 | exact | here sphere.mass = 2
            sis-collapse | dimension = 3 | dimension = 2 |  | dimension = 2: a sphere has 3
            sis-collapse | exponent = 2.0 | exponent = 3.0 | [sphere] | sphere: either exponent
            sis-collapse | exponent = 2.0 | exponent = 2.0⏎extent = 4.0 | [sphere] | either exponent
            sis-collapse | radius = 0.03 | radius = 3 | [sink] | below sphere.radius
            sis-collapse | [sink] | [sunk] |  | unknown field `sunk`
            bonnor-ebert | pressure = 1.03 | pressure = 2.03 | exact | here outside.pressure = 1.032
            evrard | energy = 0.05⏎ |  | [sphere] | sphere.energy is missing
            evrard | particles = 4000 | particles = 50 |  | at least 100
            cold-sphere | energy = 1e-5 | energy = 0.1 | exact | of a cold sphere"#;
    for row in table.lines().skip(1) {
        let cells: Vec<String> =
            row.split(" | ").map(|cell| cell.trim().replace('⏎', "\n")).collect();
        let [scene, from, to, at, words] = cells.as_slice() else { panic!("{row}") };
        let at = if at.is_empty() { to } else { at };
        let text = file(scene);
        assert!(text.contains(from.as_str()), "{scene}: {from}");
        let changed = text.replacen(from.as_str(), to, 1);
        let error = AnyScene::parse(&changed, "mine").expect_err("the file is bad");
        let line = changed.lines().nth(error.line - 1).unwrap_or_default();
        let said = line.contains(at.lines().next().unwrap_or_default())
            && error.problem.contains(words.as_str());
        assert!(said, "{scene}, {to}: {line}: {error}");
    }
}

#[test]
fn the_lattice_holds_the_totals_of_the_scene() {
    // Midpoint sums over a fine grid that puts the diaphragms of the tubes on a face.
    let fine = 100_000;
    for name in ["simple-wave", "ferrari1", "ferrari2", "ferrari4", "sod", "shu-osher"] {
        let scene = named(name);
        let gas = ideal(&scene);
        let [from, to] = scene.domain;
        let lattice = MassLattice::new(&scene, gas, 100);
        let [left, right] = lattice.waiting;
        let inside = left..lattice.x.len() - right;
        assert_eq!(inside.len(), 100);
        let (mut found, mut wanted) = ([0.0; 4], [0.0; 4]);
        for state in &lattice.states[inside] {
            let volume = lattice.spacing / state.density();
            let densities = conserved_density(gas, state);
            for (sum, part) in found.iter_mut().zip([1.0, densities[0], densities[1], densities[2]])
            {
                *sum += part * volume;
            }
        }
        let width = (to - from) / f64::from(fine);
        for i in 0..fine {
            let densities =
                conserved_density(gas, &scene.initial(from + (f64::from(i) + 0.5) * width));
            for (sum, part) in
                wanted.iter_mut().zip([1.0, densities[0], densities[1], densities[2]])
            {
                *sum += part * width;
            }
        }
        for k in 0..4 {
            // The midpoint rule of a periodic function or of constants is exact but for round-off
            // of 1e5 additions; that of a sine with ends is off by the square of the width.
            let bound = if name == "shu-osher" { 1e-8 } else { 1e-11 };
            let scale = wanted[k].abs().max(1.0);
            assert!((found[k] - wanted[k]).abs() < bound * scale, "{name} {k}");
        }
    }
}

#[test]
fn positions_halve_the_mass_of_each_particle() {
    let tube = named("ferrari1");
    let lattice = MassLattice::new(&tube, ideal(&tube), 100);
    // 0.15 of length 1 of gas of density 1 will enter; Δξ = 0.003875.
    assert_eq!(lattice.waiting, [39, 0]);
    assert!(lattice.x[38] < 0.0 && lattice.x[39] > 0.0);
    // Particle 77 straddles the diaphragm: the mass left of it is 77.42 Δξ.
    let mixed = &lattice.states[39 + 77];
    assert!(mixed.density() < 1.0 && mixed.density() > 0.125);
    assert_eq!(lattice.states[39 + 76].density(), 1.0);
    assert_eq!(lattice.states[39 + 78].density(), 0.125);
    let part = 0.3 / 0.003875 - 77.0;
    assert!((mixed.velocity() - 0.75 * part).abs() < 1e-12);
}

#[test]
fn whole_particles_fill_layers_and_the_gas_beyond_transmissive_ends() {
    let mut tube = named("sod");
    let (placed, beyond) = tube.place(100);
    // 89 of mass 0.5/89 left of the diaphragm, 11 right of it.
    assert_eq!(placed.len(), 100 + beyond[0] + beyond[1]);
    assert_eq!(placed.iter().filter(|(x, _)| (0.0..0.5).contains(x)).count(), 89);
    let mass: f64 = placed.iter().filter(|(x, _)| (0.0..1.0).contains(x)).map(|p| p.1).sum();
    assert!((mass - tube.mass()).abs() < 1e-14);
    // The fastest signals are sound behind the shock, v* + c*, to the right and, counted to either side, the
    // shock to the left; nothing beyond their ways matters.
    let ways = [0.927_452_62 + (1.4 * 0.303_130_18 / 0.265_573_71_f64).sqrt(), 1.752_155_73];
    let last = placed.last().expect("many").0;
    assert!((placed[0].0 + 0.2 * ways[0]).abs() < 0.006, "{}", placed[0].0);
    assert!((last - 1.0 - 0.2 * ways[1]).abs() < 0.05, "{last}");
    tube.boundary = [Boundary::Mirror; 2];
    assert_eq!(tube.place(100).1, [0, 0]);
    // A vacuum has no particles.
    let gas = State::new(0.124, 0.5, 1.0).expect("physical");
    let vacuum = State::new(0.0, 1.0, 0.0).expect("physical");
    tube.flow = Flow::Layers(vec![Layer::uniform(0.5, &vacuum), Layer::uniform(1.0, &gas)]);
    assert_eq!(tube.ends_of_gas(), [Boundary::Open, Boundary::Mirror]);
    let (placed, beyond) = tube.place(50);
    assert_eq!((placed.len(), beyond), (50, [0, 0]));
    assert!(placed[0].0 > 0.5 && (tube.mass() - 0.062).abs() < 1e-15);
}

#[test]
fn the_exact_solution_holds_until_an_end_is_felt() {
    // Noh's streams end at ±1 and a rarefaction runs in with the gas: 0.65/(1 + c) until the window.
    let noh = named("noh");
    let sound = (5.0e-6_f64 / 3.0).sqrt();
    assert!((noh.holds_until() - 0.65 / (1.0 + sound)).abs() < 1e-12);
    // Transmissive ends are not felt.
    assert_eq!(named("sod").holds_until(), f64::INFINITY);
    // The shock of the tube between mirrors is back in the window later than at 0.285, when it is at the wall.
    let tube = named("sod-sph");
    assert!(tube.holds_until() > 0.25 && tube.holds_until() < 0.36, "{}", tube.holds_until());
    assert_eq!(named("shu-osher").exact_solution(), ExactSolution::None);
}

/// `U_t + F_x = 0` by differences of the sampled solution: no formula of the wave enters.
#[test]
fn the_simple_wave_solves_the_equations() {
    let wave = named("simple-wave");
    let gas = ideal(&wave);
    let exact = |x: f64, t: f64| wave.exact(x, t).expect("it has not broken");
    let conserved = |x: f64, t: f64| conserved_density(gas, &exact(x, t));
    let flux = |x: f64, t: f64| {
        let state = exact(x, t);
        let [rho, momentum, energy] = conserved_density(gas, &state);
        let (v, p) = (state.velocity(), state.pressure());
        [rho * v, momentum * v + p, v * (energy + p)]
    };
    let d = 1e-4;
    for i in 0..20 {
        let (x, t) = (f64::from(i) * 0.05 + 0.01, 0.3);
        for k in 0..3 {
            let time = (conserved(x, t + d)[k] - conserved(x, t - d)[k]) / (2.0 * d);
            let space = (flux(x + d, t)[k] - flux(x - d, t)[k]) / (2.0 * d);
            // Second-order differences: d² times a third derivative of order (2π)³·0.1·steepening.
            assert!((time + space).abs() < 2e-5, "{x} {k}: {time} {space}");
        }
    }
}

/// The pulse of d'Alembert: the wave equation by finite differences, and the mirrors.
#[test]
fn the_exact_sound_wave_solves_the_wave_equation_between_mirrors() {
    let scene = named("sound-wave");
    let at = |x: f64, t: f64| scene.exact(x, t).expect("always");
    let d = 1e-4;
    for time in [0.2, 0.5, 0.8] {
        for x in [-0.45, -0.21, 0.0, 0.18, 0.3, 0.49] {
            let rate = (at(x, time + d).velocity() - at(x, time - d).velocity()) / (2.0 * d);
            let slope = (at(x + d, time).density() - at(x - d, time).density()) / (2.0 * d);
            assert!((rate + slope).abs() < 1e-5, "momentum at {x} {time}");
            let rate = (at(x, time + d).density() - at(x, time - d).density()) / (2.0 * d);
            let slope = (at(x + d, time).velocity() - at(x - d, time).velocity()) / (2.0 * d);
            assert!((rate + slope).abs() < 1e-5, "mass at {x} {time}");
        }
        assert!(at(0.5, time).velocity().abs() < 1e-15 && at(-0.5, time).velocity().abs() < 1e-15);
    }
}

#[test]
fn isothermal_tubes_have_their_star_state() {
    let tube = named("isothermal-tube");
    let star = tube.exact(0.05, 0.17).expect("a Riemann problem");
    assert!((star.pressure() - 0.49662).abs() < 5e-6);
}
