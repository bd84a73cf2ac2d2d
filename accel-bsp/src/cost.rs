//! The surface area heuristic for trees with two kinds of nodes (Ize 2008,
//! section 3.3).

use accel_core::{BuildError, SurfaceAreaHeuristic};

/// What visiting a node and testing a primitive cost. Only ratios matter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BspCosts {
    /// C_i, the cost of testing a primitive. Finite and above 0. A test of a triangle
    /// takes about as long as a visit of a node, so 1 gives fast trees of most meshes;
    /// some, scans among them, gain by 0.5. With 4 nearly all leaves hold one triangle,
    /// and a tree takes about three times the bytes: for primitives whose tests are dear.
    pub intersection: f64,
    /// C_kd, the cost of visiting a node split orthogonally to an axis. Finite
    /// and at least 0.
    pub axis_aligned: f64,
    /// C_BSP, the cost of visiting a node split by another plane; the paper
    /// measured 1.75 times C_kd (section 4.1). Finite and at least 0.
    pub general: f64,
    /// While splits are compared, C_BSP is instead
    /// `alpha C_i (n - 1) + C_kd` in a node of n primitives; the fixed C_BSP
    /// serves where no split beats a leaf that way. `None` takes the fixed one
    /// at once: the plain heuristic of BSP-orig. The paper takes 0.1.
    pub alpha: Option<f64>,
}

impl Default for BspCosts {
    /// The paper's ratios, and a primitive that costs as much as an axis-aligned node.
    fn default() -> Self {
        Self {
            intersection: 1.0,
            axis_aligned: 1.0,
            general: 1.75,
            alpha: Some(0.1),
        }
    }
}

impl BspCosts {
    pub(crate) fn validate(&self) -> Result<(), BuildError> {
        self.heuristic(self.axis_aligned).validate()?;
        self.heuristic(self.general).validate()?;
        match self.alpha {
            Some(alpha) if !(0.0..f64::INFINITY).contains(&alpha) => {
                Err(BuildError::InvalidSetting {
                    setting: "alpha",
                    value: alpha.to_string(),
                    allowed: "a finite number, 0 or more",
                })
            }
            _ => Ok(()),
        }
    }

    /// The heuristic of a node that costs this much to visit.
    pub(crate) fn heuristic(&self, traversal_cost: f64) -> SurfaceAreaHeuristic {
        SurfaceAreaHeuristic {
            traversal_cost,
            intersection_cost: self.intersection,
        }
    }

    /// What the tests in the children of a node cost if those are leaves: of the node by
    /// its area and how many primitives it holds, of these by theirs.
    pub(crate) fn of_children(
        &self,
        (area, count): (f64, usize),
        areas: [f64; 2],
        counts: [usize; 2],
    ) -> f64 {
        let heuristic = self.heuristic(0.0);
        heuristic.of_node(area, count).split(areas, counts)
    }

    /// C_BSP that grows with the number of primitives.
    pub(crate) fn linear_general(&self, count: usize) -> f64 {
        match self.alpha {
            Some(alpha) => alpha * self.intersection * (count - 1) as f64 + self.axis_aligned,
            None => self.general,
        }
    }
}
