//! Checks of a finished tree.

use accel_core::{AccelerationStructure, Primitive, ValidationError};

use crate::Bvh;

impl<P: Primitive> Bvh<P> {
    /// Checks everything that hits rely on: boxes enclose what is below them,
    /// every primitive that was not skipped stands in a leaf, and the recorded
    /// depth is right.
    ///
    /// # Errors
    /// The first [`ValidationError`] found.
    pub fn validate(&self) -> Result<(), ValidationError> {
        let outline = self.outline();
        outline.validate_depth(self.depth)?;
        outline.validate_of(self)
    }
}
