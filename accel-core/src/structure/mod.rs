//! What every acceleration structure can do.

mod cell_packet;
mod dynamic;
mod in_packets;
mod packet;
mod predicted;
mod stack;
mod validation;
mod vectors;

use crate::build::join;
use crate::geometry::Aabb;
use crate::layout::{LeafStorage, StoredPrimitives};
use crate::primitive::{Face, Primitive, SurfacePoint};
use crate::query::{AllHits, AnyHit, ClosestHit, Filtered, Hit, Query};
use crate::ray::{PreparedRay, Ray};
use crate::split::SurfaceAreaHeuristic;
use crate::statistics::{BytesByPart, TraversalStatistics, TreeOutline, TreeStatistics};

pub use cell_packet::{CellTree, CellVisit, Division, RayPart};
pub use dynamic::DynStructure;
pub use in_packets::InPackets;
pub use packet::PacketTraversal;
pub use predicted::{predicted, predicted_bit};
pub use stack::{PacketStack, StackEntry, TraversalStack, WideStack};
pub use vectors::VectorTraversal;

/// Answers ray queries over a set of primitives.
///
/// A structure supplies [`traverse`](Self::traverse) and a few facts about
/// itself; every query follows from these. All structures give the same
/// answers, bit for bit: the hit with the smallest `t`, of equals the one with
/// the smallest id.
///
/// Each query takes any [`Ray`] and has a form that counts (`_with`) and one
/// that ignores some hits (`_where`).
pub trait AccelerationStructure: Send + Sync {
    /// What the structure is built over.
    type Primitive: Primitive;

    /// How its leaves hold them.
    type Storage: LeafStorage<Self::Primitive>;

    /// Offers every hit that can matter to `query`: the only traversal a
    /// structure has.
    fn traverse<Q: Query, S: TraversalStatistics>(
        &self,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    );

    /// The box around everything that can be hit; `None` for an empty scene.
    fn bounds(&self) -> Option<Aabb>;

    /// The primitives in their leaves.
    fn stored(&self) -> &StoredPrimitives<Self::Primitive, Self::Storage>;

    /// Bytes that the nodes take.
    fn node_bytes(&self) -> usize;

    /// The tree as a list of nodes.
    fn outline(&self) -> TreeOutline;

    /// The primitive with this id, `None` if there is none or it was skipped.
    fn primitive(&self, id: u32) -> Option<Self::Primitive> {
        self.stored().leaves().primitive(id)
    }

    /// How many primitives the structure was built over, skipped ones included.
    fn primitive_count(&self) -> usize {
        self.stored().count()
    }

    /// How many primitives were left out because their bounds are not finite.
    fn skipped_count(&self) -> usize {
        self.stored().skipped()
    }

    /// Bytes by part.
    fn bytes(&self) -> BytesByPart {
        let storage = self.stored().leaves().bytes();
        BytesByPart {
            nodes: self.node_bytes(),
            references: storage.references,
            primitives: storage.primitives,
        }
    }

    /// Answers `query` for `ray`. A ray that can hit nothing, such as one with a
    /// NaN, visits no node.
    #[inline]
    fn query<Q: Query, S: TraversalStatistics>(
        &self,
        ray: &impl Ray,
        statistics: &mut S,
        query: impl FnOnce(&PreparedRay) -> Q,
    ) -> Option<Q> {
        let answer = PreparedRay::new(ray).map(|ray| {
            let mut query = query(&ray);
            self.traverse(&ray, &mut query, statistics);
            query
        });
        statistics.finish_ray();
        answer
    }

    /// The closest hit: the smallest `t`, of equals the smallest id.
    #[inline]
    fn closest_hit(&self, ray: &impl Ray) -> Option<Hit> {
        self.closest_hit_with(ray, &mut ())
    }

    /// As [`closest_hit`](Self::closest_hit), telling `statistics` what it does.
    #[inline]
    fn closest_hit_with<S: TraversalStatistics>(
        &self,
        ray: &impl Ray,
        statistics: &mut S,
    ) -> Option<Hit> {
        self.query(ray, statistics, ClosestHit::new)?.best()
    }

    /// The closest of the hits that pass `filter`, which must be pure.
    #[inline]
    fn closest_hit_where(&self, ray: &impl Ray, filter: impl Fn(&Hit) -> bool) -> Option<Hit> {
        let query = |ray: &PreparedRay| Filtered::new(ClosestHit::new(ray), filter);
        self.query(ray, &mut (), query)?.into_inner().best()
    }

    /// Whether the ray hits anything: shadow rays ask this.
    #[inline]
    fn any_hit(&self, ray: &impl Ray) -> bool {
        self.any_hit_with(ray, &mut ())
    }

