//! The results of one increment: numbers, residuals and work.

use serde::{Deserialize, Serialize};

use crate::scene::LoadPoint;

/// Rigid-body motion of body 1 relative to body 2, from the unloaded state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Approach \[m\], positive when the bodies come together.
    pub delta_z: f64,
    /// Relative tangential shift along x \[m\], of the sign of the force T_x that drives it.
    pub delta_x: f64,
    /// Relative tangential shift along y \[m\].
    pub delta_y: f64,
    /// Tilt about x \[rad\]: the gap grows by -y phi_x.
    pub phi_x: f64,
    /// Tilt about y \[rad\]: the gap grows by x phi_y.
    pub phi_y: f64,
    /// Rotation about z \[rad\], of the sign of the moment M_z that drives it.
    pub phi_z: f64,
}

impl Motion {
    /// Builds from the motions in the order of [`RigidMotion::ALL`](crate::scene::RigidMotion::ALL).
    pub(super) fn from_motions(motions: [f64; 6]) -> Self {
        let [delta_z, phi_x, phi_y, delta_x, delta_y, phi_z] = motions;
        Self {
            delta_z,
            delta_x,
            delta_y,
            phi_x,
            phi_y,
            phi_z,
        }
    }

    /// The motions in the order of [`RigidMotion::ALL`](crate::scene::RigidMotion::ALL).
    pub fn motions(&self) -> [f64; 6] {
        [
            self.delta_z,
            self.phi_x,
            self.phi_y,
            self.delta_x,
            self.delta_y,
            self.phi_z,
        ]
    }
}

/// State of the interface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Status {
    /// No cell transmits pressure.
    #[default]
    NoContact,
    /// No contact cell slips, as the field `stick` has it: the stick ratio is 1.
    FullStick,
    /// A part of the contact cells slips, or all of them below the limit of friction.
    PartialSlip,
    /// Every contact cell slips: friction carries its limit, the stick ratio is 0. Under given forces
    /// sliding is incipient.
    GrossSlip,
}

impl Status {
    /// All, in the order of increasing slip.
    pub const ALL: [Self; 4] = [
        Self::NoContact,
        Self::FullStick,
        Self::PartialSlip,
        Self::GrossSlip,
    ];

    /// Its number in result stores, 0 to 3; the higher, the more it slips.
    pub fn code(self) -> u8 {
        self as u8
    }
}

/// Energy of one increment, with mid-increment (trapezoidal) tractions \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Work of the loads, W d(delta_z) + T . d(delta) + M . d(phi), of the bulk stress on the
    /// displacements of the contact, and of the drive of rolling bodies.
    pub work: f64,
    /// Change of the elastic energy: 1/2 sum of traction times displacement, and in bodies that yield
    /// the energy of the residual stress, -1/2 int sigma : e_p dV without tractions.
    pub elastic: f64,
    /// Energy dissipated by friction, sum of g_m |ds| dA with the mean bound g_m of the increment,
    /// since a cell slips at its bound; >= 0 up to the solver's tolerance.
    pub dissipated: f64,
    /// Plastic work, int sigma : de_p dV along the hardening curve of each point.
    #[serde(default)]
    pub plastic: f64,
    /// Work of the tractions on cells that close or open, -sum of p dh dA, and of the shear on the
    /// motion of cells before they enter; a discretisation error that vanishes with the increment.
    pub opening: f64,
    /// `dissipated` and `plastic` less -sum of q . ds dA and int sigma : de_p dV by the trapezoidal
    /// rule, which the other terms use; it vanishes with the increment.
    pub quadrature: f64,
}

impl Energy {
    /// Error of the energy balance \[J\]: zero up to the solver's tolerance, for any size of the
    /// increment.
    pub fn imbalance(&self) -> f64 {
        let lost = self.dissipated + self.plastic - self.quadrature;
        self.work - self.elastic - lost - self.opening
    }
}

/// Residuals of the equations at the end of an increment, in physical terms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Residuals {
    /// Root-mean-square gap in the contact over the Hertz approach.
    pub gap: f64,
    /// Deepest penetration outside the contact over the Hertz approach.
    pub penetration: f64,
    /// Largest |q| - mu p over mu p_max; zero or below if Coulomb's law holds everywhere.
    pub coulomb: f64,
    /// Root-mean-square slip of stick cells, the residual slip of earlier increments included, over
    /// mu times the Hertz approach.
    pub stick: f64,
    /// Root-mean-square part of the slip that is not opposite to q, over mu times the approach.
    pub direction: f64,
    /// Angle between the slip and the shear that it opposes, root mean square over the slip
    /// cells, each with the square of its slip \[rad\].
    pub angle: f64,
    /// Largest error of the balances of given loads, over the load that the contact can carry.
    pub balance: f64,
    /// Energy imbalance over the work done so far.
    pub energy: f64,
}

/// Work counters; they do not jitter as times do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Work {
    /// Convolutions in units of three components (six two-dimensional transforms).
    pub convolutions: f64,
    /// Passes of the intermediate loop (normal, then tangential).
    pub alternations: usize,
    /// Conjugate-gradient iterations of the normal solver.
    pub normal_iterations: usize,
    /// Conjugate-gradient iterations of the tangential solver.
    pub tangential_iterations: usize,
    /// Pieces that the increment was solved in: more than one where a contact grows by much, and if
    /// it did not converge whole.
    pub parts: usize,
}

impl std::ops::Add for Work {
    type Output = Self;

    /// Adds work count by count.
    fn add(self, other: Self) -> Self {
        Self {
            convolutions: self.convolutions + other.convolutions,
            alternations: self.alternations + other.alternations,
            normal_iterations: self.normal_iterations + other.normal_iterations,
            tangential_iterations: self.tangential_iterations + other.tangential_iterations,
            parts: self.parts + other.parts,
        }
    }
}

