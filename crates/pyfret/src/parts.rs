//! Parts of a scene as values: they are pickled, copied, and given again with something
//! exchanged. All follows from the arguments of the constructor and the attributes that hold them.

use numpy::PyUntypedArray;
use pyo3::types::{PyList, PyTuple};

use crate::prelude::*;
use crate::python::own;

/// The arguments of the constructor that make `value` again, from pairs (argument, attribute).
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

/// A hash of the parts; equal values have equal hashes.
pub(crate) fn hash(value: &Bound<'_, PyAny>, parts: &[(&str, &str)]) -> PyResult<isize> {
    let mut hashes = vec![value.get_type().into_any()];
    for (_, attribute) in parts {
        hashes.push(hashable(value.getattr(*attribute)?)?);
    }
    PyTuple::new(value.py(), hashes)?.hash()
}

/// Converts lists to tuples, and arrays to their bytes.
fn hashable(value: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items: Vec<_> = value
            .try_iter()?
            .map(|item| hashable(item?))
            .collect::<PyResult<_>>()?;
        return Ok(PyTuple::new(value.py(), items)?.into_any());
    }
    if value.is_instance_of::<PyUntypedArray>() {
        // -0 equals 0.
        return value.add(0.0)?.call_method0("tobytes");
    }
    Ok(value)
}

/// Call of `pickle`: [`crate::python::remake`] and its arguments.
pub(crate) type Remade<'py> = (
    Bound<'py, PyAny>,
    (
        Bound<'py, PyAny>,
        Option<String>,
        Option<Bound<'py, PyDict>>,
    ),
);

/// The parts that `pickle` needs to make `value` again: the function or class `by` of the module and its arguments.
pub(crate) fn remade<'py>(
    value: &Bound<'py, PyAny>,
    by: &str,
    parts: &[(&str, &str)],
) -> PyResult<Remade<'py>> {
    let py = value.py();
    let keywords = arguments(value, parts)?;
    Ok((own(py, "remake")?, (own(py, by)?, None, Some(keywords))))
}

/// The parts that `pickle` needs to make a value again by a method of its class.
pub(crate) fn remade_by_method<'py>(
    class: Bound<'py, PyAny>,
    method: &str,
    arguments: Bound<'py, PyDict>,
) -> PyResult<Remade<'py>> {
    let remake = own(class.py(), "remake")?;
    Ok((remake, (class, Some(method.to_owned()), Some(arguments))))
}

/// Whether `other` is of the same class and has equal parts.
pub(crate) fn equal(
    value: &Bound<'_, PyAny>,
    other: &Bound<'_, PyAny>,
    parts: &[(&str, &str)],
) -> PyResult<bool> {
    if !other.get_type().is(value.get_type()) {
        return Ok(false);
    }
    arguments(value, parts)?.eq(arguments(other, parts)?)
}

/// The text of a call of the constructor that makes `value`.
pub(crate) fn shown(value: &Bound<'_, PyAny>, parts: &[(&str, &str)]) -> PyResult<String> {
    let texts = parts.iter().map(|(argument, attribute)| {
        let text = value.getattr(*attribute)?.repr()?;
        Ok(format!("{argument}={text}"))
    });
    let texts: Vec<_> = texts.collect::<PyResult<_>>()?;
    Ok(format!(
        "{}({})",
        value.get_type().name()?,
        texts.join(", ")
    ))
}

/// Pickling, copying, comparing and showing of a class whose values a function of the module makes,
/// or the class itself, by the arguments that were given, each an attribute of its name. It is
/// a key of a dict unless it is `changing`.
macro_rules! made {
    ($class:ident by $maker:literal: $($argument:ident),*) => {
        $crate::parts::made!(changing $class by $maker: $($argument),*);

        #[pyo3::pymethods]
        impl $class {
            fn __hash__(slf: &pyo3::Bound<'_, Self>) -> pyo3::PyResult<isize> {
                $crate::parts::hash(slf.as_any(), Self::PARTS)
            }
        }
    };
    (changing $class:ident by $maker:literal: $($argument:ident),*) => {
        impl $class {
            /// Arguments, and the attributes that hold them.
            const PARTS: &'static [(&'static str, &'static str)] =
                &[$((stringify!($argument), stringify!($argument))),*];
        }

        #[pyo3::pymethods]
        impl $class {
            fn __getattr__(slf: &pyo3::Bound<'_, Self>, name: &str) -> pyo3::PyResult<()> {
                Err($crate::python::missing_attribute(slf.as_any(), name))
            }

            fn __reduce__<'py>(
                slf: &pyo3::Bound<'py, Self>,
            ) -> pyo3::PyResult<$crate::parts::Remade<'py>> {
                $crate::parts::remade(slf.as_any(), $maker, Self::PARTS)
            }

            fn __eq__(
                slf: &pyo3::Bound<'_, Self>,
                other: &pyo3::Bound<'_, pyo3::PyAny>,
            ) -> pyo3::PyResult<bool> {
                $crate::parts::equal(slf.as_any(), other, Self::PARTS)
            }

            fn __repr__(slf: &pyo3::Bound<'_, Self>) -> pyo3::PyResult<String> {
                $crate::parts::shown(slf.as_any(), Self::PARTS)
            }
        }
    };
}
pub(crate) use made;

