//! Stage 1: WHAT is in contact.
//!
//! A [`Scene`] is plain data: two bodies, a friction law, a grid, a load path and the settings of
//! the solution. [`Scene::check`] refuses what has no meaning before anything is computed.

mod body;
mod bulk_stress;
mod case;
mod centred;
mod compliant_bonds;
mod departure;
mod doubts;
mod files;
mod friction;
mod friction_law;
mod grid;
mod heathcote;
mod load_path;
mod loads;
mod magnitude;
mod map_points;
mod missing;
mod motion;
mod nominal;
mod number_files;
mod residual_stress;
mod resolution;
mod settings;
mod shape;
mod stress_profile;
mod surface_map;
mod validity;
mod yields;

pub use crate::material::{Bond, Coating, Elastic, dundurs_beta};
pub use body::{Body, Bulk, check_plastic_law};
pub use case::{Fault, Section, convert_to_si, quantity, read_scene_and, read_text};
pub use doubts::CELLS_PER_FILM;
pub use files::{Reach, read as read_file};
pub use friction::Dependence;
pub use friction::{BedFriction, Friction, FrictionHistory, History};
pub use friction_law::missing_law_error;
pub use friction_law::{CellHistory, FrictionLaw, UserFriction};
pub use grid::Grid;
pub use load_path::{
    Branch, ForceUnits, Increments, LoadPath, LoadPoint, Open, Samples, Spacing, Swing,
    sample_period,
};
pub use loads::{Loads, PrescribedMotions};
pub use missing::Missing;
pub use motion::{Prescribed, RigidMotion};
pub(crate) use nominal::Nominal;
pub use number_files::{FileOfNumbers, decode_any as text_of_numbers};
pub use plasticity::{BACK_STRESSES, Plastic};
pub use residual_stress::ResidualStress;
pub use resolution::{FEW_CELLS, FEWEST_CELLS};
pub use settings::{
    KernelMethod, KernelSettings, PathGrid, Preset, SaveFields, Settings, SkipSettings,
    SolverSettings,
};
pub use shape::{Rough, Shape};
pub use stress_profile::Profile;
pub use surface_map::{SurfaceMap, check_sides};
pub use validity::Breadth;
pub use yields::FirstYield;

pub(crate) use self::doubts::LARGE_STRAIN;
pub(crate) use self::settings::MOST_ALIASES;
use self::settings::{PATH_PART, TOLERANCE};
use crate::error::Error;
pub use crate::error::LawError;
use crate::hertz::{Hertz, contact_modulus, hertz, hertz_ellipse, line_contact};
use crate::memory::fits;

/// Arrays per cell needed for the surfaces: both heights, their sum, and temporaries.
const SURFACES: f64 = 6.0;

/// A fretting contact problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// One line that names the scene in results and figures.
    pub title: String,
    /// The upper body (the indenter in the paper).
    pub body1: Body,
    /// The lower body (the coated half-space in the paper).
    pub body2: Body,
    /// Friction law of the interface.
    pub friction: Friction,
    /// Mesh of the contact plane.
    pub grid: Grid,
    /// Load history.
    pub path: LoadPath,
    /// How the problem is solved and which fields are saved.
    pub settings: Settings,
}

impl Scene {
    /// A scene without a title, solved by the default settings.
    pub fn new(body1: Body, body2: Body, friction: Friction, grid: Grid, path: LoadPath) -> Self {
        Self {
            title: String::new(),
            body1,
            body2,
            friction,
            grid,
            path,
            settings: Settings::default(),
        }
    }

