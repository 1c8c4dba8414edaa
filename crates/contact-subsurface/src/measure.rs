//! Numbers that follow from the six stresses at a point.

use ndarray::{Array1, ArrayView2, Axis};
use stress_tensor::{StressTensor, hydrostatic, principal_values, tresca, von_mises};

/// A number that follows from the stress at a point.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Name.
    pub name: &'static str,
    /// Description; all are in Pa.
    pub long_name: &'static str,
    /// Its value.
    pub value: fn(&StressTensor) -> f64,
    /// True if its largest value is searched on interfaces only.
    pub on_interfaces: bool,
}

impl Measure {
    /// Values at points, from their stresses of shape (6, points) \[Pa\].
    pub fn at_points(&self, stress: &ArrayView2<'_, f64>) -> Array1<f64> {
        let columns = stress.axis_iter(Axis(1));
        columns
            .map(|s| (self.value)(&std::array::from_fn(|c| s[c])))
            .collect()
    }
}

/// A measure with one value at a place; at an interface it is taken from one side.
const fn measure(
    name: &'static str,
    long_name: &'static str,
    value: fn(&StressTensor) -> f64,
) -> Measure {
    Measure {
        name,
        long_name,
        value,
        on_interfaces: false,
    }
}

/// Lets a measure count on interfaces, too, where its value is the same on both sides.
const fn on_interfaces(measure: Measure) -> Measure {
    Measure {
        on_interfaces: true,
        ..measure
    }
}

/// All measures.
pub const MEASURES: &[Measure] = &[
    measure("s_xx", "normal stress along x, tension positive", |s| s[0]),
    measure("s_yy", "normal stress along y, tension positive", |s| s[1]),
    measure("s_zz", "normal stress along z, tension positive", |s| s[2]),
    measure("s_xy", "shear stress xy", |s| s[3]),
    measure("s_xz", "shear stress xz", |s| s[4]),
    measure("s_yz", "shear stress yz", |s| s[5]),
    measure("von_mises", "von Mises equivalent stress", von_mises),
    measure("tresca", "Tresca equivalent stress, s_1 - s_3", tresca),
    measure("s_1", "largest principal stress", |s| {
        principal_values(s)[0]
    }),
    measure("s_2", "middle principal stress", |s| principal_values(s)[1]),
    measure("s_3", "smallest principal stress", |s| {
        principal_values(s)[2]
    }),
    measure(
        "hydrostatic",
        "hydrostatic stress, tension positive",
        hydrostatic,
    ),
    on_interfaces(measure(
        "interface_shear",
        "shear traction on planes z = const, size; largest on an interface",
        |s| s[4].hypot(s[5]),
    )),
    on_interfaces(measure(
        "interface_peel",
        "tension across planes z = const, 0 where they are pressed; largest on an interface",
        |s| s[2].max(0.0),
    )),
];

/// Looks up a measure by its name.
pub fn find_measure(name: &str) -> Option<&'static Measure> {
    MEASURES.iter().find(|m| m.name == name)
}