/// A value of the same class with some parts changed.
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
/// attribute that holds it where that has another name; and a method `replace`, except for `pickled`.
macro_rules! parts {
    (pickled $class:ident: $($argument:ident $(= $attribute:ident)?),*) => {
        #[pyo3::pymethods]
        impl $class {
            fn __getattr__(slf: &pyo3::Bound<'_, Self>, name: &str) -> pyo3::PyResult<()> {
                Err($crate::python::missing_attribute(slf.as_any(), name))
            }

            fn __getnewargs_ex__<'py>(
                slf: &pyo3::Bound<'py, Self>,
            ) -> pyo3::PyResult<((), pyo3::Bound<'py, pyo3::types::PyDict>)> {
                Ok(((), $crate::parts::arguments(slf.as_any(), Self::PARTS)?))
            }

            #[pyo3(signature = (**changes: "Any") -> "Self")]
            fn __replace__<'py>(
                slf: &pyo3::Bound<'py, Self>,
                changes: Option<&pyo3::Bound<'py, pyo3::types::PyDict>>,
            ) -> pyo3::PyResult<pyo3::Bound<'py, pyo3::PyAny>> {
                $crate::parts::replaced(slf.as_any(), Self::PARTS, changes)
            }

            fn __hash__(slf: &pyo3::Bound<'_, Self>) -> pyo3::PyResult<isize> {
                $crate::parts::hash(slf.as_any(), Self::PARTS)
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
            /// Return a copy with some of its parts exchanged, named as in the constructor.
            #[pyo3(signature = (**changes: "Any") -> "Self")]
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

/// An enumeration of the core: its members with their names in Python, and pickling by the name.
macro_rules! members {
    ($(#[$doc:meta])* $class:ident: $($member:ident = $name:literal),*) => {
        $(#[$doc])*
        #[pyo3::pyclass(frozen, eq, eq_int, hash, module = "pyfret")]
        #[derive(Clone, Copy, PartialEq, Eq, Hash)]
        pub(crate) enum $class {$(
            #[pyo3(name = $name)]
            $member,
        )*}

        // A member, or its name in any case.
        impl<'py> pyo3::FromPyObject<'_, 'py> for $class {
            type Error = pyo3::PyErr;

            const INPUT_TYPE: pyo3::inspect::PyStaticExpr = {
                use pyo3::type_hint_union;
                type_hint_union!(<Self as pyo3::PyTypeInfo>::TYPE_HINT, $crate::hints::TEXT)
            };

            /// Takes a member of the enumeration, or its name.
            fn extract(value: pyo3::Borrowed<'_, 'py, pyo3::PyAny>) -> pyo3::PyResult<Self> {
                if let Ok(member) = value.cast::<Self>() {
                    return Ok(*member.get());
                }
                let names = [$($name),*].map(str::to_lowercase);
                if let Ok(text) = value.extract::<String>() {
                    let text = text.to_lowercase();
                    $(if text == $name.to_lowercase() {
                        return Ok(Self::$member);
                    })*
                    return Err(pyo3::exceptions::PyValueError::new_err(format!(
                        "{text:?}: must be one of {}",
                        names.map(|name| format!("{name:?}")).join(", ")
                    )));
                }
                let allowed = format!("a {}, or one of {}", stringify!($class), names.join(", "));
                Err($crate::error::must_be(&value, &allowed))
            }
        }

        impl From<$class> for contact_core::scene::$class {
            fn from(member: $class) -> Self {
                match member { $($class::$member => Self::$member),* }
            }
        }

        impl From<contact_core::scene::$class> for $class {
            fn from(member: contact_core::scene::$class) -> Self {
                match member { $(contact_core::scene::$class::$member => Self::$member),* }
            }
        }

        #[pyo3::pymethods]
        impl $class {
            fn __reduce__<'py>(
                slf: &pyo3::Bound<'py, Self>,
            ) -> pyo3::PyResult<$crate::parts::Remade<'py>> {
                $crate::parts::member(slf.as_any())
            }
        }
    };
}
pub(crate) use members;

/// The parts that `pickle` needs for a member of an enumeration: its class and name.
pub(crate) fn member<'py>(value: &Bound<'py, PyAny>) -> PyResult<Remade<'py>> {
    // Shown as `Preset.FAST`.
    let shown = value.repr()?.to_string();
    let name = shown.rsplit('.').next().unwrap_or_default().to_owned();
    let class = value.get_type().into_any();
    Ok((own(value.py(), "remake")?, (class, Some(name), None)))
}
