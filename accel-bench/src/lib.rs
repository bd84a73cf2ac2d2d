//! The comparison of acceleration structures, as a library behind the
//! `accel-bench` command.
//!
//! A [`scene`] gives triangles and a camera; [`rays`] makes rays from them; the
//! [`registry`] lists the structures; [`verification`] holds them to brute
//! force; [`measure`] times and counts; [`paper`] sets
//! published figures beside measured ones; [`report`] prints and writes.

pub mod cli;
pub mod environment;
pub mod measure;
pub mod paper;
pub mod progress;
pub mod rays;
pub mod registry;
pub mod report;
pub mod scene;
pub mod verification;
