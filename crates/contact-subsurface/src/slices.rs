//! Whole planes parallel to the surface, on the cells of the grid.

use contact_core::Error;
use contact_core::kernels::{DepthKernel, Displacement, Quantity, Stress};
use contact_core::scene::{Body, Grid};
use contact_core::stop::unless;
use ndarray::Array2;
use rayon::prelude::*;

use super::counters::count_on_grids;
use super::loads::{Plane, Source};
use super::plane_transform::PlaneTransform;
use super::states::Loaded;
use super::{Depth, Side, States};

/// Stress and displacement on planes parallel to the surface.
pub struct Slices {
    loaded: Loaded,
    plane: Plane,
    /// For loads on cells and for point loads.
    transforms: [PlaneTransform; 2],
}

impl Slices {
    /// Prepares planes in the body `side` under each of the `states`.
    pub fn new<'a>(
        body: &Body,
        side: Side,
        grid: &Grid,
        states: impl Into<States<'a>>,
    ) -> Result<Self, Error> {
        let states = states.into();
        let window = || Ok((0..grid.nx, 0..grid.ny));
        let loaded = Loaded::new(body, side, grid, &states, window)?;
        let plane = Plane::new(grid, false);
        let [cells, points] = Source::ALL.map(|source| {
            PlaneTransform::new(&plane, side, states.tractions, source, &states.stop)
        });
        Ok(Self {
            loaded,
            plane,
            transforms: [cells?, points?],
        })
    }

    /// Stress of each state at one depth \[Pa\]: xx, yy, zz, xy, xz, yz, each of shape (nx, ny).
    pub fn stress(&self, depth: Depth) -> Result<Vec<[Array2<f64>; 6]>, Error> {
        let kernel = self
            .loaded
            .kernel::<Stress, 10, 6>(depth, self.plane.reach())?;
        let mut planes = self.planes_at(&kernel, depth)?;
        count_on_grids(self.loaded.grid.cells(), planes.len());
        self.add_rim(&kernel, depth, &mut planes);
        for (state, planes) in planes.iter_mut().enumerate() {
            let uniform = self.loaded.uniform(state, depth);
            for (plane, uniform) in planes.iter_mut().zip(uniform) {
                *plane += uniform;
            }
            let grid = &self.loaded.grid;
            let cells = (0..grid.cells()).into_par_iter();
            let residual = |n: usize| {
                let (i, j) = (n / grid.ny, n % grid.ny);
                let residual = self
                    .loaded
                    .eigenstress_at(state, (grid.x(i), grid.y(j)), depth)?;
                Some(((i, j), residual))
            };
            let residual: Vec<_> = cells.filter_map(residual).collect();
            for (cell, residual) in residual {
                for (plane, residual) in planes.iter_mut().zip(residual) {
                    plane[cell] += residual;
                }
            }
        }
        Ok(planes)
    }

    /// Displacement of each state at one depth relative to infinity \[m\].
    pub fn displacement(&self, depth: Depth) -> Result<Vec<[Array2<f64>; 3]>, Error> {
        let kernel = self
            .loaded
            .kernel::<Displacement, 5, 3>(depth, self.plane.reach())?;
        self.planes_at(&kernel, depth)
    }

    /// Hands the stresses of all states at each depth, of shape (6, cells in row-major order), to
    /// `f` as soon as they are known, with the accumulator of that depth; depths in parallel.
    pub fn pass_stress<T: Send>(
        &self,
        depths: &[Depth],
        kept: &mut [T],
        f: impl Fn(&mut T, Depth, &[Array2<f64>]) + Sync,
    ) -> Result<(), Error> {
        let reach = self.plane.reach();
        self.loaded
            .tabulate_kernels::<Stress, 10, 6>(depths, reach)?;
        depths.par_iter().zip(kept).try_for_each(|(depth, kept)| {
            let flat = |planes: [Array2<f64>; 6]| {
                let cells = planes[0].len();
                let values = planes.into_iter().flatten().collect();
                Array2::from_shape_vec((6, cells), values).expect("six planes of equal size")
            };
            let stresses: Vec<_> = self.stress(*depth)?.into_iter().map(flat).collect();
            f(kept, *depth, &stresses);
            Ok(())
        })
    }

    /// Fails once it has been stopped.
    pub(super) fn check_stopped(&self) -> Result<(), Error> {
        unless(&self.loaded.stop)
    }

    /// The grid.
    pub fn grid(&self) -> &Grid {
        &self.loaded.grid
    }

    /// Adds the correction of [`NearRim`] to the stress of all states at a depth.
    fn add_rim(
        &self,
        kernel: &DepthKernel<Stress, 10, 6>,
        depth: Depth,
        states: &mut [[Array2<f64>; 6]],
    ) {
        let Some(rim) = &self.loaded.rim else { return };
        let Some(parts) = rim.parts(kernel, depth, (0.0, 0.0)) else {
            return;
        };
        for (state, planes) in states.iter_mut().enumerate() {
            let with_rim = |n: usize| {
                let cell = (n / self.loaded.grid.ny, n % self.loaded.grid.ny);
                rim.is_near(state, depth, cell).then(|| {
                    let mut stress = planes.each_ref().map(|plane| plane[cell]);
                    rim.add_correction(&parts, state, cell, &mut stress);
                    (cell, stress)
                })
            };
            let cells = (0..self.loaded.grid.cells()).into_par_iter();
            let changed: Vec<_> = cells.filter_map(with_rim).collect();
            for (cell, stress) in changed {
                for (plane, stress) in planes.iter_mut().zip(stress) {
                    plane[cell] = stress;
                }
            }
        }
    }

    /// The planes of R components of each state at one depth, in the axes of the scene.
    fn planes_at<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        kernel: &DepthKernel<Q, N, R>,
        depth: Depth,
    ) -> Result<Vec<[Array2<f64>; R]>, Error> {
        let source = Source::for_depth(depth.z, self.plane.d);
        let transform = &self.transforms[source.index()];
        let mut fields =
            transform.convolve(kernel, self.plane, self.loaded.states, &self.loaded.stop)?;
        if self.loaded.side == Side::Body1 {
            for fields in &mut fields {
                let of_one_z = fields.iter_mut().enumerate();
                for (_, field) in of_one_z.filter(|(row, _)| Q::has_one_z(*row)) {
                    field.map_inplace(|v| *v = -*v);
                }
            }
        }
        Ok(fields)
    }
}
