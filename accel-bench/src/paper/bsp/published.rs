//! The published figures of Tables 1 to 3.

/// Of Table 1: frames per second or per minute. Single rays of BSP-orig, BSP,
/// BSP-tri and the kd-tree, then packets of the BSP, the kd-tree and the BVH.
#[derive(Clone, Copy, Debug)]
pub(super) struct PublishedSpeeds {
    pub single: [f64; 4],
    pub packets: [Option<f64>; 3],
}

/// Of Table 2, per ray: standard and traversal-based tests, general and
/// axis-aligned nodes. Rows are BSP-orig, BSP and the kd-tree.
pub(super) type PublishedWork = [[f64; 4]; 3];

/// Of Table 3, of the BSP and of the kd-tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct PublishedTree {
    pub build_seconds: f64,
    pub depth: u32,
    /// Thousands.
    pub nodes: f64,
    /// Percent of the inner nodes.
    pub axis_aligned: f64,
    /// Leaves of 0 to 4 triangles, and of more.
    pub leaves: [f64; 6],
    pub largest_leaf: usize,
}

/// A scene of the paper.
#[derive(Clone, Copy, Debug)]
pub(super) struct PublishedScene {
    pub name: &'static str,
    pub ray_cast: PublishedSpeeds,
    pub path_traced: Option<PublishedSpeeds>,
    pub ray_cast_work: PublishedWork,
    pub path_traced_work: Option<PublishedWork>,
    pub trees: [PublishedTree; 2],
}

const fn tree(
    build_seconds: f64,
    depth: u32,
    nodes: f64,
    axis_aligned: f64,
    leaves: [f64; 6],
    largest_leaf: usize,
) -> PublishedTree {
    PublishedTree {
        build_seconds,
        depth,
        nodes,
        axis_aligned,
        leaves,
        largest_leaf,
    }
}

pub(super) const SCENES: [PublishedScene; 4] = [
    PublishedScene {
        name: "cylinder",
        ray_cast: PublishedSpeeds {
            single: [22.0, 21.9, 23.0, 0.868],
            packets: [Some(49.2), Some(5.73), Some(5.28)],
        },
        path_traced: None,
        ray_cast_work: [
            [0.07, 0.33, 10.9, 0.0],
            [0.08, 0.34, 8.6, 3.1],
            [182.4, 0.0, 0.0, 15.2],
        ],
        path_traced_work: None,
        trees: [
            tree(
                9.2,
                26,
                15.0,
                15.0,
                [3.3e3, 3.9e3, 142.0, 30.0, 0.0, 0.0],
                3,
            ),
            tree(
                0.24,
                33,
                13.0,
                100.0,
                [3.7e3, 412.0, 333.0, 1.2e3, 131.0, 603.0],
                301,
            ),
        ],
    },
    PublishedScene {
        name: "bunny",
        ray_cast: PublishedSpeeds {
            single: [12.2, 13.3, 13.7, 11.2],
            packets: [Some(20.2), Some(22.6), Some(38.0)],
        },
        path_traced: Some(PublishedSpeeds {
            single: [0.874, 0.954, 0.963, 0.796],
            packets: [None, None, Some(1.306)],
        }),
        ray_cast_work: [
            [0.07, 0.40, 21.6, 0.0],
            [0.11, 0.36, 5.8, 18.4],
            [2.3, 0.0, 0.0, 27.8],
        ],
        path_traced_work: Some([
            [0.26, 0.28, 30.2, 0.0],
            [0.32, 0.26, 8.3, 25.1],
            [4.6, 0.0, 0.0, 36.8],
        ]),
        trees: [
            tree(
                1140.0,
                33,
                1470.0,
                27.0,
                [423e3, 309e3, 3.3e3, 107.0, 2.0, 0.0],
                4,
            ),
            tree(
                14.3,
                59,
                988.0,
                100.0,
                [250e3, 24e3, 158e3, 51e3, 9.6e3, 905.0],
                7,
            ),
        ],
    },
    PublishedScene {
        name: "power plant section 9",
        ray_cast: PublishedSpeeds {
            single: [13.3, 16.1, 16.4, 4.95],
            packets: [Some(33.8), Some(19.2), Some(17.8)],
        },
        path_traced: Some(PublishedSpeeds {
            single: [1.51, 1.74, 1.76, 0.731],
            packets: [None, None, Some(1.111)],
        }),
        ray_cast_work: [
            [0.04, 0.24, 23.3, 0.0],
            [0.09, 0.21, 4.9, 19.9],
            [18.5, 0.0, 0.0, 25.7],
        ],
        path_traced_work: Some([
            [0.11, 0.18, 24.4, 0.0],
            [0.12, 0.17, 5.1, 20.8],
            [17.5, 0.0, 0.0, 26.6],
        ]),
        trees: [
            tree(
                2160.0,
                48,
                3386.0,
                37.0,
                [734e3, 783e3, 125e3, 45e3, 3.5e3, 3.7e3],
                17,
            ),
            tree(
                29.2,
                75,
                1645.0,
                100.0,
                [181e3, 171e3, 264e3, 130e3, 41e3, 36e3],
                64,
            ),
        ],
    },
    PublishedScene {
        name: "conference room",
        ray_cast: PublishedSpeeds {
            single: [8.87, 10.9, 11.6, 10.3],
            packets: [Some(26.2), Some(25.7), Some(31.9)],
        },
        path_traced: Some(PublishedSpeeds {
            single: [0.296, 0.347, 0.358, 0.333],
            packets: [None, None, Some(0.218)],
        }),
        ray_cast_work: [
            [0.77, 0.52, 32.8, 0.0],
            [0.82, 0.52, 3.2, 31.8],
            [3.5, 0.0, 0.0, 33.5],
        ],
        path_traced_work: Some([
            [0.87, 0.35, 29.0, 0.0],
            [0.98, 0.35, 2.9, 25.5],
            [4.2, 0.0, 0.0, 29.2],
        ]),
        trees: [
            tree(
                6720.0,
                47,
                9246.0,
                21.0,
                [2128e3, 2196e3, 275e3, 21e3, 3.1e3, 493.0],
                8,
            ),
            tree(
                72.0,
                89,
                3921.0,
                100.0,
                [746e3, 279e3, 383e3, 333e3, 108e3, 111e3],
                101,
            ),
        ],
    },
];

