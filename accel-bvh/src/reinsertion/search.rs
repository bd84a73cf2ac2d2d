//! Where a node would cost least (Meister and Bittner 2018, section 3.2).

use accel_core::Aabb;

use super::links::{Content, Links};

/// The most places that a node looks at: scenes whose boxes all overlap would
/// show it the whole tree.
const MOST_PLACES: u32 = 4096;

/// A node that would be better off beside another.
pub(super) struct Move {
    pub node: u32,
    pub beside: u32,
    /// By how much the areas of all inner boxes together shrink.
    pub gain: f64,
}

/// The best place for `node`, which lies below a child of the root; `None` where
/// it stands well.
///
/// From its parent upward, each ancestor shrinks to what remains without the
/// node. Into the subtrees that hang off that path the search goes down, as long
/// as the boxes that grow with the node leave a gain.
pub(super) fn best_move(links: &Links, node: u32) -> Option<Move> {
    let parent = links.node(node).parent;
    let mut search = Search::new(links, node);
    // Without the node its parent is gone.
    let mut saved = links.node(parent).bounds.half_area();
    let mut hanging = links.sibling(node);
    let mut remaining = links.node(hanging).bounds;
    let mut ancestor = parent;
    loop {
        search.go_down(hanging, saved);
        if links.is_root(ancestor) || search.places == 0 {
            break;
        }
        if ancestor != parent {
            saved += links.node(ancestor).bounds.half_area() - remaining.half_area();
        }
        hanging = links.sibling(ancestor);
        remaining = remaining.union(&links.node(hanging).bounds);
        ancestor = links.node(ancestor).parent;
    }
    // Beside its sibling it stands already.
    let (gain, beside) = search.best?;
    (beside != links.sibling(node)).then_some(Move { node, beside, gain })
}

struct Search<'a> {
    links: &'a Links,
    bounds: Aabb,
    area: f64,
    best: Option<(f64, u32)>,
    /// Places that may still be looked at.
    places: u32,
    pending: Vec<(u32, f64)>,
}

impl<'a> Search<'a> {
    fn new(links: &'a Links, node: u32) -> Self {
        let bounds = links.node(node).bounds;
        Self {
            links,
            bounds,
            area: bounds.half_area(),
            best: None,
            places: MOST_PLACES,
            pending: Vec::new(),
        }
    }

    /// Looks at `top` and what lies below it. `saved` is what the node gains if
    /// it costs nothing at its new place.
    fn go_down(&mut self, top: u32, saved: f64) {
        self.pending.push((top, saved));
        while let Some((place, saved)) = self.pending.pop() {
            // A box around the node is never smaller than the node's own.
            if self.places == 0 || saved - self.area <= self.best_gain() {
                continue;
            }
            self.places -= 1;
            let place_bounds = self.links.node(place).bounds;
            let gain = saved - place_bounds.union(&self.bounds).half_area();
            if gain > self.best_gain() {
                self.best = Some((gain, place));
            }
            if let Content::Inner(children) = self.links.node(place).content {
                let saved = gain + place_bounds.half_area();
                self.pending.extend(children.map(|child| (child, saved)));
            }
        }
    }

    fn best_gain(&self) -> f64 {
        self.best.map_or(0.0, |(gain, _)| gain)
    }
}
