//! The variables over the points that have yielded, of all increments that keep their fields.

use contact_core::yielding::{PlasticPoint, PlasticState, Yielded};

use super::Kind;

/// Dimension of the points, increment after increment.
pub const POINTS: &str = "yielded";

/// A number of every point.
#[derive(Clone, Copy, Debug)]
pub struct PointVariable {
    /// Name.
    pub name: &'static str,
    /// Unit; `1` for a number without.
    pub units: &'static str,
    /// Meaning, for people.
    pub long_name: &'static str,
    /// Storage type.
    pub kind: Kind,
    /// Its value at a point of an increment and a body.
    pub value: fn(usize, usize, &PlasticPoint) -> f64,
}

/// A whole number per yielded point, from its body, its increment and the point.
const fn count(
    name: &'static str,
    long_name: &'static str,
    value: fn(usize, usize, &PlasticPoint) -> f64,
) -> PointVariable {
    PointVariable {
        name,
        units: "1",
        long_name,
        kind: Kind::Count,
        value,
    }
}

/// A strain per yielded point.
const fn strain(
    name: &'static str,
    long_name: &'static str,
    value: fn(usize, usize, &PlasticPoint) -> f64,
) -> PointVariable {
    PointVariable {
        name,
        units: "1",
        long_name,
        kind: Kind::Real,
        value,
    }
}

/// A back stress per yielded point \[Pa\].
const fn back_stress(
    name: &'static str,
    long_name: &'static str,
    value: fn(usize, usize, &PlasticPoint) -> f64,
) -> PointVariable {
    PointVariable {
        units: "Pa",
        ..strain(name, long_name, value)
    }
}

/// The variables over [`POINTS`] of a scene that may yield.
pub const YIELDED: &[PointVariable] = &[
    count(
        "yielded_increment",
        "increment whose plastic strain is kept",
        |increment, _, _| increment as f64,
    ),
    count("yielded_body", "body of the point, 1 or 2", |_, body, _| {
        body as f64
    }),
    count(
        "yielded_plane",
        "plane of Gauss points of the volume grid",
        |_, _, point| f64::from(point.plane),
    ),
    count(
        "yielded_cell",
        "cell of the volume grid, x first",
        |_, _, point| f64::from(point.cell),
    ),
    strain(
        "equivalent_plastic_strain",
        "equivalent plastic strain, added up over the path",
        |_, _, point| point.equivalent,
    ),
    strain("plastic_strain_xx", "plastic strain xx", |_, _, point| {
        point.strain[0]
    }),
    strain("plastic_strain_yy", "plastic strain yy", |_, _, point| {
        point.strain[1]
    }),
    strain("plastic_strain_zz", "plastic strain zz", |_, _, point| {
        point.strain[2]
    }),
    strain("plastic_strain_xy", "plastic strain xy", |_, _, point| {
        point.strain[3]
    }),
    strain(
        "plastic_strain_xz",
        "plastic strain xz, z into the body",
        |_, _, point| point.strain[4],
    ),
    strain(
        "plastic_strain_yz",
        "plastic strain yz, z into the body",
        |_, _, point| point.strain[5],
    ),
    back_stress(
        "back_stress_xx",
        "back stress with recall xx",
        |_, _, point| back_stress_sum(point, 0),
    ),
    back_stress(
        "back_stress_yy",
        "back stress with recall yy",
        |_, _, point| back_stress_sum(point, 1),
    ),
    back_stress(
        "back_stress_zz",
        "back stress with recall zz",
        |_, _, point| back_stress_sum(point, 2),
    ),
    back_stress(
        "back_stress_xy",
        "back stress with recall xy",
        |_, _, point| back_stress_sum(point, 3),
    ),
    back_stress(
        "back_stress_xz",
        "back stress with recall xz, z into the body",
        |_, _, point| back_stress_sum(point, 4),
    ),
    back_stress(
        "back_stress_yz",
        "back stress with recall yz, z into the body",
        |_, _, point| back_stress_sum(point, 5),
    ),
];

/// The sum of the back stresses with recall.
fn back_stress_sum(point: &PlasticPoint, component: usize) -> f64 {
    point.back.iter().map(|back| back[component]).sum()
}

/// Columns of the yielded points of an increment, one for each of [`YIELDED`].
pub fn to_rows(increment: usize, yielded: &Yielded) -> Vec<Vec<f64>> {
    let column = |variable: &PointVariable| {
        let bodies = yielded.bodies.iter();
        let values_of_body = |body: &PlasticState| {
            let points = body.points.iter();
            points
                .map(|point| (variable.value)(increment, body.body, point))
                .collect::<Vec<_>>()
        };
        bodies.flat_map(values_of_body).collect()
    };
    YIELDED.iter().map(column).collect()
}

/// Restores the plastic state from the columns that [`to_rows`] made. The first back stress is the sum of the
/// stored ones, so that the yield surface stays in place.
pub fn from_rows(rows: &[Vec<f64>]) -> Yielded {
    let mut yielded = Yielded::default();
    let count = rows.first().map_or(0, Vec::len);
    if rows.len() != YIELDED.len() || rows.iter().any(|column| column.len() != count) {
        return yielded;
    }
    for n in 0..count {
        let value = |column: usize| rows[column][n];
        let number = value(1) as usize;
        let point = PlasticPoint {
            plane: value(2) as u32,
            cell: value(3) as u32,
            equivalent: value(4),
            strain: std::array::from_fn(|c| value(5 + c)),
            back: [std::array::from_fn(|c| value(11 + c)), [0.0; 6], [0.0; 6]],
            growth: [0.0; 6],
        };
        yielded.largest = yielded.largest.max(point.equivalent);
        let same_body = yielded.bodies.iter_mut().find(|body| body.body == number);
        match same_body {
            Some(body) => body.points.push(point),
            None => yielded.bodies.push(PlasticState {
                body: number,
                points: vec![point],
                displacement: Vec::new(),
                growth: Vec::new(),
            }),
        }
    }
    yielded
}
