//! The limit or the curve of lives of a criterion for a material.

use material_table::Material;

use crate::error::Error;
use crate::life::{Basquin, CoffinManson};

/// The limit or the curve of lives that a value is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Judge {
    /// A limit for endless life, in the unit of the value.
    Limit(f64),
    /// A curve of lives.
    Life(CoffinManson),
}

/// The strain-life curve of a material.
pub fn strain_life(material: &Material) -> Result<CoffinManson, Error> {
    let number = |name: &str| material.number(name);
    let curve = CoffinManson {
        E: number("E")?,
        elastic: Basquin {
            coefficient: number("s_f")?,
            exponent: number("b")?,
        },
        ductility: number("e_f")?,
        exponent: number("c")?,
    };
    curve.check()?;
    Ok(curve)
}
