//! The figures of a comparison, as written to JSON, and the pictures beside them.

use serde::{Deserialize, Serialize};

/// The name of this form of JSON.
pub const SCHEMA: &str = "accel-bench/1";

/// Everything that a comparison found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: String,
    /// What the figures depend on.
    pub environment: Environment,
    /// One cell per scene and structure.
    pub cells: Vec<Cell>,
}

/// What figures depend on besides scene and structure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Environment {
    /// The processor's name, if the system tells.
    pub cpu: Option<String>,
    /// Vector instruction sets found at run time.
    pub features: Vec<String>,
    /// Threads that build and trace.
    pub threads: usize,
    /// The commit of the program, if it runs in its working copy.
    pub commit: Option<String>,
    /// The program's version.
    pub version: String,
    /// Seed of everything random.
    pub seed: u64,
    /// The command line.
    pub command: String,
    /// Operating system and architecture.
    pub os: String,
}

/// A structure over a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// The scene's name.
    pub scene: String,
    /// Its number of triangles.
    pub triangles: usize,
    /// The structure's name.
    pub structure: String,
    /// Its settings.
    pub settings: String,
    /// Median time of a build, in seconds.
    pub build_seconds: f64,
    /// Memory.
    pub bytes: Bytes,
    /// Figures of the tree.
    pub statistics: Statistics,
    /// Figures by kind of rays.
    pub rays: Vec<RayRow>,
}

/// Memory by part, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bytes {
    /// Nodes.
    pub nodes: usize,
    /// References from leaves to triangles.
    pub references: usize,
    /// Triangles, and what finds them by id.
    pub primitives: usize,
    /// All together.
    pub total: usize,
}

/// Figures of a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Nodes of all kinds.
    pub nodes: usize,
    /// Of these, leaves.
    pub leaves: usize,
    /// References in leaves.
    pub references: usize,
    /// References per leaf.
    pub mean_leaf_size: f64,
    /// Edges from the root to the deepest leaf.
    pub depth: u32,
    /// Expected cost by the surface area heuristic.
    pub sah_cost: f64,
    /// Half areas of sibling overlaps over the root's half area.
    pub overlap: f64,
    /// End-point overlap (Aila 2013).
    pub epo: Option<f64>,
}

/// Figures of one kind of rays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RayRow {
    /// The kind's name.
    pub kind: String,
    /// How many rays.
    pub count: usize,
    /// What a reader must know of their length.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub note: Option<String>,
    /// Speed; none where hits disagree with brute force's, and for packets of
    /// rays that are not coherent.
    pub mrays_per_second: Option<Spread>,
    /// Nodes read.
    pub nodes_per_ray: MeanMax,
    /// Boxes tested.
    pub box_tests_per_ray: MeanMax,
    /// Planes tested; a box counts six.
    pub plane_tests_per_ray: MeanMax,
    /// Triangles tested.
    pub primitive_tests_per_ray: MeanMax,
    /// Rays that hit something.
    pub hits: usize,
    /// The comparison with brute force.
    pub verified: Verified,
}

/// The middle and the ends of repeated measurements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Half of them are below.
    pub median: f64,
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
}

/// Mean and maximum over rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeanMax {
    /// Per ray.
    pub mean: f64,
    /// Of the ray with the most.
    pub max: u64,
}

/// A comparison with brute force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Verified {
    /// Rays compared.
    pub rays: usize,
    /// Rays answered differently.
    pub disagreements: usize,
}

/// Pictures for the report.
#[derive(Clone, Debug, Default)]
pub struct Pictures {
    /// What rays cost, pixel by pixel.
    pub heat_maps: Vec<HeatMap>,
    /// The scenes themselves.
    pub shaded: Vec<Shaded>,
}

/// A quantity, pixel by pixel.
#[derive(Clone, Debug)]
pub struct HeatMap {
    /// The scene's name.
    pub scene: String,
    /// The structure's name.
    pub structure: String,
    /// What is counted.
    pub quantity: Quantity,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Row by row from the top.
    pub values: Vec<u32>,
}

/// What a heat map counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Nodes read.
    NodeVisits,
    /// Triangles tested.
    PrimitiveTests,
}

/// A picture of a scene.
#[derive(Clone, Debug)]
pub struct Shaded {
    /// The scene's name.
    pub scene: String,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Three bytes a pixel, row by row from the top.
    pub rgb: Vec<u8>,
}

impl Report {
    /// Without cells yet.
    pub fn new(environment: Environment) -> Self {
        Self {
            schema: SCHEMA.to_owned(),
            environment,
            cells: Vec::new(),
        }
    }

