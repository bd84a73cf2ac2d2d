//! Shrinking a list by leaving items out: delta debugging (Zeller and
//! Hildebrandt 2002) with stretches that halve in length.

/// A list that shrinks towards the fewest items that still fail.
#[derive(Debug)]
pub(super) struct Subset<T> {
    items: Vec<T>,
    /// How many items the next attempt leaves out; 0 when all were tried.
    stretch: usize,
    /// Where the next stretch starts.
    position: usize,
    /// What the last attempt left out at `position`.
    left_out: Vec<T>,
}

impl<T: Clone> Subset<T> {
    pub(super) fn of(items: Vec<T>) -> Self {
        Self {
            stretch: items.len(),
            items,
            position: 0,
            left_out: Vec::new(),
        }
    }

    pub(super) fn current(&self) -> &[T] {
        &self.items
    }

    /// Leaves the next stretch out, for good unless it is put back. False if
    /// nothing remains to be tried.
    pub(super) fn leave_out_more(&mut self) -> bool {
        if self.position >= self.items.len() {
            self.position = 0;
            self.stretch = self.stretch.min(self.items.len()) / 2;
        }
        if self.stretch == 0 {
            return false;
        }
        let end = self.items.len().min(self.position + self.stretch);
        self.left_out = self.items.drain(self.position..end).collect();
        true
    }

    /// Undoes the last attempt and moves on behind it. False if there was
    /// none.
    pub(super) fn put_back(&mut self) -> bool {
        let back = std::mem::take(&mut self.left_out);
        let length = back.len();
        self.items.splice(self.position..self.position, back);
        self.position += length;
        length > 0
    }
}
