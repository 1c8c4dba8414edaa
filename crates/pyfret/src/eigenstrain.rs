//! Stress and displacement of eigenstrains, for people who build their own models.

use std::sync::{Mutex, PoisonError};

use contact_core::yielding::mesh_of;
use eigenstrain::{COMPONENTS, Cells, Operator, Sources};
use ndarray::{Array3, Array4, Ix4};
use numpy::{PyArray1, PyArray3, PyArray4};

use crate::arguments::must_fit;
use crate::error::Answer;
use crate::prelude::*;
use crate::scene::{Body, Grid};

/// Stress on the planes, and displacement of the surface.
type StressAndDisplacement<'py> = (Bound<'py, PyArray4<f64>>, Bound<'py, PyArray3<f64>>);

/// Stress and surface displacement that eigenstrains and tractions cause in a body.
///
/// An eigenstrain e is a strain without stress: plastic strain, thermal strain, a misfit::
///
///     sigma = C : (eps(u) - e),   div sigma = 0,   sigma_iz = -t_i at z = 0,   u -> 0 below
///
/// with z into the body, tension positive, bonded layers, and t = q_x, q_y, p on the surface.
/// Fields are trigonometric polynomials on the cells; in depth they are quadratic elements with two
/// Gauss points each. There are no periodic images, and t . u[e] = sigma[t] : e to rounding.
///
/// Parameters
/// ----------
/// body : Body
///     Homogeneous or coated; its shape does not matter.
/// grid : Grid
///     Cells on which eigenstrain and tractions are given.
/// depth : float
///     Depth down to which the elements are of equal height [m]. Growing ones follow down to twice
///     that depth, and through the coatings.
/// height : float
///     Height of an element [m]; a layer has two at least.
///
/// Examples
/// --------
/// >>> from pyfret import Body, Elastic, Grid
/// >>> from pyfret.kernels import EigenstrainOperator
/// >>> steel = Body(Elastic(E=210e9, nu=0.3))
/// >>> grid = Grid.centred(width=4e-4, n=16)
/// >>> operator = EigenstrainOperator(steel, grid, depth=1e-4, height=2e-5)
/// >>> stress, displacement = operator.apply(p=[[0.0] * 16] * 16)
/// >>> stress.shape == (operator.z.size, 6, 16, 16), displacement.shape
/// (True, (3, 16, 16))
#[pyclass(frozen, module = "pyfret.kernels")]
pub(crate) struct EigenstrainOperator {
    /// The body.
    #[pyo3(get)]
    body: Body,
    /// Its cells.
    #[pyo3(get)]
    grid: Grid,
    /// Depth down to which the elements are of equal height [m].
    #[pyo3(get)]
    depth: f64,
    /// Height of an element [m].
    #[pyo3(get)]
    height: f64,
    inner: Mutex<Operator>,
}

made!(EigenstrainOperator by "EigenstrainOperator": body, grid, depth, height);

