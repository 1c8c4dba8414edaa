//! Memory that the answers about a result share, which `fret check` announces.

use contact_assess::{MOST_CONTINUATIONS, MOST_HISTORIES, MOST_MOMENTS, MOST_POINTS};
use contact_core::Scene;
use contact_core::scene::Body;
use contact_subsurface::default_depths;
use serde_json::{Value, json};

/// Bytes of the six components of stress at a point.
const STRESS: f64 = 48.0;
/// Sections of a cycle: along the shear and across it.
const SECTIONS: f64 = 2.0;
/// Bytes per cell and increment of prepared points, on the cells and on larger ones.
const POINTS: f64 = 45.0;
/// Bytes per cell and increment of tractions, on the cells and on larger ones.
const MOMENTS: f64 = 38.0;
/// Bytes per cell of a section and increment of the tractions within the cells, eleven rows of them.
const CONTINUATIONS: f64 = 2.0 * 11.0 * 120.0;
/// Bytes per cell and increment of a section of a study: its tractions.
const FIELDS: f64 = 25.0;
/// Measured memory over these sums: 0.7 to 1 on 64 x 64 and 128 x 128 cells.
const MARGIN: f64 = 1.2;
/// Most memory of the sections that the stress measures of a study share \[bytes\]: the constant
/// `SHARED_SECTIONS` of the package. A section takes four times its stress: labels, measures, rims.
const MOST_SECTIONS: f64 = 128e6;
const COPIES: f64 = 4.0;
/// Most memory of the kernels of many depths below layers \[bytes\].
const MOST_KERNELS: f64 = 101e6;

/// Memory of the answers about a result whose increments have all kept their fields \[bytes\].
pub(crate) struct AnswerMemory {
    /// Stress of a cycle: lives, load factors.
    cycle: f64,
    /// Sections of all increments: largest stresses of a study.
    sections: f64,
    /// Kernels of the depths of layered bodies.
    kernels: f64,
}

impl AnswerMemory {
    /// Estimates the memory of a stress computation below a result of so many increments; `None` if the size of
    /// the contact is not known before.
    pub(crate) fn estimate(scene: &Scene, increments: usize) -> Option<Self> {
        let a = scene.hertz()?.a;
        let depths = |body: &Body| {
            if body.substrate.is_rigid() {
                return 0;
            }
            default_depths(body, a, 2.0 * a, 1.0).map_or(0, |depths| depths.len())
        };
        let depths = depths(&scene.body1).max(depths(&scene.body2)) as f64;
        let grid = &scene.grid;
        let cells = (grid.nx * grid.ny) as f64;
        let places = grid.nx.max(grid.ny) as f64;
        let count = increments as f64;
        let section = STRESS * depths * places;
        let shared = [
            (SECTIONS * count * section, MOST_HISTORIES),
            (POINTS * count * cells, MOST_POINTS),
            (MOMENTS * count * cells, MOST_MOMENTS),
            (
                SECTIONS * CONTINUATIONS * count * places,
                MOST_CONTINUATIONS,
            ),
        ];
        let layered = !(scene.body1.coatings.is_empty() && scene.body2.coatings.is_empty());
        Some(Self {
            cycle: MARGIN
                * shared
                    .map(|(size, most)| size.min(most as f64))
                    .iter()
                    .sum::<f64>(),
            sections: (COPIES * count * section + FIELDS * count * cells).min(MOST_SECTIONS),
            kernels: if layered { MOST_KERNELS } else { 0.0 },
        })
    }

    /// Lines of text on the memory that is kept for answers of each kind.
    pub(crate) fn describe(&self) -> Vec<String> {
        let megabytes = |bytes: f64| format!("about {:.0} MB", bytes / 1e6);
        let mut lines = vec![
            format!(
                "lives, load factors: the stress of one cycle and body is computed once and shared, {}",
                megabytes(self.cycle)
            ),
            "largest values: the section of one state and body is sampled once and shared by all questions; \
             its search up to 256 x 256 cells"
                .into(),
            "cracks: the contact of one cycle and body is prepared once and shared, at most 128 MB"
                .into(),
            format!(
                "largest stresses of a study: the sections are sampled once and shared, {}",
                megabytes(self.sections)
            ),
        ];
        if self.kernels > 0.0 {
            lines.push(format!(
                "all: kernels of the depths of layers are kept, at most {:.0} MB",
                self.kernels / 1e6
            ));
        }
        lines
    }

    /// The numbers \[bytes\].
    pub(crate) fn to_json(&self) -> Value {
        json!({ "cycle": self.cycle, "sections": self.sections, "kernels": self.kernels })
    }
}
