//! What papers measured, measured again, beside their published figures.

pub mod sbvh;
