//! Bounding volume hierarchies with spatial splits (SBVH).
//!
//! A bounding volume hierarchy puts each primitive into one of two children, and
//! where primitives are large, long or oblique their boxes overlap: a ray in the
//! overlap visits both. A *spatial split* cuts the node by a plane instead and
//! references the primitives that it cuts from both sides, each by the box of
//! its part there. At every node the best object split competes with the best
//! spatial split by the surface area heuristic, so references are duplicated
//! only where that pays. The result is an ordinary [`Bvh`], traversed as any
//! other.
//!
//! ```
//! use accel_sbvh::{AccelerationStructure, RaySegment, SbvhBuilder, Triangle};
//!
//! # fn main() -> Result<(), accel_sbvh::BuildError> {
//! let triangles = [
//!     Triangle::new([0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]),
//!     Triangle::new([0.0, 0.0, 7.0], [1.0, 0.0, 7.0], [0.0, 1.0, 7.0]),
//! ];
//! let bvh = SbvhBuilder::default().build(&triangles)?;
//! let hit = bvh.closest_hit(&RaySegment::new([0.2, 0.2, 0.0], [0.0, 0.0, 1.0])).unwrap();
//! assert_eq!((hit.id, hit.t), (0, 5.0));
//! # Ok(())
//! # }
//! ```
//!
//! # Sources
//! - Stich, Friedrich and Dietrich, *Spatial Splits in Bounding Volume
//!   Hierarchies*, 2009: all of sections 3 to 5, and of section 6.1 the hard
//!   memory limit, the parallel build and refitting.
//! - Ernst and Greiner, *Early Split Clipping for Bounding Volume Hierarchies*,
//!   2007, and Dammertz and Keller, *The Edge Volume Heuristic*, 2008: the methods
//!   that the paper compares with, in [`presplit`].
//! - Waechter and Keller, *Terminating Spatial Hierarchies by A Priori Bounding
//!   Memory*, 2007: a limit that is known before the build
//!   ([`ReferenceLimit::TreeBytes`], [`Spending::Shares`]).
//!
//! # Reading order
//! [`SbvhBuilder`] takes settings; `growth` grows the tree in rounds, so that a
//! limit is spent where it pays most; `partitioning` decides about one node in
//! the three steps of section 4.1, from `object_split` and `spatial_split`;
//! `fragment` is what they divide. Subtrees that can't attempt a spatial split
//! are built by `accel-bvh`.
//!
//! # Refitting
//! [`Bvh::refit`] works on these trees as on any other. It fits every leaf to its
//! primitives as wholes, since the parts that a spatial split made are unknown
//! once they have moved: hits stay exact, but the overlap that the splits removed
//! comes back, and with it the duplicates are dead weight. Where splits doubled the
//! references, a refitted tree costs about twice the plain BVH's (SAH), even if
//! nothing moved; where they added a hundredth, nothing. To animate, build a plain
//! BVH or rebuild.
//!
//! # Complexity
//! O((n + r) log n) time with r the references that splits add, and while
//! building up to 470 bytes for each of the n + r, or 250 with binned object
//! splits. [`ReferenceLimit`] bounds r.

mod builder;
mod fragment;
mod growth;
mod limit;
mod node;
mod object_split;
mod partitioning;
pub mod presplit;
mod spatial_split;
mod statistics;
mod waiting;

pub use builder::SbvhBuilder;
pub use limit::{ReferenceLimit, Spending};
pub use spatial_split::CandidateClipping;
pub use statistics::SplitStatistics;

pub use accel_bvh::{
    self, Aabb, AccelerationStructure, AllHits, AnyHit, Archive, BuildBudget, BuildError,
    BuildObserver, Bvh, BvhBuilder, ClosestHit, Face, Filtered, Hit, Indexed, Intersection,
    InvalidPrimitives, LeafOrdered, LeafRule, LoadError, ObjectSplit, PreparedRay, Primitive,
    Query, Ray, RaySegment, ReadError, RefitError, Reinsertion, Sphere, SurfaceAreaHeuristic,
    SurfacePoint, TraversalCounters, TraversalStatistics, TreeStatistics, Triangle,
    ValidationError, accel_core, glam, triangles_of_mesh,
};
pub use accel_core::Clip;