    /// Fails with the key, the value and what is allowed if the scene has no meaning.
    pub fn check(&self) -> Result<(), Error> {
        self.body1.check("body1")?;
        self.body2.check("body2")?;
        let is_rigid = |body: &Body| body.substrate.is_rigid() && body.coatings.is_empty();
        if is_rigid(&self.body1) && is_rigid(&self.body2) {
            return Err(Error::invalid(
                "body2.E",
                "inf",
                "finite, since body 1 is rigid",
            ));
        }
        self.grid.check()?;
        self.check_magnitudes()?;
        self.check_surfaces_fit()?;
        self.friction.check(Some(&self.grid))?;
        self.friction
            .check_layers([&self.body1, &self.body2].map(|body| body.coatings.len() + 1))?;
        let by_frequency = matches!(
            self.settings.kernel.method,
            KernelMethod::FrequencyDomain { .. }
        );
        if let Some(mu_y) = self.friction.mu_y.filter(|_| by_frequency) {
            return Err(Error::invalid(
                "friction.mu_y",
                mu_y,
                "left out with the frequency-domain operator",
            ));
        }
        self.body1.shape.check_on(&self.grid, "body1.shape")?;
        self.body2.shape.check_on(&self.grid, "body2.shape")?;
        if !self.opens_at_the_border() {
            let (first, second) = (self.body1.shape.name(), self.body2.shape.name());
            return Err(Error::invalid(
                "body1.shape",
                format!("{first} on {second}"),
                "a surface that parts from the other one towards the border of the grid. Parallel cylinders are a line \
                 contact: use Grid.strip (plane_strain = true)",
            ));
        }
        self.path.check_for_friction(&self.friction)?;
        self.path.check_on(&self.grid)?;
        self.path.units.check(&self.grid)?;
        if self.grid.plane_strain && self.settings.kernel.method != KernelMethod::Hankel {
            return Err(Error::invalid(
                "kernel.method",
                "a transform in two dimensions",
                "\"hankel\" in plane strain",
            ));
        }
        for (key, body, number) in [("sigma_B", &self.body2, 2), ("sigma_B1", &self.body1, 1)] {
            let bulk_stress = |to: &Loads| if number == 1 { to.sigma_B1 } else { to.sigma_B };
            let stresses = self.path.branches.iter().map(|b| bulk_stress(&b.to));
            let stress = stresses
                .filter(|_| body.substrate.is_rigid())
                .find(|s| *s != 0.0);
            if let Some(stress) = stress {
                let allowed = format!("0, since body {number} is rigid");
                return Err(Error::invalid(format!("path.{key}"), stress, allowed));
            }
        }
        let strip = self.grid.plane_strain;
        self.body1.check_bulk("body1", strip)?;
        self.body2.check_bulk("body2", strip)?;
        self.check_plausibility()?;
        self.check_bonds()?;
        self.check_approach()?;
        self.settings.check()?;
        self.check_hardness()?;
        self.check_yielding()?;
        self.check_path_grid()?;
        self.check_saved_increments()
    }

    /// Whether any layer of the bodies may yield.
    pub fn yields(&self) -> bool {
        self.body1.yields() || self.body2.yields()
    }

    /// Returns the scene with bodies that never yield.
    #[must_use]
    pub fn elastic(&self) -> Self {
        Self {
            body1: self.body1.elastic(),
            body2: self.body2.elastic(),
            ..self.clone()
        }
    }

    /// Fails if fields are to be kept of increments that the path does not have.
    fn check_saved_increments(&self) -> Result<(), Error> {
        let (SaveFields::Indices(kept), false) =
            (&self.settings.save, self.path.has_open_increments())
        else {
            return Ok(());
        };
        let last = self.path.increments();
        match kept.iter().find(|index| !(1..=last).contains(*index)) {
            Some(index) => Err(Error::invalid(
                "output.save",
                index,
                format!("1 to {last}, the increments of the path"),
            )),
            None => Ok(()),
        }
    }

    /// Fails if there is no memory even to lay out the surfaces on the grid.
    fn check_surfaces_fit(&self) -> Result<(), Error> {
        let cells = self.grid.nx as f64 * self.grid.ny as f64;
        fits("the grid", SURFACES * cells * size_of::<f64>() as f64)
    }

