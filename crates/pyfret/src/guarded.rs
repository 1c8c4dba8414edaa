//! Refusals of unknown arguments that name those that are known: for all classes and functions.

use pyo3::exceptions::PyTypeError;
use pyo3::ffi;
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyDict, PyTuple, PyType};

/// Wraps all that the module exports by `pyfret._util.compiled`, which checks arguments.
pub(crate) fn guard(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let compiled = module.py().import("pyfret._util.compiled")?;
    compiled.call_method1("guard", (module, constructors(module)?))?;
    Ok(())
}

/// The constructors of the classes, as functions of class and arguments. Python reaches a constructor by
/// ``__new__`` alone, which gets another value here.
///
/// Python reaches a constructor by ``__new__`` alone, and no more once ``__new__`` has another value.
fn constructors<'py>(module: &Bound<'py, PyModule>) -> PyResult<Bound<'py, PyDict>> {
    let makers = PyDict::new(module.py());
    for of in module.dict().values() {
        if let Ok(class) = of.cast_into::<PyType>()
            && let Some(make) = constructor(&class)?
        {
            makers.set_item(class, make)?;
        }
    }
    Ok(makers)
}

/// The constructor of a class from its slot; none if it has none.
fn constructor<'py>(class: &Bound<'py, PyType>) -> PyResult<Option<Bound<'py, PyCFunction>>> {
    let py = class.py();
    // SAFETY: the type is alive; the slot of a class, if it has one, holds a function of this type.
    let new: Option<ffi::newfunc> =
        unsafe { std::mem::transmute(ffi::PyType_GetSlot(class.as_type_ptr(), ffi::Py_tp_new)) };
    let Some(new) = new else {
        return Ok(None);
    };
    let base = class.clone().unbind();
    let make = move |args: &Bound<'_, PyTuple>, named: Option<&Bound<'_, PyDict>>| {
        let py = args.py();
        let class = args.get_item(0)?.cast_into::<PyType>()?;
        if !class.is_subclass(base.bind(py))? {
            let message = format!(
                "{}: must be a class of {}",
                class.name()?,
                base.bind(py).name()?
            );
            return Err(PyTypeError::new_err(message));
        }
        let arguments = args.get_slice(1, args.len());
        let keywords = named.map_or(std::ptr::null_mut(), Bound::as_ptr);
        // SAFETY: the function is the constructor of a base class, and takes a class, a tuple and a
        // dict or nothing; it gives a new reference, or sets an error.
        let made = unsafe {
            let made = new(class.as_type_ptr(), arguments.as_ptr(), keywords);
            Bound::from_owned_ptr_or_err(py, made)
        };
        made.map(Bound::unbind)
    };
    PyCFunction::new_closure(py, None, None, make).map(Some)
}
