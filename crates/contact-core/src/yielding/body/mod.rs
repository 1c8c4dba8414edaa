//! One body that yields.

mod outcome;
mod pass;
mod unknowns;

use eigenstrain::{Answer, COMPONENTS, Mesh, Operator, Sources};
use plasticity::{Plastic, Point, Returned, Tensor};

use super::state::{PlasticPoint, PlasticState};
use super::volume::Volume;
use crate::error::Error;
use crate::scene::{Body, ResidualStress};

/// Largest change of the stress in a pass, over the yield stress, of a plastic strain that is taken.
pub(super) const TOLERANCE: f64 = 1e-4;
/// No slot.
const NONE: u32 = u32::MAX;

/// A body that yields: its response, and its points that have yielded or may.
#[derive(Debug)]
pub(super) struct YieldingBody {
    pub(super) number: usize,
    volume: Volume,
    operator: Operator,
    /// Law and shear modulus of each plane \[Pa\].
    laws: Vec<Option<(Plastic, f64)>>,
    /// Residual stress s_xx, s_yy of each plane before the first load \[Pa\].
    initial: Vec<[f64; 2]>,
    /// Stress s_xx, s_yy, s_xy of each plane under the bulk stress 1, and the bulk stress at the start and at the
    /// end of the increment \[Pa\].
    bulk_course: Vec<[f64; 3]>,
    pub(super) bulk: [f64; 2],
    /// Planes that may yield, and the planes that are computed in the present increment.
    may_yield: Vec<bool>,
    wanted: Vec<bool>,
    /// Planes that the last pass has computed.
    computed: Vec<bool>,
    /// Whether the increment has had a pass.
    passed: bool,
    /// Plastic strain of the present x, as `operator` takes it.
    strain: Vec<f64>,
    /// Residual displacement of the present x below the contact, and its image.
    pub(super) displacement: Vec<f64>,
    pub(super) next_displacement: Vec<f64>,
    /// The image on all cells.
    next_everywhere: Vec<f64>,
    stress: Vec<f64>,
    /// Tractions of the last pass, with z into the body \[Pa\].
    tractions: [Vec<f64>; 3],
    /// Tractions at the start of the increment, with z into the body \[Pa\].
    start_tractions: [Vec<f64>; 3],
    /// Stress at the start of the increment on the planes that may yield; empty until a point yields.
    start_stress: Vec<f64>,
    /// Largest change of the stress in the last pass, over the yield stress.
    pub(super) off: f64,
    /// Largest stress of von Mises in the last pass over the yield stress, of points that have not
    /// yielded; above 1 where a point yields.
    pub(super) reached: f64,
    /// Slot of each point of the planes and cells.
    slot: Vec<u32>,
    /// Point (plane times cells plus cell), its state at the start of the increment and the returned one.
    active: Vec<(usize, Point, Returned)>,
}

impl YieldingBody {
    /// Builds a body (its `number` is 1 or 2) that may yield, on a volume grid: mesh, laws of each plane,
    /// residual stress.
    pub(super) fn new(number: usize, body: &Body, volume: &Volume) -> Result<Self, Error> {
        let mesh = volume.mesh(number, body)?;
        let law = |plane: usize| {
            let layer = mesh.layer(plane);
            let [_, mu] = mesh.layers()[layer].lame();
            body.plastic(layer).map(|law| (law, mu))
        };
        let laws: Vec<_> = (0..mesh.planes()).map(law).collect();
        let residual = ResidualStress::from_body(body);
        let initial = (0..mesh.planes()).map(|n| residual.stress_at(mesh.layer(n), mesh.depth(n)));
        let initial = initial.collect();
        let plane_strain = volume.cells.plane_strain;
        let bulk_course = (0..mesh.planes())
            .map(|n| body.bulk_stress(1.0, plane_strain, (mesh.layer(n), mesh.depth(n))))
            .collect();
        let cells = volume.cells.len();
        let operator = Operator::new(mesh);
        let may_yield: Vec<bool> = laws.iter().map(Option::is_some).collect();
        Ok(Self {
            number,
            volume: volume.clone(),
            wanted: may_yield.clone(),
            computed: Vec::new(),
            may_yield,
            passed: false,
            strain: vec![0.0; operator.len()],
            stress: vec![0.0; operator.len()],
            displacement: vec![0.0; 3 * volume.cells_below_contact()],
            next_displacement: vec![0.0; 3 * volume.cells_below_contact()],
            next_everywhere: vec![0.0; 3 * cells],
            slot: vec![NONE; laws.len() * cells],
            active: Vec::new(),
            tractions: Default::default(),
            start_tractions: Default::default(),
            start_stress: Vec::new(),
            off: 0.0,
            reached: 0.0,
            laws,
            initial,
            bulk_course,
            bulk: [0.0; 2],
            operator,
        })
    }

    /// The mesh of the body.
    pub(super) fn mesh(&self) -> &Mesh {
        self.operator.mesh()
    }

    /// Cells of a plane of the mesh.
    fn cells(&self) -> usize {
        self.mesh().cells.len()
    }

    /// Index of a component of a point in the fields.
    fn index_of_component(&self, point: usize, component: usize) -> usize {
        let cells = self.cells();
        (point / cells * COMPONENTS + component) * cells + point % cells
    }

    /// Index (plane times cells plus cell) of a yielded point of a state; `None` beyond the grid.
    fn point(&self, known: &PlasticPoint) -> Option<usize> {
        let (plane, cell) = (known.plane as usize, self.volume.cell(known.cell)?);
        (plane < self.laws.len()).then(|| plane * self.cells() + cell)
    }

