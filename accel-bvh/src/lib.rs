//! Bounding volume hierarchies built by the surface area heuristic.
