//! The table of structures and settings: adding a structure is adding a row.

mod bsp;
mod bvh;
mod dualsplit;
mod kdtree;
mod packets;
mod sbvh;

use accel_core::layout::TriangleBlocks;
use accel_core::{
    BruteForce, BuildError, BuildObserver, DynStructure, InvalidPrimitives, SurfaceAreaHeuristic,
    Triangle,
};

/// A structure with settings, by the name that users type.
pub struct Row {
    /// The name.
    pub name: &'static str,
    /// Whether it is compared when nothing is asked for: the rows that stand for
    /// their crate.
    pub is_headline: bool,
    /// What it is, in a line.
    pub about: &'static str,
    /// The settings that differ from other rows.
    pub settings: &'static str,
    /// The costs it was built with, for its SAH cost.
    pub heuristic: fn() -> SurfaceAreaHeuristic,
    build: BuildFunction,
}

/// A structure in a box.
pub type Structure = Box<dyn DynStructure>;

type BuildFunction =
    fn(&[Triangle], InvalidPrimitives, &dyn BuildObserver) -> Result<Structure, BuildError>;

impl Row {
    /// Whether rays are traced in packets, which pay on coherent rays.
    pub fn is_packet(&self) -> bool {
        self.name.ends_with("-packet")
    }

    /// Builds the structure over `triangles`.
    ///
    /// # Errors
    /// As the structure's builder.
    pub fn build(
        &self,
        triangles: &[Triangle],
        invalid: InvalidPrimitives,
        observer: &dyn BuildObserver,
    ) -> Result<Structure, BuildError> {
        (self.build)(triangles, invalid, observer)
    }
}

static BRUTE_FORCE: &[Row] = &[Row {
    name: "brute-force",
    is_headline: false,
    about: "every triangle tested, sixteen at once: the oracle",
    settings: "",
    heuristic: SurfaceAreaHeuristic::default,
    build: |triangles, invalid, _| Ok(Box::new(oracle(triangles, invalid)?)),
}];

/// The rows of every crate, in the order of tables.
static ROWS: &[&[Row]] = &[
    bvh::ROWS,
    packets::ROWS,
    sbvh::ROWS,
    kdtree::ROWS,
    bsp::ROWS,
    dualsplit::ROWS,
    BRUTE_FORCE,
];

/// The brute force that every row must agree with.
///
/// # Errors
/// As [`BruteForce::with_storage`].
pub fn oracle(
    triangles: &[Triangle],
    invalid: InvalidPrimitives,
) -> Result<BruteForce<Triangle, TriangleBlocks>, BuildError> {
    BruteForce::with_storage(triangles, invalid)
}

/// All rows.
pub fn rows() -> impl Iterator<Item = &'static Row> {
    ROWS.iter().copied().flatten()
}

/// The rows of a list of names; `all` stands for every row but brute force,
/// which is slow, and no names for the headline rows.
///
/// # Errors
/// A sentence that names the first unknown name and those there are.
pub fn select(names: &[String]) -> Result<Vec<&'static Row>, String> {
    if names.is_empty() {
        return Ok(rows().filter(|row| row.is_headline).collect());
    }
    let mut selected: Vec<&Row> = Vec::new();
    for name in names {
        let before = selected.len();
        let is_named =
            |row: &&Row| row.name == name || (name == "all" && row.name != "brute-force");
        for row in rows().filter(is_named) {
            if selected.iter().all(|other| other.name != row.name) {
                selected.push(row);
            }
        }
        let is_known = rows().any(|row| is_named(&row));
        if selected.len() == before && !is_known {
            let known: Vec<_> = rows().map(|row| row.name).collect();
            return Err(format!(
                "there is no structure named `{name}`; there are {} and `all`",
                known.join(", ")
            ));
        }
    }
    Ok(selected)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(list: &[&str]) -> Result<Vec<&'static str>, String> {
        let list: Vec<String> = list.iter().map(ToString::to_string).collect();
        Ok(select(&list)?.iter().map(|row| row.name).collect())
    }

    #[test]
    fn selections_name_each_row_once() {
        let all = names(&["bvh-binned", "all"]).unwrap();
        assert_eq!(all[..2], ["bvh-binned", "bvh-sweep"]);
        assert_eq!(all.iter().filter(|name| **name == "bvh-binned").count(), 1);
        assert!(!all.contains(&"brute-force"));
        assert_eq!(names(&["brute-force"]).unwrap(), ["brute-force"]);
        assert!(names(&[]).unwrap().contains(&"bvh-sweep"));
        assert!(names(&["bvh"]).unwrap_err().contains("bvh-sweep"));
    }
}
