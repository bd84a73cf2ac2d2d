//! The split bounding volume hierarchy (SBVH).
//!
//! Source: Martin Stich, Heiko Friedrich and Andreas Dietrich, *Spatial Splits
//! in Bounding Volume Hierarchies*, High-Performance Graphics 2009.
//!
//! **Not built yet: this crate holds its documentation alone.** It will hold a
//! builder that yields an `accel_bvh::Bvh`: at every node the best object split
//! competes with the best *spatial* split, which may reference a primitive from
//! both children and so cuts the overlap that large, oblique primitives cause.
//! Early split clipping and the edge volume heuristic, the methods the paper
//! compares with, will stand beside it.
