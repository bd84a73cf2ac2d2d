//! The integration tests of this crate, a module a file. They are one program, so
//! that the structures they share are compiled once.

mod agreement;
mod determinism;
mod limits;
mod packets;
mod persistence;
mod stress;
