//! The places of a stroke: shifts of the bodies and the slip at each.

use contact_core::Error;
use contact_core::scene::{Dependence, Scene, Shape};
use ndarray::Array2;

/// Places closer than this part of a cell are the same.
const SAME: f64 = 1e-9;

/// A place of the stroke, the middle of an increment of the cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Shift of body 1 against body 2 along x, in the middle of the increment \[m\].
    pub(crate) shift: f64,
    /// Length of the increment \[m\].
    pub(crate) length: f64,
    /// Slip here per cycle \[m\].
    pub(crate) slip: f64,
    /// Normal force \[N\].
    pub(crate) W: f64,
}

/// The body that the grid is fixed to; the other one slides over it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Frame {
    Body1,
    Body2,
}

impl Frame {
    /// Index of the body that the grid is fixed to.
    pub(crate) fn body(self) -> usize {
        match self {
            Self::Body1 => 0,
            Self::Body2 => 1,
        }
    }

    /// The body on which the grid lies: body 1. If body 1 is straight along x and body 2 is not, the contact
    /// stays on body 2.
    pub(crate) fn new(scene: &Scene) -> Self {
        let straight = [&scene.body1, &scene.body2].map(|body| body.shape.is_straight_along_x());
        if scene.body1.shape == Shape::Flat || (straight[0] && !straight[1]) {
            Self::Body2
        } else {
            Self::Body1
        }
    }

    /// The shape of the body that slides over the grid.
    pub(crate) fn moving_shape(self, scene: &Scene) -> &Shape {
        match self {
            Self::Body1 => &scene.body2.shape,
            Self::Body2 => &scene.body1.shape,
        }
    }

    /// Whether the gap at every place of a stroke is its own mirror image under y -> -y if it is so at no shift.
    pub(crate) fn is_even(self, scene: &Scene) -> bool {
        let shape = self.moving_shape(scene);
        let even = |shape: &Shape| match shape {
            Shape::HeightMap(_) | Shape::Rough(_) => false,
            shape => shape.curvature()[1] == 0.0 && !matches!(shape, Shape::Sum(_)),
        };
        shape.is_straight_along_x() || even(shape)
    }

    /// Gap between the unworn surfaces over the cells where body 1 has moved from `shift - length/2` to
    /// `shift + length/2` along x, mean over the way \[m\].
    pub(crate) fn gap(self, scene: &Scene, shift: f64, length: f64) -> Array2<f64> {
        let (shape, way) = match self {
            Self::Body1 => (&scene.body1.shape, 1.0),
            Self::Body2 => (&scene.body2.shape, -1.0),
        };
        let moving = self.moving_shape(scene);
        if moving.is_straight_along_x() {
            return scene.h_init();
        }
        // Gauss's rule of three points: exact for polynomials of the fifth degree.
        let mut gap = shape.drop(&scene.grid);
        for (node, weight) in [(-0.6_f64.sqrt(), 5.0), (0.0, 8.0), (0.6_f64.sqrt(), 5.0)] {
            let at = way * (shift + 0.5 * node * length);
            if let Some(drop) = moving.drop_shifted(&scene.grid, at) {
                gap.scaled_add(weight / 18.0, &drop);
            }
        }
        gap
    }
}

/// The corners of the loop: shift of the rig \[m\], shift of the contact \[m\], force T_x \[N\].
pub(crate) type Corner = [f64; 3];

