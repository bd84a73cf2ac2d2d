//! The integration tests of this crate, a module a file. They are one program, so
//! that the structures they share are compiled once.

mod agreement;
mod candidate_planes;
mod limits;
mod other_primitives;
mod persistence;
mod quality;
mod unconfirmed;
