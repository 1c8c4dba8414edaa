//! Outline of a contact.

use contact_core::convolution::Tractions;
use contact_core::zones as core;
use contact_subsurface::Line;

use crate::line::{LineName, name_of};
use crate::prelude::*;
use crate::scene::Grid;

/// A spot of a contact: x, y of its centre, area, larger and smaller semi-axis, azimuth.
type Spot = (f64, f64, f64, f64, f64, f64);

/// The outline of a contact: its border in any direction, its spots, the direction of its shear.
///
/// Made of the tractions on a grid, each of shape (nx, ny) [Pa]; of :attr:`Snapshot.outline`.
#[pyclass(frozen, module = "pyfret")]
pub(crate) struct Outline(core::Outline);

#[pymethods]
impl Outline {
    #[new]
    #[pyo3(signature = (grid, *, p: "NDArray[np.float64]", q_x: "NDArray[np.float64]", q_y: "NDArray[np.float64]"))]
    fn new(grid: Grid, p: Field<'_>, q_x: Field<'_>, q_y: Field<'_>) -> PyResult<Self> {
        let cells = |name: &str, field: Field<'_>| field.on_grid(name, &grid.0);
        let (p, q_x, q_y) = (cells("p", p)?, cells("q_x", q_x)?, cells("q_y", q_y)?);
        let tractions = Tractions {
            p: Some(&p),
            q_x: Some(&q_x),
            q_y: Some(&q_y),
        };
        core::Outline::new(&grid.0, &tractions)
            .map(Self)
            .ok_or_else(|| PyValueError::new_err("p is 0 everywhere: the bodies do not touch"))
    }

    /// The spots, the largest first: x, y [m], area [m^2], semi-axes [m] and azimuth [rad].
    ///
    /// The semi-axes belong to the ellipse with the second moments of the spot, the larger one
    /// first, in the direction of the azimuth.
    #[getter]
    fn spots(&self) -> Vec<Spot> {
        let spots = self.0.spots.iter();
        spots
            .map(|s| {
                let [large, small] = s.semi_axes;
                (s.centre.0, s.centre.1, s.area, large, small, s.azimuth)
            })
            .collect()
    }

    /// Ends of a line through the centre within the contact, backwards and forwards [m].
    #[pyo3(signature = (azimuth: "Angle" = 0.0))]
    fn border(&self, #[pyo3(from_py_with = Given::azimuth)] azimuth: f64) -> (f64, f64) {
        self.0.border(azimuth)
    }

    /// Half of the width of the contact in a direction [m].
    #[pyo3(signature = (azimuth: "Angle" = 0.0))]
    fn half_width(&self, #[pyo3(from_py_with = Given::azimuth)] azimuth: f64) -> f64 {
        self.0.half_width(azimuth)
    }

    fn __repr__(&self) -> String {
        let (a, b, _) = self.0.half_widths();
        let (x, y) = self.0.centre;
        format!(
            "Outline(centre ({x:.4e}, {y:.4e}) m, half-widths {a:.4e} and {b:.4e} m, {} spots)",
            self.0.spots.len()
        )
    }
}

attributes!(Outline, self:
    /// Centre of the area, x and y [m]; 0 where it lies in the middle of the grid.
    centre: (f64, f64) = self.0.centre;
    /// Direction of the shear to the x axis [rad]; None without shear, or where it has none.
    shear_azimuth: Option<f64> = self.0.shear_azimuth();
    /// Half of the largest and smallest width [m], and the direction of the largest [rad].
    half_widths: (f64, f64, f64) = self.0.half_widths();
    /// Centres x, y of the cells at the rim [m].
    rim_cells: Vec<(f64, f64)> = self.0.rim_cells();
);

/// x, y and azimuth of the sections in which a contact is looked at by default.
///
/// The first along the shear; a second across it, where the contact or its shear has no axis of its
/// own there.
#[pyfunction]
pub(crate) fn main_sections(outline: PyRef<'_, Outline>) -> Vec<LineName> {
    let lines = Line::for_outlines(&[&outline.0], &[]);
    lines.into_iter().map(name_of).collect()
}
