//! Bounding volume hierarchies built by the surface area heuristic (SAH).
//!
//! A bounding volume hierarchy (BVH) divides the primitives of a scene into two
//! sets, and these again, and keeps a box around each set. A ray that misses a
//! box misses everything in it. Which sets are best is told by the surface area
//! heuristic: a box of small area is met by few rays. The *full sweep* weighs
//! every cut in the order of the primitives along each axis; the *binned*
//! search weighs a few dozen cuts and is about twice as fast. A ray visits the
//! nearer child first, and drops what lies behind the hit that it has.
//!
//! ```
//! use accel_bvh::{AccelerationStructure, BvhBuilder, RaySegment, Triangle};
//!
//! # fn main() -> Result<(), accel_bvh::BuildError> {
//! let triangles = [
//!     Triangle::new([0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]),
//!     Triangle::new([0.0, 0.0, 7.0], [1.0, 0.0, 7.0], [0.0, 1.0, 7.0]),
//! ];
//! let bvh = BvhBuilder::default().build(&triangles)?;
//! let hit = bvh.closest_hit(&RaySegment::new([0.2, 0.2, 0.0], [0.0, 0.0, 1.0])).unwrap();
//! assert_eq!((hit.id, hit.t), (0, 5.0));
//! # Ok(())
//! # }
//! ```
//!
//! # Sources
//! - Wald, *On fast Construction of SAH-based Bounding Volume Hierarchies*,
//!   2007: binning, and the sweep over sorted centres.
//! - Stich, Friedrich and Dietrich, *Spatial Splits in Bounding Volume
//!   Hierarchies*, 2009, sections 2.1 and 5: the full sweep and its leaf rule.
//! - Lin, Shkurko, Mallett and Yuksel, *Dual-Split Trees*, 2019, section 5: the
//!   uncompressed layout of 52 and 4 bytes and its leaf rule.
//! - Fabianowski and Dingliana, *Compact BVH Storage for Ray Tracing and Photon
//!   Mapping*, 2009: nodes of 32 bytes.
//! - Wald, Benthin and Boulos, *Getting Rid of Packets*, 2008: [`WideBvh`].
//! - Meister and Bittner, *Parallel Reinsertion for Bounding Volume Hierarchy
//!   Optimization*, 2018: [`Reinsertion`].
//!
//! # Reading order
//! [`BvhBuilder`] takes settings and runs one of the two searches (`sweep`,
//! `binned`); `reinsertion` improves what they make; `layout` packs it into the
//! words of `node`; `traversal` walks them; `refit`, `validate` and `persistence`
//! follow. `compact` converts the tree to [`CompactBvh`], whose nodes share planes,
//! and `wide` to [`WideBvh`], whose nodes have eight children: the fastest for
//! single rays.
//!
//! # Complexity
//! Both builders take O(n log n) time: the depth is bounded, by falling back to
//! median splits. The full sweep holds about 140 bytes a primitive while it
//! builds, the binned one about 30.

// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;

mod binned;
mod builder;
mod bvh;
mod compact;
mod layout;
mod leaf_rule;
mod node;
mod node_rules;
mod packet;
mod persistence;
mod reading;
mod refit;
mod reinsertion;
mod sweep;
mod traversal;
mod validate;
mod wide;
mod wide_collapse;

pub use builder::{BvhBuilder, ObjectSplit};
pub use bvh::Bvh;
pub use compact::{COMPACT_NODE_BYTES, CompactBvh};
pub use layout::ChildBounds;
pub use leaf_rule::LeafRule;
pub use node::{INNER_NODE_BYTES, LEAF_NODE_BYTES};
pub use node_rules::NodeRules;
pub use reading::{BvhNode, NodeHandle};
pub use reinsertion::Reinsertion;
pub use wide::{WIDE_NODE_BYTES, WideBvh};
pub use wide_collapse::{KeptNode, WideCollapse};

pub use accel_core::layout::{Indexed, LeafOrdered};
pub use accel_core::primitive::{Face, Intersection, SurfacePoint, triangles_of_mesh};
pub use accel_core::{
    self, Aabb, AccelerationStructure, AllHits, AnyHit, Archive, BuildBudget, BuildError,
    BuildObserver, ClosestHit, Filtered, Hit, InPackets, InvalidPrimitives, LoadError,
    PacketTraversal, PreparedRay, Primitive, Query, Ray, RaySegment, ReadError, RefitError, Sphere,
    SurfaceAreaHeuristic, TraversalCounters, TraversalStatistics, TreeStatistics, Triangle,
    ValidationError, glam,
};
