//! From primitives to references, with validation.

use super::Reference;
use crate::build::{InvalidPrimitives, join};
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
    gather_part(primitives, 0, invalid)
}

/// Parts of fewer primitives than this are gathered by one thread.
const PARALLEL_GATHER: usize = 1 << 14;

/// Gathers a part of the scene whose first primitive has the id `first`.
fn gather_part<P: Primitive>(
    primitives: &[P],
    first: u32,
    invalid: InvalidPrimitives,
) -> Result<Gathered, BuildError> {
    if primitives.len() < PARALLEL_GATHER {
        return gather_run(primitives, first, invalid);
    }
    let middle = primitives.len() / 2;
    let (left, right) = primitives.split_at(middle);
    let (left, right) = join(
        || gather_part(left, first, invalid),
        || gather_part(right, first + middle as u32, invalid),
    );
    // The left error first: it names the smaller id.
    let (mut gathered, others) = (left?, right?);
    gathered.references.extend_from_slice(&others.references);
    gathered.bounds = gathered.bounds.union(&others.bounds);
    gathered.skipped += others.skipped;
    Ok(gathered)
}

fn gather_run<P: Primitive>(
    primitives: &[P],
    first: u32,
    invalid: InvalidPrimitives,
) -> Result<Gathered, BuildError> {
    let mut gathered = Gathered {
        references: Vec::with_capacity(primitives.len()),
        bounds: Aabb::EMPTY,
        skipped: 0,
    };
    for (id, primitive) in (first..).zip(primitives) {
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
