//! Forces as Python gives them: numbers, or texts with the unit of a force or of a force per length.

use contact_core::scene::ForceUnits;

use super::increments::{Values, visit};
use crate::document::{has_unit, text_of};
use crate::prelude::*;
use crate::quantity::si;

/// A force \[N\], or in plane strain a force per length \[N/m\], with the unit that it was written in.
pub(super) struct Force {
    pub(super) value: f64,
    pub(super) units: ForceUnits,
}

/// One force or several to visit in turn, with the units that they were written in.
pub(super) struct Forces {
    pub(super) values: Values,
    pub(super) units: ForceUnits,
}

macro_rules! forces {
    ($($name:ident)*) => {
        impl Force {
            $(pub(super) fn $name(value: &Bound<'_, PyAny>) -> PyResult<Option<Self>> {
                if value.is_none() {
                    return Ok(None);
                }
                let units = units(value)?;
                si(stringify!($name), value).map(|value| Some(Self { value, units }))
            })*
        }

        #[allow(dead_code)] // not each name is visited
        impl Forces {
            $(pub(super) fn $name(value: &Bound<'_, PyAny>) -> PyResult<Self> {
                let mut written = units(value)?;
                if let Ok(several) = value.extract::<List<Bound<'_, PyAny>>>() {
                    for one in several.iter() {
                        written.add(units(one)?);
                    }
                }
                visit(stringify!($name), value).map(|values| Self { values, units: written })
            })*
        }
    };
}

forces!(W T_x T_y);

/// The dimension of a force from a text or a quantity of pint; unknown for a number.
fn units(value: &Bound<'_, PyAny>) -> PyResult<ForceUnits> {
    if !has_unit(value)? {
        return Ok(ForceUnits::default());
    }
    let text = text_of(value)?;
    Ok(text.map_or_else(ForceUnits::default, |text| ForceUnits::from_text(&text)))
}

/// The values of optional forces, and the dimensions of all.
pub(super) fn values_and_units<const N: usize>(
    forces: [Option<Force>; N],
) -> ([Option<f64>; N], ForceUnits) {
    let mut units = ForceUnits::default();
    let values = forces.map(|force| {
        force.map(|force| {
            units.add(force.units);
            force.value
        })
    });
    (values, units)
}
