//! Results of an increment: works, volume, largest strain, distance from yield.

use eigenstrain::COMPONENTS;
use plasticity::{Point, Returned, Tensor, contraction, deviator};

use super::YieldingBody;
use crate::yielding::state::Rim;

impl YieldingBody {
    /// Plastic work of the increment \[J\].
    pub(in crate::yielding) fn work(&self) -> f64 {
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
    /// stress includes the stress of the tractions t, whose work on the strain is their work on its displacement u[e]
    /// (Betti): 1/2 (sum t . u[e] dA - int sigma : e dV). A residual stress s_R before the first load is in
    /// balance without tractions, so that it adds -int s_R : e dV.
    pub(in crate::yielding) fn locked(&self) -> f64 {
        let cells = self.cells();
        let of_point = |(point, ..): &(usize, Point, Returned)| {
            let [stress, strain]: [Tensor; 2] = [&self.stress, &self.strain]
                .map(|field| std::array::from_fn(|c| field[self.index_of_component(*point, c)]));
            let [xx, yy] = self.initial[point / cells];
            let initial = xx * strain[0] + yy * strain[1];
            self.mesh().weight(point / cells) * (contraction(&stress, &strain) + 2.0 * initial)
        };
        let of_stress: f64 = self.active.iter().map(of_point).sum();
        let displaced = self.tractions.iter().flatten().zip(&self.next_everywhere);
        let of_tractions: f64 = displaced.map(|(t, u)| t * u).sum();
        0.5 * self.volume.cells.area() * (of_tractions - of_stress)
    }

    /// Work of the bulk stress on the plastic strain of the increment \[J\], by the trapezoidal rule.
    pub(in crate::yielding) fn work_of_bulk(&self) -> f64 {
        let (mesh, cells) = (self.mesh(), self.cells());
        let mean = 0.5 * (self.bulk[0] + self.bulk[1]);
        if mean == 0.0 {
            return 0.0;
        }
        let of_point = |(point, start, end): &(usize, Point, Returned)| {
            let plane = point / cells;
            let [xx, yy, xy] = self.bulk_course[plane];
            let grown: Tensor = std::array::from_fn(|c| end.strain[c] - start.strain[c]);
            mesh.weight(plane) * contraction(&[xx, yy, 0.0, xy, 0.0, 0.0], &grown)
        };
        mean * self.volume.cells.area() * self.active.iter().map(of_point).sum::<f64>()
    }

    /// Volume of the points that have yielded \[m^3\].
    pub(in crate::yielding) fn plastic_volume(&self) -> f64 {
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
    pub(in crate::yielding) fn reaches_the_border(&self) -> bool {
        let mut active = self.active.iter();
        active.any(|(point, _, end)| end.equivalent > 0.0 && self.at_border(*point))
    }

    /// Whether a point lies in a cell at the border or on the lowest plane.
    pub(super) fn at_border(&self, point: usize) -> bool {
        let (cells, planes) = (self.mesh().cells, self.mesh().planes());
        let ends = |i: usize, n: usize| i == 0 || i + 1 == n;
        let (plane, cell) = (point / cells.len(), point % cells.len());
        let across = !cells.plane_strain && ends(cell % cells.ny, cells.ny);
        ends(cell / cells.ny, cells.nx) || across || plane + 1 == planes
    }

    /// Largest equivalent plastic strain and, if the point lies at the border of the volume, on which rim. None
    /// if nothing has yielded.
    pub(in crate::yielding) fn largest(&self) -> Option<(f64, Option<Rim>)> {
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

    /// The point that is nearest to yield under tractions, without plastic strain: 1/f of the factor f by which
    /// the stress of the tractions has to grow, beside the residual stress, until the point yields; body,
    /// layer, depth \[m\]. Without residual stress 1/f is the stress of von Mises over the yield stress.
    pub(in crate::yielding) fn nearest_to_yield(
        &mut self,
        tractions: &[Vec<f64>; 3],
    ) -> Option<(f64, usize, usize, f64)> {
        self.begin(None, &Default::default());
        self.tractions = self.tractions_on_body(tractions);
        self.respond();
        let cells = self.cells();
        let of_plane = |plane: usize| {
            let (law, _) = self.laws[plane].as_ref()?;
            let plane_stress = &self.stress[plane * COMPONENTS * cells..][..COMPONENTS * cells];
            let [xx, yy] = self.initial[plane];
            let constant = deviator(&[xx, yy, 0.0, 0.0, 0.0, 0.0]);
            let reached = (0..cells).map(|cell| {
                let s: Tensor = std::array::from_fn(|c| plane_stress[c * cells + cell]);
                part_of_yield(&deviator(&s), &constant, law.s_y)
            });
            Some((reached.fold(0.0, f64::max), plane))
        };
        let planes = (0..self.laws.len()).filter_map(of_plane);
        let (ratio, plane) = planes.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let mesh = self.mesh();
        Some((ratio, self.number, mesh.layer(plane), mesh.depth(plane)))
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
