//! How the sweep builder grows: comparisons counted over scenes of 10^4 to 10^6
//! triangles, for each reference and level of the tree, and for n log2 n.
//!
//! ```sh
//! cargo bench -p accel-kdtree --bench kd_tree_growth
//! ```
//!
//! The exponent is that of the comparisons between one size and the next.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use accel_core::testing::families;
use accel_kdtree::{BuildError, InvalidPrimitives, KdTreeBuilder};

const FAMILIES: [&str; 5] = [
    "soup-mixed-sizes",
    "closed-bumpy-sphere",
    "hairball",
    "coplanar-overlapping",
    "one-point",
];

fn main() -> Result<(), BuildError> {
    let builder = KdTreeBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..KdTreeBuilder::default()
    };
    for name in FAMILIES {
        let family = families::find(name).expect(name);
        let mut smaller: Option<(f64, f64)> = None;
        for size in [10_000, 100_000, 1_000_000] {
            let scene = family.scene(1, size);
            let n = scene.len() as f64;
            let start = Instant::now();
            let (tree, work) = builder.build_counting(&scene, &())?;
            let seconds = start.elapsed().as_secs_f64();
            let comparisons = work.comparisons as f64;
            let references = n + work.references_created as f64;
            let exponent = smaller.map_or(f64::NAN, |(smaller_n, fewer)| {
                (comparisons / fewer).ln() / (n / smaller_n).ln()
            });
            smaller = Some((n, comparisons));
            println!(
                "{name:20} n {n:8}  {seconds:6.2} s  depth {:3}  references {:.2} n  comparisons \
                 {:.1} n log2 n, {:.2} a reference and level, exponent {exponent:.3}",
                tree.depth(),
                references / n,
                comparisons / (n * n.log2()),
                comparisons / (references * f64::from(tree.depth() + 1)),
            );
        }
    }
    Ok(())
}