    /// The Hertz contact of the uncoated pair at the largest normal load of the path, or at the
    /// largest approach that it gives: the yardstick `a_H`, `p_H` of every dimensionless result.
    /// `None` where both substrates are rigid, nothing presses the bodies together or their shapes
    /// do not meet in a point. A contact of unequal radii has the mean of its semi-axes for `a_H`, the
    /// geometric one. In plane strain it is the contact of parallel cylinders, `a_H` their half-width, the
    /// approach relative to the points at the grid's length; `None` there if the path gives no W.
    pub fn hertz(&self) -> Option<Hertz> {
        let both_rigid = self.body1.substrate.is_rigid() && self.body2.substrate.is_rigid();
        if self.grid.plane_strain {
            return self.hertz_line().filter(|_| !both_rigid);
        }
        let (k_1, k_2) = self.principal_curvatures();
        if k_2 <= 1e-9 * k_1 || both_rigid {
            return None;
        }
        let hertz_under = |W| {
            let round = hertz(1.0 / k_1, self.body1.substrate, self.body2.substrate, W);
            if k_1 - k_2 <= 1e-12 * k_1 {
                return round;
            }
            let ellipse = hertz_ellipse(1.0 / k_2, 1.0 / k_1, round.E_star, W);
            Hertz {
                a: (ellipse.a_x * ellipse.a_y).sqrt(),
                p0: ellipse.p0,
                delta_z: ellipse.delta_z,
                ..round
            }
        };
        // delta_z grows with W^(2/3).
        let delta_z = self.path.delta_z_max();
        let W = self
            .path
            .W_max()
            .max((delta_z / hertz_under(1.0).delta_z).powf(1.5));
        (W > 0.0).then(|| hertz_under(W))
    }

    /// The Hertz contact of the sections y = 0 in plane strain.
    fn hertz_line(&self) -> Option<Hertz> {
        let k = self.body1.shape.curvature()[0] + self.body2.shape.curvature()[0];
        let W = self.path.W_max();
        let E_star = contact_modulus(self.body1.substrate, self.body2.substrate);
        let line = line_contact(1.0 / k, E_star, W / self.grid.dy);
        (k > 0.0 && W > 0.0).then(|| Hertz {
            W,
            E_star,
            a: line.a,
            p0: line.p0,
            delta_z: line.approach(1.0 / k, self.grid.extent().0),
        })
    }

    /// Reference length of the results of an increment with the pressure `p`, shape (nx, ny) \[Pa\], in
    /// \[m\]. It is a_H. Without a Hertz contact it is half the longer side of the box around the
    /// contact, or of the grid where nothing touches.
    pub fn reference_length(&self, p: &ndarray::Array2<f64>) -> f64 {
        if let Some(hertz) = self.hertz() {
            return hertz.a;
        }
        let touching = p
            .indexed_iter()
            .filter(|(_, p)| **p > 0.0)
            .map(|(at, _)| at);
        let empty_box = ((usize::MAX, 0), (usize::MAX, 0));
        let ((left, right), (low, high)) = touching.fold(empty_box, |((l, r), (b, t)), (i, j)| {
            ((l.min(i), r.max(i)), (b.min(j), t.max(j)))
        });
        let grid = &self.grid;
        if left > right {
            return grid.extent().0 / 2.0;
        }
        let along_x = (right - left + 1) as f64 * grid.dx;
        let along_y = (high - low + 1) as f64 * grid.dy;
        let longer = if grid.plane_strain {
            along_x
        } else {
            along_x.max(along_y)
        };
        longer / 2.0
    }

    /// Reference approach \[m\]: Hertz's approach. Without a Hertz contact it is the largest prescribed
    /// approach, or the one of a punch as wide as the grid under the largest force. Between rigid
    /// substrates the compression of the layers under that force is an upper bound.
    pub fn reference_approach(&self) -> f64 {
        self.hertz().map_or_else(
            || self.path.delta_z_max().max(self.approach_of_punch()),
            |hertz| hertz.delta_z,
        )
    }

    /// The approach under the largest force, spread over the grid \[m\].
    fn approach_of_punch(&self) -> f64 {
        let bodies = [&self.body1, &self.body2];
        let softest = |body: &Body| {
            let coatings = body.coatings.iter().map(|c| c.material);
            let layers = coatings.chain([body.substrate]);
            layers.fold(Elastic::RIGID, |s, m| if m.E < s.E { m } else { s })
        };
        let E_star = contact_modulus(softest(bodies[0]), softest(bodies[1]));
        let (length, width) = self.grid.extent();
        let longer_side = if self.grid.plane_strain {
            width
        } else {
            length.max(width)
        };
        let W = self.path.W_max();
        let approach_of_half_spaces = W / (E_star * longer_side);
        if !bodies.iter().all(|body| body.substrate.is_rigid()) {
            return approach_of_half_spaces;
        }
        let layers = bodies.iter().flat_map(|body| &body.coatings);
        let compliance: f64 = layers.map(|c| c.thickness / c.material.E).sum();
        approach_of_half_spaces.min(W / (length * width) * compliance)
    }

