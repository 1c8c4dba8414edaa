//! Bodies.

use crate::hints::sequence_of;
use crate::prelude::*;
use contact_core::scene as core;
use pyo3::{PyTypeInfo, type_hint_union};

use super::shape::{Flat, Shape};
use crate::error::Answer;
use crate::material::{Coating, Elastic};
use crate::python::from_python;
use crate::residual_stress::{Profile, Shown, shown, text};

/// An elastic half-space under its coatings and a gently curved surface.
///
/// Parameters
/// ----------
/// substrate : Elastic, Material or str
///     Material below the coatings.
/// coatings : sequence of Coating
///     Layers from the surface down: ``coatings[0]`` is the outermost (default: none).
/// residual : float or array_like, optional
///     Residual stress of the substrate [Pa], tension positive (default: none). A stress means s_xx
///     = s_yy. A table has the rows ``[depth, s]`` or ``[depth, s_xx, s_yy]``, the depth [m] below
///     the top of the layer. Linear between the depths, constant beyond them.
/// shape : Flat, Sphere, Ellipsoid, Cylinder, ... or a sum of them
///     Undeformed surface (default: flat).
/// bulk_azimuth : float, optional
///     Direction of its bulk stress, from x towards y [rad] (default: along the axis of a cylinder
///     or roller, else along x; in line contacts along x).
/// bulk_neutral_depth : float, optional
///     Depth of the neutral plane of a bent body [m]: its bulk stress falls linearly from
///     the surface to zero there (default: the same at all depths).
/// hardness : float, Material or str, optional
///     Largest pressure that the surface bears [Pa]: beyond it the surface is indented for
///     good. Of a material of the table, or its name, 2.8 times its yield stress (default: none).
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Body(pub(crate) core::Body);

parts!(Body: substrate, coatings, residual, shape, bulk_azimuth, bulk_neutral_depth, hardness);
takes!(
    Body,
    "a body, such as Body(Elastic(E=210e9, nu=0.3), shape=Sphere(R=5e-3))"
);

#[pymethods]
impl Body {
    #[new]
    #[pyo3(signature = (substrate: "Elastic | Material | str", *, coatings = Coatings(Vec::new()), residual = None, shape = Shape::Flat(Flat {}), bulk_azimuth: "Angle | None" = None, bulk_neutral_depth: "Length | None" = None, hardness: "YieldStress | Material | str | None" = None))]
    fn new(
        substrate: Elastic,
        coatings: Coatings,
        residual: Option<Profile>,
        shape: Shape,
        #[pyo3(from_py_with = Optional::angle)] bulk_azimuth: Option<f64>,
        #[pyo3(from_py_with = Optional::depth)] bulk_neutral_depth: Option<f64>,
        hardness: Option<&Bound<'_, PyAny>>,
    ) -> Answer<Self> {
        let hardness = match hardness {
            Some(given) => from_python(given.py(), "hardness_from")?
                .call1((given,))?
                .extract()?,
            None => f64::INFINITY,
        };
        let body = Self(core::Body {
            substrate: substrate.0,
            residual: coatings.residual(residual),
            bonds: coatings.bonds(),
            plastic: coatings.plastic(substrate),
            coatings: coatings.0.into_iter().map(|c| c.layer).collect(),
            hardness,
            shape: shape.into(),
            bulk: core::Bulk {
                azimuth: bulk_azimuth,
                neutral_depth: bulk_neutral_depth,
            },
        });
        body.0.check_residual("body")?;
        body.0.check_hardness("body")?;
        Ok(body)
    }

    /// Layers from the surface down.
    #[getter]
    fn coatings(&self) -> Vec<Coating> {
        let layers = self.0.coatings.iter().enumerate();
        layers
            .map(|(n, c)| Coating {
                layer: *c,
                bond: self.0.bond(n),
                plastic: self.0.plastic(n),
                residual: self.of_layer(n),
            })
            .collect()
    }

    /// Second derivatives xx, xy, yy of the parabola of the surface [1/m].
    #[getter]
    fn _curvature(&self) -> [f64; 3] {
        self.0.shape.curvature()
    }

