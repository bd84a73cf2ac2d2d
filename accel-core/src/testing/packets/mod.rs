//! Packets of every width, at every level of vectors that the machine has, held
//! to what brute force answers, bit for bit.

mod one_query;
mod ray_sets;

use std::fmt;

use super::agreement::{Disagreement, Expected};
use crate::ray::PreparedRay;
use crate::simd::SimdLevel;
use crate::statistics::TraversalCounters;
use crate::{PacketTraversal, RaySegment};

use one_query::{Kind, OneQuery};
pub use ray_sets::ray_sets;

/// A ray of a packet that is answered differently from brute force.
#[derive(Clone, Debug)]
pub struct PacketDisagreement {
    /// Rays in the packet.
    pub width: usize,
    /// The name of the [`SimdLevel`].
    pub level: &'static str,
    /// Which ray, and how.
    pub disagreement: Disagreement,
}

impl fmt::Display for PacketDisagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            width,
            level,
            disagreement,
        } = self;
        write!(f, "packets of {width}, {level}: {disagreement}")
    }
}

/// Compares the closest, any, all and filtered hits of packets of 4, 8, 16 and 64
/// rays with `expected`.
///
/// # Errors
/// The first ray that is answered differently.
pub fn check_packets<A>(structure: &A, expected: &Expected) -> Result<(), Box<PacketDisagreement>>
where
    A: PacketTraversal<4> + PacketTraversal<8> + PacketTraversal<16> + PacketTraversal<64>,
{
    check_width::<A, 4>(structure, expected)?;
    check_width::<A, 8>(structure, expected)?;
    check_width::<A, 16>(structure, expected)?;
    check_width::<A, 64>(structure, expected)
}

/// As [`check_packets`], for packets of `N`.
///
/// # Errors
/// The first ray that is answered differently.
pub fn check_width<A: PacketTraversal<N>, const N: usize>(
    structure: &A,
    expected: &Expected,
) -> Result<(), Box<PacketDisagreement>> {
    for level in SimdLevel::available() {
        for kind in Kind::ALL {
            check_query(structure, level, kind, expected)?;
        }
    }
    Ok(())
}

fn check_query<A: PacketTraversal<N>, const N: usize>(
    structure: &A,
    level: SimdLevel,
    kind: Kind,
    expected: &Expected,
) -> Result<(), Box<PacketDisagreement>> {
    let rays: &[RaySegment] = &expected.rays;
    let mut answers = vec![None; rays.len()];
    let mut counters = TraversalCounters::default();
    let query = |ray: &PreparedRay| OneQuery::new(kind, ray);
    structure.query_packets(level, rays, &mut counters, query, |index, query| {
        answers[index] = Some(query.map_or_else(Vec::new, OneQuery::into_hits));
    });
    assert_eq!(
        counters.rays,
        rays.len() as u64,
        "every ray is counted once"
    );
    for (index, (ray, actual)) in rays.iter().zip(answers).enumerate() {
        let actual = actual.expect("every ray is answered");
        let Some((expected, actual)) = kind.difference(expected.all_hits(index), &actual) else {
            continue;
        };
        return Err(Box::new(PacketDisagreement {
            width: N,
            level: level.name(),
            disagreement: Disagreement {
                index,
                ray: *ray,
                query: kind.name(),
                expected,
                actual,
            },
        }));
    }
    Ok(())
}
