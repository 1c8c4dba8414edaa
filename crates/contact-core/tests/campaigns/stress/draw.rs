//! Random scenes over the whole space that a scene can describe.

use contact_core::kernels::Stack;
use contact_core::scene::{
    Body, Branch, Coating, Elastic, Friction, Grid, LoadPath, Loads, Rough, Scene, Settings, Shape,
    Spacing,
};
use contact_reference::hertz;
use fastrand::Rng;

/// What a scene is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Intent {
    /// To be solved.
    Solve,
    /// To be refused: a tangential force past mu W.
    PastFriction,
    /// To be refused: a grid smaller than the contact.
    OffGrid,
    /// Either: a contact about as large as the grid.
    Edge,
}

pub(crate) struct Drawn {
    pub(crate) scene: Scene,
    pub(crate) intent: Intent,
}

/// Seeds from here on draw other shapes than a sphere, and branches of given shifts.
pub(crate) const SHAPED: u64 = 100_000;

/// Seeds from here on roll at the end of their paths.
pub(crate) const ROLLED: u64 = 200_000;

/// The scene of a seed.
pub(crate) fn draw(seed: u64) -> Drawn {
    let mut drawn = sphere(seed);
    if seed >= ROLLED {
        roll(&mut Rng::with_seed(!seed), &mut drawn.scene);
    } else if seed >= SHAPED {
        shape(&mut Rng::with_seed(!seed), &mut drawn);
    }
    drawn
}

/// Adds a branch in which the contact rolls one to three cells an increment, under the forces that
/// it has or with a given creepage; the grid has room for that.
fn roll(rng: &mut Rng, scene: &mut Scene) {
    let cells = rng.usize(1..4);
    scene.grid.nx += 2 * (cells + 2);
    let increments = rng.usize(1..8);
    let way = (cells * increments) as f64 * scene.grid.dx;
    let last = scene.path.branches.len() - 1;
    let before = &scene.path.branches[last];
    let (mut to, t_end) = (before.to, before.t_end + 1.0);
    to.rolled = if rng.bool() { way } else { -way };
    if rng.bool() {
        let creep = scene.friction.mu * scene.reference_approach() * power(rng, -2.0, 0.5);
        to.given.delta_x = Some(if rng.bool() { creep } else { -creep });
    }
    scene.path.branches.push(Branch {
        to,
        increments: Some(increments),
        spacing: Spacing::Uniform,
        t_end,
        path_error: None,
    });
}

/// Gives body 1 another shape, about as wide in contact as its sphere, and, of every other scene,
/// the last branch shifts in place of forces.
fn shape(rng: &mut Rng, drawn: &mut Drawn) {
    let scene = &mut drawn.scene;
    let R = 0.018;
    let extent = scene.grid.extent();
    let (narrow, approach) = (extent.0.min(extent.1), scene.reference_approach());
    let sphere = Shape::Sphere { R };
    let shortest = 3.0 * scene.grid.dx.max(scene.grid.dy);
    scene.body1.shape = match rng.u32(0..4) {
        0 => Shape::Ellipsoid {
            R_x: R * (0.2 + 0.8 * rng.f64()),
            R_y: R * (0.2 + 0.8 * rng.f64()),
            angle: std::f64::consts::TAU * rng.f64(),
        },
        1 => Shape::FlatPunch {
            radius: narrow * (0.1 + 0.15 * rng.f64()),
            edge: R * power(rng, -3.0, -1.0),
        },
        2 => Shape::Sum(vec![
            sphere,
            Shape::Waviness {
                amplitude: 0.1 * approach * rng.f64(),
                wavelength: narrow * (0.1 + 0.4 * rng.f64()),
                angle: std::f64::consts::TAU * rng.f64(),
                phase: std::f64::consts::TAU * rng.f64(),
            },
        ]),
        _ => Shape::Sum(vec![
            sphere,
            Shape::Rough(Rough {
                rms: 0.1 * approach * rng.f64(),
                hurst: 0.3 + 0.6 * rng.f64(),
                longest: shortest.max(0.5 * narrow),
                shortest,
                seed: rng.u32(..),
            }),
        ]),
    };
    if rng.bool() {
        let far = scene.friction.mu * approach * power(rng, -2.0, 1.0);
        let angle = std::f64::consts::TAU * rng.f64();
        if let Some(last) = scene.path.branches.last_mut() {
            last.to.given.delta_x = Some(far * angle.cos());
            last.to.given.delta_y = Some(far * angle.sin());
        }
    }
}

