//! A fatigue criterion applied to layers.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::digits::short;
use contact_core::error::Raised;
use contact_core::scene::Body;
use contact_subsurface::{CycleSource, Line, plastic_growth};
use fatigue::{Assessment, Criterion, History, Material, PointResult, Search, evaluate};

use super::judged::Judge;

/// Relative difference between the elastic constants of the material and of the scene above which a
/// note is added.
const NOTABLE_DIFFERENCE: f64 = 0.05;

/// A criterion with the numbers of the material of every layer.
#[derive(Clone, Debug)]
pub struct CriterionJudge {
    /// Assessment of every layer from the surface down, the substrate last; `None` for a layer that
    /// is not judged.
    pub assessments: Vec<Option<Assessment>>,
    /// Settings of the search for the critical plane.
    pub search: Search,
    /// Notes for the reader: materials whose elastic constants differ from the scene.
    pub notes: Vec<String>,
}

impl CriterionJudge {
    /// Looks up a criterion for the materials of the layers of a body. Elastic strains follow from
    /// the stress by the E and nu of the scene.
    pub fn new(
        name: &str,
        body: &Body,
        materials: &[Option<Material>],
        search: Search,
    ) -> Result<Self, Error> {
        let mut notes = Vec::new();
        let mut assessments = Vec::new();
        for (layer, material) in materials.iter().enumerate() {
            let Some(material) = material else {
                assessments.push(None);
                continue;
            };
            let coating = body.coatings.get(layer);
            let elastic = coating.map_or(body.substrate, |coating| coating.material);
            let mut assessment = Assessment::from_name(name, material).map_err(from_fatigue)?;
            for (number, value, digits) in [("E", elastic.E, 1e-9), ("nu", elastic.nu, 1.0)] {
                let enters = assessment.criterion.number(number).is_some();
                let own_value = material.number(number).unwrap_or(value);
                // Another E is another material; another nu matters where the criterion has it.
                if (enters || number == "E")
                    && (own_value - value).abs() > NOTABLE_DIFFERENCE * value.abs()
                {
                    let unit = if number == "E" { " GPa" } else { "" };
                    notes.push(format!(
                        "{}: the scene has {number} = {}{unit}, `{}` has {}{unit}. Stresses and strains use \
                         the numbers of the scene, strengths the numbers of `{}`",
                        body.layer_name(layer),
                        short(digits * value),
                        material.name,
                        short(digits * own_value),
                        material.name,
                    ));
                }
                if enters {
                    let changed = assessment.criterion.with_number(number, value);
                    assessment.criterion = changed.map_err(from_fatigue)?;
                }
            }
            assessments.push(Some(assessment));
        }
        Ok(Self {
            assessments,
            search,
            notes,
        })
    }

    /// [`Self::notes`], and notes on numbers of the materials without a source.
    pub fn notes_on_materials(&self, materials: &[Option<Material>]) -> Result<Vec<String>, Error> {
        let mut notes = self.notes.clone();
        for (assessment, material) in self.assessments.iter().zip(materials) {
            if let Some(assessment) = assessment {
                let (_, note) = assessment
                    .scatter(material.as_ref(), None)
                    .map_err(from_fatigue)?;
                notes.extend(note);
            }
        }
        Ok(notes)
    }

    /// The assessment of a layer, if it is judged.
    pub fn assessment(&self, layer: usize) -> Option<&Assessment> {
        self.assessments.get(layer).and_then(Option::as_ref)
    }
}

impl Judge for CriterionJudge {
    type Judgement = PointResult;

    /// Whether the layer has a material for the criterion.
    fn judges(&self, layer: usize) -> bool {
        self.assessment(layer).is_some()
    }

    /// Evaluates the criterion on the histories of points in a layer; the depths do not matter.
    fn judge(
        &self,
        layer: usize,
        _: &[f64],
        history: &History<'_>,
        stop: &AtomicBool,
    ) -> Result<Vec<PointResult>, Error> {
        let Some(assessment) = self.assessment(layer) else {
            return Ok(Vec::new());
        };
        evaluate(&assessment.criterion, history, &self.search, stop).map_err(from_fatigue)
    }

    /// Whether the criterion of any layer takes plastic strain.
    fn takes_strain(&self) -> bool {
        let mut criteria = self
            .assessments
            .iter()
            .flatten()
            .map(|assessment| &assessment.criterion);
        criteria.any(Criterion::takes_strain)
    }

    /// Rejects a cycle with growing plastic strain for criteria of strain: their lives hold for
    /// closed loops.
    fn accepts(&self, cycle: &dyn CycleSource) -> Result<(), Error> {
        let mut criteria = self
            .assessments
            .iter()
            .flatten()
            .map(|yielding| &yielding.criterion);
        let Some(strained) = criteria.find(|criterion| criterion.takes_strain()) else {
            return Ok(());
        };
        if !cycle.yielding()?.is_some_and(|yielding| yielding.grows()) {
            return Ok(());
        }
        let yielding = plastic_growth(cycle)?;
        if !yielding.ratchets() {
            return Ok(());
        }
        let allowed = format!(
            "a criterion of stress such as dang_van, or a later cycle whose strain closes: go on for more cycles. \
             This one ratchets. It adds up a plastic strain of {:.2e} and keeps {:.2e}, and lives of strain are \
             for closed loops",
            yielding.added, yielding.net
        );
        Err(Error::invalid("criterion", strained.name(), allowed))
    }

    /// The value of the criterion: the larger, the worse.
    fn score(&self, found: &PointResult) -> f64 {
        found.value
    }
}

/// Converts an error of the crate fatigue.
pub fn from_fatigue(error: fatigue::Error) -> Error {
    match error {
        fatigue::Error::Stopped => Error::Interrupted { increment: 0 },
        error => Error::Other(Raised(Arc::new(error))),
    }
}

/// The material of every layer, given from the surface down. A single material is the substrate's.
pub fn layer_materials(
    body: &Body,
    given: Vec<Option<Material>>,
) -> Result<Vec<Option<Material>>, Error> {
    let layers = body.coatings.len() + 1;
    let mut materials = given;
    if materials.len() == 1 {
        let mut coatings = vec![None; layers - 1];
        coatings.append(&mut materials);
        materials = coatings;
    }
    if materials.len() != layers {
        let allowed = format!(
            "one, the substrate's, or one for each of the {layers} layers from the surface down"
        );
        return Err(Error::invalid("materials", materials.len(), allowed));
    }
    if materials.iter().all(Option::is_none) {
        let allowed = "at least one that is a material: nothing is judged";
        return Err(Error::invalid("materials", "none", allowed));
    }
    Ok(materials)
}

/// Angle from the surface normal, into the body, to the trace of a plane of this normal in a
/// section \[rad\]: positive where the trace leans towards the end of the line with depth. NaN
/// where the plane is the section.
pub fn inclination(normal: [f64; 3], line: Line) -> f64 {
    let [cos, sin] = line.direction();
    let along = cos * normal[0] + sin * normal[1];
    if along.hypot(normal[2]) < 1e-9 {
        return f64::NAN;
    }
    // (n_z, -n_along) lies in the plane; downwards.
    let sign = if along > 0.0 { -1.0 } else { 1.0 };
    (sign * normal[2]).atan2(along.abs())
}
