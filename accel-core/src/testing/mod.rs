//! Scene families, rays and the agreement check that hold every structure to
//! the answers of brute force.

pub mod agreement;
pub mod archives;
mod bench_arguments;
pub mod closed;
mod damage;
mod edge;
pub mod families;
pub mod family_check;
pub mod mesh_file;
pub mod packets;
mod random;
pub mod rays;
#[cfg(feature = "proptest")]
pub mod strategy;
pub mod stress;

pub use bench_arguments::bench_arguments;
