//! Refusals of unknown arguments that name those that are known: for all classes and functions.

use pyo3::exceptions::PyTypeError;
use pyo3::ffi;
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyDict, PyTuple, PyType};

/// Puts `pyfret._util.compiled` before all that the module exports.
pub(crate) fn guard(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let compiled = module.py().import("pyfret._util.compiled")?;
    compiled.call_method1("guard", (module, constructors(module)?))?;
    Ok(())
}

/// The constructors of the classes of the module, functions of the class and its arguments.
///
/// Python reaches that of a class by ``__new__`` alone, and no more once that has another value.
fn constructors<'py>(module: &Bound<'py, PyModule>) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(module.py());
    for of in module.dict().values() {
        if let Ok(class) = of.cast_into::<PyType>()
            && let Some(make) = constructor(&class)?
        {
            found.set_item(class, make)?;
        }
    }
    Ok(found)
}

fn constructor<'py>(class: &Bound<'py, PyType>) -> PyResult<Option<Bound<'py, PyCFunction>>> {
    let py = class.py();
    // SAFETY: the type is alive; the slot of a class, if it has one, holds a function of this type.
    let new: Option<ffi::newfunc> =
        unsafe { std::mem::transmute(ffi::PyType_GetSlot(class.as_type_ptr(), ffi::Py_tp_new)) };
    let Some(new) = new else {
        return Ok(None);
    };
    let own = class.clone().unbind();
    let make = move |args: &Bound<'_, PyTuple>, named: Option<&Bound<'_, PyDict>>| {
        let py = args.py();
        let class = args.get_item(0)?.cast_into::<PyType>()?;
        if !class.is_subclass(own.bind(py))? {
            let message = format!(
                "{}: must be a class of {}",
                class.name()?,
                own.bind(py).name()?
            );
            return Err(PyTypeError::new_err(message));
        }
        let rest = args.get_slice(1, args.len());
        let named = named.map_or(std::ptr::null_mut(), Bound::as_ptr);
        // SAFETY: the function is that of a class that this one is, and takes a class, a tuple and a
        // dict or nothing; it gives a new reference, or sets an error.
        let made = unsafe {
            let made = new(class.as_type_ptr(), rest.as_ptr(), named);
            Bound::from_owned_ptr_or_err(py, made)
        };
        made.map(Bound::unbind)
    };
    PyCFunction::new_closure(py, None, None, make).map(Some)
}
