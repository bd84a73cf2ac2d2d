//! A block of triangles, coordinate by coordinate.

use std::ops::ControlFlow;

use glam::Vec3;

use crate::layout::{offer_intersection, offer_primitive};
use crate::primitive::watertight::LaneTest;
use crate::primitive::{Primitive, Triangle};
use crate::query::Query;
use crate::ray::PreparedRay;
use crate::ray::packet::lanes_of;
use crate::simd::F32x4;

#[derive(Clone, Debug)]
#[repr(C, align(16))]
pub(super) struct Block<const LANES: usize> {
    /// Corner, coordinate, lane.
    vertices: [[[f32; LANES]; 3]; 3],
    pub ids: [u32; LANES],
    /// How many lanes hold a triangle, from the first.
    pub used: u8,
    pub is_last_in_leaf: bool,
}

impl<const LANES: usize> Block<LANES> {
    /// The block of these ids, of which there are at most `LANES`.
    pub(super) fn new(primitives: &[Triangle], ids: &[u32], is_last_in_leaf: bool) -> Self {
        let mut block = Self {
            vertices: [[[f32::NAN; LANES]; 3]; 3],
            ids: [u32::MAX; LANES],
            used: ids.len() as u8,
            is_last_in_leaf,
        };
        block.ids[..ids.len()].copy_from_slice(ids);
        block.fill(primitives);
        block
    }

    pub(super) fn fill(&mut self, primitives: &[Triangle]) {
        for lane in 0..usize::from(self.used) {
            let vertices = primitives[self.ids[lane] as usize].vertices();
            for (corner, vertex) in vertices.into_iter().enumerate() {
                for (coordinate, value) in vertex.to_array().into_iter().enumerate() {
                    self.vertices[corner][coordinate][lane] = value;
                }
            }
        }
    }

    #[inline]
    pub(super) fn triangle(&self, lane: usize) -> Triangle {
        let corner = |corner: usize| Vec3::from([0, 1, 2].map(|c| self.vertices[corner][c][lane]));
        Triangle::new(corner(0), corner(1), corner(2))
    }

    #[inline]
    fn used_lanes(&self) -> u32 {
        (1 << self.used) - 1
    }

    pub(super) fn used_ids(&self) -> &[u32] {
        &self.ids[..usize::from(self.used)]
    }

    /// Offers the hits of its triangles.
    #[inline(always)]
    pub(super) fn offer<Q: Query>(
        &self,
        test: &LaneTest,
        ray: &PreparedRay,
        query: &mut Q,
    ) -> ControlFlow<()> {
        if LANES == 4 {
            return self.offer_four(test, ray, query);
        }
        let candidates = test.candidates(&self.vertices) & self.used_lanes();
        if candidates == 0 {
            return ControlFlow::Continue(());
        }
        self.offer_lanes(candidates, ray, query)
    }

    /// Offers the hits of a block of four: what the lanes have computed is enough
    /// to decide them.
    #[inline(always)]
    fn offer_four<Q: Query>(
        &self,
        test: &LaneTest,
        ray: &PreparedRay,
        query: &mut Q,
    ) -> ControlFlow<()> {
        let (candidates, sheared) = test.sheared_lanes::<F32x4, LANES>(&self.vertices);
        for lane in lanes_of(candidates & self.used_lanes()) {
            if let Some(intersection) = sheared.decide(lane, ray) {
                let bounds = self.triangle(lane).bounds();
                offer_intersection(intersection, self.ids[lane], &bounds, ray, query)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Decides the lanes that the lane test kept, with the scalar kernel.
    #[inline(never)]
    fn offer_lanes<Q: Query>(
        &self,
        mut lanes: u32,
        ray: &PreparedRay,
        query: &mut Q,
    ) -> ControlFlow<()> {
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            offer_primitive(&self.triangle(lane), self.ids[lane], ray, query)?;
            lanes &= lanes - 1;
        }
        ControlFlow::Continue(())
    }
}
