//! The dual-split tree: two axis-aligned planes per node.
//!
//! A BVH stores six planes for every box, though most of them are planes of the
//! parent's box. A *dual-split tree* stores each plane once. A *splitting node*
//! separates two children by two planes on one axis: where the first ends and
//! where the second begins, so that they may overlap. A *carving node* cuts empty
//! space off its one child by two planes, on one axis or on two. A ray keeps the
//! part of itself that is left of its way, cuts it at two planes a node, and goes
//! to the child first that comes first along the splitting axis, as in a kd-tree.
//!
//! ```
//! use accel_dualsplit::{
//!     AccelerationStructure, BvhBuilder, DualSplitConverter, RaySegment, Triangle,
//! };
//!
//! # fn main() -> Result<(), accel_dualsplit::BuildError> {
//! let triangles = [
//!     Triangle::new([0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]),
//!     Triangle::new([0.0, 0.0, 7.0], [1.0, 0.0, 7.0], [0.0, 1.0, 7.0]),
//! ];
//! let bvh = BvhBuilder::default().build(&triangles)?;
//! let tree = DualSplitConverter::default().convert(&bvh)?;
//! let hit = tree.closest_hit(&RaySegment::new([0.2, 0.2, 0.0], [0.0, 0.0, 1.0])).unwrap();
//! assert_eq!((hit.id, hit.t), (0, 5.0));
//! # Ok(())
//! # }
//! ```
//!
//! # Source
//! Daqi Lin, Konstantin Shkurko, Ian Mallett and Cem Yuksel, *Dual-Split Trees*,
//! Symposium on Interactive 3D Graphics and Games 2019.
//!
//! The two structures that the paper compares with are made of the same parts, from
//! the same BVH: the bounding interval hierarchy ([`Bih`]) and the H-tree
//! ([`HTree`]).
//!
//! # Reading order
//! [`DualSplitConverter`] (`convert`) chooses splitting axes (`splitting`) and
//! carving nodes (`carving`, equation 1) and writes them (`packing`) in the words
//! of `codec`, where the headers are tabulated; `traversal` walks them; `packet`,
//! `statistics`, `refit`, `validate` and `persistence` follow. `direct` builds without a
//! BVH's say. `node_set` tells a dual-split tree, a BIH (`bih`) and an H-tree (`h_tree`)
//! apart. `wide` is a tree of its own, with eight children a node
//! ([`WideDualSplitTree`]).
//!
//! # Complexity
//! Conversion takes time in proportion to the nodes of the BVH, on all cores. A
//! ray visits about twice the nodes that it visits in the BVH and meets about
//! two fifths of the planes; in a wide tree, two fifths of the nodes.

mod bih;
mod codec;
mod convert;
mod direct;
mod error;
mod h_tree;
mod node_set;
mod packet;
mod persistence;
mod refit;
mod statistics;
mod traversal;
mod tree;
mod validate;
mod wide;

pub use bih::{Bih, BihConverter, BihNodes};
pub use codec::{LEAF_BYTES, NODE_BYTES};
pub use convert::{CarvingCosts, DualSplitConverter, Partitioning};
pub use direct::DualSplitBuilder;
pub use error::{PlaneTreeLoadError, WordsError};
pub use h_tree::{BoundingCosts, HTree, HTreeConverter, HTreeNodes};
pub use node_set::{DualSplitNodes, NodeSet};
pub use statistics::NodeStatistics;
pub use tree::{DualSplitTree, PlaneTree};
pub use validate::check_words;
pub use wide::WideDualSplitTree;

pub use accel_bvh::{Bvh, BvhBuilder, LeafRule, ObjectSplit};
pub use accel_core::layout::{Indexed, LeafOrdered};
pub use accel_core::primitive::{Face, Intersection, SurfacePoint, triangles_of_mesh};
pub use accel_core::{
    self, Aabb, AccelerationStructure, AllHits, AnyHit, Archive, BuildBudget, BuildError,
    BuildObserver, ClosestHit, Filtered, Hit, InvalidPrimitives, LoadError, PreparedRay, Primitive,
    Query, Ray, RaySegment, ReadError, RefitError, Sphere, SurfaceAreaHeuristic, TraversalCounters,
    TraversalStatistics, TreeStatistics, Triangle, ValidationError, glam,
};
