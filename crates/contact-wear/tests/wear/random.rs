//! Random runs of wear, audited jump by jump. `FRET_WEAR` says how many (24).

use contact_core::Error;
use contact_core::scene::{
    Body, Coating, Elastic, Friction, FrictionHistory, Grid, History, LoadPath, Loads,
    PrescribedMotions, Scene, Settings, Shape,
};
use contact_wear::{BodyWear, Cycling, Jumps, Wear, WornThrough};

use crate::audit::Audit;
use crate::bench::{STEEL, cylinder, to_and_fro};
use crate::laws::{Drawn, draw_laws};
use crate::splitmix::Draw;

/// What is drawn: a scene and its wear, whose volume per energy may be known for each body.
struct Case {
    scene: Scene,
    wear: Wear,
    per_energy: Option<[f64; 2]>,
}

#[test]
#[ignore = "slow"]
fn random_wear_is_sound() {
    let count = std::env::var("FRET_WEAR").map_or(24, |n| n.parse().unwrap());
    let from = std::env::var("FRET_WEAR_FROM").map_or(0, |n| n.parse().unwrap());
    let (mut jumps, mut off_grid) = (0, 0);
    for seed in from..from + count {
        let Case {
            scene,
            wear,
            per_energy,
        } = draw(seed);
        let name = format!("scene {seed}");
        match Audit::new(&name, &scene, &wear, per_energy).run(&wear) {
            Ok(done) => jumps += done.len(),
            // Far too many cycles wear the contact wider than the grid: that is said.
            Err(Error::WornOffGrid { .. } | Error::OffGrid { .. }) => off_grid += 1,
            Err(error) => panic!("{name}: {error}\n{scene:?}\n{wear:?}"),
        }
    }
    println!("{count} scenes, {jumps} jumps; {off_grid} wore wider than the grid");
    assert!(3 * off_grid < count, "{off_grid} of {count} off the grid");
}

fn draw(seed: u64) -> Case {
    let mut draw = Draw(seed);
    let (sliding, flat) = (draw.next() < 0.5, draw.next() < 0.4);
    let scene = scene(&mut draw, sliding, flat);
    let layers_of = |body: &Body| body.coatings.len() + 1;
    let layers = [&scene.body1, &scene.body2].map(layers_of);
    // From a fiftieth of what wears as deep as the bodies approach each other to twice that.
    let natural = natural_cycles(&scene);
    let cycles = natural * draw.between(0.02, 2.0);
    let plain = scene.friction == Friction::coulomb(scene.friction.mu);
    let Drawn { bodies, per_energy } = draw_laws(&mut draw, layers, scene.friction.mu, plain);
    let cycling = if sliding {
        Cycling::Sliding
    } else {
        Cycling::March
    };
    let mut wear = wear(&scene, bodies, cycles, cycling);
    wear.jumps = match (6.0 * draw.next()) as usize {
        0 => Jumps::Number(1),
        1 | 2 => {
            // One jump a thousand times as long as those that a tolerance of 0.01 chooses.
            wear.cycles *= 30.0;
            Jumps::Number(1)
        }
        3 => Jumps::Number(3),
        4 => Jumps::Explicit(4),
        _ => Jumps::Tolerance(0.1),
    };
    if draw.next() < 0.5 {
        wear.debris_kept = [1.0, 0.85, draw.next()][(3.0 * draw.next()) as usize];
    }
    if draw.next() < 0.7 {
        wear.worn_through = WornThrough::GoOn;
    }
    Case {
        scene,
        wear,
        per_energy,
    }
}

fn wear(scene: &Scene, bodies: [BodyWear; 2], cycles: f64, cycling: Cycling) -> Wear {
    // All but the last two branches, or the last turn of an ellipse, lead in.
    let first = if scene.path.branches.len() > 6 {
        2
    } else {
        scene.path.branches.len() - 2
    };
    Wear {
        first_branch: Some(first),
        cycling,
        ..Wear::new(bodies, cycles)
    }
}

/// Cycles of k = 1e-14 /Pa that wear about as deep as the bodies come together.
fn natural_cycles(scene: &Scene) -> f64 {
    let p0 = scene.hertz().unwrap().p0;
    let slid = 4.0 * scene.friction.reference_mu() * scene.reference_approach();
    scene.reference_approach() / (1e-14 * p0 * slid)
}

