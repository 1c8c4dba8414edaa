//! Names that most files of the binding use.

pub(crate) use std::path::PathBuf;
pub(crate) use std::sync::Arc;

pub(crate) use numpy::{IntoPyArray, ToPyArray};
pub(crate) use pyo3::exceptions::PyValueError;
pub(crate) use pyo3::inspect::PyStaticExpr;
pub(crate) use pyo3::prelude::*;
pub(crate) use pyo3::types::PyDict;

pub(crate) use crate::arguments::{Array, Field, List, Mask, number, side};
pub(crate) use crate::attributes::attributes;
pub(crate) use crate::error::{must_be, refuse, takes};
pub(crate) use crate::interruptible::{interruptible, stoppable};
pub(crate) use crate::parts::{made, parts};
pub(crate) use crate::quantity::{Given, Optional};
