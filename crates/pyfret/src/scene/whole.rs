//! The scene as a whole.

use std::path::PathBuf;

use contact_core::scene as core;
use pyo3::prelude::*;

use super::{AnyFriction, Body, Friction, Grid, LoadPath, Save, Settings};
use crate::error::to_python;
use crate::reference::Hertz;

/// A fretting contact problem.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Scene(pub(crate) core::Scene);

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (*, body1, body2, mu, grid, path = None, settings = None, title = String::new()))]
    fn new(
        body1: Body,
        body2: Body,
        mu: AnyFriction,
        grid: Grid,
        path: Option<LoadPath>,
        settings: Option<Settings>,
        title: String,
    ) -> Self {
        Self(core::Scene {
            title,
            body1: body1.0,
            body2: body2.0,
            friction: mu.into(),
            grid: grid.0,
            path: path.map_or_else(core::LoadPath::start, |p| p.0),
            settings: settings.unwrap_or_default().0,
        })
    }

    #[staticmethod]
    #[pyo3(signature = (path, *, set = Vec::new(), allow_outside = false))]
    fn from_file(path: PathBuf, set: Vec<String>, allow_outside: bool) -> PyResult<Self> {
        let reach = if allow_outside {
            core::Reach::Anywhere
        } else {
            core::Reach::Folder
        };
        core::Scene::from_file_reaching(path, &set, reach)
            .map(Self)
            .map_err(to_python)
    }

    #[staticmethod]
    #[pyo3(signature = (text, *, set = Vec::new()))]
    fn from_toml(text: &str, set: Vec<String>) -> PyResult<Self> {
        core::Scene::from_toml_str(text, "scene", &set)
            .map(Self)
            .map_err(to_python)
    }

    fn to_toml(&self) -> String {
        self.0.to_toml()
    }

    #[pyo3(signature = (*, path = None, settings = None, save = None, mu = None, title = None))]
    fn replace(
        &self,
        path: Option<LoadPath>,
        settings: Option<Settings>,
        save: Option<Save>,
        mu: Option<AnyFriction>,
        title: Option<String>,
    ) -> PyResult<Self> {
        let mut scene = self.0.clone();
        if let Some(path) = path {
            scene.path = path.0;
        }
        if let Some(settings) = settings {
            scene.settings = settings.0;
        }
        if let Some(save) = save {
            scene.settings.save = save.into_core()?;
        }
        if let Some(mu) = mu {
            scene.friction = mu.into();
        }
        if let Some(title) = title {
            scene.title = title;
        }
        Ok(Self(scene))
    }

    fn check(&self) -> PyResult<()> {
        self.0.check().map_err(to_python)
    }

    #[getter]
    fn title(&self) -> &str {
        &self.0.title
    }

    #[getter]
    fn body1(&self) -> Body {
        Body(self.0.body1.clone())
    }

    #[getter]
    fn body2(&self) -> Body {
        Body(self.0.body2.clone())
    }

    #[getter]
    fn mu(&self) -> f64 {
        self.0.friction.mu
    }

    #[getter]
    fn friction(&self) -> Friction {
        Friction(self.0.friction.clone())
    }

    #[getter]
    fn grid(&self) -> Grid {
        Grid(self.0.grid)
    }

    #[getter]
    fn path(&self) -> LoadPath {
        LoadPath(self.0.path.clone())
    }

    #[getter]
    fn settings(&self) -> Settings {
        Settings(self.0.settings.clone())
    }

    #[getter]
    fn hertz(&self) -> Option<Hertz> {
        self.0.hertz().map(Hertz)
    }

    fn __repr__(&self) -> String {
        format!(
            "Scene(title={:?}, body1={}, body2={}, mu={}, grid={}, path={})",
            self.0.title,
            self.body1().__repr__(),
            self.body2().__repr__(),
            self.friction().__repr__(),
            self.grid().__repr__(),
            self.path().__repr__(),
        )
    }
}
