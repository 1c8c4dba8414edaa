//! Stress in the plane and its traction on a line.

use super::Error;

/// Stress in the plane \[Pa\], tension positive: s_xx, s_zz, s_xz.
pub type PlaneStress = [f64; 3];

/// Traction on a line \[Pa\]: s_nn and s_tn, t along the line from the mouth to the tip, n = t
/// turned by 90 degrees towards +x of a line along the depth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Traction {
    /// Normal traction s_nn \[Pa\].
    pub normal: f64,
    /// Shear traction s_tn \[Pa\].
    pub shear: f64,
}

/// A point of a crack at which the stress is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Place along the surface \[m\].
    pub x: f64,
    /// Depth \[m\].
    pub z: f64,
    /// Angle of the crack there from the inward normal, positive towards +x \[rad\].
    pub angle: f64,
    /// Length of the crack from the mouth to the point \[m\].
    pub s: f64,
}

impl Point {
    /// The traction of a stress on the crack's line here: t = (sin, cos), n = (cos, -sin).
    pub fn traction(&self, [s_xx, s_zz, s_xz]: PlaneStress) -> Traction {
        let (sin, cos) = self.angle.sin_cos();
        Traction {
            normal: cos * cos * s_xx - 2.0 * cos * sin * s_xz + sin * sin * s_zz,
            shear: sin * cos * (s_xx - s_zz) + (cos * cos - sin * sin) * s_xz,
        }
    }
}

/// Tractions of the stress at each of the points; fails where their numbers differ or a stress is
/// not finite.
pub(crate) fn tractions(points: &[Point], stress: &[PlaneStress]) -> Result<Vec<Traction>, Error> {
    if points.len() != stress.len() {
        let allowed = format!("{}, one for each point of the crack", points.len());
        return Err(Error::invalid("number of stresses", stress.len(), allowed));
    }
    let of = |(point, stress): (&Point, &PlaneStress)| {
        let traction = point.traction(*stress);
        if traction.normal.is_finite() && traction.shear.is_finite() {
            return Ok(traction);
        }
        let place = format!("stress at x = {:.4e} m, z = {:.4e} m", point.x, point.z);
        Err(Error::invalid(place, format!("{stress:?}"), "finite"))
    };
    points.iter().zip(stress).map(of).collect()
}
