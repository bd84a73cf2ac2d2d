//! What a traversal may remember of the planes that it has passed (Ize 2008, section
//! 4.3); nothing, as a rule.

/// What a part of the ray knows of the planes that it lies between.
pub(crate) trait PlaneTracking: Copy {
    /// Of the whole ray inside the scene's box.
    fn of_ray(near: f64, far: f64) -> Self;

    /// In a child, if the ray passes the plane on one side.
    fn on_one_side(self) -> Self;

    /// In the nearer child and the farther one, if the plane is at the `t` that `at`
    /// tells.
    fn divided(self, at: impl FnOnce() -> f64) -> [Self; 2];

    /// What a leaf answers whose primitive covers the face that the node at
    /// `depth` has cut.
    fn leaf_answer(&self, depth: u32) -> LeafAnswer;
}

/// What is known of the primitive of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LeafAnswer {
    /// Nothing: its kernel must decide.
    AskKernel,
    /// It is hit there.
    Hit(f64),
    /// It is missed.
    Miss,
}

/// Knows nothing, for the queries that kernels answer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Untracked;

impl PlaneTracking for Untracked {
    #[inline]
    fn of_ray(_: f64, _: f64) -> Self {
        Self
    }

    #[inline]
    fn on_one_side(self) -> Self {
        self
    }

    #[inline]
    fn divided(self, _: impl FnOnce() -> f64) -> [Self; 2] {
        [self; 2]
    }

    #[inline]
    fn leaf_answer(&self, _: u32) -> LeafAnswer {
        LeafAnswer::AskKernel
    }
}
