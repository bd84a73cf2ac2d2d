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
        let actual = outline.depths().into_iter().max().unwrap_or(0);
        if actual != self.depth {
            return Err(ValidationError::DepthMismatch {
                actual,
                recorded: self.depth,
            });
        }
        let gate = |id| {
            self.primitive(id)
                .map(|primitive| primitive.bounds().gate())
        };
        outline.validate(self.primitive_count(), gate)
    }
}
