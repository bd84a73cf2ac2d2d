//! Rays that leave no vertex of a scene out.

use glam::Vec3;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::aligned::within_planes;
use super::targets::{Targets, towards};
use crate::{RaySegment, Triangle};

/// One ray exactly towards each vertex of `triangles`, and one within each
/// plane that is constant in an axis and passes through a vertex. Equal
/// vertices and equal planes count once, non-finite ones not at all.
pub fn at_every_vertex(triangles: &[Triangle], seed: u64) -> Vec<RaySegment> {
    let targets = Targets::of(triangles);
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let vertices = distinct_vertices(triangles);
    let mut rays = Vec::with_capacity(vertices.len());
    for vertex in &vertices {
        let origin = targets.origin(&mut rng);
        rays.push(towards(origin, vertex.as_dvec3(), &mut rng));
    }
    for axis in 0..3 {
        let mut planes: Vec<_> = vertices.iter().map(|vertex| vertex[axis]).collect();
        planes.sort_by(f32::total_cmp);
        planes.dedup();
        for plane in planes {
            let mut origin = targets.origin(&mut rng);
            origin[axis] = f64::from(plane);
            rays.push(within_planes(&targets, origin, &[axis], &mut rng));
        }
    }
    rays
}

fn distinct_vertices(triangles: &[Triangle]) -> Vec<Vec3> {
    let corners = triangles.iter().flat_map(Triangle::vertices);
    let mut vertices: Vec<_> = corners.filter(|vertex| vertex.is_finite()).collect();
    // Zeros of both signs are one place: adding +0 makes them one value.
    let key = |vertex: &Vec3| (*vertex + Vec3::ZERO).to_array().map(f32::to_bits);
    vertices.sort_unstable_by_key(key);
    vertices.dedup_by_key(|vertex| key(vertex));
    vertices
}
