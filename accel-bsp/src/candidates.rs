//! The planes worth trying (Ize 2008, section 3.4).

use accel_core::Polygonal;
use accel_core::glam::Vec3;

use crate::pieces::pad_of;
use crate::split_plane::SplitPlane;

/// Single precision places a point of coordinate 1 within this.
pub(crate) const RELATIVE_PLACEMENT: f64 = 1.0 / (1 << 22) as f64;

/// The planes that a primitive offers, with at least the slack that its own
/// place on them needs, and at least `local`.
pub(crate) fn planes_of<P: Polygonal>(
    primitive: &P,
    local: f64,
) -> impl Iterator<Item = SplitPlane> {
    let slack = slack_of(primitive).max(local);
    primitive.candidate_planes().filter_map(move |plane| {
        let distance = |point: &_| plane.signed_distance(*point).abs();
        let point = primitive
            .vertices()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        SplitPlane::general(&plane, point, slack)
    })
}

/// How far, in scene units, a primitive may lie off a plane of its own.
pub(crate) fn slack_of<P: Polygonal>(primitive: &P) -> f64 {
    let bounds = primitive.bounds();
    let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
    4.0 * pad_of(primitive) + RELATIVE_PLACEMENT * f64::from(largest)
}

/// Whether a primitive lies on a plane, within its slack.
pub(crate) fn lies_on<P: Polygonal>(primitive: &P, plane: &SplitPlane) -> bool {
    let distance = |corner: Vec3| plane.signed_distance(corner.as_dvec3());
    primitive
        .vertices()
        .all(|corner| distance(corner).abs() <= plane.slack())
}
