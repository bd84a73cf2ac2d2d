//! The kd-tree built by the surface area heuristic.
//!
//! Sources: Ingo Wald and Vlastimil Havran, *On building fast kd-trees for ray
//! tracing, and on doing that in O(N log N)*, 2006; Vlastimil Havran,
//! *Heuristic Ray Shooting Algorithms*, 2000.
//!
//! **Not built yet: this crate holds its documentation alone.** It will hold
//! the event sweep builder with perfect splits, a parallel binned builder for
//! large scenes, 8-byte nodes, and traversal by single rays and SIMD packets.
