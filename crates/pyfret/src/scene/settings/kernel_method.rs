//! How frequency responses become influence coefficients.

use contact_core::scene as core;
use pyo3::prelude::*;

use crate::parts::{parts, shown_by_parts};

/// Influence coefficients by Hankel integrals: exact to round-off.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.settings")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Hankel;

parts!(Hankel:);
shown_by_parts!(Hankel);

#[pymethods]
impl Hankel {
    #[new]
    fn new() -> Self {
        Self
    }
}

/// Influence coefficients by the paper's inverse FFT, eq. (9)-(13).
///
/// Parameters
/// ----------
/// enlargement : int
///     How many times larger the domain is, the paper's lambda, 1 to 12 (default 8).
/// aliases : int
///     Order of the alias sums (default 0, as in the paper).
#[pyclass(frozen, eq, get_all, from_py_object, module = "pyfret.settings")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct InverseFft {
    /// How many times larger the domain is.
    enlargement: usize,
    /// Order of the alias sums.
    aliases: usize,
}

parts!(InverseFft: enlargement, aliases);
shown_by_parts!(InverseFft);

#[pymethods]
impl InverseFft {
    #[new]
    #[pyo3(signature = (*, enlargement = 8, aliases = 0))]
    fn new(enlargement: usize, aliases: usize) -> Self {
        Self {
            enlargement,
            aliases,
        }
    }
}

/// No coefficients: every convolution with the frequency response on an enlarged domain.
///
/// Parameters
/// ----------
/// enlargement : int
///     How many times larger the domain is, 1 to 12 (default 8).
#[pyclass(frozen, eq, get_all, from_py_object, module = "pyfret.settings")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct FrequencyDomain {
    /// How many times larger the domain is.
    enlargement: usize,
}

parts!(FrequencyDomain: enlargement);
shown_by_parts!(FrequencyDomain);

#[pymethods]
impl FrequencyDomain {
    #[new]
    #[pyo3(signature = (*, enlargement = 8))]
    fn new(enlargement: usize) -> Self {
        Self { enlargement }
    }
}

/// Any method of conversion, on its way in or out.
#[derive(FromPyObject, IntoPyObject)]
pub(crate) enum Method {
    Hankel(Hankel),
    InverseFft(InverseFft),
    FrequencyDomain(FrequencyDomain),
}

impl From<Method> for core::KernelMethod {
    fn from(method: Method) -> Self {
        match method {
            Method::Hankel(_) => Self::Hankel,
            Method::InverseFft(InverseFft {
                enlargement: lambda,
                aliases,
            }) => Self::InverseFft { lambda, aliases },
            Method::FrequencyDomain(FrequencyDomain {
                enlargement: lambda,
            }) => Self::FrequencyDomain { lambda },
        }
    }
}

impl From<core::KernelMethod> for Method {
    fn from(method: core::KernelMethod) -> Self {
        match method {
            core::KernelMethod::Hankel => Self::Hankel(Hankel),
            core::KernelMethod::InverseFft { lambda, aliases } => Self::InverseFft(InverseFft {
                enlargement: lambda,
                aliases,
            }),
            core::KernelMethod::FrequencyDomain { lambda } => {
                Self::FrequencyDomain(FrequencyDomain {
                    enlargement: lambda,
                })
            }
        }
    }
}
