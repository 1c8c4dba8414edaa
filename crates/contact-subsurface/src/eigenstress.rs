//! The residual stress that plastic strain leaves, between the points of its grid.
//!
//! It stands at the Gauss points of the elements in depth and at the middles of the cells of the volume
//! grid. Between them it is a product of cubic polynomials through the four nearest points along each
//! axis, in depth through those of one layer alone. The surface carries nothing of it: there s_zz, s_xz
//! and s_yz are zero. Beyond the grid it falls as the stress of a source far away, with the third power of
//! the distance, in plane strain with the second.

use std::sync::{Arc, Mutex, PoisonError};

use contact_core::Error;
use contact_core::scene::Scene;
use contact_core::yielding::{Yielded, Yielding};
use stress_tensor::StressTensor;

use super::{Depth, Side};

/// Points of a polynomial.
const POINTS: usize = 4;
/// Components of a tensor.
const COMPONENTS: usize = 6;
/// Components that the surface carries: zz, xz, yz.
const CARRIED: [usize; 3] = [2, 4, 5];

/// A residual stress of a body, in the axes of the scene.
#[derive(Clone, Debug)]
pub struct Eigenstress {
    field: Arc<Field>,
    /// Where the origin of x, y lies in the scene \[m\].
    origin: (f64, f64),
}

#[derive(Debug)]
struct Field {
    /// Cells along x and y, and their lengths \[m\].
    n: [usize; 2],
    d: [f64; 2],
    plane_strain: bool,
    /// Depth \[m\] and layer of every plane.
    planes: Vec<(f64, usize)>,
    /// For each plane six components on the cells, x first \[Pa\]; a cycle holds many of them.
    stress: Vec<f32>,
}

/// The nearest points along an axis with their weights.
type Weights = [(usize, f64); POINTS];

impl Eigenstress {
    /// The same with x, y counted from another point of the scene \[m\].
    #[must_use]
    pub fn seen_from(&self, (x, y): (f64, f64)) -> Self {
        Self {
            field: self.field.clone(),
            origin: (self.origin.0 + x, self.origin.1 + y),
        }
    }

    /// The stress at x, y \[m\] and a depth \[Pa\]; zero in a layer that has no element.
    pub fn stress(&self, x: f64, y: f64, depth: Depth) -> StressTensor {
        let field = &*self.field;
        let rows = field.planes.iter().enumerate();
        let rows = rows.filter(|(_, (_, layer))| *layer == depth.layer);
        let (rows, z): (Vec<usize>, Vec<f64>) = rows.map(|(n, (z, _))| (n, *z)).unzip();
        let (Some(first), Some(last)) = (z.first(), z.last()) else {
            return [0.0; COMPONENTS];
        };
        let power = if field.plane_strain { 2 } else { 3 };
        // The substrate goes on below its last plane.
        let is_last = rows.last().is_some_and(|n| n + 1 == field.planes.len());
        let deep = if is_last && depth.z > *last {
            (last / depth.z).powi(power)
        } else {
            1.0
        };
        let at = if is_last { depth.z.min(*last) } else { depth.z };
        let in_depth = weights(&z, at);
        let (along_x, far_x) = field.along(0, x + self.origin.0);
        let (along_y, far_y) = field.along(1, y + self.origin.1);
        let far = deep * far_x.min(far_y).powi(power);
        let cells = field.n[0] * field.n[1];
        let mut sum = [0.0; COMPONENTS];
        for &(row, w_z) in &in_depth {
            for &(i, w_x) in &along_x {
                for &(j, w_y) in &along_y {
                    let weight = far * w_z * w_x * w_y;
                    if weight == 0.0 {
                        continue;
                    }
                    let at = rows[row] * COMPONENTS * cells + i * field.n[1] + j;
                    for (c, sum) in sum.iter_mut().enumerate() {
                        *sum += weight * f64::from(field.stress[at + c * cells]);
                    }
                }
            }
        }
        if depth.layer == 0 && depth.z < *first {
            // Linear between the surface, which carries nothing, and the first plane.
            let plane = rows[0];
            for c in CARRIED {
                let block = (plane * COMPONENTS + c) * cells;
                let mut value = 0.0;
                for &(i, w_x) in &along_x {
                    for &(j, w_y) in &along_y {
                        let at = block + i * field.n[1] + j;
                        value += w_x * w_y * f64::from(field.stress[at]);
                    }
                }
                sum[c] = far * value * depth.z / first;
            }
        }
        sum
    }
}

