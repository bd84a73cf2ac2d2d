//! Nodes decoded with checks: for words that may be anything.

use super::{FirstWord, Header, MOST_PLANES, OFFSET_BITS};
use crate::error::WordsError;
use accel_core::Aabb;

/// A node, decoded with checks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    pub header: Header,
    /// Of the first child, from the start of the words; or a leaf's number.
    pub target: usize,
    /// As many as the header tells, then zeros.
    pub planes: [f32; MOST_PLANES],
}

impl Node {
    /// Reads the node at `position`.
    ///
    /// # Errors
    /// What is wrong with it: see [`WordsError`].
    pub(crate) fn decode(words: &[u32], position: usize) -> Result<Self, WordsError> {
        let beyond = WordsError::BeyondEnd {
            position,
            words: words.len(),
        };
        let word = FirstWord(*words.get(position).ok_or(beyond.clone())?);
        let code = word.0 >> OFFSET_BITS;
        let header = Header::decode(word).ok_or(WordsError::UnusedCode { position, code })?;
        let own = words
            .get(position..position + header.words())
            .ok_or(beyond)?;
        let mut planes = [0.0; MOST_PLANES];
        for (plane, word) in planes.iter_mut().zip(&own[1..]) {
            *plane = f32::from_bits(*word);
        }
        if planes.iter().any(|plane| plane.is_nan()) {
            return Err(WordsError::NanPlane { position });
        }
        let offset = word.offset() as usize;
        let target = if header.is_leaf() {
            offset
        } else if offset < header.words() {
            return Err(WordsError::NotForward { position, offset });
        } else {
            position + offset
        };
        Ok(Self {
            header,
            target,
            planes,
        })
    }

    /// Where the children of an inner node are: one or two of them.
    pub(crate) fn children(&self) -> impl DoubleEndedIterator<Item = usize> + use<> {
        let second = match self.header {
            Header::Splitting {
                first_child_words, ..
            } => Some(self.target + first_child_words),
            _ => None,
        };
        let first = (!self.header.is_leaf()).then_some(self.target);
        first.into_iter().chain(second)
    }

    /// What the planes leave of `region`: of a splitting node for each child, of
    /// a carving node for its one child, twice.
    pub(crate) fn child_regions(&self, region: Aabb) -> [Aabb; 2] {
        match self.header {
            Header::Leaf => [region; 2],
            Header::Splitting { axis, .. } => [
                region.with_range(axis, f32::NEG_INFINITY, self.planes[0]),
                region.with_range(axis, self.planes[1], f32::INFINITY),
            ],
            Header::Carving { planes, .. } => [planes.carve(region, &self.planes); 2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::geometry::Axis;

    #[test]
    fn decoding_refuses_what_no_encoder_writes() {
        let splitting = Header::Splitting {
            axis: Axis::Y,
            first_child_words: 1,
        };
        let plane = 1.0_f32.to_bits();
        let error = |words: &[u32]| Node::decode(words, 0).unwrap_err();
        let forward = splitting.encode(3);
        assert!(Node::decode(&[forward, plane, plane], 0).is_ok());
        assert_eq!(
            error(&[splitting.encode(2), plane, plane]),
            WordsError::NotForward {
                position: 0,
                offset: 2
            }
        );
        assert_eq!(
            error(&[forward, plane]),
            WordsError::BeyondEnd {
                position: 0,
                words: 2
            }
        );
        assert_eq!(
            error(&[forward, plane, f32::NAN.to_bits()]),
            WordsError::NanPlane { position: 0 }
        );
        assert_eq!(
            error(&[0b00_1101 << OFFSET_BITS, plane, plane]),
            WordsError::UnusedCode {
                position: 0,
                code: 0b00_1101
            }
        );
    }
}
