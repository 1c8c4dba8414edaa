//! Triangles on half of the unit sphere: the normals of all planes, each plane once.

use std::sync::LazyLock;

use crate::path::{cross, dot, normalize};

/// Corners of a triangle on the sphere, as unit vectors.
pub(crate) type Triangle = [[f64; 3]; 3];

/// A triangle and the numbers of the planes of its corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    pub(crate) corners: Triangle,
    pub(crate) planes: [usize; 3],
    /// [`sag`] of the corners.
    pub(crate) sag: f64,
    /// Upper bound of the value of its planes.
    pub(crate) most: f64,
}

impl Face {
    /// A face with these corners, whose planes have the given numbers, and without a bound.
    pub(crate) fn new(corners: Triangle, planes: [usize; 3]) -> Self {
        let sag = sag(&corners);
        Self {
            corners,
            planes,
            sag,
            most: f64::INFINITY,
        }
    }
}

/// The start of a search: ten faces of an icosahedron, divided into four a few times.
pub(crate) struct Hemisphere {
    /// A normal of every plane.
    pub(crate) planes: Vec<[f64; 3]>,
    pub(crate) faces: Vec<Face>,
    /// The largest [`sag`] of the faces.
    pub(crate) sag: f64,
}

/// 40 faces, for criteria with sharp bounds on large faces.
pub(crate) static COARSE: LazyLock<Hemisphere> = LazyLock::new(|| build_hemisphere(1));
/// 160 faces.
pub(crate) static FINE: LazyLock<Hemisphere> = LazyLock::new(|| build_hemisphere(2));

/// Triangles and planes of a hemisphere: half of an icosahedron with each triangle divided into four, `cuts`
/// times.
fn build_hemisphere(cuts: usize) -> Hemisphere {
    let mut faces: Vec<Triangle> = half_icosahedron();
    for _ in 0..cuts {
        faces = faces.iter().flat_map(divide_triangle).collect();
    }
    let mut planes: Vec<[f64; 3]> = Vec::new();
    let mut number = |n: [f64; 3]| {
        let same = |m: &[f64; 3]| dot(*m, n).abs() > 1.0 - 1e-9;
        planes.iter().position(same).unwrap_or_else(|| {
            planes.push(n);
            planes.len() - 1
        })
    };
    let faces = faces
        .into_iter()
        .map(|corners| Face::new(corners, corners.map(&mut number)))
        .collect::<Vec<_>>();
    let sag = faces.iter().map(|f: &Face| f.sag).fold(0.0, f64::max);
    Hemisphere { planes, faces, sag }
}

/// Ten faces of a regular icosahedron of which none lies opposite another.
fn half_icosahedron() -> Vec<Triangle> {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let mut corners = Vec::new();
    for (a, b) in [
        (1.0, golden),
        (1.0, -golden),
        (-1.0, golden),
        (-1.0, -golden),
    ] {
        corners.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]].map(normalize));
    }
    // Corners of a face are neighbours: the cosine between them is 1/sqrt 5.
    let near = |a: [f64; 3], b: [f64; 3]| (dot(a, b) - 0.2_f64.sqrt()).abs() < 1e-9;
    let mut faces: Vec<Triangle> = Vec::new();
    for (i, &a) in corners.iter().enumerate() {
        for (j, &b) in corners.iter().enumerate().skip(i + 1) {
            for &c in &corners[j + 1..] {
                if near(a, b) && near(b, c) && near(a, c) {
                    let centre = centroid_on_sphere([a, b, c]);
                    let opposite =
                        |f: &Triangle| dot(self::centroid_on_sphere(*f), centre) < -1.0 + 1e-9;
                    if !faces.iter().any(opposite) {
                        faces.push([a, b, c]);
                    }
                }
            }
        }
    }
    faces
}

/// The unit vector through the centroid of a triangle.
fn centroid_on_sphere([a, b, c]: Triangle) -> [f64; 3] {
    normalize(std::array::from_fn(|d| a[d] + b[d] + c[d]))
}

/// The middle of the arc between two corners.
pub(crate) fn arc_midpoint(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    normalize(std::array::from_fn(|d| a[d] + b[d]))
}

/// Divides a triangle into four at the middles of its arcs.
fn divide_triangle([a, b, c]: &Triangle) -> [Triangle; 4] {
    let (ab, bc, ca) = (
        arc_midpoint(*a, *b),
        arc_midpoint(*b, *c),
        arc_midpoint(*c, *a),
    );
    [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]
}

/// 1/cos r - 1, with r the angular radius of the circle through the corners: how far a plane through them lies
/// below the sphere.
pub(crate) fn sag([a, b, c]: &Triangle) -> f64 {
    let edge = |corner: &[f64; 3]| std::array::from_fn(|d| corner[d] - a[d]);
    let axis = cross(edge(b), edge(c));
    let height = dot(axis, *a).abs();
    // With w the axis: |w|/(w.a) - 1, the difference of near numbers written as a product.
    let flat = cross(axis, *a);
    let square = dot(flat, flat);
    let length = dot(axis, axis).sqrt();
    square / (height * (length + height))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_plane_once() {
        let sphere = &*FINE;
        // Euler on the projective plane: planes - edges + faces = 1, edges = 3/2 faces.
        assert_eq!((sphere.planes.len(), sphere.faces.len()), (81, 160));
        // The solid angles of the faces fill half of the sphere.
        let angle = |[a, b, c]: Triangle| {
            let triple = dot(a, cross(b, c)).abs();
            2.0 * triple.atan2(1.0 + dot(a, b) + dot(b, c) + dot(c, a))
        };
        let whole: f64 = sphere.faces.iter().map(|f| angle(f.corners)).sum();
        assert!((whole - 2.0 * std::f64::consts::PI).abs() < 1e-12);
    }

    #[test]
    fn the_sag_is_that_of_the_circle_through_the_corners() {
        for r in [0.3_f64, 1e-5] {
            let corner = |angle: f64| [r.sin() * angle.cos(), r.sin() * angle.sin(), r.cos()];
            let computed = sag(&[corner(0.3), corner(2.0), corner(4.4)]);
            let exact = 2.0 * (r / 2.0).sin().powi(2) / r.cos();
            assert!((computed / exact - 1.0).abs() < 1e-9, "{computed} {exact}");
        }
    }
}
