//! The computations that a scene needs, decided before the first of them.

mod direct;
mod memory;
mod methods;
mod mirror;

pub use methods::{Methods, TangentialMethod};
pub use mirror::{Mirror, Parity};

use ndarray::Array2;

use self::direct::direct_branches;
use crate::scene::{Body, LoadPoint, Loads, RigidMotion, Scene, Spacing, SurfaceMap};

/// The computations to do and those to skip.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::struct_excessive_bools)] // one for each rule
pub struct Plan {
    /// Whether pressure and shear act on each other: the normal-tangential kernels and the
    /// Whether pressure and shear influence each other: the normal-tangential kernels and the
    pub coupling: bool,
    /// Whether there is friction: the tangential kernels and solver.
    pub friction: bool,
    /// Part of the grid that is solved for.
    pub mirror: Mirror,
    /// The numerical methods.
    pub methods: Methods,
    /// Branches of the load path whose end does not depend on the path.
    pub direct: Vec<bool>,
    /// A readable line for each rule.
    pub lines: Vec<PlanLine>,
}

/// Set of influence coefficients.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum KernelSet {
    /// `zz`, sufficient for a contact without friction.
    Normal,
    /// `xx`, `yy`, `zz` and `xy`: pressure and shear do not influence each other.
    Uncoupled,
    /// All six.
    #[default]
    All,
}

/// One rule of the plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanLine {
    /// The subject of the rule.
    pub subject: String,
    /// Whether it is skipped in this scene.
    pub skipped: bool,
    /// Reason for the decision.
    pub reason: String,
}

impl std::fmt::Display for PlanLine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let verdict = if self.skipped { "skipped" } else { "kept" };
        write!(f, "{verdict}: {} ({})", self.subject, self.reason)
    }
}

impl Plan {
    /// The influence coefficients that are computed.
    pub fn kernels(&self) -> KernelSet {
        match (self.friction, self.coupling) {
            (_, true) => KernelSet::All,
            (true, false) => KernelSet::Uncoupled,
            (false, false) => KernelSet::Normal,
        }
    }

    /// The increments that are solved: of a branch whose end does not depend on the path, the last,
    /// and a short first one.
    pub fn points(&self, scene: &Scene) -> Vec<LoadPoint> {
        let mut points = scene.path.points();
        let mut previous_branch = None;
        points.retain(|point| {
            let is_first = previous_branch.replace(point.branch) != Some(point.branch);
            let has_short_first = scene.path.branches[point.branch].spacing == Spacing::ShortFirst;
            point.ends_branch || !self.direct[point.branch] || (is_first && has_short_first)
        });
        points
    }

    /// Plans a scene: which kernels, symmetries, windows and increments it needs, each with the reason.
    pub fn new(scene: &Scene) -> Self {
        let mut lines = Vec::new();
        let mut rule = |subject: &str, verdict: Result<&str, &str>| {
            let (skipped, reason) = match verdict {
                Ok(reason) => (true, reason),
                Err(reason) => (false, reason),
            };
            lines.push(PlanLine {
                subject: subject.into(),
                skipped,
                reason: reason.into(),
            });
            skipped
        };
        let friction = !rule(
            "tangential kernels and solver",
            if scene.friction.mu == 0.0 {
                Ok("the contact is frictionless")
            } else {
                Err("friction transmits shear")
            },
        );
        rule("influence coefficients of body 1", compare_bodies(scene));
        let coupling = !rule("normal-tangential coupling", decide_coupling(scene));
        let half = rule("the half y < 0 of the grid", decide_mirror(scene));
        let window = rule("cells far from the contact", methods::decide_window(scene));
        let single = rule(
            "digits beyond single precision in the iterations",
            methods::decide_single_precision(scene),
        );
        let (direct, verdict) = direct_branches(scene, coupling);
        let subject = match direct.iter().filter(|&&d| d).count() {
            0 => "increments within the branches".to_owned(),
            n if n == direct.len() => "increments within all branches".to_owned(),
            n => format!("increments within {n} of {} branches", direct.len()),
        };
        rule(&subject, verdict);
        Self {
            coupling,
            friction,
            mirror: if half { Mirror::Y } else { Mirror::None },
            methods: Methods::new(scene, window, single),
            direct,
            lines,
        }
    }
}

