//! What a comparison prints and writes.

pub mod csv;
pub mod document;
pub mod heat;
pub mod html;
pub mod json;
pub mod model;
pub mod png;
pub mod table;