fn scene(draw: &mut Draw, sliding: bool, flat: bool) -> Scene {
    let R = draw.between(2e-3, 50e-3);
    let mu = draw.between(0.05, 1.5);
    let W = draw.between(0.2, 5.0) * if flat { 1e4 } else { 20.0 };
    let mut material = || match (3.0 * draw.next()) as usize {
        0 | 1 => STEEL,
        _ => Elastic {
            E: draw.between(5e9, 600e9),
            nu: 0.45 * draw.next(),
        },
    };
    let (one, two) = (material(), material());
    let shape = match (4.0 * draw.next()) as usize {
        _ if flat => cylinder(R),
        0 => Shape::Ellipsoid {
            R_x: R,
            R_y: R * draw.between(0.3, 3.0),
            angle: 0.0,
        },
        _ => Shape::Sphere { R },
    };
    let (mut body1, mut body2) = (
        Body::homogeneous(one, shape),
        Body::homogeneous(two, Shape::Flat),
    );
    let mut scene = Scene {
        title: String::new(),
        body1: body1.clone(),
        body2: body2.clone(),
        friction: Friction::coulomb(mu),
        grid: Grid::centred(1.0, 4).unwrap(),
        path: LoadPath::start().normal(W, 1),
        settings: Settings::default(),
    };
    let hertz = if flat {
        scene.grid = Grid::strip(1.0, 4, 1.0).unwrap();
        scene.hertz().unwrap()
    } else {
        scene.hertz().unwrap()
    };
    for body in [&mut body1, &mut body2] {
        if draw.next() < 0.4 {
            let layers = 1 + (2.0 * draw.next()) as usize;
            let mut coating = || Coating {
                material: Elastic {
                    E: body.substrate.E * draw.between(0.3, 3.0),
                    nu: 0.1 + 0.3 * draw.next(),
                },
                thickness: hertz.a * draw.between(1e-3, 1.0),
            };
            body.coatings = (0..layers).map(|_| coating()).collect();
        }
    }
    (scene.body1, scene.body2) = (body1, body2);
    let wide = if sliding { 8.0 } else { 4.5 } * hertz.a;
    scene.grid = if flat {
        Grid::strip(wide, [48, 72, 96][(3.0 * draw.next()) as usize], 1.0).unwrap()
    } else {
        let wide = wide
            * if scene.body1.shape == (Shape::Sphere { R }) {
                1.0
            } else {
                1.6
            };
        Grid::centred(wide, [16, 20, 24][(3.0 * draw.next()) as usize]).unwrap()
    };
    scene.path = if sliding {
        slid(draw, W, hertz.a)
    } else {
        path(draw, &mut scene, W, hertz.a, flat)
    };
    scene
}

/// To and fro under given shifts, under a load that may change within the cycle; a spring may drive
/// it.
fn slid(draw: &mut Draw, W: f64, a: f64) -> LoadPath {
    let stroke = a * draw.between(1e-3, 0.8);
    let places = 1 + (4.0 * draw.next()) as usize;
    let mut path = to_and_fro(W, stroke, places);
    if draw.next() < 0.3 {
        path.branches[2].to.W = W * (0.5 + 0.5 * draw.next());
    }
    path
}

/// One of the motions to and fro, below gross slip or beyond it.
fn path(draw: &mut Draw, scene: &mut Scene, W: f64, a: f64, flat: bool) -> LoadPath {
    let mu = scene.friction.mu;
    let (most, far) = (mu * W, mu * scene.reference_approach());
    let part = 0.1 + 0.85 * draw.next();
    if draw.next() < 0.2 {
        let table = vec![(0.0, 1.0), (far, 0.6)];
        scene.friction.history = Some(FrictionHistory {
            of: History::Slip,
            table,
        });
    }
    let start = LoadPath::start().normal(W, 1);
    let fro = |change: &dyn Fn(&mut Loads, f64), increments: usize| {
        [1.0, -1.0, 1.0]
            .into_iter()
            .fold(start.clone(), |path, sign| {
                path.change_to(|to| change(to, sign), increments)
            })
    };
    let strongest = if scene.friction.history.is_some() {
        0.55
    } else {
        1.0
    };
    let T = strongest * part * most;
    // Forces on a strip are those on its width.
    let width = if flat { scene.grid.dy } else { a };
    let given = |to: &mut Loads, delta_x: f64| {
        to.given = PrescribedMotions {
            delta_x: Some(delta_x),
            ..to.given
        };
    };
    match (9.0 * draw.next()) as usize {
        0 | 1 => fro(&|to, sign| to.T_x = sign * T, 3),
        2 if !flat => fro(
            &|to, sign| (to.T_x, to.T_y) = (0.6 * sign * T, 0.7 * sign * T),
            2,
        ),
        3 if !flat => start.ellipse((0.7 * T, 0.5 * T), 1, 6),
        4 if !flat => fro(&|to, sign| to.M_z = 0.5 * sign * T * a, 3),
        5 => fro(
            &|to, sign| (to.T_x, to.W) = (0.5 * sign * T, W * (0.8 + 0.2 * sign)),
            3,
        ),
        6 => fro(
            &|to, sign| (to.T_x, to.sigma_B) = (0.5 * sign * T, 0.1 * sign * most / (a * width)),
            3,
        ),
        _ => {
            let far = far * draw.between(0.3, 5.0);
            fro(&|to, sign| given(to, sign * far), 4)
        }
    }
}
