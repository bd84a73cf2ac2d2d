//! The published figures of Table 1, for the scenes that we have or stand in for.

use std::fmt;

use crate::scene::Scene;

/// A row of Table 1. Cells that can't be read in our copy of the paper are
/// `None`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Published {
    pub method: &'static str,
    /// References in percent of the triangles.
    pub references: f64,
    pub nodes: Option<usize>,
    pub sah_cost: Option<f64>,
    /// Mean and maximum per pixel.
    pub intersections: Option<(f64, u64)>,
    /// Mean and maximum per pixel.
    pub traversals: Option<(f64, u64)>,
    /// In percent of the BVH's.
    pub overlap: Option<f64>,
    pub spatial_splits: Option<usize>,
    /// In percent of the BVH's, primary and ambient occlusion.
    pub speed: Option<[f64; 2]>,
}

/// A scene of Table 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct PublishedScene {
    pub name: &'static str,
    /// As the table has it, to the thousand.
    pub triangles: usize,
    pub rows: [Published; 4],
}

impl PublishedScene {
    /// Whether a scene of so many triangles can be it: conversions of the same
    /// model differ by a few percent.
    fn has_about(&self, triangles: usize) -> bool {
        self.triangles.abs_diff(triangles) * 10 <= self.triangles
    }
}

const UNREADABLE: Published = Published {
    method: "",
    references: 0.0,
    nodes: None,
    sah_cost: None,
    intersections: None,
    traversals: None,
    overlap: None,
    spatial_splits: None,
    speed: None,
};

const ROTATED_SPONZA: PublishedScene = PublishedScene {
    name: "Rotated Sponza",
    triangles: 66_000,
    rows: [
        Published {
            method: "SBVH",
            references: 203.0,
            intersections: Some((102.0, 429)),
            traversals: Some((176.2, 426)),
            overlap: Some(57.0),
            speed: Some([215.0, 174.0]),
            ..UNREADABLE
        },
        Published {
            method: "ESC",
            references: 203.0,
            nodes: Some(49041),
            speed: Some([139.0, 114.0]),
            ..UNREADABLE
        },
        Published {
            method: "EVH",
            references: 203.0,
            nodes: Some(49187),
            overlap: Some(114.0),
            ..UNREADABLE
        },
        Published {
            method: "BVH",
            references: 100.0,
            nodes: Some(24291),
            sah_cost: Some(123.5),
            intersections: Some((224.1, 909)),
            traversals: Some((321.9, 797)),
            overlap: Some(100.0),
            spatial_splits: None,
            speed: Some([100.0, 100.0]),
        },
    ],
};

const SIBENIK: PublishedScene = PublishedScene {
    name: "Sibenik Cathedral",
    triangles: 80_000,
    rows: [
        Published {
            method: "SBVH",
            references: 128.0,
            nodes: Some(35079),
            sah_cost: Some(75.4),
            intersections: Some((38.9, 267)),
            traversals: Some((109.0, 280)),
            overlap: Some(76.0),
            spatial_splits: Some(2990),
            speed: Some([116.0, 113.0]),
        },
        Published {
            method: "ESC",
            references: 128.0,
            nodes: Some(35125),
            sah_cost: Some(94.1),
            intersections: Some((40.9, 249)),
            traversals: Some((127.1, 330)),
            overlap: Some(103.0),
            spatial_splits: None,
            speed: Some([94.0, 96.0]),
        },
        Published {
            method: "EVH",
            references: 128.0,
            nodes: Some(35369),
            sah_cost: Some(93.7),
            intersections: Some((39.9, 341)),
            traversals: Some((126.9, 459)),
            overlap: Some(125.0),
            spatial_splits: None,
            speed: Some([95.0, 94.0]),
        },
        Published {
            method: "BVH",
            references: 100.0,
            nodes: Some(26993),
            sah_cost: Some(86.1),
            intersections: Some((42.3, 321)),
            traversals: Some((122.6, 311)),
            overlap: Some(100.0),
            spatial_splits: None,
            speed: Some([100.0, 100.0]),
        },
    ],
};

