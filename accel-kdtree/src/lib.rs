//! The kd-tree built by the surface area heuristic.
//!
//! A kd-tree divides space by a plane orthogonal to an axis, and both parts
//! again. Unlike the boxes of a bounding volume hierarchy its cells never
//! overlap, so a ray that has found a hit in a cell need not look farther;
//! in return, a primitive stands in every leaf that it reaches into. Each node
//! weighs the planes that touch its primitives by the surface area heuristic:
//! how likely a ray meets each side, and how much there is to test. A primitive
//! that straddles the plane is clipped to both cells, so that below it only
//! planes count that touch what is really there (*perfect splits*). A node takes
//! 8 bytes, and a step one plane.
//!
//! ```
//! use accel_kdtree::{AccelerationStructure, KdTreeBuilder, RaySegment, Triangle};
//!
//! # fn main() -> Result<(), accel_kdtree::BuildError> {
//! let triangles = [
//!     Triangle::new([0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]),
//!     Triangle::new([0.0, 0.0, 7.0], [1.0, 0.0, 7.0], [0.0, 1.0, 7.0]),
//! ];
//! let tree = KdTreeBuilder::default().build(&triangles)?;
//! let hit = tree.closest_hit(&RaySegment::new([0.2, 0.2, 0.0], [0.0, 0.0, 1.0])).unwrap();
//! assert_eq!((hit.id, hit.t), (0, 5.0));
//! # Ok(())
//! # }
//! ```
//!
//! # Sources
//! - Ingo Wald and Vlastimil Havran, *On building fast kd-trees for ray tracing,
//!   and on doing that in O(N log N)*, IEEE Symposium on Interactive Ray Tracing
//!   2006: the builder.
//! - Vlastimil Havran, *Heuristic Ray Shooting Algorithms*, 2000: clipping, and
//!   traversal by near and far.
//! - Thiago Ize, Ingo Wald and Steven G. Parker, *Ray Tracing with the BSP Tree*,
//!   2008, sections 2 and 5: what it is compared with.
//!
//! # Reading order
//! [`KdTreeBuilder`] takes settings; `splitting` divides one node by the cheapest
//! `plane`, which `sweep` finds among sorted `event`s, or `binned` among a few;
//! `division` carries it out, clipping by `part`, which tells why no hit is lost;
//! `layout` packs the tree into the words of `node`; `traversal` walks them, by
//! where a ray is `crossing` planes; `packet` does so for many rays at once;
//! `validate` checks; `persistence` saves and loads.
//!
//! # Complexity
//! With n primitives, r references that splits create, and depth D, the sweep
//! takes O((n + r) D) time beside one sort: O(n log n) where few primitives
//! straddle. It holds about 250 bytes a reference while it builds.

mod binned;
mod builder;
mod crossing;
mod division;
mod event;
mod kd_tree;
mod layout;
mod node;
mod packet;
mod part;
mod persistence;
mod plane;
mod splitting;
mod sweep;
mod termination;
mod traversal;
mod validate;
mod work;

pub use builder::{KdTreeBuilder, PlaneSearch};
pub use kd_tree::KdTree;
pub use node::NODE_BYTES;
pub use termination::Termination;
pub use work::Work;

pub use accel_core::layout::{Indexed, LeafOrdered};
pub use accel_core::primitive::{Face, Intersection, SurfacePoint, triangles_of_mesh};
pub use accel_core::{
    self, Aabb, AccelerationStructure, AllHits, AnyHit, Archive, BuildBudget, BuildError,
    BuildObserver, Clip, ClosestHit, Filtered, Hit, InvalidPrimitives, LoadError, PacketTraversal,
    PreparedRay, Primitive, Query, Ray, RaySegment, ReadError, Sphere, SurfaceAreaHeuristic,
    TraversalCounters, TraversalStatistics, TreeStatistics, Triangle, ValidationError, glam,
};
