//! From primitives to references, with validation.

use super::Reference;
use crate::build::InvalidPrimitives;
use crate::error::BuildError;
use crate::geometry::Aabb;
use crate::layout::MAX_PRIMITIVES;
use crate::primitive::Primitive;

/// The references of a scene.
#[derive(Clone, Debug)]
pub struct Gathered {
    /// One reference per valid primitive, by its gate box, in order of ids.
    pub references: Vec<Reference>,
    /// The box around all of them; empty if there are none.
    pub bounds: Aabb,
    /// How many invalid primitives were left out.
    pub skipped: usize,
}

/// Makes a reference for every primitive of the scene.
///
/// # Errors
/// [`BuildError::InvalidPrimitive`] names the first primitive whose bounds are
/// not finite, unless `invalid` says to skip such ones;
/// [`BuildError::TooManyPrimitives`] if ids do not fit 31 bits.
pub fn gather<P: Primitive>(
    primitives: &[P],
    invalid: InvalidPrimitives,
) -> Result<Gathered, BuildError> {
    if primitives.len() > MAX_PRIMITIVES {
        return Err(BuildError::TooManyPrimitives {
            count: primitives.len(),
            limit: MAX_PRIMITIVES,
        });
    }
    let mut gathered = Gathered {
        references: Vec::with_capacity(primitives.len()),
        bounds: Aabb::EMPTY,
        skipped: 0,
    };
    for (id, primitive) in (0..).zip(primitives) {
        let bounds = primitive.bounds();
        if bounds.is_valid() {
            let gate = bounds.gate();
            gathered.bounds = gathered.bounds.union(&gate);
            gathered.references.push(Reference { bounds: gate, id });
        } else if invalid == InvalidPrimitives::Skip {
            gathered.skipped += 1;
        } else {
            return Err(BuildError::InvalidPrimitive { id, bounds });
        }
    }
    Ok(gathered)
}