/// Whether both bodies have the same coefficients, so that they are computed once: Ok has the reason why, Err
/// the reason why not.
fn compare_bodies(scene: &Scene) -> Result<&'static str, &'static str> {
    if layers(&scene.body1, scene) == layers(&scene.body2, scene) {
        Ok("as in body 2, which has the same layers")
    } else {
        Err("the bodies differ in elasticity")
    }
}

/// Whether pressure causes no tangential mismatch of the surfaces, so that coupling is skipped: Ok has the
/// reason why, Err the reason why not.
fn decide_coupling(scene: &Scene) -> Result<&'static str, &'static str> {
    if scene.friction.mu == 0.0 {
        return Ok("without shear there is nothing to couple");
    }
    if !scene.settings.skip.coupling {
        return Err("skip.coupling is off");
    }
    if compare_bodies(scene).is_ok() {
        return Ok("the bodies are elastically alike, eq. (4): C_13(2) = C_13(1)");
    }
    let coupling_compliance = |b: &Body| {
        let homogeneous = layers(b, scene).len() == 1;
        homogeneous.then(|| (1.0 - 2.0 * b.substrate.nu) / b.substrate.G())
    };
    match (
        coupling_compliance(&scene.body1),
        coupling_compliance(&scene.body2),
    ) {
        (Some(a), Some(b)) if a.to_bits() == b.to_bits() => {
            Ok("(1 - 2 nu)/G is the same in both bodies")
        }
        _ => Err("the bodies differ in elasticity"),
    }
}

/// The layers of a body as the plan compares them; without equal layers if the scene allows to skip these.
fn layers(body: &Body, scene: &Scene) -> Vec<[f64; 5]> {
    body.layers(scene.settings.skip.equal_layers)
}

/// Whether a field is its own mirror image under y -> -y, up to rounding.
fn is_mirror_symmetric(h: &Array2<f64>) -> bool {
    let ny = h.ncols();
    let largest = h.iter().fold(0.0, |m: f64, h| m.max(h.abs()));
    h.indexed_iter()
        .all(|((i, j), h_ij)| (h_ij - h[(i, ny - 1 - j)]).abs() <= 1e-12 * largest)
}

/// Whether the solution is its own mirror image under y -> -y, so that half of it is solved: Ok has the reason
/// why, Err the reason why not.
fn decide_mirror(scene: &Scene) -> Result<&'static str, &'static str> {
    if !scene.settings.skip.mirror {
        return Err("skip.mirror is off");
    }
    if methods::uses_frequency_domain(scene) {
        return Err("the frequency-domain operator works on the whole grid");
    }
    if !scene.grid.ny.is_multiple_of(2) {
        return Err("the grid has an odd number of rows along y");
    }
    if !is_mirror_symmetric(&scene.h_init()) {
        return Err("the surfaces are not mirror-symmetric in y");
    }
    let is_even =
        |map: &SurfaceMap| is_mirror_symmetric(&scene.grid.map(|x, y| map.interpolate(x, y)));
    if let Some(why) = scene.friction.laws().find_map(|law| law.is_uneven(is_even)) {
        return Err(why);
    }
    let drives_odd_motion = |to: &Loads| {
        let mut odd = RigidMotion::ALL.into_iter().filter(|of| of.is_odd_in_y());
        odd.any(|of| to.prescribed(of).value() != 0.0)
    };
    if scene.path.branches.iter().any(|b| drives_odd_motion(&b.to)) {
        return Err("the load path drives a motion along y or a rotation about x or z");
    }
    if scene.has_oblique_bulk_stress() {
        return Err("a bulk stress acts obliquely to x and y");
    }
    Ok("shapes and loads are mirror-symmetric in y")
}