const BUBS: PublishedScene = PublishedScene {
    name: "Bubs",
    triangles: 1_888_000,
    rows: [
        Published {
            method: "SBVH",
            references: 103.0,
            nodes: Some(669_113),
            sah_cost: Some(29.8),
            intersections: Some((33.2, 374)),
            traversals: Some((97.9, 476)),
            overlap: Some(47.0),
            spatial_splits: Some(1493),
            speed: Some([126.0, 103.0]),
        },
        Published {
            method: "ESC",
            references: 103.0,
            nodes: Some(669_771),
            sah_cost: Some(53.4),
            intersections: Some((28.3, 458)),
            traversals: Some((135.6, 509)),
            overlap: Some(70.0),
            spatial_splits: None,
            speed: Some([94.0, 88.0]),
        },
        Published {
            method: "EVH",
            references: 103.0,
            nodes: Some(668_321),
            sah_cost: Some(42.7),
            intersections: Some((34.6, 435)),
            traversals: Some((143.5, 545)),
            overlap: Some(117.0),
            spatial_splits: None,
            speed: Some([95.0, 92.0]),
        },
        Published {
            method: "BVH",
            references: 100.0,
            nodes: Some(646_783),
            sah_cost: Some(44.6),
            intersections: Some((92.2, 465)),
            traversals: Some((126.7, 501)),
            overlap: Some(100.0),
            spatial_splits: None,
            speed: Some([100.0, 100.0]),
        },
    ],
};

/// How a published scene is related to the one that it stands beside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relation {
    /// A file that is it by all that can be told.
    Alike,
    /// An embedded scene of its kind.
    StoodFor,
}

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Alike => "which the file is by its name, size and rotation",
            Self::StoodFor => "for which this scene stands",
        })
    }
}

/// Embedded scenes that stand for published ones.
const STAND_INS: [(&str, &PublishedScene); 2] =
    [("colonnade-45", &ROTATED_SPONZA), ("stadium", &BUBS)];

/// Files of published scenes: a word of their names, and their rotation.
const FILES: [(&str, [f64; 3], &PublishedScene); 2] = [
    ("sponza", [45.0; 3], &ROTATED_SPONZA),
    ("sibenik", [0.0; 3], &SIBENIK),
];

/// The published scene that a scene is, or stands for.
pub(super) fn find(scene: &Scene) -> Option<(&'static PublishedScene, Relation)> {
    let degrees = scene.rotation.degrees;
    if let Some(embedded) = scene.embedded {
        let mut stand_ins = STAND_INS.into_iter();
        let (_, published) = stand_ins.find(|(name, _)| *name == embedded)?;
        return (degrees == [0.0; 3]).then_some((published, Relation::StoodFor));
    }
    let name = scene.name.to_lowercase();
    let (_, _, published) = FILES.into_iter().find(|(word, rotation, published)| {
        name.contains(word) && degrees == *rotation && published.has_about(scene.triangles.len())
    })?;
    Some((published, Relation::Alike))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::rotation::Rotation;

    /// A file of this name and size.
    fn file(name: &str, triangles: usize, degrees: [f64; 3]) -> Scene {
        let mut scene = Scene::load("cylinder").unwrap();
        let triangle = scene.triangles[0];
        scene.embedded = None;
        scene.name = name.to_owned();
        scene.triangles = vec![triangle; triangles];
        scene.rotate(Rotation { degrees });
        scene
    }

    fn found(scene: &Scene) -> Option<(&'static str, Relation)> {
        find(scene).map(|(published, relation)| (published.name, relation))
    }

    #[test]
    fn files_are_set_beside_what_they_are_by_name_size_and_rotation() {
        let sponza = |triangles, degrees| found(&file("my_Sponza", triangles, degrees));
        let rotated = Some(("Rotated Sponza", Relation::Alike));
        assert_eq!(sponza(66_450, [45.0; 3]), rotated);
        assert_eq!(sponza(1, [45.0; 3]), None);
        assert_eq!(sponza(262_267, [45.0; 3]), None);
        assert_eq!(sponza(66_450, [0.0; 3]), None);
        assert_eq!(sponza(66_450, [45.0, 0.0, 0.0]), None);
        let sibenik = Some(("Sibenik Cathedral", Relation::Alike));
        assert_eq!(found(&file("sibenik", 80_479, [0.0; 3])), sibenik);
        assert_eq!(found(&file("sibenik", 80_479, [45.0; 3])), None);
        assert_eq!(found(&file("colonnade-45", 66_450, [0.0; 3])), None);
    }

    #[test]
    fn embedded_scenes_only_stand_for_published_ones() {
        let mut scene = Scene::load("stadium@600").unwrap();
        assert_eq!(found(&scene), Some(("Bubs", Relation::StoodFor)));
        scene.rotate(Rotation { degrees: [9.0; 3] });
        assert_eq!(found(&scene), None);
        for (name, _) in STAND_INS {
            assert!(found(&Scene::load(name).unwrap()).is_some(), "{name}");
        }
        assert_eq!(found(&Scene::load("room").unwrap()), None);
    }
}
