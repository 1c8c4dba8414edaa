//! Numbers that may come with a unit: quantities of pint, texts such as "380 GPa".

use contact_core::scene::quantity as in_si;

use crate::document::text_of;
use crate::prelude::*;

/// The number in SI of a value with this name in a scene file; a text or quantity of pint brings its unit.
pub(crate) fn si(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let Some(text) = text_of(value)? else {
        return number(value);
    };
    in_si(name, &text)
        .map_err(|allowed| PyValueError::new_err(format!("{text:?}: must be {allowed}")))
}

/// Takes an argument of a name.
pub(crate) struct Given;
/// Takes an argument of a name that may be left out.
pub(crate) struct Optional;

/// The key of a name: where the name alone has several meanings, with what stands before it.
macro_rules! key {
    ($name:ident) => {
        stringify!($name)
    };
    ($name:ident $key:literal) => {
        $key
    };
}

macro_rules! taken {
    ($($name:ident $(= $key:literal)?)*) => {
        #[allow(dead_code)] // each name has both kinds
        impl Given {$(
            pub(crate) fn $name(value: &Bound<'_, PyAny>) -> PyResult<f64> {
                si(key!($name $($key)?), value)
            }
        )*}

        #[allow(dead_code)]
        impl Optional {$(
            pub(crate) fn $name(value: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
                if value.is_none() {
                    return Ok(None);
                }
                si(key!($name $($key)?), value).map(Some)
            }
        )*}
    };
}

taken! {
    E thickness R R_x R_y length crown radius edge spacing count amplitude wavelength angle phase slope
    W T_x T_y M_x M_y M_z delta_x delta_y phi_z sigma_B sigma_B1 rolled stiffness
    s_y hardening voce_Q kinematic
    azimuth depth extent longest rms shortest frequency delta_z phi_x phi_y t rig_stiffness
    E_star p0 middle dx dy width
    point_W = "Hertz.W" point_T = "CattaneoMindlin.T"
    line_W = "line_contact.W" line_T = "LineContact.T"
    bond_normal bond_shear
}