fn sphere(seed: u64) -> Drawn {
    let rng = &mut Rng::with_seed(seed);
    let intent = match rng.u32(0..100) {
        _ if seed >= SHAPED => Intent::Solve,
        0 => Intent::PastFriction,
        1 | 2 => Intent::OffGrid,
        3 | 4 => Intent::Edge,
        _ => Intent::Solve,
    };
    let R = 0.018;
    // Loads from 1e-9 to 1e9 of the nominal 1 kN.
    let W = 1e3 * power(rng, -9.0, 9.0);
    let mut body1 = Body::homogeneous(substrate(rng), Shape::Sphere { R });
    let mut body2 = Body::homogeneous(substrate(rng), Shape::Flat);
    if body1.substrate.is_rigid() && body2.substrate.is_rigid() {
        body2.substrate = Elastic { E: 2e11, nu: 0.3 };
    }
    // A contact as large as the sphere is refused.
    let a = hertz(R, body1.substrate, body2.substrate, W).a;
    let W = W * (0.3 * R / a).powi(3).min(1.0);
    let a_H = hertz(R, body1.substrate, body2.substrate, W).a;
    if rng.f64() < 0.2 {
        coat(rng, &mut body1, a_H);
    }
    if rng.f64() < 0.75 {
        coat(rng, &mut body2, a_H);
    }
    let mu = match rng.u32(0..10) {
        0 => 0.0,
        1..=6 => rng.f64(),
        _ => 1.0 + 2.0 * rng.f64(),
    };
    let grid = grid(rng, contact_radius(&body1, &body2, R, W), intent);
    let mut scene = Scene {
        title: format!("stress {seed}"),
        body1,
        body2,
        friction: Friction::coulomb(mu),
        grid,
        path: path(rng, mu, W),
        settings: Settings::default(),
    };
    if intent == Intent::PastFriction {
        let last = scene.path.branches.len() - 1;
        scene.path.branches[last].to.W = W;
        scene.path.branches[last].to.T_x = mu.max(0.01) * W * (1.0 + power(rng, -9.0, 0.0));
    }
    if rng.f64() < 0.2 {
        scene.settings.skip.mirror = false;
    }
    if rng.f64() < 0.1 {
        scene.settings.solver.tolerance = Some(1e-4);
    }
    Drawn { scene, intent }
}

/// 10^x, x between `low` and `high`.
fn power(rng: &mut Rng, low: f64, high: f64) -> f64 {
    10f64.powf(low + (high - low) * rng.f64())
}

fn nu(rng: &mut Rng) -> f64 {
    match rng.u32(0..10) {
        0 => 0.0,
        1 => 0.4999,
        2 => -0.5 * rng.f64(),
        _ => 0.4999 * rng.f64(),
    }
}

fn substrate(rng: &mut Rng) -> Elastic {
    match rng.u32(0..20) {
        0 => Elastic::RIGID,
        // Like bodies are common, and a case of their own.
        1..=6 => Elastic { E: 2e11, nu: 0.3 },
        _ => Elastic {
            E: 2e11 * power(rng, -1.5, 1.5),
            nu: nu(rng),
        },
    }
}

/// One to ten layers, each a thousandth to a thousand times as stiff as the substrate.
fn coat(rng: &mut Rng, body: &mut Body, a_H: f64) {
    if body.substrate.is_rigid() {
        return;
    }
    let layers = if rng.f64() < 0.7 { 1 } else { rng.usize(2..11) };
    body.coatings = (0..layers)
        .map(|_| Coating {
            material: Elastic {
                E: body.substrate.E * power(rng, -3.0, 3.0),
                nu: nu(rng),
            },
            thickness: a_H * power(rng, -3.0, 2.0) / layers as f64,
        })
        .collect();
}

/// About the contact radius: Hertz's with the stiffness that a wave of its size meets.
fn contact_radius(body1: &Body, body2: &Body, R: f64, W: f64) -> f64 {
    let stacks: Vec<_> = [body1, body2]
        .into_iter()
        .filter(|b| !b.substrate.is_rigid())
        .map(Stack::new)
        .collect();
    let mut a = hertz(R, body1.substrate, body2.substrate, W).a;
    for _ in 0..60 {
        // 2/E* = sum of k C_33(k).
        let compliance: f64 = stacks.iter().map(|s| s.response(1.5 / a).zz).sum();
        a = (a * (0.375 * W * R * compliance).cbrt()).sqrt();
    }
    a
}

