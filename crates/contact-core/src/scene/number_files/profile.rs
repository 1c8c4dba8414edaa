//! Heights along a line, which are no map.

/// Message for heights along a line.
pub(super) fn profile_message(points: usize) -> String {
    format!(
        "holds a profile of {points} points, not a map of heights over the plane. In plane strain give its heights \
         as an array of shape ({points}, 1), SurfaceMap(heights.reshape(-1, 1), spacing=(2e-6, 1.0))"
    )
}
