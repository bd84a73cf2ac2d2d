//! The codec of references: an id in 31 bits, and in bit 31 whether the leaf
//! ends here.

/// The most primitives that a structure can hold: ids take 31 bits.
pub const MAX_PRIMITIVES: usize = 1 << 31;

const LAST_IN_LEAF: u32 = 1 << 31;

/// The references of all leaves, one after the other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReferenceList {
    words: Vec<u32>,
}

impl ReferenceList {
    /// An empty list with room for `references`.
    pub fn with_capacity(references: usize) -> Self {
        Self {
            words: Vec::with_capacity(references),
        }
    }

    /// Adds a leaf of at least one id and returns the position of its first
    /// reference.
    pub fn push_leaf(&mut self, ids: &[u32]) -> u32 {
        let first = self.words.len() as u32;
        debug_assert!(
            ids.iter().all(|id| id & LAST_IN_LEAF == 0),
            "ids take 31 bits"
        );
        self.words.extend_from_slice(ids);
        if let Some(last) = self.words.last_mut() {
            *last |= LAST_IN_LEAF;
        }
        first
    }

    /// The id at `position`.
    #[inline]
    pub fn id(&self, position: usize) -> u32 {
        self.words[position] & !LAST_IN_LEAF
    }

    /// Ids from the leaf's `first` reference to its last.
    #[inline]
    pub fn leaf(&self, first: u32) -> impl Iterator<Item = u32> + '_ {
        let rest = &self.words[first as usize..];
        let mut ended = false;
        rest.iter().map_while(move |&word| {
            let id = (!ended).then_some(word & !LAST_IN_LEAF);
            ended = word & LAST_IN_LEAF != 0;
            id
        })
    }

    /// How many references there are.
    pub fn len(&self) -> usize {
        self.words.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// Four bytes a reference.
    pub fn bytes(&self) -> usize {
        size_of_val(self.words.as_slice())
    }

    /// The words as stored.
    pub fn words(&self) -> &[u32] {
        &self.words
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_end_at_their_markers_even_for_id_zero() {
        let mut list = ReferenceList::default();
        let first = list.push_leaf(&[5, 0]);
        let second = list.push_leaf(&[0]);
        let third = list.push_leaf(&[MAX_PRIMITIVES as u32 - 1, 7, 7]);
        assert_eq!(list.leaf(first).collect::<Vec<_>>(), [5, 0]);
        assert_eq!(list.leaf(second).collect::<Vec<_>>(), [0]);
        assert_eq!(
            list.leaf(third).collect::<Vec<_>>(),
            [MAX_PRIMITIVES as u32 - 1, 7, 7]
        );
        assert_eq!((list.len(), list.bytes()), (6, 24));
    }
}
