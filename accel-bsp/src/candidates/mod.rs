//! The planes worth trying (Ize 2008, section 3.4), and more of them (section
//! 6.1).

mod shared_edges;
mod tangents;
mod vertex_triples;

use accel_core::geometry::Plane;
use accel_core::glam::{DVec3, Vec3};
use accel_core::{BuildError, Polygonal};

use crate::pieces::{Pieces, pad_of};
use crate::split_plane::SplitPlane;

/// Single precision places a point of coordinate 1 within this.
pub(crate) const RELATIVE_PLACEMENT: f64 = 1.0 / (1 << 22) as f64;

/// Which planes are tried besides those orthogonal to the axes. Those of the paper are
/// the planes of each primitive's face and edges, and it tries them
/// [everywhere](GeneralPlanes::Everywhere); the others follow its section 6.1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CandidatePlanes {
    /// Where planes that are not orthogonal to an axis are tried at all.
    pub general: GeneralPlanes,
    /// Also two planes through each edge that two polygons share, halfway between
    /// theirs: one of them parts the two where they meet at an acute angle.
    pub shared_edges: bool,
    /// Also, for each edge, the planes through it and a corner of this many other
    /// polygons of the node: tangent to many where they form a staircase.
    pub tangents: usize,
    /// In nodes of at most so many primitives, also every plane through three
    /// corners: the search in cubic time of section 5.1, to judge the others by.
    pub vertex_triples: usize,
}

/// Where planes that are not orthogonal to an axis are tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GeneralPlanes {
    /// In every node, as in the paper.
    Everywhere,
    /// In nodes of at most this many primitives; the tree above is a kd-tree.
    UpTo(usize),
    /// Where the best axis-aligned plane saves less than this part of the cost of a
    /// leaf, 0 to 1.
    BelowGain(f64),
}

impl Default for GeneralPlanes {
    /// Where axis-aligned planes save less than 40 %: trees at least as good as with
    /// those of [`Everywhere`](Self::Everywhere), built several times as fast.
    fn default() -> Self {
        Self::BelowGain(0.4)
    }
}

impl CandidatePlanes {
    /// The planes that the paper tries, in every node.
    pub fn of_the_paper() -> Self {
        Self {
            general: GeneralPlanes::Everywhere,
            ..Self::default()
        }
    }

    pub(crate) fn validate(&self) -> Result<(), BuildError> {
        match self.general {
            GeneralPlanes::BelowGain(gain) if !(0.0..=1.0).contains(&gain) => {
                Err(BuildError::InvalidSetting {
                    setting: "general",
                    value: format!("BelowGain({gain})"),
                    allowed: "a gain of 0 to 1",
                })
            }
            _ => Ok(()),
        }
    }

    /// The planes that primitives offer together, those of every `stride`th piece.
    pub(crate) fn of_neighbors<P: Polygonal>(&self, node: &Neighbors<'_, P>) -> Vec<SplitPlane> {
        let mut planes = Vec::new();
        if self.shared_edges {
            shared_edges::collect(node, &mut planes);
        }
        if self.tangents > 0 {
            tangents::collect(node, self.tangents, &mut planes);
        }
        if node.pieces.len() <= self.vertex_triples {
            vertex_triples::collect(node, &mut planes);
        }
        planes
    }
}

impl GeneralPlanes {
    /// Whether to try them in a node of so many primitives, of which the best
    /// axis-aligned plane saves this part of the cost of a leaf.
    pub(crate) fn are_tried(self, primitives: usize, gain: impl FnOnce() -> f64) -> bool {
        match self {
            Self::Everywhere => true,
            Self::UpTo(count) => primitives <= count,
            Self::BelowGain(limit) => gain() < limit,
        }
    }
}

/// The primitives of a node, for planes that several of them define.
pub(crate) struct Neighbors<'a, P> {
    pub primitives: &'a [P],
    pub pieces: &'a Pieces,
    /// Every how many pieces one offers planes.
    pub stride: usize,
    /// The least slack, in scene units.
    pub slack: f64,
}

impl<P: Polygonal> Neighbors<'_, P> {
    fn primitive(&self, piece: usize) -> &P {
        &self.primitives[self.pieces.ids()[piece] as usize]
    }

    /// The corners of a polygon; none of anything else, whose hull means nothing.
    fn corners(&self, piece: usize) -> Vec<Vec3> {
        let primitive = self.primitive(piece);
        if primitive.is_convex_polygon() {
            primitive.vertices().collect()
        } else {
            Vec::new()
        }
    }

    fn sampled(&self) -> impl Iterator<Item = usize> {
        (0..self.pieces.len()).step_by(self.stride)
    }

    /// The plane through `point` with this normal of any length, if it has a
    /// direction, with a slack that suits the primitives of both pieces.
    fn plane(&self, point: Vec3, normal: DVec3, pieces: [usize; 2]) -> Option<SplitPlane> {
        let unit = normal.try_normalize()?.as_vec3();
        let [a, b] = pieces.map(|piece| slack_of(self.primitive(piece)));
        SplitPlane::general(
            &Plane::through(point, unit),
            point,
            a.max(b).max(self.slack),
        )
    }
}

/// The edges of a polygon.
fn edges(corners: &[Vec3]) -> impl Iterator<Item = [Vec3; 2]> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&from, &to)| [from, to])
}

/// Orthogonal to a polygon, as long as twice its area.
fn normal_of(corners: &[Vec3]) -> DVec3 {
    let first = corners[0].as_dvec3();
    let spoke = |corner: Vec3| corner.as_dvec3() - first;
    corners
        .windows(2)
        .map(|pair| spoke(pair[0]).cross(spoke(pair[1])))
        .sum()
}

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
