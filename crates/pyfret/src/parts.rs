//! What the parts of a scene can do as values: be pickled and copied, and be given with something
//! exchanged. All follows from the arguments of the constructor and the attributes that hold them.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

/// The arguments of the constructor that make `value` again: (argument, attribute) each.
pub(crate) fn arguments<'py>(
    value: &Bound<'py, PyAny>,
    parts: &[(&str, &str)],
) -> PyResult<Bound<'py, PyDict>> {
    let arguments = PyDict::new(value.py());
    for (argument, attribute) in parts {
        arguments.set_item(argument, value.getattr(*attribute)?)?;
    }
    Ok(arguments)
}

/// A value of the class of `value` with some of its parts exchanged.
pub(crate) fn replaced<'py>(
    value: &Bound<'py, PyAny>,
    parts: &[(&str, &str)],
    changes: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let arguments = arguments(value, parts)?;
    if let Some(changes) = changes {
        arguments.update(changes.as_mapping())?;
    }
    value.get_type().call((), Some(&arguments))
}

/// Pickling, copying and `copy.replace` of a class by the arguments of its constructor, each with the
/// attribute that holds it where that has another name; and, but for `pickled`, a method `replace`.
macro_rules! parts {
    (pickled $class:ident: $($argument:ident $(= $attribute:ident)?),*) => {
        #[pyo3::pymethods]
        impl $class {
            fn __getnewargs_ex__<'py>(
                slf: &pyo3::Bound<'py, Self>,
            ) -> pyo3::PyResult<((), pyo3::Bound<'py, pyo3::types::PyDict>)> {
                Ok(((), $crate::parts::arguments(slf.as_any(), Self::PARTS)?))
            }

            #[pyo3(signature = (**changes))]
            fn __replace__<'py>(
                slf: &pyo3::Bound<'py, Self>,
                changes: Option<&pyo3::Bound<'py, pyo3::types::PyDict>>,
            ) -> pyo3::PyResult<pyo3::Bound<'py, pyo3::PyAny>> {
                $crate::parts::replaced(slf.as_any(), Self::PARTS, changes)
            }
        }

        impl $class {
            /// Arguments of the constructor, each with the attribute that holds it.
            const PARTS: &'static [(&'static str, &'static str)] =
                &[$((stringify!($argument), $crate::parts::parts!(attribute $argument $($attribute)?))),*];
        }
    };
    (attribute $argument:ident) => { stringify!($argument) };
    (attribute $argument:ident $attribute:ident) => { stringify!($attribute) };
    ($class:ident: $($argument:ident $(= $attribute:ident)?),*) => {
        $crate::parts::parts!(pickled $class: $($argument $(= $attribute)?),*);

        #[pyo3::pymethods]
        impl $class {
            /// The same with some of its parts exchanged, named as in the constructor.
            #[pyo3(signature = (**changes))]
            fn replace<'py>(
                slf: &pyo3::Bound<'py, Self>,
                changes: Option<&pyo3::Bound<'py, pyo3::types::PyDict>>,
            ) -> pyo3::PyResult<pyo3::Bound<'py, pyo3::PyAny>> {
                $crate::parts::replaced(slf.as_any(), Self::PARTS, changes)
            }
        }
    };
}
pub(crate) use parts;

/// Pickling of an enumeration, by the name of the member.
macro_rules! members {
    ($class:ident) => {
        #[pyo3::pymethods]
        impl $class {
            fn __reduce__<'py>(
                slf: &pyo3::Bound<'py, Self>,
            ) -> pyo3::PyResult<$crate::parts::Member<'py>> {
                $crate::parts::member(slf.as_any())
            }
        }
    };
}
pub(crate) use members;

/// The function `getattr`, the class, and the name of a member.
pub(crate) type Member<'py> = (Bound<'py, PyAny>, (Bound<'py, PyType>, String));

/// `getattr(class, "MEMBER")` of a member of an enumeration, as `pickle` wants it.
pub(crate) fn member<'py>(value: &Bound<'py, PyAny>) -> PyResult<Member<'py>> {
    // Shown as `Preset.FAST`.
    let shown = value.repr()?.to_string();
    let name = shown.rsplit('.').next().unwrap_or_default().to_owned();
    let getattr = value.py().import("builtins")?.getattr("getattr")?;
    Ok((getattr, (value.get_type(), name)))
}
