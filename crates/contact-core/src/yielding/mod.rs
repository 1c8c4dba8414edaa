//! BODIES THAT YIELD: plastic strain below the contact, and what it does to the surfaces.
//!
//! The plastic strain e of a body is an eigenstrain. It leaves a residual stress and a residual
//! displacement of the surface, which enter the contact as displacements without tractions
//! (`march::offsets`); the solver of the contact knows nothing else of it. Within an increment the pair
//! x = (e, residual displacement u) is the fixed point of
//!
//! ```text
//! contact with u  ->  p, q;      stress of (p, q, e), displacement of e  ->  radial return  ->  x'
//! ```
//!
//! mixed after Anderson. Both parts are mixed: a displacement that lags behind e is part of the state of
//! the iteration. The stress is computed by `eigenstrain` on a volume grid of its own ([`Volume`]), the
//! return by `plasticity`. Where nothing yields one pass is enough, and the contact equals the contact of
//! elastic bodies to the last bit.

mod anderson;
mod body;
mod resampled;
mod state;
mod volume;

use ndarray::Array2;

use self::anderson::Anderson;
use self::body::{TOLERANCE, YieldingBody};
pub use self::state::{PlasticPoint, PlasticState, Rim, Yielded};
pub(crate) use self::volume::volume_cells;
pub use self::volume::{Volume, mesh_of};
use crate::error::Error;
use crate::scene::Scene;

/// Excess over the yield stress that is no yielding in reverse.
const UNLOADS: f64 = 1e-2;
/// Most passes of an increment.
pub(crate) const MOST_PASSES: usize = 120;

/// Bodies that yield, at an increment.
#[derive(Debug)]
pub struct Yielding {
    volume: Volume,
    bodies: Vec<YieldingBody>,
    mixing: Anderson,
}

/// Displacements that the surfaces have without tractions, on the grid of the scene \[m\].
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// u(2) - u(1) along x and y.
    pub u: [Array2<f64>; 2],
    /// Growth of the gap.
    pub gap: Array2<f64>,
}

/// Residual stress at a depth.
pub(crate) struct Below {
    /// Body and layer.
    pub(crate) layer: [usize; 2],
    /// Depth \[m\].
    pub(crate) depth: f64,
    /// xx, yy, zz \[Pa\].
    pub(crate) stress: [f64; 3],
}

impl Yielding {
    /// Builds the bodies of a scene that may yield, on the chosen volume grid or on the one that it grows to;
    /// `None` where none does.
    pub fn from_scene(scene: &Scene, grown: bool) -> Result<Option<Self>, Error> {
        Self::on_cells(scene, volume_cells(scene.grid.plane_strain), grown)
    }

    /// Builds as [`Self::from_scene`] does, with at most `most` cells along a side before the grid grows.
    pub(crate) fn on_cells(scene: &Scene, most: usize, grown: bool) -> Result<Option<Self>, Error> {
        if !scene.yields() {
            return Ok(None);
        }
        let volume = Volume::choose(scene, most, grown);
        let bodies = [(1, &scene.body1), (2, &scene.body2)];
        let bodies = bodies.into_iter().filter(|(_, body)| body.yields());
        let bodies = bodies.map(|(number, body)| YieldingBody::new(number, body, &volume));
        Ok(Some(Self {
            bodies: bodies.collect::<Result<_, _>>()?,
            volume,
            mixing: Anderson::default(),
        }))
    }

    /// The volume grid.
    pub fn volume(&self) -> &Volume {
        &self.volume
    }

    /// Begins an increment from a state and its tractions p, q_x, q_y \[Pa\], with the plastic strain and
    /// displacement of its start.
    pub(crate) fn begin(&mut self, state: &Yielded, [p, q_x, q_y]: [&Array2<f64>; 3]) {
        self.mixing = Anderson::default();
        let tractions = [q_x, q_y, p].map(|field| self.volume.to_volume(field));
        for (n, body) in self.bodies.iter_mut().enumerate() {
            body.begin(state.bodies.get(n), &tractions);
            body.bulk = [0.0; 2];
        }
    }

