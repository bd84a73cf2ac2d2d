//! The integration tests of this crate, a module a file. They are one program, so
//! that the structures they share are compiled once.

mod agreement;
mod bih_and_h_tree;
mod determinism;
mod persistence;
mod visited_leaves;
