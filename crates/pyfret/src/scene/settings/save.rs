//! Which increments keep their fields.

use contact_core::Error;
use contact_core::scene as core;
use pyo3::prelude::*;

use crate::arguments::List;
use crate::error::{must_be, to_python};

/// Which increments keep their fields, on its way in or out.
#[derive(IntoPyObject)]
pub(crate) enum Save {
    Indices(Vec<usize>),
    Named(String),
}

impl<'py> FromPyObject<'_, 'py> for Save {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(name) = value.extract::<String>() {
            return Ok(Self::Named(name));
        }
        let indices = value.extract::<List<usize>>();
        let wanted = "\"branches\", \"all\" or a list of increments, from 1";
        indices
            .map(|indices| Self::Indices(indices.0))
            .map_err(|_| must_be(&value, wanted))
    }
}

impl Save {
    pub(crate) fn into_core(self) -> PyResult<core::SaveFields> {
        match self {
            Self::Indices(indices) => Ok(core::SaveFields::Indices(indices)),
            Self::Named(name) if name == "branches" => Ok(core::SaveFields::Branches),
            Self::Named(name) if name == "all" => Ok(core::SaveFields::All),
            Self::Named(name) => {
                let allowed = "\"branches\", \"all\" or a list of increments, from 1";
                Err(to_python(Error::invalid("output.save", name, allowed)))
            }
        }
    }
}

impl From<&core::SaveFields> for Save {
    fn from(save: &core::SaveFields) -> Self {
        match save {
            core::SaveFields::Branches => Self::Named("branches".into()),
            core::SaveFields::All => Self::Named("all".into()),
            core::SaveFields::Indices(indices) => Self::Indices(indices.clone()),
        }
    }
}