/// 8 to 256 cells along x, a contact from three cells to most of the grid, square cells or up to
/// ten times as long as wide.
fn grid(rng: &mut Rng, a: f64, intent: Intent) -> Grid {
    let cells = |rng: &mut Rng, most: f64| power(rng, 8f64.log10(), most.log10()) as usize;
    let most = if rng.f64() < 0.2 { 257.0 } else { 97.0 };
    let nx = cells(rng, most);
    let across = |rng: &mut Rng, n: usize| {
        let widest = n as f64 / 1.6;
        let narrowest = 3.0_f64.min(widest);
        narrowest * (widest / narrowest).powf(rng.f64().sqrt())
    };
    let dx = 2.0 * a / across(rng, nx);
    let (ny, dy) = if rng.f64() < 0.25 {
        let ny = cells(rng, most);
        let dy = (2.0 * a / across(rng, ny)).clamp(0.1 * dx, 10.0 * dx);
        // The contact has to fit, whatever the shape of the cells.
        let needed = (1.6 * 2.0 * a / dy).ceil() as usize;
        (ny.max(needed), dy)
    } else {
        (nx, dx)
    };
    let (length, width) = (nx as f64 * dx, ny as f64 * dy);
    let shrink = match intent {
        // The corners of the grid lie within half of the contact.
        Intent::OffGrid => 0.35 * a / (0.5 * length.hypot(width)),
        Intent::Edge => 2.0 * a * (0.8 + 0.4 * rng.f64()) / length.min(width),
        Intent::Solve | Intent::PastFriction => 1.0,
    };
    Grid::from_spacing((nx, ny), (dx * shrink, dy * shrink)).expect("a grid")
}

/// Indentation, then one to four branches: shear, reversal, rotation, crawl, jump, unloading.
fn path(rng: &mut Rng, mu: f64, W: f64) -> LoadPath {
    let mut path = LoadPath::start();
    let mut t = 0.0;
    let mut to = |path: LoadPath, to: Loads, increments: usize, spacing| {
        t += 1.0;
        path.push_branch(Branch {
            to,
            increments: Some(increments),
            spacing,
            t_end: t,
            path_error: None,
        })
    };
    let spacing = if rng.bool() {
        Spacing::Uniform
    } else {
        Spacing::EqualRadius
    };
    let start = Loads {
        W,
        ..Loads::default()
    };
    path = to(path, start, rng.usize(1..9), spacing);
    let mut at = start;
    let mut angle = if rng.bool() {
        0.0
    } else {
        std::f64::consts::TAU * rng.f64()
    };
    for _ in 0..rng.usize(1..5) {
        let sheared = |W: f64, part: f64, angle: f64| Loads {
            W,
            T_x: part * mu * W * angle.cos(),
            T_y: if angle == 0.0 {
                0.0
            } else {
                part * mu * W * angle.sin()
            },
            ..Loads::default()
        };
        let part = 0.95 * rng.f64();
        let increments = rng.usize(1..7);
        match rng.u32(0..10) {
            // Up to the verge of sliding, and sliding.
            0 => at = sheared(at.W, 0.9999, angle),
            1 => at = sheared(at.W, 1.0, angle),
            2 => {
                // Reversal.
                at.T_x = -at.T_x;
                at.T_y = -at.T_y;
            }
            3 => {
                angle += rng.f64();
                at = sheared(at.W, part, angle);
            }
            4 => {
                // A crawl: a millionth of the load.
                let W = at.W * (1.0 - 1e-6 * rng.f64());
                at = Loads {
                    W,
                    T_x: at.T_x * (1.0 - 1e-6),
                    T_y: at.T_y * (1.0 - 1e-6),
                    ..at
                };
            }
            5 => {
                // Unloaded and loaded again.
                path = to(path, Loads::default(), increments, Spacing::Uniform);
                at = start;
            }
            6 => at = sheared(W * (0.05 + 0.95 * rng.f64()), part, angle),
            _ => at = sheared(at.W, part, angle),
        }
        path = to(path, at, increments, Spacing::Uniform);
    }
    path
}
