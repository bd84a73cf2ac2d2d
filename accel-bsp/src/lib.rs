//! The general binary space partitioning tree, with split planes of any
//! orientation.
//!
//! A BSP tree divides space by a plane, and both parts again. Where a kd-tree
//! takes planes orthogonal to the axes alone, this one also takes the planes of
//! the primitives' faces, and those through their edges, so that long triangles
//! across the axes are told apart. Each node weighs such candidates by the
//! surface area heuristic, for which it knows its cell, a convex polytope. Most
//! nodes still turn out axis-aligned, and these are traversed as fast as in a
//! kd-tree. A ray visits the nearer side of each plane first, and both sides where
//! it comes so near to the plane that rounding could hide a hit.
//!
//! ```
//! use accel_bsp::{AccelerationStructure, BspBuilder, RaySegment, Triangle};
//!
//! # fn main() -> Result<(), accel_bsp::BuildError> {
//! let triangles = [
//!     Triangle::new([0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]),
//!     Triangle::new([0.0, 0.0, 7.0], [1.0, 0.0, 7.0], [0.0, 1.0, 7.0]),
//! ];
//! let tree = BspBuilder::default().build(&triangles)?;
//! let hit = tree.closest_hit(&RaySegment::new([0.2, 0.2, 0.0], [0.0, 0.0, 1.0])).unwrap();
//! assert_eq!((hit.id, hit.t), (0, 5.0));
//! # Ok(())
//! # }
//! ```
//!
//! # Source
//! Thiago Ize, Ingo Wald and Steven G. Parker, *Ray Tracing with the BSP Tree*,
//! IEEE Symposium on Interactive Ray Tracing 2008.
//!
//! # Reading order
//! [`BspBuilder`] takes settings; `search` finds the best of the planes of
//! `candidates`, with the counts of `ends` and `sphere_hierarchy` and the areas of
//! `polytope`, by the costs of `cost`; `pieces` divides what the node holds and
//! `allowance` what it may use; `layout` packs the tree into the nodes of `node`
//! and the planes of `nodes`, those along the axes with the slacks of `shared_slacks`;
//! `traversal` walks them by the `crossing` of ray and plane, `packet` with many
//! rays of one origin at once; `traversal_based` and
//! `unconfirmed` are the paper's triangle test without a triangle test; `cells`
//! walks a finished tree for its cost; `persistence` saves and loads.
//!
//! # Complexity
//! A node of n primitives weighs O(n) axis-aligned planes in O(n log n) time, and
//! the planes of at most `sampled_primitives` primitives, each counted in less
//! than O(n) time where few primitives are near it.

mod allowance;
mod bsp_tree;
mod builder;
mod candidates;
mod cells;
mod cost;
mod crossing;
mod ends;
mod layout;
mod node;
mod nodes;
mod packet;
mod persistence;
mod pieces;
mod plane_tracking;
mod polytope;
mod search;
mod shared_slacks;
mod sphere_hierarchy;
mod split_plane;
mod traversal;
mod traversal_based;
mod unconfirmed;

pub use bsp_tree::{BspShape, BspTree};
pub use builder::{BspBuilder, SingleLeaves};
pub use candidates::{CandidatePlanes, GeneralPlanes};
pub use cost::BspCosts;
pub use node::NODE_BYTES;
pub use nodes::PLANE_BYTES;
pub use unconfirmed::UnconfirmedHit;

pub use accel_core::layout::{Indexed, LeafOrdered};
pub use accel_core::primitive::{Face, Intersection, SurfacePoint, triangles_of_mesh};
pub use accel_core::{
    self, Aabb, AccelerationStructure, AllHits, AnyHit, Archive, BuildBudget, BuildError,
    BuildObserver, ClosestHit, Filtered, Hit, InvalidPrimitives, LoadError, PacketTraversal,
    Polygonal, PreparedRay, Primitive, Quad, Query, Ray, RaySegment, ReadError, Sphere,
    SurfaceAreaHeuristic, TraversalCounters, TraversalStatistics, TreeStatistics, Triangle,
    ValidationError, glam,
};