    /// As [`any_hit`](Self::any_hit), telling `statistics` what it does.
    #[inline]
    fn any_hit_with<S: TraversalStatistics>(&self, ray: &impl Ray, statistics: &mut S) -> bool {
        let answer = self.query(ray, statistics, AnyHit::new);
        answer.is_some_and(|query| query.found())
    }

    /// Whether any hit passes `filter`, which must be pure.
    #[inline]
    fn any_hit_where(&self, ray: &impl Ray, filter: impl Fn(&Hit) -> bool) -> bool {
        let query = |ray: &PreparedRay| Filtered::new(AnyHit::new(ray), filter);
        let answer = self.query(ray, &mut (), query);
        answer.is_some_and(|query| query.into_inner().found())
    }

    /// Every hit, by `t`, then id, each primitive once.
    fn all_hits(&self, ray: &impl Ray) -> Vec<Hit> {
        self.all_hits_with(ray, &mut ())
    }

    /// As [`all_hits`](Self::all_hits), telling `statistics` what it does.
    fn all_hits_with<S: TraversalStatistics>(
        &self,
        ray: &impl Ray,
        statistics: &mut S,
    ) -> Vec<Hit> {
        let answer = self.query(ray, statistics, AllHits::new);
        answer.map_or_else(Vec::new, AllHits::into_sorted)
    }

    /// Every hit that passes `filter`, which must be pure.
    fn all_hits_where(&self, ray: &impl Ray, filter: impl Fn(&Hit) -> bool) -> Vec<Hit> {
        let query = |ray: &PreparedRay| Filtered::new(AllHits::new(ray), filter);
        let answer = self.query(ray, &mut (), query);
        answer.map_or_else(Vec::new, |query| query.into_inner().into_sorted())
    }

    /// The closest hits of many rays, in their order, on all cores.
    fn closest_hits<R: Ray + Sync>(&self, rays: &[R]) -> Vec<Option<Hit>> {
        let mut hits = vec![None; rays.len()];
        for_each_ray(rays, &mut hits, &|ray| self.closest_hit(ray));
        hits
    }

    /// Whether each of many rays hits anything, in their order, on all cores.
    fn any_hits<R: Ray + Sync>(&self, rays: &[R]) -> Vec<bool> {
        let mut answers = vec![false; rays.len()];
        for_each_ray(rays, &mut answers, &|ray| self.any_hit(ray));
        answers
    }

    /// The surface where `ray` met `hit`: point, error, normal and face. `None`
    /// if the hit is not of this structure.
    fn surface(&self, ray: &impl Ray, hit: &Hit) -> Option<SurfacePoint> {
        let ray = PreparedRay::new(ray)?;
        let primitive = self.primitive(hit.id)?;
        let (point, error) = primitive.hit_point(&ray, hit);
        let normal = primitive.geometric_normal(hit, point);
        Some(SurfacePoint {
            point,
            error,
            normal,
            face: Face::towards(&ray, normal),
        })
    }

    /// Whether `hit` struck the front of its primitive: as a filter,
    /// `closest_hit_where(&ray, |hit| structure.is_front(&ray, hit))` culls
    /// backfaces.
    fn is_front(&self, ray: &impl Ray, hit: &Hit) -> bool {
        self.surface(ray, hit)
            .is_some_and(|surface| surface.face == Face::Front)
    }

    /// Figures that describe the tree, its SAH cost with the costs of
    /// `heuristic`.
    fn tree_statistics(&self, heuristic: &SurfaceAreaHeuristic) -> TreeStatistics {
        TreeStatistics::of(&self.outline(), heuristic)
    }
}

/// Rays of a batch that one task answers: whole packets.
const BATCH: usize = 256;

/// Answers `rays` into `answers`, halving the batch over all cores.
fn for_each_ray<R: Sync, A: Send>(
    rays: &[R],
    answers: &mut [A],
    answer: &(impl Fn(&R) -> A + Sync),
) {
    for_each_batch(rays, answers, &|rays: &[R], answers: &mut [A]| {
        for (ray, slot) in rays.iter().zip(answers) {
            *slot = answer(ray);
        }
    });
}

/// Answers batches of `rays` into those of `answers`, on all cores.
fn for_each_batch<R: Sync, A: Send>(
    rays: &[R],
    answers: &mut [A],
    answer: &(impl Fn(&[R], &mut [A]) + Sync),
) {
    if rays.len() <= BATCH {
        return answer(rays, answers);
    }
    let middle = (rays.len() / 2).next_multiple_of(BATCH);
    let (left_rays, right_rays) = rays.split_at(middle);
    let (left_answers, right_answers) = answers.split_at_mut(middle);
    join(
        || for_each_batch(left_rays, left_answers, answer),
        || for_each_batch(right_rays, right_answers, answer),
    );
}
