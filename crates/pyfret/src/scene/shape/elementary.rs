//! Shapes that a few numbers describe.

/// A shape class with numbers for fields, and its way to and from the core's variant.
macro_rules! elementary {
    ($(#[$doc:meta])* $name:ident { $($(#[$about:meta])* $field:ident),* }, ($($signature:tt)*)) => {
        $(#[$doc])*
        #[pyo3::pyclass(frozen, eq, from_py_object, module = "pyfret.shapes")]
        #[derive(Clone, Copy, PartialEq)]
        pub(crate) struct $name {
            $($(#[$about])* #[pyo3(get)] pub(super) $field: f64,)*
        }

        #[pyo3::pymethods]
        impl $name {
            #[new]
            #[pyo3(signature = ($($signature)*))]
            fn new($(#[pyo3(from_py_with = $crate::quantity::Given::$field)] $field: f64),*) -> $crate::error::Answer<Self> {
                let shape = Self { $($field),* };
                contact_core::scene::Shape::from(shape).check("shape")?;
                Ok(shape)
            }

            pub(super) fn __repr__(&self) -> String {
                let fields: &[String] = &[$(format!(concat!(stringify!($field), "={:?}"), self.$field)),*];
                format!(concat!(stringify!($name), "({})"), fields.join(", "))
            }
        }

        crate::parts::parts!($name: $($field),*);

        impl From<$name> for contact_core::scene::Shape {
            fn from(shape: $name) -> Self {
                let $name { $($field),* } = shape;
                Self::$name { $($field),* }
            }
        }
    };
}
pub(super) use elementary;