    /// The first point of a state that lies beyond the grid.
    pub(super) fn first_point_beyond<'a>(
        &self,
        state: &'a PlasticState,
    ) -> Option<&'a PlasticPoint> {
        let mut points = state.points.iter();
        points.find(|known| self.point(known).is_none())
    }

    /// Whether a point of a state lies beyond the border or at it.
    pub(super) fn outgrown_by(&self, state: &PlasticState) -> bool {
        let mut points = state.points.iter();
        points.any(|known| self.point(known).is_none_or(|point| self.at_border(point)))
    }

    /// Starts from the state at the start of an increment and its tractions, with z into body 2 \[Pa\].
    pub(super) fn begin(&mut self, state: Option<&PlasticState>, tractions: &[Vec<f64>; 3]) {
        self.start_tractions = self.tractions_on_body(tractions);
        self.start_stress.clear();
        for (point, ..) in std::mem::take(&mut self.active) {
            self.slot[point] = NONE;
            for c in 0..COMPONENTS {
                let at = self.index_of_component(point, c);
                self.strain[at] = 0.0;
            }
        }
        self.displacement.fill(0.0);
        self.wanted.clone_from(&self.may_yield);
        self.passed = false;
        let Some(state) = state else { return };
        if state.displacement.len() == self.displacement.len() {
            self.displacement.copy_from_slice(&state.displacement);
        }
        for known in &state.points {
            let Some(point) = self.point(known) else {
                continue;
            };
            self.slot[point] = self.active.len() as u32;
            let start = Point {
                strain: known.strain,
                equivalent: known.equivalent,
                back: known.back,
            };
            self.active.push((point, start, start.unchanged()));
            for c in 0..COMPONENTS {
                let at = self.index_of_component(point, c);
                self.strain[at] = known.strain[c];
            }
        }
    }

    /// The tractions on this body, with z into it: body 1 gets the opposite shear.
    fn tractions_on_body(&self, tractions: &[Vec<f64>; 3]) -> [Vec<f64>; 3] {
        let mut signed = tractions.clone();
        if self.number == 1 {
            for q in &mut signed[..2] {
                for q in q.iter_mut() {
                    *q = -*q;
                }
            }
        }
        signed
    }

    /// The state at the end of the increment: the returned strain of the last pass.
    pub(super) fn commit(&self, before: Option<&PlasticState>) -> PlasticState {
        let cells = self.cells();
        let points = self
            .active
            .iter()
            .filter(|(_, _, end)| end.equivalent > 0.0);
        PlasticState {
            body: self.number,
            points: points
                .map(|(point, start, end)| PlasticPoint {
                    plane: (point / cells) as u32,
                    cell: self.volume.of_largest(point % cells),
                    strain: end.strain,
                    equivalent: end.equivalent,
                    back: end.back,
                    growth: std::array::from_fn(|c| end.strain[c] - start.strain[c]),
                })
                .collect(),
            displacement: self.displacement.clone(),
            growth: match before {
                Some(before) => {
                    let pairs = self.displacement.iter().zip(&before.displacement);
                    pairs.map(|(now, before)| now - before).collect()
                }
                None => self.displacement.clone(),
            },
        }
    }

    /// The stress of a plane that does not depend on the tractions \[Pa\]: the residual stress before the first
    /// load, and the bulk stress where it is `bulk` at the surface.
    fn uniform_stress(&self, plane: usize, bulk: f64) -> Tensor {
        let ([xx, yy], course) = (self.initial[plane], self.bulk_course[plane]);
        [
            xx + bulk * course[0],
            yy + bulk * course[1],
            0.0,
            bulk * course[2],
            0.0,
            0.0,
        ]
    }

    /// Adds the residual stress before the first load and a bulk stress to a stress on all planes \[Pa\].
    pub(super) fn add_uniform(&self, stress: &mut [f64], bulk: f64) {
        let cells = self.cells();
        for (plane, of_plane) in stress.chunks_exact_mut(COMPONENTS * cells).enumerate() {
            let uniform = self.uniform_stress(plane, bulk);
            for (field, uniform) in of_plane.chunks_exact_mut(cells).zip(uniform) {
                for s in field.iter_mut() {
                    *s += uniform;
                }
            }
        }
    }

    /// Stress of a state on all planes, in the axes of the scene \[Pa\], and displacement of the surface by
    /// its plastic strain, with z into the body \[m\].
    pub(super) fn response(
        &mut self,
        state: Option<&PlasticState>,
        tractions: Option<&[Vec<f64>; 3]>,
    ) -> (Vec<f64>, Vec<f64>) {
        self.begin(state, &Default::default());
        let signed = tractions.map(|tractions| self.tractions_on_body(tractions));
        let mut stress = vec![0.0; self.operator.len()];
        let mut everywhere = vec![0.0; self.next_everywhere.len()];
        let is_computed = vec![true; self.may_yield.len()];
        let tractions = signed.as_ref().map(|[x, y, z]| [&x[..], &y[..], &z[..]]);
        self.operator.apply(
            Sources {
                eigenstrain: Some(&self.strain),
                tractions,
            },
            Answer {
                stress: &mut stress,
                wanted: &is_computed,
                displacement: &mut everywhere,
                of_tractions: false,
            },
        );
        let mut displacement = vec![0.0; self.displacement.len()];
        self.volume
            .part_below_contact(&everywhere, &mut displacement);
        if self.number == 1 {
            let cells = self.cells();
            for (n, field) in stress.chunks_exact_mut(cells).enumerate() {
                if n % COMPONENTS >= 4 {
                    for s in field.iter_mut() {
                        *s = -*s;
                    }
                }
            }
        }
        (stress, displacement)
    }
}
