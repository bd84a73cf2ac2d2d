//! What papers measured, measured again, beside their published figures.

pub mod bsp;
pub mod dual_split;
pub mod sbvh;

use crate::report::document::Section;

/// What was found about a scene.
#[derive(Clone, Debug)]
pub struct Found {
    /// Ready for a document.
    pub section: Section,
    /// Rays compared with brute force.
    pub verified: usize,
    /// Rays answered differently.
    pub disagreements: usize,
}