    pub(crate) fn __repr__(&self) -> String {
        let mut parts = vec![self.substrate().__repr__()];
        if !self.0.coatings.is_empty() {
            let layers: Vec<_> = self.coatings().iter().map(Coating::__repr__).collect();
            parts.push(format!("coatings=[{}]", layers.join(", ")));
        }
        let residual = self.of_layer(self.0.coatings.len());
        if !residual.rows.is_empty() {
            parts.push(format!("residual={}", text(&residual)));
        }
        if self.0.shape != core::Shape::Flat {
            parts.push(format!("shape={}", self.shape().repr()));
        }
        let bulk = [
            ("bulk_azimuth", self.0.bulk.azimuth),
            ("bulk_neutral_depth", self.0.bulk.neutral_depth),
        ];
        parts.extend(
            bulk.into_iter()
                .filter_map(|(name, value)| Some(format!("{name}={:?}", value?))),
        );
        if self.0.hardness < f64::INFINITY {
            parts.push(format!("hardness={:?}", self.0.hardness));
        }
        format!("Body({})", parts.join(", "))
    }
}

attributes!(Body, self:
    /// Material below the coatings.
    substrate: Elastic = Elastic(self.0.substrate, self.0.plastic(self.0.coatings.len()));
    /// Whether a layer of it may yield.
    yields: bool = self.0.yields();
    /// Residual stress of the substrate [Pa], or its table; None where it has none.
    residual: Option<Shown> = shown(&self.of_layer(self.0.coatings.len()));
    /// Undeformed surface.
    shape: Shape = (&self.0.shape).into();
    /// Given direction of its bulk stress [rad]; None: along its axis, else x.
    bulk_azimuth: Option<f64> = self.0.bulk.azimuth;
    /// Depth of the neutral plane of a bent body [m]; None: the same stress at all depths.
    bulk_neutral_depth: Option<f64> = self.0.bulk.neutral_depth;
    /// Largest pressure that the surface bears [Pa]; None without a limit.
    hardness: Option<f64> = Some(self.0.hardness).filter(|hardness| hardness.is_finite());
);

impl Body {
    /// Residual stress of a layer.
    fn of_layer(&self, layer: usize) -> core::Profile {
        self.0.residual.get(layer).cloned().unwrap_or_default()
    }
}

/// Layers from the surface down, or a single one.
struct Coatings(Vec<Coating>);

impl Coatings {
    /// Yield laws of the layers, the substrate last; empty if all stay elastic.
    fn plastic(&self, substrate: Elastic) -> Vec<Option<core::Plastic>> {
        let laws = self.0.iter().map(|c| c.plastic).chain([substrate.1]);
        if laws.clone().all(|law| law.is_none()) {
            return Vec::new();
        }
        laws.collect()
    }

    /// Residual stress of the layers, the substrate last; empty if no layer has any.
    fn residual(&self, substrate: Option<Profile>) -> Vec<core::Profile> {
        let substrate = substrate.unwrap_or_default().0;
        let layers = self.0.iter().map(|c| c.residual.clone()).chain([substrate]);
        let layers: Vec<_> = layers.collect();
        let none = layers.iter().all(|layer| layer.rows.is_empty());
        if none { Vec::new() } else { layers }
    }

    /// Bonds below the layers; empty if all are perfect.
    fn bonds(&self) -> Vec<core::Bond> {
        let bonds = self.0.iter().map(|c| c.bond);
        if bonds.clone().all(|bond| bond == core::Bond::PERFECT) {
            return Vec::new();
        }
        bonds.collect()
    }
}

impl<'py> FromPyObject<'_, 'py> for Coatings {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr =
        type_hint_union!(Coating::TYPE_HINT, sequence_of!(Coating::TYPE_HINT));

    /// Takes a coating, or a list of coatings.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(one) = value.extract::<Coating>() {
            return Ok(Self(vec![one]));
        }
        let layers = value.try_iter().map_err(|_| {
            must_be(
                &value,
                "a list of coatings, the outermost first, such as [Coating(..)]",
            )
        })?;
        let layer = |layer: PyResult<Bound<'_, PyAny>>| layer?.extract::<Coating>();
        Ok(Self(layers.map(layer).collect::<PyResult<_>>()?))
    }
}
