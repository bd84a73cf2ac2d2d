//! Shared foundation of the ray-tracing acceleration structures: primitives,
//! rays, queries, statistics, builder parts, and the brute force that all of
//! them must agree with. See the crate's modules; depend on a structure crate
//! instead, which re-exports what its user needs.

pub use glam;

pub mod archive;
mod brute_force;
pub mod build;
mod error;
pub mod geometry;
pub mod layout;
pub mod primitive;
pub mod query;
pub mod ray;
pub mod reference;
pub mod simd;
pub mod split;
pub mod statistics;
pub mod structure;
#[cfg(feature = "testing")]
pub mod testing;

pub use archive::{Archive, LoadError, ReadError};
pub use brute_force::BruteForce;
pub use build::{BuildBudget, BuildObserver, InvalidPrimitives};
pub use error::{BuildError, RefitError, ValidationError};
pub use geometry::Aabb;
pub use primitive::{Clip, Polygonal, Primitive, Quad, Sphere, Triangle};
pub use query::{AllHits, AnyHit, ClosestHit, Filtered, Hit, Query};
pub use ray::{PreparedRay, Ray, RaySegment};
pub use split::SurfaceAreaHeuristic;
pub use statistics::{TraversalCounters, TraversalStatistics, TreeStatistics};
pub use structure::{AccelerationStructure, DynStructure, InPackets, PacketTraversal};