    /// Sets the bulk stresses of body 1 and body 2 at the start and at the end of an increment that has begun
    /// \[Pa\].
    pub(crate) fn set_bulk(&mut self, start: [f64; 2], end: [f64; 2]) {
        for body in &mut self.bodies {
            body.bulk = [start, end].map(|bulk| bulk[body.number - 1]);
        }
    }

    /// Work of the bulk stresses on the plastic strain of the increment \[J\].
    pub(crate) fn work_of_bulk(&self) -> f64 {
        self.bodies.iter().map(YieldingBody::work_of_bulk).sum()
    }

    /// Guesses x where the path goes on, by `factor` of the last increment.
    pub(crate) fn guess(&mut self, state: &Yielded, factor: f64) {
        for (body, state) in self.bodies.iter_mut().zip(&state.bodies) {
            body.guess(state, factor);
        }
    }

    /// The residual displacement of the present x.
    pub(crate) fn residual(&self) -> Residual {
        let bodies = self.bodies.iter();
        self.together(&bodies.map(|body| (body.number, &body.displacement[..])))
    }

    /// The residual displacement of a state.
    pub fn residual_of(&self, state: &Yielded) -> Residual {
        let bodies = state.bodies.iter();
        self.together(&bodies.map(|body| (body.body, &body.displacement[..])))
    }

