//! Twins of a scene: the same contact scaled, mirrored and turned.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::march::Fields;
use contact_core::scene::{Loads, PrescribedMotions, Scene};
use ndarray::Array2;

use super::audit::misfit::{Misfit, least_response};
use super::campaign::{End, Fate, audited, ended};
use super::draw::{ROLLED, SHAPED};

/// Whether a scene is compared with its twins.
pub(crate) fn has_twins(seed: u64) -> bool {
    seed.is_multiple_of(2) && !(SHAPED..ROLLED).contains(&seed)
}

/// How many twins a scene of a seed has: what rolls along x has none turned by a right angle.
pub(crate) fn twins(seed: u64) -> usize {
    if seed >= ROLLED { 2 } else { 3 }
}

fn rolls(scene: &Scene) -> bool {
    scene.path.branches.iter().any(|b| b.to.rolled != 0.0)
}

/// The name of twins that are alike without the turn of the slip only.
pub(crate) const UNTURNED: &str = "unturned";

/// The tolerance of the pairs that are compared again, over that of the scene.
const CLOSER: f64 = 0.01;

/// The distances of the twins of a scene that take the same path: not those of which an increment
/// is solved in more pieces. Where the turn of the slip cannot be followed to the end the solution
/// depends on how far it was, and which of two cells enters first may be decided by less than the
/// tolerance: a pair that differs is compared without the turn and to a hundredth of the tolerance.
pub(crate) fn compared(
    scene: &Scene,
    ours: &End,
    stop: &Arc<AtomicBool>,
) -> Result<Vec<(&'static str, f64)>, Fate> {
    let allowed = Allowed::of(scene);
    let run = |name: &str, scene: &Scene| match audited(scene, stop) {
        Ok((end, _)) => Ok(end),
        Err(error) => Err(ended(scene, &format!("{name} twin: "), &error)),
    };
    let unturned = |scene: &Scene| {
        let mut scene = scene.clone();
        scene.settings.solver.slip_rotation_correction = false;
        scene.settings.solver.tolerance = Some(CLOSER * scene.tolerance());
        run("unturned", &scene).map(|end| (end, Allowed::of(&scene)))
    };
    let mut distances = Vec::new();
    for (name, twin, back) in twins_of(scene) {
        let theirs = run(name, &twin)?;
        if !theirs.pieces().eq(ours.pieces()) {
            continue;
        }
        let off = difference(ours, &theirs, &*back, &allowed);
        distances.push(if off <= 1.0 {
            (name, off)
        } else {
            let ((ours, allowed), (theirs, _)) = (unturned(scene)?, unturned(&twin)?);
            (UNTURNED, difference(&ours, &theirs, &*back, &allowed))
        });
    }
    Ok(distances)
}

/// p, q_x, q_y of a twin as those of the scene, and the factor of the twin's lengths.
type Mapped = ([Array2<f64>; 3], f64);
/// How the fields of a twin are mapped back.
type Back = Box<dyn Fn(&Fields) -> Mapped>;