impl EigenstrainOperator {
    /// Calls `f` with the operator, which is locked meanwhile.
    fn with_operator<T>(&self, f: impl FnOnce(&mut Operator) -> T) -> T {
        f(&mut self.inner.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Collects `f` of each plane.
    fn of_planes<T>(&self, f: impl Fn(&Operator, usize) -> T) -> Vec<T> {
        self.with_operator(|own| (0..own.mesh().planes()).map(|n| f(own, n)).collect())
    }
}

#[pymethods]
impl EigenstrainOperator {
    #[new]
    #[pyo3(signature = (body, grid, *, depth: "Length", height: "float"))]
    fn new(
        py: Python<'_>,
        body: Body,
        grid: Grid,
        #[pyo3(from_py_with = Given::depth)] depth: f64,
        #[pyo3(from_py_with = number)] height: f64,
    ) -> Answer<Self> {
        let core_grid = &grid.0;
        let cells = Cells {
            nx: core_grid.nx,
            ny: core_grid.ny,
            dx: core_grid.dx,
            dy: core_grid.dy,
            plane_strain: core_grid.plane_strain,
        };
        for (name, value) in [("depth", depth), ("height", height)] {
            if !(value > 0.0 && value.is_finite()) {
                refuse!("{name} = {value}: must be a positive length in m");
            }
        }
        // Before a mesh of so many elements is made.
        if depth / height > 1e5 {
            refuse!("height = {height}: must be above 1e-5 of the depth, {depth}");
        }
        let mesh = mesh_of(&body.0, cells, depth, [height, height], 2.0 * depth);
        let mesh = mesh?;
        must_fit(mesh.planes() * COMPONENTS * cells.len(), 8.0)?;
        let operator = interruptible(py, &Arc::default(), || Operator::new(mesh))?;
        Ok(Self {
            body,
            grid,
            depth,
            height,
            inner: Mutex::new(operator),
        })
    }

    /// Stress on the planes [Pa] and displacement of the surface [m].
    ///
    /// Parameters
    /// ----------
    /// eigenstrain : array of shape (planes, 6, nx, ny), optional
    ///     xx, yy, zz, xy, xz, yz on each plane, tensor components (default: none).
    /// p, q_x, q_y : array of shape (nx, ny), optional
    ///     Tractions on the body [Pa] (default: none).
    ///
    /// Returns
    /// -------
    /// stress : array of shape (planes, 6, nx, ny)
    ///     [Pa]
    /// displacement : array of shape (3, nx, ny)
    ///     u_x, u_y, u_z, with z into the body [m]. In plane strain displacements by
    ///     tractions are relative to a point far away.
    #[pyo3(signature = (eigenstrain = None, *, p = None, q_x = None, q_y = None) -> "tuple[NDArray[np.float64], NDArray[np.float64]]")]
    fn apply<'py>(
        &self,
        py: Python<'py>,
        eigenstrain: Option<Array<'py, Ix4>>,
        p: Option<Field<'py>>,
        q_x: Option<Field<'py>>,
        q_y: Option<Field<'py>>,
    ) -> PyResult<StressAndDisplacement<'py>> {
        let (nx, ny) = (self.grid.0.nx, self.grid.0.ny);
        let planes = self.with_operator(|own| own.mesh().planes());
        let shape = (planes, COMPONENTS, nx, ny);
        let strain: Option<Vec<f64>> = match &eigenstrain {
            None => None,
            Some(given) if given.as_array().dim() == shape => {
                Some(given.as_array().iter().copied().collect())
            }
            Some(given) => {
                refuse!(
                    "eigenstrain has the shape {:?}: must be {shape:?}, from the planes and the grid",
                    given.as_array().dim()
                );
            }
        };
        let cells = |name: &str, field: Option<Field<'_>>| match field {
            None => Ok(vec![0.0; nx * ny]),
            Some(field) => field.on_grid(name, &self.grid.0),
        };
        let tractions = [cells("q_x", q_x)?, cells("q_y", q_y)?, cells("p", p)?];
        let mut stress = vec![0.0; planes * COMPONENTS * nx * ny];
        let mut displacement = vec![0.0; 3 * nx * ny];
        interruptible(py, &Arc::default(), || {
            self.with_operator(|own| {
                own.apply(
                    Sources {
                        eigenstrain: strain.as_deref(),
                        tractions: Some([&tractions[0], &tractions[1], &tractions[2]]),
                    },
                    eigenstrain::Answer {
                        stress: &mut stress,
                        wanted: &vec![true; planes],
                        displacement: &mut displacement,
                        of_tractions: true,
                    },
                );
            });
        })?;
        let stress = Array4::from_shape_vec(shape, stress);
        let displacement = Array3::from_shape_vec((3, nx, ny), displacement);
        let wrong = |error: ndarray::ShapeError| PyValueError::new_err(error.to_string());
        Ok((
            stress.map_err(wrong)?.into_pyarray(py),
            displacement.map_err(wrong)?.into_pyarray(py),
        ))
    }
}

attributes!(EigenstrainOperator, self, py:
    /// Depth of each plane of Gauss points [m].
    z: Bound<'py, PyArray1<f64>> = PyArray1::from_vec(py, self.of_planes(|own, n| own.mesh().depth(n)));
    /// Height that each plane stands for [m]: an integral over depth is the sum with these.
    weights: Bound<'py, PyArray1<f64>> = PyArray1::from_vec(py, self.of_planes(|own, n| own.mesh().weight(n)));
    /// Layer of each plane, from the surface down.
    layer: Bound<'py, PyArray1<usize>> = PyArray1::from_vec(py, self.of_planes(|own, n| own.mesh().layer(n)));
);
