//! States of a contact, as Python hands them over.

use contact_core::scene::Grid as Cells;
use contact_subsurface::Moments;
use ndarray::{Array2, Ix2};

use crate::prelude::*;
use crate::scene::Grid;
use crate::yielding::{Eigenstress, of_states};

/// Fields of several states.
type Fields<'py> = List<Array<'py, Ix2>>;

/// States of a contact: tractions [Pa], where it sticks, bulk stress [Pa], what has yielded.
///
/// Fields are of shape (nx, ny), one for each state. A body that may yield has an `eigenstress` for
/// each state, another body has none.
#[pyclass(frozen, module = "pyfret._core")]
pub(crate) struct States {
    grid: Cells,
    moments: Moments,
}

impl States {
    /// The moments; fails if they are on another grid.
    pub(crate) fn moments_on(&self, grid: &Cells) -> PyResult<&Moments> {
        if self.grid != *grid {
            refuse!("states: are on another grid");
        }
        Ok(&self.moments)
    }

    /// The cells and the moments.
    pub(crate) fn parts(&self) -> (&Cells, &Moments) {
        (&self.grid, &self.moments)
    }
}

#[pymethods]
impl States {
    #[new]
    #[pyo3(signature = (grid, *, p: "Sequence[NDArray[np.float64]]", q_x: "Sequence[NDArray[np.float64]]", q_y: "Sequence[NDArray[np.float64]]", stick: "Sequence[NDArray[np.bool_]]", sigma_B: "Sequence[float]", eigenstress: "Sequence[Eigenstress | None]"))]
    fn new(
        grid: Grid,
        p: Fields<'_>,
        q_x: Fields<'_>,
        q_y: Fields<'_>,
        stick: List<Mask<'_, Ix2>>,
        sigma_B: List<f64>,
        eigenstress: List<Option<Py<Eigenstress>>>,
    ) -> PyResult<Self> {
        let (shape, count) = ((grid.0.nx, grid.0.ny), sigma_B.len());
        let fields = [&q_x, &q_y, &p];
        let mut shapes = fields
            .iter()
            .flat_map(|f| f.iter().map(|f| f.as_array().dim()));
        let sticking = stick.iter().map(|f| f.as_array().dim());
        let as_many = fields.iter().all(|f| f.len() == count) && stick.len() == count;
        if !as_many || shapes.any(|s| s != shape) || sticking.into_iter().any(|s| s != shape) {
            refuse!(
                "p, q_x, q_y, stick: must be {count} fields each, as many as sigma_B, of the shape of the \
                 grid, {shape:?}"
            );
        }
        let to_standard_layout =
            |f: &Array<'_, Ix2>| f.as_array().as_standard_layout().into_owned();
        let cells =
            |f: &Mask<'_, Ix2>| -> Array2<bool> { f.as_array().as_standard_layout().into_owned() };
        let moments = Moments {
            tractions: (0..count)
                .map(|n| fields.map(|f| to_standard_layout(&f[n])))
                .collect(),
            stick: stick.iter().map(cells).collect(),
            sigma_B: sigma_B.0,
            eigenstress: of_states(Some(eigenstress)),
        };
        Ok(Self {
            grid: grid.0,
            moments,
        })
    }
}
