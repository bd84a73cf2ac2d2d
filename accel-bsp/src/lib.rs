//! The general binary space partitioning tree, with split planes of any
//! orientation.
//!
//! Source: Thiago Ize, Ingo Wald and Steven G. Parker, *Ray Tracing with the
//! BSP Tree*, IEEE Symposium on Interactive Ray Tracing 2008.
//!
//! **Not built yet: this crate holds its documentation alone.** It will hold
//! polytope cells clipped in double precision, candidate planes taken from the
//! primitives, both cost models of the paper, 20-byte nodes with a fast path
//! for axis-aligned planes, and the modes BSP, BSP-orig and BSP-tri.
