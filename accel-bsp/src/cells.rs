//! Walking a finished tree with the cell of every node: cells are not kept, but
//! the planes cut them again as they did in the build.

use accel_core::{Aabb, Polygonal};

use crate::node::{Node, NodeKind};
use crate::nodes::Nodes;
use crate::polytope::{CutError, Polytope, Reach};
use crate::split_plane::SplitPlane;
use crate::{BspCosts, BspTree};

/// A plane above a node, and whether the node lies in front of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ancestor {
    pub plane: SplitPlane,
    pub is_in_front: bool,
}

/// Shows `visit` every node: its index, its cell, and the planes of the nodes
/// above by their depth. Parts that hold nothing have no node.
///
/// # Errors
/// If a plane does not cut its cell, which no tree has that was built with such cells.
pub(crate) fn for_each_cell(
    nodes: &Nodes,
    bounds: &Aabb,
    reach: Reach,
    mut visit: impl FnMut(u32, &Polytope, &[Ancestor]),
) -> Result<(), CutError> {
    let mut path: Vec<Ancestor> = Vec::new();
    let mut pending = vec![(0, None, Polytope::of_box(bounds))];
    while let Some((index, parent, cell)) = pending.pop() {
        if let Some((parent, depth)) = parent {
            path.truncate(depth);
            path.push(parent);
        }
        visit(index, &cell, &path);
        let node = nodes.node(index);
        if let Some(plane) = nodes.split_plane(node) {
            let [behind, in_front] = cell.cut(&plane, reach)?;
            for (is_in_front, part) in [(true, in_front), (false, behind)] {
                if let Some(child) = node.child(u32::from(is_in_front)) {
                    let parent = Ancestor { plane, is_in_front };
                    pending.push((child, Some((parent, path.len())), part));
                }
            }
        }
    }
    Ok(())
}

impl<P: Polygonal> BspTree<P> {
    /// What a random ray costs by the surface area heuristic with the surface
    /// areas of the cells: the visits of nodes by their kind, fixed costs, and the
    /// tests of primitives. `None` for an empty tree, or a loaded one whose planes
    /// miss their cells.
    pub fn surface_area_cost(&self, costs: &BspCosts) -> Option<f64> {
        let (mut sum, mut whole) = (0.0, None);
        let bounds = self.bounds?;
        for_each_cell(&self.nodes, &bounds, Reach::Slack, |index, cell, _| {
            whole.get_or_insert(cell.area());
            sum += cell.area() * self.node_cost(self.nodes.node(index), costs);
        })
        .ok()?;
        // A scene without extent costs what its root does.
        let whole = whole.filter(|&area| area > 0.0);
        Some(whole.map_or(self.node_cost(self.nodes.node(0), costs), |area| sum / area))
    }

    fn node_cost(&self, node: &Node, costs: &BspCosts) -> f64 {
        match node.kind() {
            NodeKind::AxisAligned { .. } => costs.axis_aligned,
            NodeKind::General { .. } => costs.general,
            _ => costs.intersection * self.ids_of(node).count() as f64,
        }
    }
}
