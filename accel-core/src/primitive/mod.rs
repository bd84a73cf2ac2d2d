//! What a structure is built over.

mod triangle;

pub use triangle::Triangle;