fn twins_of(scene: &Scene) -> Vec<(&'static str, Scene, Back)> {
    let mut twins: Vec<(&'static str, Scene, Back)> = Vec::new();
    let with_loads = |f: &dyn Fn(Loads) -> Loads| {
        let mut twin = scene.clone();
        for branch in &mut twin.path.branches {
            branch.to = f(branch.to);
        }
        twin
    };

    // Lengths a thousandth, moduli sixty-four times.
    let (length, modulus) = (1e-3, 64.0);
    let force = modulus * length * length;
    let mut scaled = with_loads(&|l| Loads {
        W: l.W * force,
        T_x: l.T_x * force,
        T_y: l.T_y * force,
        rolled: l.rolled * length,
        given: PrescribedMotions {
            delta_x: l.given.delta_x.map(|shift| shift * length),
            ..l.given
        },
        ..l
    });
    for body in [&mut scaled.body1, &mut scaled.body2] {
        if let contact_core::scene::Shape::Sphere { R } = &mut body.shape {
            *R *= length;
        }
        body.substrate.E *= modulus;
        for coating in &mut body.coatings {
            coating.material.E *= modulus;
            coating.thickness *= length;
        }
    }
    scaled.grid.dx *= length;
    scaled.grid.dy *= length;
    twins.push((
        "scaled",
        scaled,
        Box::new(move |f| {
            let back = |f: &Array2<f64>| f / modulus;
            ([back(&f.p), back(&f.q_x), back(&f.q_y)], length)
        }),
    ));

    let mirrored = with_loads(&|l| Loads { T_y: -l.T_y, ..l });
    let flip = |f: &Array2<f64>, sign: f64| f.slice(ndarray::s![.., ..;-1]).mapv(|v| sign * v);
    twins.push((
        "mirrored",
        mirrored,
        Box::new(move |f| {
            (
                [flip(&f.p, 1.0), flip(&f.q_x, 1.0), flip(&f.q_y, -1.0)],
                1.0,
            )
        }),
    ));

    if rolls(scene) {
        return twins;
    }
    // A quarter turn: x to y, y to -x.
    let mut rotated = with_loads(&|l| Loads {
        T_x: -l.T_y,
        T_y: l.T_x,
        ..l
    });
    (rotated.grid.nx, rotated.grid.ny) = (scene.grid.ny, scene.grid.nx);
    (rotated.grid.dx, rotated.grid.dy) = (scene.grid.dy, scene.grid.dx);
    let turn = |f: &Array2<f64>| f.slice(ndarray::s![..;-1, ..]).t().to_owned();
    twins.push((
        "rotated",
        rotated,
        Box::new(move |f| ([turn(&f.p), turn(&f.q_y), -turn(&f.q_x)], 1.0)),
    ));
    twins
}

/// What two solutions within the tolerance may differ by ([`Misfit`]).
struct Allowed {
    misfit: Misfit,
    mu: f64,
    /// Least tangential response to a wave of unit traction \[m/Pa\].
    tangential: f64,
}

impl Allowed {
    fn of(scene: &Scene) -> Self {
        let [_, tangential] = least_response(scene);
        Self {
            misfit: Misfit::of(scene),
            mu: scene.friction.mu,
            tangential,
        }
    }

    /// Norm of the difference of the shears after `increments`, each of which hands its slip on to
    /// the next; the bound mu p differs too \[Pa\].
    fn shear(&self, fields: &Fields, increments: usize) -> f64 {
        let misfit = &self.misfit;
        let own = 2.0 * misfit.slip * Misfit::root_of_cells(fields) / self.tangential;
        increments as f64 * (own + self.mu * misfit.pressure(fields))
    }

    /// Difference of the approaches \[m\]: the gaps, weighted with the pressure.
    fn approach(&self, fields: &Fields) -> f64 {
        let weight = norm(&fields.p) / fields.p.sum() * Misfit::root_of_cells(fields);
        2.0 * self.misfit.gap * weight
    }
}

/// What a twin differs by over what two solutions within the tolerance may differ by.
fn difference(
    ours: &End,
    theirs: &End,
    back: &dyn Fn(&Fields) -> Mapped,
    allowed: &Allowed,
) -> f64 {
    let ([p, q_x, q_y], length) = back(&theirs.fields);
    let f = &ours.fields;
    let pressure = norm(&(p - &f.p)) / allowed.misfit.pressure(f);
    let of_shear = allowed.shear(f, ours.increments.len());
    let shear =
        norm(&(q_x - &f.q_x)).hypot(norm(&(q_y - &f.q_y))) / of_shear.max(f64::MIN_POSITIVE);
    let approach = (theirs.approach / length - ours.approach).abs() / allowed.approach(f);
    pressure.max(shear).max(approach)
}

/// Root of the sum of squares.
fn norm(f: &Array2<f64>) -> f64 {
    f.iter().map(|v| v * v).sum::<f64>().sqrt()
}
