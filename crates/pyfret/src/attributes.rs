//! Attributes of classes: a name, a type and a value each.

/// Attributes of a class that are read and not set, `name: type = value` each with its docstring;
/// with `py` those that make an object of Python.
macro_rules! attributes {
    ($class:ident, $own:ident: $($(#[$doc:meta])* $name:ident: $of:ty = $value:expr;)*) => {
        #[pyo3::pymethods]
        impl $class {$(
            $(#[$doc])*
            #[getter]
            fn $name(&$own) -> $of {
                $value
            }
        )*}
    };
    ($class:ident, $own:ident, $py:ident: $($(#[$doc:meta])* $name:ident: $of:ty = $value:expr;)*) => {
        #[pyo3::pymethods]
        impl $class {$(
            $(#[$doc])*
            #[getter]
            fn $name<'py>(&$own, $py: pyo3::Python<'py>) -> $of {
                $value
            }
        )*}
    };
}
pub(crate) use attributes;
