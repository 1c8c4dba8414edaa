//! One body that yields.

use eigenstrain::{Answer, COMPONENTS, Mesh, Operator, Sources};
use plasticity::{
    Plastic, Point, Returned, Tensor, YIELDS, contraction, deviator, equivalent_stress,
};
use rayon::prelude::*;

use super::state::{PlasticPoint, PlasticState, Rim};
use super::volume::Volume;
use crate::error::Error;
use crate::scene::{Body, ResidualStress};

/// Largest change of the stress in a pass, over the yield stress, of a plastic strain that is taken.
pub(super) const TOLERANCE: f64 = 1e-4;
/// Largest change of the residual displacement in a pass, over its largest.
const DISPLACEMENT: f64 = 1e-4;
/// Scale of the displacements in the fixed point, beside strains: small enough that the strains decide
/// the mixing.
const SCALE: f64 = 0.3;
/// Part of the yield stress that a plane must reach in the first pass of an increment to be computed in
/// the others.
const NEAR: f64 = 0.75;
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
    /// Planes that may yield, and those of them that are computed in the present increment.
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
    /// That image on all cells.
    next_everywhere: Vec<f64>,
    stress: Vec<f64>,
    /// Tractions of the last pass, with z into the body \[Pa\].
    tractions: [Vec<f64>; 3],
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
    pub(super) fn new(number: usize, body: &Body, volume: &Volume) -> Result<Self, Error> {
        let mesh = volume.mesh(number, body)?;
        let law = |plane: usize| {
            let layer = mesh.layer(plane);
            let [_, mu] = mesh.layers()[layer].lame();
            body.plastic(layer).map(|law| (law, mu))
        };
        let laws: Vec<_> = (0..mesh.planes()).map(law).collect();
        let residual = ResidualStress::of(body);
        let initial = (0..mesh.planes()).map(|n| residual.at(mesh.layer(n), mesh.depth(n)));
        let initial = initial.collect();
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
            off: 0.0,
            reached: 0.0,
            laws,
            initial,
            operator,
        })
    }

    pub(super) fn mesh(&self) -> &Mesh {
        self.operator.mesh()
    }

    fn cells(&self) -> usize {
        self.mesh().cells.len()
    }

    /// Where a component of a point stands in the fields.
    fn at(&self, point: usize, component: usize) -> usize {
        let cells = self.cells();
        (point / cells * COMPONENTS + component) * cells + point % cells
    }

    /// The plane times cells plus cell of a point of a state; `None` beyond the grid.
    fn point(&self, known: &PlasticPoint) -> Option<usize> {
        let (plane, cell) = (known.plane as usize, self.volume.cell(known.cell)?);
        (plane < self.laws.len()).then(|| plane * self.cells() + cell)
    }

    /// The first point of a state that lies beyond the grid.
    pub(super) fn beyond<'a>(&self, state: &'a PlasticState) -> Option<&'a PlasticPoint> {
        let mut points = state.points.iter();
        points.find(|known| self.point(known).is_none())
    }

    /// From the state at the start of an increment.
    pub(super) fn begin(&mut self, state: Option<&PlasticState>) {
        for (point, ..) in std::mem::take(&mut self.active) {
            self.slot[point] = NONE;
            for c in 0..COMPONENTS {
                let at = self.at(point, c);
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
                flow: known.flow,
                back: known.back,
            };
            self.active.push((point, start, start.unchanged()));
            for c in 0..COMPONENTS {
                let at = self.at(point, c);
                self.strain[at] = known.strain[c];
            }
        }
    }

    /// A guess of x: the state at the start of the increment, grown by `factor` times the growth of the
    /// last one.
    pub(super) fn guess(&mut self, state: &PlasticState, factor: f64) {
        for (u, growth) in self.displacement.iter_mut().zip(&state.growth) {
            *u += factor * growth;
        }
        for known in &state.points {
            let Some(point) = self.point(known) else {
                continue;
            };
            for (c, growth) in known.growth.iter().enumerate() {
                let at = self.at(point, c);
                self.strain[at] += factor * growth;
            }
        }
    }

    /// One pass: stress, return, displacement. True where neither strain nor displacement would change
    /// beyond the tolerance.
    pub(super) fn pass(&mut self, tractions: &[Vec<f64>; 3]) -> bool {
        self.tractions = self.facing(tractions);
        self.respond();
        let found = self.returned();
        let reached = found.iter().map(|(_, most)| *most);
        self.reached = reached.fold(0.0, f64::max).sqrt();
        if !std::mem::replace(&mut self.passed, true) {
            for (wanted, (points, most)) in self.wanted.iter_mut().zip(&found) {
                *wanted = !points.is_empty() || *most > NEAR * NEAR;
            }
        }
        self.off = self.take(found);
        let largest = self
            .next_displacement
            .iter()
            .fold(0.0_f64, |m, u| m.max(u.abs()));
        let pairs = self.next_displacement.iter().zip(&self.displacement);
        let moved = pairs.fold(0.0_f64, |m, (to, from)| m.max((to - from).abs()));
        self.off <= TOLERANCE && moved <= DISPLACEMENT * largest
    }

    /// Whether a point yields on the planes that the last pass has left out, under its tractions and strain.
    /// Those planes are computed from then on.
    pub(super) fn others_yield(&mut self) -> bool {
        if self.computed == self.may_yield {
            return false;
        }
        let others: Vec<bool> = (self.may_yield.iter().zip(&self.computed))
            .map(|(may, computed)| *may && !computed)
            .collect();
        let wanted = std::mem::replace(&mut self.wanted, others);
        self.respond();
        let found = self.returned();
        self.wanted = wanted;
        for (wanted, (points, _)) in self.wanted.iter_mut().zip(&found) {
            *wanted |= !points.is_empty();
        }
        self.take(found) > TOLERANCE
    }

    /// What yields of each plane that is computed, and its largest stress over the yield stress, squared.
    fn returned(&self) -> Vec<(Vec<(usize, Returned)>, f64)> {
        let cells = self.cells();
        let (laws, stress, strain, slot, active) = (
            &self.laws,
            &self.stress,
            &self.strain,
            &self.slot,
            &self.active,
        );
        let block = COMPONENTS * cells;
        let (wanted, initial) = (&self.wanted, &self.initial);
        let of_plane = |plane: usize| -> (Vec<(usize, Returned)>, f64) {
            let (Some((law, mu)), true) = (&laws[plane], wanted[plane]) else {
                return (Vec::new(), 0.0);
            };
            let (stress, strain) = (
                &stress[plane * block..][..block],
                &strain[plane * block..][..block],
            );
            let slots = &slot[plane * cells..][..cells];
            let mut found = Vec::new();
            let (limit, mut most) = (law.s_y * (1.0 + YIELDS), 0.0_f64);
            for cell in 0..cells {
                let mut s: Tensor = std::array::from_fn(|c| stress[c * cells + cell]);
                s[0] += initial[plane][0];
                s[1] += initial[plane][1];
                if slots[cell] == NONE {
                    let s_dev = deviator(&s);
                    let square = 1.5 * contraction(&s_dev, &s_dev);
                    most = most.max(square);
                    if square > limit * limit {
                        found.push((plane * cells + cell, Point::default().at(law, *mu, &s)));
                    }
                    continue;
                }
                let (_, start, _) = &active[slots[cell] as usize];
                let trial = std::array::from_fn(|c| {
                    s[c] + 2.0 * mu * (strain[c * cells + cell] - start.strain[c])
                });
                let returned = start.at(law, *mu, &trial);
                if returned.flow != [0.0; COMPONENTS] {
                    most = most.max(law.s_y * law.s_y);
                }
                found.push((plane * cells + cell, returned));
            }
            (found, most / (law.s_y * law.s_y))
        };
        (0..laws.len()).into_par_iter().map(of_plane).collect()
    }

    /// Takes the returned points; gives the largest change of the stress over the yield stress.
    fn take(&mut self, found: Vec<(Vec<(usize, Returned)>, f64)>) -> f64 {
        let cells = self.cells();
        let mut off = 0.0_f64;
        for (point, returned) in found.into_iter().flat_map(|(points, _)| points) {
            if self.slot[point] == NONE {
                self.slot[point] = self.active.len() as u32;
                self.active.push((point, Point::default(), returned));
            }
            let slot = self.slot[point] as usize;
            self.active[slot].2 = returned;
            let change: Tensor =
                std::array::from_fn(|c| returned.strain[c] - self.strain[self.at(point, c)]);
            if let Some((law, mu)) = &self.laws[point / cells] {
                off = off.max(equivalent_stress(&change) * 2.0 * mu / law.s_y);
            }
        }
        off
    }

    /// Stress of the tractions and the present strain, displacement of the strain alone.
    fn respond(&mut self) {
        self.computed.clone_from(&self.wanted);
        let [x, y, z] = &self.tractions;
        let yields = !self.active.is_empty();
        self.operator.apply(
            Sources {
                eigenstrain: yields.then_some(&self.strain[..]),
                tractions: Some([x, y, z]),
            },
            Answer {
                stress: &mut self.stress,
                wanted: &self.wanted,
                displacement: &mut self.next_everywhere,
                of_tractions: false,
            },
        );
        self.volume
            .part_below_contact(&self.next_everywhere, &mut self.next_displacement);
    }

    /// Tractions on the body, with z into it: on body 1 the shear is the opposite.
    fn facing(&self, tractions: &[Vec<f64>; 3]) -> [Vec<f64>; 3] {
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

    /// Points that have yielded or may.
    pub(super) fn slots(&self) -> usize {
        self.active.len()
    }

    /// Growth of the strain in the increment, of x.
    pub(super) fn grown(&self) -> impl Iterator<Item = f64> {
        self.active.iter().flat_map(|(point, start, _)| {
            (0..COMPONENTS).map(|c| self.strain[self.at(*point, c)] - start.strain[c])
        })
    }

    /// The same of its image.
    pub(super) fn next_grown(&self) -> impl Iterator<Item = f64> {
        let grown = |(_, start, end): &(usize, Point, Returned)| -> [f64; COMPONENTS] {
            std::array::from_fn(|c| end.strain[c] - start.strain[c])
        };
        self.active.iter().flat_map(grown)
    }

    /// Displacement \[m\] over its unit in x.
    pub(super) fn scaled<'a>(
        &self,
        displacement: &'a [f64],
    ) -> impl Iterator<Item = f64> + use<'a> {
        let unit = self.unit();
        displacement.iter().map(move |u| u / unit)
    }

    /// Unit of the displacements in x \[m\]: the yield strain along the depth of the first element.
    fn unit(&self) -> f64 {
        let laws = self.laws.iter().flatten();
        let strain = laws
            .map(|(law, mu)| law.s_y / mu)
            .fold(f64::INFINITY, f64::min);
        let mesh = self.mesh();
        let planes = (0..mesh.planes()).filter(|plane| self.may_yield[*plane]);
        let height: f64 = planes.map(|plane| mesh.weight(plane)).sum();
        strain * height / SCALE
    }

    pub(super) fn take_displacement(&mut self, x: &[f64], from: usize) -> usize {
        let (unit, n) = (self.unit(), self.displacement.len());
        for (u, x) in self.displacement.iter_mut().zip(&x[from..from + n]) {
            *u = x * unit;
        }
        from + n
    }

    pub(super) fn take_strain(&mut self, x: &[f64], from: usize) -> usize {
        let n = COMPONENTS * self.active.len();
        for (slot, grown) in x[from..from + n].chunks_exact(COMPONENTS).enumerate() {
            let (point, start, _) = self.active[slot];
            for c in 0..COMPONENTS {
                let at = self.at(point, c);
                self.strain[at] = start.strain[c] + grown[c];
            }
        }
        from + n
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
                    flow: end.flow,
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

    /// Plastic work of the increment \[J\].
    pub(super) fn work(&self) -> f64 {
        let (mesh, cells) = (self.mesh(), self.cells());
        let of_point = |(point, start, end): &(usize, Point, Returned)| {
            let plane = point / cells;
            let Some((law, _)) = &self.laws[plane] else {
                return 0.0;
            };
            mesh.weight(plane) * start.work(law, end)
        };
        self.volume.cells.area() * self.active.iter().map(of_point).sum::<f64>()
    }

    /// Elastic energy of the residual stress \[J\] in the last pass, -1/2 int sigma_res : e dV. The
    /// stress is that of the tractions t, too, whose work on the strain is that on its displacement u[e]
    /// (Betti): 1/2 (sum t . u[e] dA - int sigma : e dV). A residual stress s_R before the first load is in
    /// balance without tractions, so that it adds -int s_R : e dV.
    pub(super) fn locked(&self) -> f64 {
        let cells = self.cells();
        let of_point = |(point, ..): &(usize, Point, Returned)| {
            let [stress, strain]: [Tensor; 2] = [&self.stress, &self.strain]
                .map(|field| std::array::from_fn(|c| field[self.at(*point, c)]));
            let [xx, yy] = self.initial[point / cells];
            let initial = xx * strain[0] + yy * strain[1];
            self.mesh().weight(point / cells) * (contraction(&stress, &strain) + 2.0 * initial)
        };
        let of_stress: f64 = self.active.iter().map(of_point).sum();
        let displaced = self.tractions.iter().flatten().zip(&self.next_everywhere);
        let of_tractions: f64 = displaced.map(|(t, u)| t * u).sum();
        0.5 * self.volume.cells.area() * (of_tractions - of_stress)
    }

    /// Volume of the points that have yielded \[m^3\].
    pub(super) fn plastic_volume(&self) -> f64 {
        let (mesh, cells) = (self.mesh(), self.cells());
        let yielded = self
            .active
            .iter()
            .filter(|(_, _, end)| end.equivalent > 0.0);
        self.volume.cells.area()
            * yielded
                .map(|(point, ..)| mesh.weight(point / cells))
                .sum::<f64>()
    }

    /// Whether a point has yielded in a cell at the border or on the lowest plane.
    pub(super) fn reaches_the_border(&self) -> bool {
        let (cells, planes) = (self.mesh().cells, self.mesh().planes());
        let ends = |i: usize, n: usize| i == 0 || i + 1 == n;
        self.active.iter().any(|(point, _, end)| {
            let (plane, cell) = (point / cells.len(), point % cells.len());
            let across = !cells.plane_strain && ends(cell % cells.ny, cells.ny);
            let beside = ends(cell / cells.ny, cells.nx) || across;
            end.equivalent > 0.0 && (beside || plane + 1 == planes)
        })
    }

    /// Largest equivalent plastic strain, and whether it lies at a rim.
    pub(super) fn largest(&self) -> Option<(f64, Option<Rim>)> {
        let (point, _, end) =
            (self.active.iter()).max_by(|a, b| a.2.equivalent.total_cmp(&b.2.equivalent))?;
        let (plane, mesh) = (point / self.cells(), self.mesh());
        let rim = if mesh.layer(plane) + 1 < mesh.layers().len() {
            Some(Rim::Coating)
        } else {
            (plane < eigenstrain::PLANES_PER_ELEMENT).then_some(Rim::Surface)
        };
        Some((end.equivalent, rim))
    }

    /// Largest inverse of the factor by which the stress of tractions grows, beside the residual stress, until
    /// a point yields, without plastic strain: that inverse, body, layer, depth \[m\]. Without residual stress it is
    /// the stress of von Mises over the yield stress.
    pub(super) fn nearest_to_yield(
        &mut self,
        tractions: &[Vec<f64>; 3],
    ) -> Option<(f64, usize, usize, f64)> {
        self.begin(None);
        self.tractions = self.facing(tractions);
        self.respond();
        let cells = self.cells();
        let of_plane = |plane: usize| {
            let (law, _) = self.laws[plane].as_ref()?;
            let of = &self.stress[plane * COMPONENTS * cells..][..COMPONENTS * cells];
            let [xx, yy] = self.initial[plane];
            let constant = deviator(&[xx, yy, 0.0, 0.0, 0.0, 0.0]);
            let reached = (0..cells).map(|cell| {
                let s: Tensor = std::array::from_fn(|c| of[c * cells + cell]);
                part_of_yield(&deviator(&s), &constant, law.s_y)
            });
            Some((reached.fold(0.0, f64::max), plane))
        };
        let planes = (0..self.laws.len()).filter_map(of_plane);
        let (ratio, plane) = planes.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let mesh = self.mesh();
        Some((ratio, self.number, mesh.layer(plane), mesh.depth(plane)))
    }

    /// Adds the residual stress before the first load to a stress on all planes \[Pa\].
    pub(super) fn add_initial(&self, stress: &mut [f64]) {
        let cells = self.cells();
        for (of_plane, initial) in stress
            .chunks_exact_mut(COMPONENTS * cells)
            .zip(&self.initial)
        {
            for (field, initial) in of_plane.chunks_exact_mut(cells).zip(initial) {
                for s in field.iter_mut() {
                    *s += initial;
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
        self.begin(state);
        let signed = tractions.map(|tractions| self.facing(tractions));
        let mut stress = vec![0.0; self.operator.len()];
        let mut everywhere = vec![0.0; self.next_everywhere.len()];
        let wanted = vec![true; self.may_yield.len()];
        let tractions = signed.as_ref().map(|[x, y, z]| [&x[..], &y[..], &z[..]]);
        self.operator.apply(
            Sources {
                eigenstrain: Some(&self.strain),
                tractions,
            },
            Answer {
                stress: &mut stress,
                wanted: &wanted,
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

/// 1/f of the factor f > 0 at which the deviator f s + constant has the stress of von Mises s_y; `constant`
/// lies within. 0 where none has.
fn part_of_yield(s: &Tensor, constant: &Tensor, s_y: f64) -> f64 {
    let a = 1.5 * contraction(s, s);
    let b = 1.5 * contraction(s, constant);
    let free = s_y * s_y - 1.5 * contraction(constant, constant);
    // a f^2 + 2 b f = free, with g = 1/f.
    if free > 0.0 {
        (b + (b * b + a * free).sqrt()) / free
    } else if b > 0.0 {
        f64::INFINITY
    } else {
        a / (-2.0 * b)
    }
}
