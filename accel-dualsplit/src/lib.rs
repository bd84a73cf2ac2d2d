//! The dual-split tree: two axis-aligned planes per node.
//!
//! Source: Daqi Lin, Konstantin Shkurko, Ian Mallett and Cem Yuksel,
//! *Dual-Split Trees*, Symposium on Interactive 3D Graphics and Games 2019.
//!
//! **Not built yet: this crate holds its documentation alone.** It will hold
//! the encoding of splitting and carving nodes in a 6-bit header and a 26-bit
//! offset, the *identical* and *similar* conversions from any `accel_bvh::Bvh`,
//! and the BIH and H-tree converted from the same source for comparison.
