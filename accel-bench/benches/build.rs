//! How builds grow with the scene: ten thousand to a million triangles.

use accel_bench::scene::embedded;
use accel_bvh::{BvhBuilder, ObjectSplit};
use accel_core::primitive::triangles_of_mesh;
use criterion::{BenchmarkId, Criterion, SamplingMode, criterion_group, criterion_main};

fn build(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("build");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    let scene = embedded::find("figure").expect("the figure is embedded");
    for count in [10_000, 100_000, 1_000_000] {
        let mesh = scene.mesh_of(count);
        let triangles = triangles_of_mesh(&mesh.positions, &mesh.triangles).expect("it is sound");
        for (name, object_split) in [
            ("sweep", ObjectSplit::FullSweep),
            ("binned", ObjectSplit::default()),
        ] {
            let builder = BvhBuilder {
                object_split,
                ..BvhBuilder::default()
            };
            group.bench_with_input(
                BenchmarkId::new(name, triangles.len()),
                &triangles,
                |bench, triangles| {
                    bench.iter(|| builder.build(triangles).expect("it is finite"));
                },
            );
        }
    }
    group.finish();
}

criterion_group!(benches, build);
criterion_main!(benches);