/// Plastic state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Yield {
    /// Volume that has yielded so far \[m^3\].
    pub volume: f64,
    /// Largest equivalent plastic strain of a point so far.
    pub largest: f64,
    /// Whether that point lies in the uppermost element under friction, at the border of slip, or in a
    /// coating, at its rim: there the strain grows with every refinement.
    #[serde(default)]
    pub at_rim: bool,
    /// Whether what has yielded reaches the border of the volume grid.
    #[serde(default)]
    pub at_border: bool,
    /// Passes of the fixed point: each a contact, a stress and a return; none where bodies have stayed
    /// elastic.
    #[serde(default)]
    pub passes: usize,
    /// Largest stress of von Mises at the end of the increment over the yield stress there, of the points
    /// of the volume grid; 1 where one yields.
    #[serde(default)]
    pub reached: f64,
}

/// Mean of (true area - area of whole cells) over the area of the cells along the border, one for each face
/// between a cell in contact and one that is not: -(pi - 1 + ln 2)/24 (V. A. Yastrebov, G. Anciaux,
/// J.-F. Molinari, Tribology Int. 114 (2017) 161-171).
pub(super) const EDGE: f64 = (std::f64::consts::PI - 1.0 + std::f64::consts::LN_2) / 24.0;
/// Error of the area so corrected, over the area of the cells along the border.
const EDGE_ERROR: f64 = 0.06;

/// Sizes of the spots of a contact, and the gap between the surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spots {
    /// Number of spots: patches of cells in contact that touch, corners included.
    pub count: usize,
    /// Area of the cells in contact \[m^2\].
    pub whole_cells: f64,
    /// Faces between a cell in contact and one that is not, times the area of a cell \[m^2\].
    pub edge_cells: f64,
    /// Area of the largest spot, corrected for the perimeter of its cells \[m^2\].
    pub largest: f64,
    /// Part of the cells in contact that have no neighbour in contact.
    pub lone_share: f64,
    /// Area of the nominal contact \[m^2\]: the Hertz contact of the shapes without their unevenness, of flat
    /// shapes the grid.
    pub nominal_area: f64,
    /// Gap between the surfaces, mean over the nominal contact \[m\].
    pub mean_gap: f64,
    /// Root mean square of the slopes of the gap between the undeformed surfaces, without those of the
    /// shapes' curvature, over the nominal contact; between neighbouring cells. Zero for even surfaces.
    #[serde(default)]
    pub rms_slope: f64,
    /// Distance of the points between which it was taken \[m\].
    #[serde(default)]
    pub slope_length: f64,
}

impl Spots {
    /// Real area of the contact \[m^2\], corrected for the perimeter of its cells.
    pub fn real_area(&self) -> f64 {
        self.whole_cells - EDGE * self.edge_cells
    }

    /// Mean pressure in the cells in contact under the normal force W \[Pa\]; 0 without contact.
    pub fn mean_pressure(&self, W: f64) -> f64 {
        if self.whole_cells > 0.0 {
            W / self.whole_cells
        } else {
            0.0
        }
    }

    /// Error of the real area \[m^2\].
    pub fn real_area_error(&self) -> f64 {
        EDGE_ERROR * self.edge_cells
    }
}

/// One increment of the load path: scalars, residuals, work.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Increment {
    /// Increment, from 1.
    pub index: usize,
    /// The place in the path and the loads; for given motions the loads of the solution.
    pub point: LoadPoint,
    /// Rigid-body motion.
    pub motion: Motion,
    /// State of the interface.
    pub status: Status,
    /// Area of the contact \[m^2\]; cells at the rim count with the part inside.
    pub contact_area: f64,
    /// Area of the stick zone \[m^2\]; cells at its border count with the part inside.
    pub stick_area: f64,
    /// Cells across the radius of the contact: the half width, the smaller semi-axis of an ellipse,
    /// of many spots the one of the spot in the middle of their area; zero without a contact.
    pub cells_per_radius: f64,
    /// Radius of the circle of the contact's area, of a line contact half its width \[m\].
    pub contact_radius: f64,
    /// Spots of the contact, and the mean gap.
    #[serde(default)]
    pub spots: Spots,
    /// Largest pressure \[Pa\].
    pub p_max: f64,
    /// Largest shear traction |q| \[Pa\].
    pub q_max: f64,
    /// Shear traction |q|, root mean square over the contact \[Pa\].
    pub q_rms: f64,
    /// Scatter of the shear from cell to cell where the bodies stick, root mean square over the
    /// contact \[Pa\]: at the end of a branch, where enough cells in a line stick. It contains the
    /// error that too few increments leave in a contact that grows ([`shear_errors`]), and, once the
    /// shear has turned, the bends that earlier borders of the stick zone left.
    ///
    /// [`shear_errors`]: super::shear_errors
    pub q_scatter: Option<f64>,
    /// Cells along x of the grid that it was solved on; fewer than the scene's grid has where
    /// it was solved for the path alone (`solver.path_grid`).
    pub path_grid: usize,
    /// Energies of the increment.
    pub energy: Energy,
    /// Plastic work, volume and strain; zeros where nothing has yielded.
    pub yielded: Yield,
    /// Residuals of the equations.
    pub residuals: Residuals,
    /// Work of the solvers.
    pub work: Work,
}

impl Increment {
    /// Stick area over contact area; NaN without contact.
    pub fn stick_ratio(&self) -> f64 {
        if self.contact_area > 0.0 {
            self.stick_area / self.contact_area
        } else {
            f64::NAN
        }
    }
}