    /// Rays answered differently from brute force, over all cells.
    pub fn disagreements(&self) -> usize {
        let rows = self.cells.iter().flat_map(|cell| &cell.rays);
        rows.map(|row| row.verified.disagreements).sum()
    }

    /// The scenes in order of first appearance.
    pub fn scenes(&self) -> Vec<&str> {
        let mut scenes: Vec<&str> = Vec::new();
        for cell in &self.cells {
            if !scenes.contains(&cell.scene.as_str()) {
                scenes.push(&cell.scene);
            }
        }
        scenes
    }

    /// The cells of a scene.
    pub fn cells_of<'a>(&'a self, scene: &'a str) -> impl Iterator<Item = &'a Cell> {
        self.cells.iter().filter(move |cell| cell.scene == scene)
    }
}

impl Quantity {
    /// Both quantities.
    pub const ALL: [Self; 2] = [Self::NodeVisits, Self::PrimitiveTests];

    /// A name for readers.
    pub fn name(self) -> &'static str {
        match self {
            Self::NodeVisits => "node visits",
            Self::PrimitiveTests => "triangle tests",
        }
    }
}

impl Spread {
    /// The median of `values` and the interval that holds the median of what
    /// they are drawn from with 95 % confidence, by their order alone; all of
    /// their range where there are too few for that.
    pub fn with_confidence(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let median = Self::of(&sorted).median;
        let Some(last) = sorted.len().checked_sub(1) else {
            return Self::default();
        };
        let rank = rank_outside_confidence(sorted.len()).unwrap_or(0);
        Self {
            median,
            min: sorted[rank],
            max: sorted[last - rank],
        }
    }

    /// What the interval of [`with_confidence`](Self::with_confidence) is for so
    /// many values, for readers.
    pub fn interval_of(count: usize) -> &'static str {
        match rank_outside_confidence(count) {
            Some(_) => "the interval that holds the median with 95 % confidence",
            None => "their range, since so few don't bound the median with 95 % confidence",
        }
    }

    /// Of `values`; zeroes without any.
    pub fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (Some(&min), Some(&max)) = (sorted.first(), sorted.last()) else {
            return Self::default();
        };
        let middle = sorted.len() / 2;
        let median = if sorted.len() % 2 == 1 {
            sorted[middle]
        } else {
            (sorted[middle - 1] + sorted[middle]) / 2.0
        };
        Self { median, min, max }
    }
}

/// How many of the smallest and of the largest of `count` values lie outside of
/// the interval that holds their median with 95 % confidence; `None` for too few
/// to tell. For at most a thousand: more have too many subsets for an f64.
fn rank_outside_confidence(count: usize) -> Option<usize> {
    // A value is below the median with probability 1/2: the binomial
    // distribution tells how likely few of them are.
    let (mut ways, mut below) = (1.0_f64, 0.0);
    for rank in 0..count / 2 {
        below += ways / 2.0_f64.powi(count as i32);
        if below > 0.025 {
            return rank.checked_sub(1);
        }
        ways *= (count - rank) as f64 / (rank + 1) as f64;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_has_the_median_of_odd_and_even_counts() {
        assert_eq!(Spread::of(&[3.0, 1.0, 2.0]).median, 2.0);
        let even = Spread::of(&[4.0, 1.0, 2.0, 3.0]);
        assert_eq!((even.median, even.min, even.max), (2.5, 1.0, 4.0));
        assert_eq!(Spread::of(&[]), Spread::default());
        assert_eq!(Spread::with_confidence(&[]), Spread::default());
    }

    #[test]
    fn the_confidence_interval_drops_as_many_values_as_tables_say() {
        // Of 9 values the second and the eighth hold the median with 96 %.
        let ranks = [6, 9, 12, 20, 100, 1000].map(rank_outside_confidence);
        assert_eq!(ranks, [0, 1, 2, 5, 39, 468].map(Some));
        let nine: Vec<f64> = (1..=9).map(f64::from).collect();
        let spread = Spread::with_confidence(&nine);
        assert_eq!((spread.min, spread.median, spread.max), (2.0, 5.0, 8.0));
    }

    #[test]
    fn fewer_than_six_values_claim_no_confidence() {
        // Five values are all on one side of the median with 2 / 2^5 = 6 %.
        assert_eq!([0, 1, 2, 5].map(rank_outside_confidence), [None; 4]);
        assert!(Spread::interval_of(5).contains("range"));
        assert!(!Spread::interval_of(6).contains("range"));
        let five = Spread::with_confidence(&[5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!((five.min, five.median, five.max), (1.0, 3.0, 5.0));
    }
}