/// The places of the cycle, which begins with the branch `first_branch`, and the corners of its
/// loop.
///
/// A rig of stiffness K \[N/m\] drives the contact through a spring (a Prandtl element). Let u be
/// the shift of the rig and d the shift of the contact. Each increment moves d by the least amount
/// to `|u - d| <= mu W/K`.
pub(crate) fn stroke(
    scene: &Scene,
    first_branch: usize,
) -> Result<(Vec<Place>, Vec<Corner>), Error> {
    let rig_stiffness = scene.path.rig_stiffness.unwrap_or(f64::INFINITY);
    check(scene, first_branch, rig_stiffness.is_infinite())?;
    let mu = scene.friction.mu;
    let points = scene.path.points();
    let lead_in = points
        .iter()
        .take_while(|p| p.branch < first_branch)
        .count();
    let cycle = points.len() - lead_in;
    let u_of = |k: usize| {
        points[k]
            .loads
            .given
            .delta_x
            .filter(|u| u.is_finite())
            .unwrap_or(0.0)
    };
    let play =
        |d: f64, u: f64, W: f64| d.clamp(u - mu * W / rig_stiffness, u + mu * W / rig_stiffness);
    let (mut d, mut W) = (0.0, 0.0);
    for k in 0..lead_in {
        W = points[k].loads.W;
        d = play(d, u_of(k), W);
    }
    let mut places: Vec<Place> = Vec::new();
    let (mut corners, mut force) = (Vec::new(), 0.0);
    // The first pass leads to the closed cycle, the second runs through it.
    for pass in 0..2 {
        for k in lead_in..points.len() {
            let (before, W_before) = (d, W);
            W = points[k].loads.W;
            d = play(d, u_of(k), W);
            let slip = (d - before).abs();
            let slips = mu * W_before * (d - before).signum();
            let turns = slip > 0.0 && (force - slips).abs() > 1e-9 * mu * W_before;
            if slip > 0.0 {
                force = mu * W * (d - before).signum();
            } else if rig_stiffness.is_finite() {
                force = rig_stiffness * (u_of(k) - d);
            }
            if pass == 0 {
                continue;
            }
            if turns {
                // Onset of sliding within the increment.
                corners.push([before + force / rig_stiffness, before, force]);
            }
            corners.push([u_of(k), d, force]);
            let (shift, W) = (0.5 * (d + before), 0.5 * (W + W_before));
            if slip == 0.0 {
                continue;
            }
            let near = SAME * scene.grid.dx;
            let same_place = places.iter_mut().find(|p| {
                let alike = (p.shift - shift).abs() < near && (p.length - slip).abs() < near;
                alike && (p.W - W).abs() <= 1e-12 * W
            });
            match same_place {
                Some(place) => place.slip += slip,
                None => places.push(Place {
                    shift,
                    length: slip,
                    slip,
                    W,
                }),
            }
        }
    }
    if places.is_empty() {
        return Err(Error::invalid(
            "wear.cycling",
            format!("\"sliding\" with {cycle} increments in which nothing slides"),
            "a stroke longer than the spring of the rig gives way under mu W",
        ));
    }
    Ok((places, corners))
}

/// Fails if the scene cannot be solved as a stroke of gross slip; `rigid` if no spring of a rig drives it.
fn check(scene: &Scene, first_branch: usize, rigid: bool) -> Result<(), Error> {
    let refuse =
        |key: String, value: String, allowed: &str| Err(Error::invalid(key, value, allowed));
    let friction = &scene.friction;
    let allowed_dependences = [
        Dependence::Direction,
        Dependence::Cycles,
        Dependence::Surface,
    ];
    let own_law = rigid && friction.law.is_some();
    if !own_law && !friction.depends_only_on(&allowed_dependences[..if rigid { 3 } else { 1 }]) {
        let allowed = "one coefficient mu where wear.cycling = \"sliding\". Without a spring of the rig it may follow the \
                       cycles, the exposed surface, or a law of your own. wear.cycling = \"march\" takes all of them";
        let value = if friction.law.is_some() {
            "a law of your own"
        } else {
            "a law of place or history"
        };
        return refuse("friction".into(), value.into(), allowed);
    }
    let frame = Frame::new(scene);
    if frame
        .moving_shape(scene)
        .drop_shifted(&scene.grid, 0.0)
        .is_none()
    {
        let allowed = "a height map, or flat, where wear.cycling = \"sliding\": random roughness is known on the grid \
                       alone, and this body slides over it";
        let key = if frame == Frame::Body1 {
            "body2.shape"
        } else {
            "body1.shape"
        };
        return refuse(key.into(), "rough".into(), allowed);
    }
    for (b, branch) in scene.path.branches.iter().enumerate() {
        let to = &branch.to;
        let prescribed = to.given.motions();
        let allowed = "W and the shift delta_x alone where wear.cycling = \"sliding\"";
        let others = [
            to.T_y,
            to.M_z,
            to.M_x,
            to.M_y,
            to.sigma_B,
            to.sigma_B1,
            to.rolled,
        ];
        let moves = [1, 2, 4, 5]
            .iter()
            .any(|&k| prescribed[k].unwrap_or(0.0) != 0.0);
        if prescribed[0].is_some() || moves || others.iter().any(|f| *f != 0.0) {
            return refuse(format!("path[{b}]"), "other loads".into(), allowed);
        }
        if b >= first_branch && prescribed[3].is_none() {
            return refuse(format!("path[{b}].T_x"), to.T_x.to_string(), allowed);
        }
        if b + 1 >= first_branch && !(to.W > 0.0) {
            return refuse(
                format!("path[{b}].W"),
                to.W.to_string(),
                "above 0 all through the cycle",
            );
        }
    }
    Ok(())
}
