//! All cores where the feature `parallel` is on, one otherwise.

/// Runs both closures, in parallel where the feature `parallel` is on.
pub fn join<A: Send, B: Send>(
    left: impl FnOnce() -> A + Send,
    right: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "parallel")]
    {
        rayon::join(left, right)
    }
    #[cfg(not(feature = "parallel"))]
    {
        (left(), right())
    }
}

/// What `function` makes of each item, in order; in parallel where the feature
/// `parallel` is on.
pub fn map_each<T: Send, U: Send>(
    items: Vec<T>,
    function: impl Fn(T) -> U + Sync + Send,
) -> Vec<U> {
    #[cfg(feature = "parallel")]
    {
        use rayon::iter::{IntoParallelIterator, ParallelIterator};
        items.into_par_iter().map(function).collect()
    }
    #[cfg(not(feature = "parallel"))]
    {
        items.into_iter().map(function).collect()
    }
}
