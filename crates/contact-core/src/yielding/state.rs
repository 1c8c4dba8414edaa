//! The plastic state that the next increment depends on.

use plasticity::{BACK_STRESSES, Tensor};
use serde::{Deserialize, Serialize};

/// A point that has yielded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlasticPoint {
    /// Plane of Gauss points of the body's mesh.
    pub plane: u32,
    /// Cell of the volume grid that has grown, x first: the same number before and after.
    pub cell: u32,
    /// Plastic strain: xx, yy, zz, xy, xz, yz, with z into the body.
    pub strain: Tensor,
    /// Equivalent plastic strain, added up over the path.
    pub equivalent: f64,
    /// Back stresses with recall \[Pa\], with z into the body.
    pub back: [Tensor; BACK_STRESSES],
    /// Growth of the plastic strain in the last increment, from which the next one is guessed.
    pub growth: Tensor,
}

/// The plastic state of a body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlasticState {
    /// 1 or 2.
    pub body: usize,
    /// The points that have yielded.
    pub points: Vec<PlasticPoint>,
    /// Residual displacement u_x, u_y, u_z of the surface on the cells of the volume grid below the contact
    /// \[m\], one after the other, with z into the body.
    pub displacement: Vec<f64>,
    /// Its growth in the last increment \[m\].
    pub growth: Vec<f64>,
}

/// The plastic state after an increment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Yielded {
    /// States of the bodies that may yield.
    pub bodies: Vec<PlasticState>,
    /// Plastic work over the path \[J\].
    pub work: f64,
    /// Elastic energy of the residual stress \[J\].
    #[serde(default)]
    pub locked: f64,
    /// Volume that has yielded \[m^3\].
    pub volume: f64,
    /// Largest equivalent plastic strain of a point.
    pub largest: f64,
    /// Position of that point, if strains do not converge there.
    #[serde(default)]
    pub at_rim: Option<Rim>,
    /// Whether a point has yielded at the border of the volume grid.
    #[serde(default)]
    pub at_border: bool,
    /// Whether the volume grid has grown: it does once, when a point yields at its border.
    #[serde(default)]
    pub grown: bool,
}

/// A place where strains grow with every refinement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Rim {
    /// The uppermost element of a substrate, at the border of slip.
    Surface,
    /// A coating, at the rim of the contact.
    Coating,
}

impl Rim {
    /// Remark on a largest strain that lies there.
    pub const TOLD: &str = "the largest plastic strain lies at the border of slip or at the rim of a coating, where it grows \
        with every refinement. Judge the works, the volume and the strain below";
}