    /// Fails if the path grid does not divide the grid, or a feature of the scene needs the full grid for the path.
    pub(crate) fn check_path_grid(&self) -> Result<(), Error> {
        let PathGrid::Cells(cells) = self.settings.solver.path_grid else {
            return Ok(());
        };
        let (nx, ny) = (self.grid.nx, self.grid.ny);
        let divides = |ratio: &usize| nx.is_multiple_of(2 * ratio) && ny.is_multiple_of(2 * ratio);
        let rolls = self.path.branches.iter().any(|b| b.to.rolled != 0.0);
        let refusing_feature = if self.grid.plane_strain {
            Some("in plane strain")
        } else if rolls {
            Some("where the bodies roll")
        } else if self.friction.varies() {
            Some("where the coefficient of friction changes along the path")
        } else if self.settings.solver.preset == Preset::Spinu2020 {
            Some("with the preset spinu2020")
        } else if self.yields() || self.hardness() < f64::INFINITY {
            Some("where a body yields")
        } else {
            None
        };
        let ratios: Vec<usize> = [2, 4].into_iter().filter(divides).collect();
        if refusing_feature.is_none() && ratios.iter().any(|ratio| nx == ratio * cells) {
            return Ok(());
        }
        let cells_of = |ratio: &usize| format!(", {}", nx / ratio);
        let allowed = match refusing_feature {
            Some(why) => format!("\"auto\" or \"same\" {why}"),
            None => format!(
                "\"auto\", \"same\"{}: an even half or quarter of the cells along x and y",
                ratios.iter().map(cells_of).collect::<String>()
            ),
        };
        Err(Error::invalid("solver.path_grid", cells, allowed))
    }

    /// Relative tolerance of the solution: the one of the settings, or 1e-6. Where increments are
    /// chosen it is 1/125 of the tolerance on the path (1/2500 of a path that only presses) if that is
    /// more.
    pub fn tolerance(&self) -> f64 {
        let solver = &self.settings.solver;
        if let Some(tolerance) = solver.tolerance {
            return tolerance;
        }
        if self.path.has_open_increments() && self.friction.mu > 0.0 {
            let part = PATH_PART[usize::from(!self.path.only_presses())];
            (part * solver.path_tolerance).max(TOLERANCE)
        } else {
            TOLERANCE
        }
    }

    /// Gap between the undeformed surfaces, h_init \[m\], shape (nx, ny).
    pub fn h_init(&self) -> ndarray::Array2<f64> {
        match (&self.body1.shape, &self.body2.shape) {
            (shape, Shape::Flat) | (Shape::Flat, shape) => shape.drop(&self.grid),
            (first, second) => first.drop(&self.grid) + second.drop(&self.grid),
        }
    }

    /// The larger and the smaller principal curvature of the gap between the nominal shapes
    /// \[1/m\].
    pub fn principal_curvatures(&self) -> (f64, f64) {
        let (first, second) = (self.body1.shape.curvature(), self.body2.shape.curvature());
        let [xx, xy, yy]: [f64; 3] = std::array::from_fn(|i| first[i] + second[i]);
        let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        (mean + half, mean - half)
    }

    /// Whether the gap is narrower somewhere inside than everywhere along the border of the grid.
    fn opens_at_the_border(&self) -> bool {
        let h = self.h_init();
        let (nx, ny) = h.dim();
        let (mut inside, mut border) = (f64::INFINITY, f64::INFINITY);
        for ((i, j), &h) in h.indexed_iter() {
            let along_y = !self.grid.plane_strain && (j == 0 || j + 1 == ny);
            let at_border = i == 0 || i + 1 == nx || along_y;
            let lowest = if at_border { &mut border } else { &mut inside };
            *lowest = lowest.min(h);
        }
        inside < border
    }
}
