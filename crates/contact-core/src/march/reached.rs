//! Largest values of a run, and warnings that follow from them.

use super::{Increment, Spots, shear_errors};
use crate::digits::short;
use crate::error::Error;
use crate::scene::{Breadth, FEW_CELLS, LARGE_STRAIN, PathGrid, Scene};

/// Pressure over the Young's modulus of the softest layer, above which metals yield: their hardness
/// is 0.005 to 0.05 of it.
const HARD: f64 = 0.01;
/// Equivalent plastic strain beyond which strains are not small.
const LARGE_PLASTIC_STRAIN: f64 = 0.06;
/// A warning names the error of the increments if it exceeds the tolerance of the path by this
/// factor.
const NOTABLE_RATIO: f64 = 2.0;
/// Least Young's modulus of a solid that yields, other than rubber \[Pa\].
const YIELDS: f64 = 1e9;

/// Largest values over the increments of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reached {
    /// Cells across the radius of the contact.
    pub cells_per_radius: f64,
    /// Radius of the contact, of a line contact half its width \[m\].
    pub contact_radius: f64,
    /// Spots of the contact where it is largest.
    pub spots: Spots,
    /// Pressure \[Pa\].
    pub p_max: f64,
    /// Equivalent plastic strain.
    pub plastic_strain: f64,
    /// Whether what has yielded reaches the border of its grid.
    pub yields_at_border: bool,
    /// The increments that ended branches.
    pub ends: Vec<Increment>,
}

impl Reached {
    /// The largest values of these increments.
    pub fn from_increments(increments: &[Increment]) -> Self {
        let mut reached = Self::default();
        for of in increments {
            reached.see(of);
        }
        reached
    }

    /// Takes an increment into account: largest cells, radius, pressure, strain, and the ends of branches.
    pub fn see(&mut self, increment: &Increment) {
        self.cells_per_radius = self.cells_per_radius.max(increment.cells_per_radius);
        self.contact_radius = self.contact_radius.max(increment.contact_radius);
        if increment.spots.whole_cells > self.spots.whole_cells {
            self.spots = increment.spots;
        }
        self.p_max = self.p_max.max(increment.p_max);
        self.plastic_strain = self.plastic_strain.max(increment.yielded.largest);
        self.yields_at_border |= increment.yielded.at_border;
        if increment.point.ends_branch {
            self.ends.push(*increment);
        }
    }

    /// Fails if a smooth contact, where it is largest, has fewer than
    /// [`FEWEST_CELLS`](crate::scene::FEWEST_CELLS) across its radius, on the grid or on the path
    /// grid, or is as wide as a body.
    pub fn check(&self, scene: &Scene) -> Result<(), Error> {
        if self.cells_per_radius > 0.0 {
            scene.check_cells_across_radius(self.cells_per_radius, 1.0)?;
        }
        self.breadth(scene)
            .map_or(Ok(()), |of| scene.check_ratio(&of))
    }

    /// The half width of the contact beside the radius of a body, where their ratio is largest.
    fn breadth(&self, scene: &Scene) -> Option<Breadth> {
        let line = scene.grid.plane_strain;
        let a = if line || scene.hertz().is_some() {
            self.contact_radius
        } else {
            // Curved along one direction alone: the smaller semi-axis lies along it.
            self.cells_per_radius * scene.grid.dx.min(scene.grid.dy)
        };
        scene.breadth_for_radius(a)
    }

    /// All that is to be doubted of a run: [`Scene::doubts`], then [`Self::doubts`]. What the scene
    /// estimates of the contact is left out once the run has it.
    pub fn all_doubts(&self, scene: &Scene) -> Vec<String> {
        if self.cells_per_radius == 0.0 {
            return scene.doubts();
        }
        let mut doubts = scene.doubts_without_breadth();
        doubts.extend(self.doubts(scene));
        doubts
    }

    /// The estimated error of the shear at the end of every branch whose increments were chosen
    /// ([`shear_errors`]).
    pub fn shear_errors(&self, scene: &Scene) -> Vec<Option<f64>> {
        let branches = scene.path.branches.iter();
        let errors = branches.zip(shear_errors(scene, &self.ends));
        let estimated = errors.map(|(branch, error)| branch.path_error.map(|_| error));
        estimated.collect()
    }

    /// Whether the contact is one of asperities: of uneven surfaces, more than one spot, or one whose surroundings
    /// are rough.
    fn has_asperities(&self, scene: &Scene) -> bool {
        scene.is_uneven() && (self.spots.count != 1 || !scene.touches_smoothly(self.contact_radius))
    }

    /// A warning if the spots of uneven bodies have fewer than [`FEW_CELLS`] across their radius.
    fn doubt_of_asperities(&self) -> Option<String> {
        let (cells, spots) = (self.cells_per_radius, &self.spots);
        if cells >= FEW_CELLS {
            return None;
        }
        let area = spots.real_area_error() / spots.real_area().max(f64::MIN_POSITIVE);
        let [area, lone] = [area, spots.lone_share].map(|part| (100.0 * part).ceil());
        let count = match spots.count {
            1 => "one spot".to_owned(),
            count => format!("{count} spots"),
        };
        Some(format!(
            "the surfaces are uneven: the contact is {count}. Its asperities have {} cells across their radius, {lone} % of its cells \
             have no neighbour in contact. The real area is off by up to {area} %, the largest pressure and the stick \
             ratio by as much or more. Approach, loads and energies are off by less: solve(..., error=True) estimates each. \
             A map of closer points with more cells shows more of the asperities",
            (10.0 * cells).floor() / 10.0
        ))
    }