/// The transparent truck of Table 1, which the paper renders from one view.
pub(super) const TRUCK: PublishedSpeeds = PublishedSpeeds {
    single: [2.46, 2.75, 2.80, 2.19],
    packets: [None, None, Some(1.87)],
};

/// The scene of the paper that a scene stands for: its own, or one of its kind,
/// long thin triangles or rooms.
pub(super) fn find(scene: &str) -> Option<&'static PublishedScene> {
    const STANDS_FOR: [(&str, &str); 8] = [
        ("cylinder", "cylinder"),
        ("bunny", "bunny"),
        ("hospital", "power plant section 9"),
        ("pipes", "power plant section 9"),
        ("sponza", "conference room"),
        ("sibenik", "conference room"),
        ("room", "conference room"),
        ("colonnade", "conference room"),
    ];
    let (_, name) = STANDS_FOR.iter().find(|(own, _)| scene.contains(own))?;
    SCENES.iter().find(|published| published.name == *name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_are_the_multiples_that_the_paper_states() {
        let times = |speeds: PublishedSpeeds| speeds.single[2] / speeds.single[3];
        // Figure 2: 26, 1.3, 1.2 and 2.4 times as fast.
        assert!((times(SCENES[0].ray_cast) - 26.5).abs() < 0.5);
        assert!((times(TRUCK) - 1.3).abs() < 0.05);
        assert!((times(SCENES[1].path_traced.unwrap()) - 1.2).abs() < 0.05);
        assert!((times(SCENES[2].path_traced.unwrap()) - 2.4).abs() < 0.05);
    }

    #[test]
    fn nodes_are_the_leaves_twice() {
        // A binary tree has one leaf more than inner nodes.
        for tree in SCENES.iter().flat_map(|scene| scene.trees) {
            let leaves: f64 = tree.leaves.iter().sum();
            let nodes = 2.0 * leaves / 1e3;
            assert!((nodes / tree.nodes - 1.0).abs() < 0.03, "{tree:?}");
        }
    }
}