impl Field {
    /// The cells beside a place along an axis, and the part that is left of the stress beyond the grid.
    fn along(&self, axis: usize, place: f64) -> (Weights, f64) {
        let n = self.n[axis];
        if n == 1 {
            return ([(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)], 1.0);
        }
        let border = 0.5 * (n as f64 - 1.0) * self.d[axis];
        let within = place.clamp(-border, border);
        let far = if place.abs() > border {
            border / place.abs()
        } else {
            1.0
        };
        let at = (within + border) / self.d[axis];
        let middles: Vec<f64> = (0..n).map(|i| i as f64).collect();
        (weights(&middles, at), far)
    }
}

/// Lagrange's polynomial through the points nearest to a place; the value of the place itself beyond them.
fn weights(points: &[f64], at: f64) -> Weights {
    let count = points.len().min(POINTS);
    let above = points.partition_point(|p| *p < at);
    let first = above.saturating_sub(POINTS / 2).min(points.len() - count);
    let mut found = [(first, 0.0); POINTS];
    for (k, found) in found[..count].iter_mut().enumerate() {
        let others = (first..first + count).filter(|m| *m != first + k);
        let factor = |m: usize| (at - points[m]) / (points[first + k] - points[m]);
        *found = (first + k, others.map(factor).product());
    }
    found
}

/// Makes the residual stresses of a body from the plastic states of a run.
#[derive(Debug)]
pub struct Eigenstresses {
    scene: Scene,
    side: Side,
    /// On the volume grid before and after it has grown, each set up with the first state that needs it.
    yielding: Mutex<[Option<Yielding>; 2]>,
}

impl Eigenstresses {
    /// Of a body of a scene.
    pub fn of(scene: &Scene, side: Side) -> Self {
        Self {
            scene: scene.clone(),
            side,
            yielding: Mutex::default(),
        }
    }

    /// The number of the body.
    fn number(&self) -> usize {
        match self.side {
            Side::Body1 => 1,
            Side::Body2 => 2,
        }
    }

    /// Does `work` with the bodies that yield, on the volume grid on which a state was solved; `None` where none
    /// may yield.
    ///
    /// # Errors
    /// The state has points beyond both grids.
    pub fn with<T>(
        &self,
        yielded: &Yielded,
        work: impl FnOnce(&mut Yielding) -> T,
    ) -> Result<Option<T>, Error> {
        let mut held = self.yielding.lock().unwrap_or_else(PoisonError::into_inner);
        for (held, grown) in held.iter_mut().zip([false, true]) {
            if held.is_none() {
                *held = Yielding::of(&self.scene, grown)?;
            }
            let Some(bodies) = held else { return Ok(None) };
            if grown {
                bodies.check(yielded)?;
            } else if bodies.outgrown_by(yielded) {
                continue;
            }
            return Ok(Some(work(bodies)));
        }
        Ok(None)
    }

