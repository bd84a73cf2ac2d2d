//! Scene families, rays and the agreement check that hold every structure to
//! the answers of brute force.

pub mod agreement;