    /// Warnings that need the results of a run, beyond [`Scene::doubts`]; one sentence
    /// each.
    pub fn doubts(&self, scene: &Scene) -> Vec<String> {
        let mut doubts = Vec::new();
        if self.cells_per_radius > 0.0 && self.has_asperities(scene) {
            doubts.extend(self.doubt_of_asperities());
        } else if self.cells_per_radius > 0.0 {
            doubts.extend(scene.doubts_about_cells(self.cells_per_radius, 1.0));
        }
        let allowed = scene.settings.solver.path_tolerance;
        let errors = shear_errors(scene, &self.ends).into_iter().enumerate();
        if let Some((k, error)) = errors.max_by(|a, b| a.1.total_cmp(&b.1))
            && error > NOTABLE_RATIO * allowed
        {
            let with = match scene.settings.solver.path_grid {
                PathGrid::Cells(cells) => {
                    format!(
                        "with more increments, and with more cells than solver.path_grid = {cells}"
                    )
                }
                _ => "with more increments".into(),
            };
            let count = match scene.path.branches[k].count() {
                1 => "one increment".into(),
                count => format!("{count} increments"),
            };
            doubts.push(format!(
                "branch {} of the path, in {count}, leaves the shear {:.1} % off, the path tolerance is {:.1} %: it falls {with}",
                k + 1,
                100.0 * error,
                100.0 * allowed
            ));
        }
        if self.plastic_strain > LARGE_PLASTIC_STRAIN {
            doubts.push(format!(
                "the plastic strain comes to {:.0} %: the equations hold for small strains, below {:.0} %",
                100.0 * self.plastic_strain,
                100.0 * LARGE_PLASTIC_STRAIN
            ));
        }
        if self.yields_at_border {
            doubts.push(
                "the plastic zone reaches the border of its grid, beyond which bodies are taken to be elastic: choose a wider grid"
                    .into(),
            );
        }
        let breadth = self.breadth(scene);
        doubts.extend(breadth.and_then(|of| scene.doubt_of_breadth(&of)));
        let p = self.p_max;
        if let Some((layer, E)) = softest_elastic(scene, self.contact_radius)
            && p > HARD * E
            && scene.hardness() == f64::INFINITY
        {
            doubts.push(format!(
                "the pressure comes to {} GPa, E/{:.0} of {layer} (E = {E:.3e} Pa): metals yield above E/100 or before (hardness over E \
                 is 0.005 to 0.05); the solution is elastic there. Body(hardness=...) limits the pressure of a rough surface, \
                 Elastic(..., plastic=...) lets the volume yield",
                short(1e-9 * p),
                E / p
            ));
        } else if let Some(hertz) = scene.hertz()
            && p > LARGE_STRAIN * hertz.E_star
        {
            doubts.push(format!(
                "the pressure comes to {p:.3e} Pa, {:.2} E*: strains are not small",
                p / hertz.E_star
            ));
        } else if let Some((layer, strain)) = most_squeezed(scene, self.contact_radius, p)
            && strain > LARGE_STRAIN
        {
            doubts.push(format!(
                "the pressure comes to {p:.3e} Pa and strains {layer} by some {:.0} %: strains are not small, below {:.0} %",
                100.0 * strain,
                100.0 * LARGE_STRAIN
            ));
        }
        doubts
    }
}

/// The layer that a pressure \[Pa\] on a contact of this radius \[m\] strains most, and the strain. A layer as
/// thick as the contact is wide strains like a half-space, `(1 - nu^2) p/E`. A thin one cannot move sideways:
/// `(1 + nu)(1 - 2 nu)/(1 - nu) p/E`, and where it is incompressible the part of its thickness in the radius.
fn most_squeezed(scene: &Scene, radius: f64, p: f64) -> Option<(String, f64)> {
    let bodies = [("body1", &scene.body1), ("body2", &scene.body2)];
    let mut strains = Vec::new();
    for (key, body) in bodies {
        let mut top = 0.0;
        let coatings = body.coatings.iter().map(|c| (c.material, c.thickness));
        for (n, (material, thickness)) in coatings
            .chain([(body.substrate, f64::INFINITY)])
            .enumerate()
        {
            if top > radius || !material.E.is_finite() {
                top += thickness;
                continue;
            }
            let (E, nu) = (material.E, material.nu);
            let confined = (1.0 - 2.0 * nu) / (1.0 - nu).powi(2);
            let free = (thickness / radius.max(f64::MIN_POSITIVE)).min(1.0);
            let strain = (1.0 - nu * nu) * p / E * confined.max(free);
            let name = if thickness.is_finite() {
                format!("{key}.coatings[{n}]")
            } else {
                key.to_owned()
            };
            strains.push((name, strain));
            top += thickness;
        }
    }
    strains.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The layer of the lowest Young's modulus that stays elastic in the computation, is no rubber, and
/// lies within `depth` of the surface \[m\].
fn softest_elastic(scene: &Scene, depth: f64) -> Option<(String, f64)> {
    let bodies = [("body1", &scene.body1), ("body2", &scene.body2)];
    let mut layers = Vec::new();
    for (key, body) in bodies {
        let mut top = 0.0;
        for (n, coating) in body.coatings.iter().enumerate() {
            let name = format!("{key}.coatings[{n}]");
            layers.push((n, top, body, name, coating.material.E));
            top += coating.thickness;
        }
        let substrate = body.coatings.len();
        layers.push((substrate, top, body, key.to_owned(), body.substrate.E));
    }
    layers
        .into_iter()
        .filter(|(n, top, body, _, E)| {
            let solid = *E >= YIELDS && E.is_finite();
            solid && *top <= depth && body.plastic(*n).is_none()
        })
        .map(|(_, _, _, name, E)| (name, E))
        .min_by(|a, b| a.1.total_cmp(&b.1))
}
