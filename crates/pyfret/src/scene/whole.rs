//! The scene as a whole.

use contact_core::scene as core;
use contact_subsurface::Side;

use super::settings::save_fields;
use super::{AnyFriction, Body, Friction, Grid, LoadPath, Settings};
use crate::error::Answer;
use crate::prelude::*;
use crate::python::from_python;
use crate::reference::Hertz;

/// A fretting contact problem.
///
/// Parameters
/// ----------
/// body1, body2 : Body
///     The upper body (the indenter) and the lower one.
/// friction : float, Friction or "stick"
///     Friction coefficient, >= 0, a friction law, or no slip.
/// grid : Grid
///     Mesh of the contact plane; it has to hold the contact.
/// path : LoadPath, optional
///     Load history; it can be given when the scene is solved instead.
/// settings : Settings, optional
///     How the scene is solved.
/// title : str
///     One line that names the scene in results and figures.
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Scene(pub(crate) core::Scene);

parts!(pickled Scene: body1, body2, friction, grid, path, settings, title);
takes!(
    Scene,
    "a scene, such as Scene(body1=.., body2=.., friction=0.3, grid=..) or Scene.from_file(\"scene.toml\")"
);

impl Scene {
    /// A copy of the scene, with another load history if one is given.
    fn with_path(&self, path: Option<LoadPath>) -> core::Scene {
        let mut scene = self.0.clone();
        if let Some(path) = path {
            scene.path = path.0;
        }
        scene
    }
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (*, body1, body2, friction, grid, path = None, settings = None, title = String::new()))]
    fn new(
        body1: Body,
        body2: Body,
        friction: AnyFriction,
        grid: Grid,
        path: Option<LoadPath>,
        settings: Option<Settings>,
        title: String,
    ) -> Self {
        Self(core::Scene {
            title,
            body1: body1.0,
            body2: body2.0,
            friction: friction.0,
            grid: grid.0,
            path: path.map_or_else(core::LoadPath::start, |p| p.0),
            settings: settings.unwrap_or_default().0,
        })
    }

    /// Read a scene file.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     The file: TOML, ``schema = 1``, SI units.
    /// set : sequence of str, optional
    ///     Values to exchange, each ``"key=value"`` as after ``fret run --set``, e.g.
    ///     ``"friction.mu=0.5"`` or ``"body2.coatings.0.E.E_substrate=4"``.
    /// allow_outside : bool, optional
    ///     Let the scene name files outside its own folder.
    ///
    /// Raises
    /// ------
    /// InvalidSceneError
    ///     With the line, the key and what is allowed; an unknown key names the nearest valid one.
    #[staticmethod]
    #[pyo3(signature = (path, *, set = List(Vec::new()), allow_outside = false))]
    fn from_file(path: PathBuf, set: List<String>, allow_outside: bool) -> Answer<Self> {
        let reach = if allow_outside {
            core::Reach::Anywhere
        } else {
            core::Reach::Folder
        };
        Ok(Self(core::Scene::from_file_reaching(path, &set, reach)?))
    }

    /// Read a scene from the text of a scene file; see :meth:`from_file`.
    #[staticmethod]
    #[pyo3(signature = (text, *, set = List(Vec::new())))]
    fn from_toml(text: &str, set: List<String>) -> Answer<Self> {
        Ok(Self(core::Scene::from_toml_str(text, "scene", &set)?))
    }

    /// Write the text of a scene file, all numbers in SI units.
    fn to_toml(&self) -> String {
        self.0.to_toml()
    }

    /// Return the scene with other values, or with other parts.
    ///
    /// Parameters
    /// ----------
    /// values : mapping of str to value, optional
    ///     By the keys of a scene file: ``"body2.coatings.0.thickness"`` or ``"path.1.T_x.mu_W"``.
    ///     ``"mu"`` is short for ``"friction.mu"``. ``"path.*.W"`` stands for every branch.
    ///     Several keys with commas between get the same value, and a key after a ``-`` gets the
    ///     opposite value. So ``"path.1.T_x,-path.2.T_x,path.3.T_x"`` is an amplitude.
    /// body1, body2, grid, path, settings, friction, title : optional
    ///     Parts as in the constructor. They replace the parts of the scene with new values.
    /// save : "branches", "all" or sequence of int, optional
    ///     Increments whose fields are kept.
    ///
    /// Raises
    /// ------
    /// InvalidSceneError
    ///     A key does not exist, or a value has no meaning; the message names both.
    ///
    /// Examples
    /// --------
    /// >>> harder = scene.replace({"body2.coatings.0.E": 3e11})  # doctest: +SKIP
    #[pyo3(signature = (values: "Mapping[str, Any] | None" = None, *, body1 = None, body2 = None, grid = None, path = None, settings = None,
                        save: "Literal['branches', 'all'] | Sequence[int] | None" = None, friction = None, title = None))]
    fn replace(
        &self,
        py: Python<'_>,
        values: Option<&Bound<'_, PyAny>>,
        body1: Option<Body>,
        body2: Option<Body>,
        grid: Option<Grid>,
        path: Option<LoadPath>,
        settings: Option<Settings>,
        save: Option<&Bound<'_, PyAny>>,
        friction: Option<AnyFriction>,
        title: Option<String>,
    ) -> PyResult<Self> {
        let mut scene = match values {
            Some(values) => {
                let changed = from_python(py, "with_values")?.call1((self.clone(), values))?;
                changed.extract::<Self>()?.0
            }
            None => self.0.clone(),
        };
        if let Some(body1) = body1 {
            scene.body1 = body1.0;
        }
        if let Some(body2) = body2 {
            scene.body2 = body2.0;
        }
        if let Some(grid) = grid {
            scene.grid = grid.0;
        }
        if let Some(path) = path {
            scene.path = path.0;
        }
        if let Some(settings) = settings {
            scene.settings = settings.0;
        }
        if let Some(save) = save {
            scene.settings.save = save_fields(save)?;
        }
        if let Some(friction) = friction {
            scene.friction = friction.0;
        }
        if let Some(title) = title {
            scene.title = title;
        }
        Ok(Self(scene))
    }

    /// Refuse a scene that has no meaning, warn of what is hardly meant.
    ///
    /// Parameters
    /// ----------
    /// path : LoadPath, optional
    ///     Load history (default: the path of the scene).
    ///
    /// Raises
    /// ------
    /// InvalidSceneError
    ///     With the key, the value and what is allowed.
    ///
    /// Warns
    /// -----
    /// SceneWarning
    ///     One for each sentence of :meth:`doubts`.
    #[pyo3(signature = (path = None))]
    fn check(&self, py: Python<'_>, path: Option<LoadPath>) -> Answer<()> {
        let scene = self.with_path(path);
        scene.check()?;
        scene.check_fit()?;
        let warn = from_python(py, "warn")?;
        for doubt in scene.doubts() {
            warn.call1((doubt,))?;
        }
        Ok(())
    }

    /// Depths of the interfaces of a body [m], from the surface down; none of a homogeneous one.
    ///
    /// Parameters
    /// ----------
    /// body_number : 1 or 2
    ///     The upper body or the lower one (default 2).
    ///
    /// Examples
    /// --------
    /// >>> scene.interfaces()  # doctest: +SKIP
    /// [3e-06, 3.5e-06]
    #[pyo3(signature = (body_number: "int" = 2))]
    fn interfaces(&self, #[pyo3(from_py_with = number)] body_number: u8) -> PyResult<Vec<f64>> {
        Ok(match side(body_number)? {
            Side::Body1 => self.0.body1.interfaces(),
            Side::Body2 => self.0.body2.interfaces(),
        })
    }

    /// Length that results of an increment are measured in [m].
    ///
    /// That is a_H. Without a Hertz contact it is half the longer side of the box around the cells
    /// under the pressure `p` [Pa], shape (nx, ny).
    fn length(&self, p: Field<'_>) -> f64 {
        self.0.reference_length(&p.as_array().to_owned())
    }

    /// Doubts: numbers that look like numbers in another unit, few cells.
    ///
    /// One sentence for each, with what was understood; :func:`pyfret.solve` and :meth:`check` warn
    /// of them.
    ///
    /// Parameters
    /// ----------
    /// path : LoadPath, optional
    ///     Load history (default: the path of the scene).
    #[pyo3(signature = (path = None))]
    fn doubts(&self, path: Option<LoadPath>) -> Vec<String> {
        self.with_path(path).doubts()
    }

    /// Describe bodies, friction, grid, Hertz contact and load path, a line for each.
    #[pyo3(signature = () -> "str")]
    fn summary<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "summarize_scene")?.call1((slf,))
    }

    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "scene_html")?.call1((slf,))
    }

    fn __repr__(&self) -> String {
        format!(
            "Scene(title={:?}, body1={}, body2={}, friction={}, grid={}, path={})",
            self.0.title,
            self.body1().__repr__(),
            self.body2().__repr__(),
            self.friction().__repr__(),
            self.grid().__repr__(),
            self.path().__repr__(),
        )
    }
}

attributes!(Scene, self:
    /// One line that names the scene.
    title: &str = &self.0.title;
    /// The upper body.
    body1: Body = Body(self.0.body1.clone());
    /// The lower body.
    body2: Body = Body(self.0.body2.clone());
    /// Friction coefficient.
    mu: f64 = self.0.friction.mu;
    /// Friction law.
    friction: Friction = Friction(self.0.friction.clone());
    /// Mesh of the contact plane.
    grid: Grid = Grid(self.0.grid);
    /// Load history.
    path: LoadPath = LoadPath(self.0.path.clone());
    /// How the scene is solved.
    settings: Settings = Settings(self.0.settings.clone());
    /// The yardstick a_H, p_H: the uncoated pair at the largest normal force of the path.
    hertz: Option<Hertz> = self.0.hertz().map(Hertz);
);
