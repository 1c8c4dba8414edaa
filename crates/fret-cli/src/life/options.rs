//! Options of `fret life`.

use std::path::PathBuf;

use clap::Args;
use contact_assess::Averaging;
use fatigue::CRITERIA;

use crate::quantity::{length, stress};

/// Options of `fret life`.
#[derive(Args)]
pub(crate) struct Options {
    /// Result store of `fret run`, the increments of its cycle kept
    pub(super) store: PathBuf,
    /// Name of the material, or one for each layer from the surface down, with commas; 'none'
    /// leaves a layer out. A single name is the substrate (default: the only one of
    /// --materials)
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(super) material: Vec<String>,
    /// Table of materials (TOML)
    #[arg(long, value_name = "FILE")]
    pub(super) materials: Option<PathBuf>,
    /// Criterion, or several with commas, judged by the same stress
    #[arg(long, required = true, value_delimiter = ',', value_name = "CRITERIA",
          value_parser = CRITERIA.iter().map(|c| c.name).collect::<Vec<_>>())]
    pub(super) criterion: Vec<String>,
    /// Body below (2) or above (1) the contact plane
    #[arg(long, default_value = "2", value_parser = clap::value_parser!(u8).range(1..=2))]
    pub(super) body: u8,
    /// Section along x at this y [m, or with a unit] (default: the section along the shear through the centre
    /// of the largest contact of the cycle, and the one across it unless a round contact is sheared
    /// along one line)
    #[arg(
        long,
        value_name = "Y",
        value_parser = length,
        allow_hyphen_values = true,
        conflicts_with = "along_y"
    )]
    pub(super) along_x: Option<f64>,
    /// Section along y at this x [m, or with a unit]
    #[arg(long, value_name = "X", value_parser = length, allow_hyphen_values = true)]
    pub(super) along_y: Option<f64>,
    /// Depths [m, or with a unit] (default: as the layers ask)
    #[arg(long, value_name = "Z", value_delimiter = ',', value_parser = length)]
    pub(super) depths: Vec<f64>,
    /// Closed cycle of the load path, from 0; negative from the end
    #[arg(long, default_value = "-1", allow_hyphen_values = true)]
    pub(super) cycle: i64,
    /// Residual stress of each layer from the surface down, the substrate's last [Pa, or with a unit], tension
    /// positive; write --residual=-1e9,0 if the first is negative
    #[arg(
        long,
        value_name = "STRESSES",
        value_parser = stress,
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub(super) residual: Vec<f64>,
    /// Judge the mean stress over this critical distance from the top of a layer [m, or with a unit]
    /// (default: the range from the mean over the critical distance of the material, where it has
    /// one, beside the value at the worst point)
    #[arg(long, value_name = "L", value_parser = length)]
    pub(super) distance: Option<f64>,
    /// Region of the average: the point at the depth L/2, the line down to 2 L, the half disc or
    /// the half ball of radius L
    #[arg(long, default_value = "line", requires = "distance",
          value_parser = Averaging::ALL.map(|(name, _)| name).to_vec())]
    pub(super) method: String,
    /// Layer that the distance lies in, from the surface down and from 0: coating 1 is 0 (default:
    /// the outermost with a material)
    #[arg(long, value_name = "N", requires = "distance")]
    pub(super) layer: Option<usize>,
    /// Life, or strength, that 90 % of the specimens reach less than over that which 10 % do
    /// (default: 3 for lives and 1.2 for strengths, 5 and 1.5 where numbers of the material are
    /// estimates)
    #[arg(long, value_name = "FACTOR")]
    pub(super) scatter: Option<f64>,
    /// Print one JSON object per layer, for programs; an endless life is null
    #[arg(long)]
    pub(super) json: bool,
    /// Table to write (.csv): a line for each point of the first section, or with --distance for
    /// the mean below each place, z the top of the layer. Several criteria stand below each other,
    /// named in the first column
    #[arg(short, long, value_name = "FILE")]
    pub(super) out: Option<PathBuf>,
}