    /// Sums the displacements of the `bodies` (number, displacement with z into the body) to the residual
    /// displacement of the contact.
    fn together<'a>(
        &self,
        bodies: &(impl Iterator<Item = (usize, &'a [f64])> + Clone),
    ) -> Residual {
        let cells = self.volume.cells_below_contact();
        let sum = |component: usize, sign: f64| {
            let mut sum = vec![0.0; cells];
            for (number, displacement) in bodies.clone() {
                let sign = if number == 1 { sign } else { 1.0 };
                let component_field = &displacement[component * cells..(component + 1) * cells];
                for (sum, u) in sum.iter_mut().zip(component_field) {
                    *sum += sign * u;
                }
            }
            self.volume.to_contact(&sum)
        };
        // Both bodies are computed with z into them: normal displacements add.
        Residual {
            u: [sum(0, -1.0), sum(1, -1.0)],
            gap: sum(2, 1.0),
        }
    }

    /// Largest change of the stress in the last pass over the yield stress, and what is allowed.
    pub(crate) fn residuals(&self) -> (f64, f64) {
        let off = self.bodies.iter().map(|body| body.off);
        (off.fold(0.0, f64::max), TOLERANCE)
    }

    /// Largest stress of von Mises of the last pass over the yield stress there, 1 where a point yields.
    pub(crate) fn reached(&self) -> f64 {
        let reached = self.bodies.iter().map(|body| body.reached);
        reached.fold(0.0, f64::max).min(1.0)
    }

    /// One pass under the tractions p, q_x, q_y of the contact \[Pa\]: whether x is settled. Otherwise
    /// x is the next one to try.
    pub(crate) fn pass(&mut self, [p, q_x, q_y]: [&Array2<f64>; 3]) -> bool {
        let tractions = [q_x, q_y, p].map(|field| self.volume.to_volume(field));
        let mut settled = true;
        for body in &mut self.bodies {
            settled &= body.pass(&tractions);
        }
        if settled {
            // The planes that the increment has left out since its first pass yield neither.
            for body in &mut self.bodies {
                settled &= !body.others_yield();
            }
            if settled {
                return true;
            }
        }
        let bodies = self.bodies.iter();
        let mut x: Vec<f64> = bodies
            .clone()
            .flat_map(|b| b.scaled(&b.displacement))
            .collect();
        let mut to: Vec<f64> = bodies
            .flat_map(|b| b.scaled(&b.next_displacement))
            .collect();
        let displacements = x.len();
        let mut counts = Vec::new();
        for body in &self.bodies {
            counts.push(body.slots());
            x.extend(body.grown());
            to.extend(body.next_grown());
        }
        let mixed = self.mixing.mixed(&x, &to, displacements, &counts);
        let mut from = 0;
        for body in &mut self.bodies {
            from = body.take_displacement(&mixed, from);
        }
        for body in &mut self.bodies {
            from = body.take_strain(&mixed, from);
        }
        false
    }

    /// Ends the increment and returns the state with which the next one begins.
    pub(crate) fn commit(&self, before: &Yielded) -> Yielded {
        let bodies = self.bodies.iter().enumerate();
        let bodies: Vec<PlasticState> = bodies
            .map(|(n, body)| body.commit(before.bodies.get(n)))
            .collect();
        let strains = self.bodies.iter().filter_map(YieldingBody::largest);
        let largest = strains.max_by(|a, b| a.0.total_cmp(&b.0));
        let done: f64 = self.bodies.iter().map(YieldingBody::work).sum();
        Yielded {
            work: before.work + done,
            locked: self.bodies.iter().map(YieldingBody::locked).sum(),
            volume: self.bodies.iter().map(YieldingBody::plastic_volume).sum(),
            largest: largest.map_or(0.0, |(strain, _)| strain),
            at_border: self.bodies.iter().any(YieldingBody::reaches_the_border),
            at_rim: largest.and_then(|(_, rim)| rim),
            grown: self.volume.grown,
            bodies,
        }
    }

    /// The state before anything has yielded.
    pub(crate) fn unyielded(&self) -> Yielded {
        let cells = self.volume.cells_below_contact();
        let body = |body: &YieldingBody| PlasticState {
            body: body.number,
            points: Vec::new(),
            displacement: vec![0.0; 3 * cells],
            growth: vec![0.0; 3 * cells],
        };
        Yielded {
            bodies: self.bodies.iter().map(body).collect(),
            grown: self.volume.grown,
            ..Yielded::default()
        }
    }

    /// Stress under tractions, bulk stress, residual stress and plastic strain of a state in a body, on the planes
    /// of its mesh: for each plane six components on the cells of the volume grid \[Pa\], in the axes of the scene.
    pub fn stress(
        &mut self,
        state: &Yielded,
        tractions: Option<[&Array2<f64>; 3]>,
        (body, sigma_B): (usize, f64),
    ) -> Option<Vec<f64>> {
        let mut stress = self.stress_of_changes(state, tractions, body)?;
        let yielding_body = self.bodies.iter().find(|b| b.number == body)?;
        yielding_body.add_uniform(&mut stress, sigma_B);
        Some(stress)
    }

    /// Builds the bodies without the residual stress before the first load.
    pub fn stress_of_changes(
        &mut self,
        state: &Yielded,
        tractions: Option<[&Array2<f64>; 3]>,
        body: usize,
    ) -> Option<Vec<f64>> {
        let tractions =
            tractions.map(|[p, q_x, q_y]| [q_x, q_y, p].map(|field| self.volume.to_volume(field)));
        let yielding_body = self.bodies.iter_mut().find(|b| b.number == body)?;
        let state = state.bodies.iter().find(|state| state.body == body);
        Some(yielding_body.response(state, tractions.as_ref()).0)
    }

    /// The points of a body that have yielded in a state, with plane and cell of the volume grid; their strain
    /// in the axes of the scene.
    pub fn points(&self, state: &Yielded, body: usize) -> Vec<(usize, usize, PlasticPoint)> {
        let states = state.bodies.iter().filter(|known| known.body == body);
        let points = states.flat_map(|known| &known.points).filter_map(|point| {
            let mut seen = *point;
            if body == 1 {
                // z points into body 2.
                seen.strain[4] = -seen.strain[4];
                seen.strain[5] = -seen.strain[5];
            }
            Some((point.plane as usize, self.volume.cell(point.cell)?, seen))
        });
        points.collect()
    }

    /// Residual stress of a state on every plane below the middle of the grid.
    pub(crate) fn below_the_middle(&mut self, state: &Yielded) -> Vec<Below> {
        let cells = self.volume.cells;
        // The middle of an even number of cells lies between two of them.
        let around = |n: usize| [(n - 1) / 2, n / 2];
        let near: Vec<usize> = (around(cells.nx).iter())
            .flat_map(|i| around(cells.ny).map(|j| i * cells.ny + j))
            .collect();
        let mut planes = Vec::new();
        for body in &mut self.bodies {
            let of_body = state.bodies.iter().find(|known| known.body == body.number);
            let (stress, _) = body.response(of_body, None);
            let mesh = body.mesh();
            planes.extend((0..mesh.planes()).map(|plane| {
                let mean = |c: usize| {
                    let field = &stress[(plane * eigenstrain::COMPONENTS + c) * cells.len()..];
                    near.iter().map(|cell| field[*cell]).sum::<f64>() / near.len() as f64
                };
                Below {
                    layer: [body.number, mesh.layer(plane)],
                    depth: mesh.depth(plane),
                    stress: [0, 1, 2].map(mean),
                }
            }));
        }
        planes
    }

    /// A state with the residual displacements of its plastic strain, from one that has the strain
    /// alone.
    pub fn completed(&mut self, state: &Yielded) -> Yielded {
        let bodies = self.bodies.iter_mut().map(|body| {
            let state_of_body = state.bodies.iter().find(|known| known.body == body.number);
            PlasticState {
                body: body.number,
                points: state_of_body.map_or_else(Vec::new, |known| known.points.clone()),
                displacement: body.response(state_of_body, None).1,
                growth: Vec::new(),
            }
        });
        Yielded {
            bodies: bodies.collect(),
            ..state.clone()
        }
    }

    /// Whether the stress of a state after unloading stays below the yield stress everywhere, by at least a
    /// hundredth.
    pub fn unloads_elastically(&mut self, state: &Yielded) -> bool {
        let whole = self.completed(state);
        let none = Array2::zeros((self.volume.grid().nx, self.volume.grid().ny));
        self.begin(&whole, [&none; 3]);
        self.pass([&none; 3]);
        self.residuals().0 < UNLOADS
    }

    /// Whether a state is one of the grid that has grown: a point lies beyond this one or at its border.
    pub fn outgrown_by(&self, state: &Yielded) -> bool {
        let is_outgrown = |known: &PlasticState| {
            let yielding_body = self.bodies.iter().find(|body| body.number == known.body);
            yielding_body.map_or(!known.points.is_empty(), |body| body.outgrown_by(known))
        };
        state.bodies.iter().any(is_outgrown)
    }

    /// Fails where a state has points beyond the volume grid.
    pub fn check(&self, state: &Yielded) -> Result<(), Error> {
        for known in &state.bodies {
            let yielding_body = self.bodies.iter().find(|body| body.number == known.body);
            let beyond = match yielding_body {
                Some(body) => body.first_point_beyond(known),
                None => known.points.first(),
            };
            if let Some(point) = beyond {
                let planes = yielding_body.map_or(0, |body| body.mesh().planes());
                let cells = self.volume.cells;
                let message = format!("plane {}, cell {}", point.plane, point.cell);
                let allowed = format!(
                    "within {planes} planes of {} x {} cells, the volume grid of its scene: solve it again",
                    cells.nx, cells.ny
                );
                return Err(Error::invalid("plastic strain", message, allowed));
            }
        }
        Ok(())
    }

    /// Point where the stress of von Mises under tractions is largest over the yield stress, before anything has
    /// yielded: that ratio, body, layer, depth \[m\].
    pub(crate) fn nearest_to_yield(
        &mut self,
        [p, q_x, q_y]: [&Array2<f64>; 3],
    ) -> Option<(f64, usize, usize, f64)> {
        let tractions = [q_x, q_y, p].map(|field| self.volume.to_volume(field));
        let bodies = self.bodies.iter_mut();
        let places = bodies.filter_map(|body| body.nearest_to_yield(&tractions));
        places.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The mesh of a body that yields.
    pub fn mesh(&self, body: usize) -> Option<&eigenstrain::Mesh> {
        let yielding_body = self.bodies.iter().find(|b| b.number == body);
        yielding_body.map(YieldingBody::mesh)
    }
}