    /// The residual stress of a state; `None` where nothing of the body has yielded.
    pub fn at(&self, yielded: Option<&Yielded>) -> Result<Option<Eigenstress>, Error> {
        let number = self.number();
        let has_yielded = |yielded: &&Yielded| {
            let mut own = yielded.bodies.iter().filter(|body| body.body == number);
            own.any(|body| !body.points.is_empty())
        };
        let Some(yielded) = yielded.filter(has_yielded) else {
            return Ok(None);
        };
        let plane_strain = self.scene.grid.plane_strain;
        let found = self.with(yielded, |yielding| {
            let stress = yielding.stress_of_changes(yielded, None, number);
            let (Some(stress), Some(mesh)) = (stress, yielding.mesh(number)) else {
                return None;
            };
            let (cells, planes) = (mesh.cells, 0..mesh.planes());
            Some(Field {
                n: [cells.nx, cells.ny],
                d: [cells.dx, cells.dy],
                plane_strain,
                planes: planes.map(|n| (mesh.depth(n), mesh.layer(n))).collect(),
                stress: stress.into_iter().map(|s| s as f32).collect(),
            })
        })?;
        Ok(found.flatten().map(|field| Eigenstress {
            field: Arc::new(field),
            origin: (0.0, 0.0),
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A field that is cubic along each axis within each of two layers.
    fn cubic(x: f64, y: f64, depth: Depth, c: usize) -> f64 {
        let [x, y, z] = [x, y, depth.z].map(|v| v * 1e4);
        let of_layer = if depth.layer == 0 { 1.0 } else { -2.0 };
        (c as f64 + of_layer) * (1.0 + x - x * x * y) * (1.0 + z - 0.1 * z * z * z)
    }

    #[test]
    fn cubic_stresses_are_exact_within_each_layer_and_the_surface_carries_nothing() {
        let (n, d) = ([9, 8], [2e-5, 2.5e-5]);
        let depths = [0.1, 0.3, 0.6, 0.9, 1.1, 1.4, 1.9, 2.6].map(|z| z * 1e-4);
        let planes: Vec<_> = depths
            .into_iter()
            .map(|z| (z, usize::from(z > 1e-4)))
            .collect();
        let mut stress = Vec::new();
        for (z, layer) in &planes {
            for c in 0..COMPONENTS {
                for i in 0..n[0] {
                    for j in 0..n[1] {
                        let [x, y] = [(i, 0), (j, 1)]
                            .map(|(i, a)| (i as f64 - 0.5 * (n[a] as f64 - 1.0)) * d[a]);
                        let depth = Depth {
                            z: *z,
                            layer: *layer,
                        };
                        stress.push(cubic(x, y, depth, c) as f32);
                    }
                }
            }
        }
        let field = Eigenstress {
            field: Arc::new(Field {
                n,
                d,
                plane_strain: false,
                planes,
                stress,
            }),
            origin: (0.0, 0.0),
        };
        for (x, y, z, layer) in [
            (1.3e-5, -2e-5, 5e-5, 0),
            (-7e-5, 8e-5, 1e-4, 0),
            (-7e-5, 8e-5, 1e-4, 1),
            (0.0, 0.0, 2.5e-4, 1),
        ] {
            let depth = Depth { z, layer };
            let found = field.stress(x, y, depth);
            let moved = field
                .seen_from((1e-5, 2e-5))
                .stress(x - 1e-5, y - 2e-5, depth);
            for c in 0..COMPONENTS {
                let exact = cubic(x, y, depth, c);
                assert!((found[c] - exact).abs() < 1e-4, "{depth:?}");
                assert!((found[c] - moved[c]).abs() < 1e-9);
            }
        }
        let top = field.stress(1e-5, 1e-5, Depth { z: 0.0, layer: 0 });
        assert!(CARRIED.iter().all(|c| top[*c] == 0.0) && top[0] != 0.0);
        // Beyond the grid with the third power of the distance.
        let depth = Depth { z: 2e-4, layer: 1 };
        let (border, far) = (
            field.stress(8e-5, 0.0, depth),
            field.stress(16e-5, 0.0, depth),
        );
        assert!((far[0] / border[0] - 0.125).abs() < 1e-12);
        let below = [2.6e-4, 5.2e-4].map(|z| field.stress(0.0, 0.0, Depth { z, layer: 1 })[0]);
        assert!((below[1] / below[0] - 0.125).abs() < 1e-12);
    }
}
