//! Choosing a child in a way that the processor can guess.

use std::hint::black_box;

/// The item whose place is in the three lowest bits of `place`: found by a jump
/// that the processor predicts, not by an address that it must wait for.
///
/// Which child a ray visits next follows from a test of all children, and an address
/// computed from that is known only when the test is done; loading the next node
/// begins that late. A jump is guessed from those before it, and the load begins
/// at once. Neighbouring rays go the same way, and so the guess is often right.
#[inline(always)]
pub fn predicted<T: Copy>(items: &[T; 8], place: usize) -> T {
    let [a, b, c, d, e, f, g, h] = items;
    match place & 0b111 {
        0 => taken(a),
        1 => taken(b),
        2 => taken(c),
        3 => taken(d),
        4 => taken(e),
        5 => taken(f),
        6 => taken(g),
        _ => taken(h),
    }
}

/// Reads `item` before anything behind the jump, so that the compiler does not put
/// all reads into one, at a computed address.
#[inline(always)]
fn taken<T: Copy>(item: &T) -> T {
    let item = *item;
    black_box(());
    item
}

/// 1 if `condition` holds and 0 if not, by a jump as [`predicted`]: for conditions that
/// take long to compute and are often the same.
#[inline(always)]
pub fn predicted_bit(condition: bool) -> u32 {
    // Without `black_box`, the compiler computes the bit from the condition.
    if condition {
        black_box(1)
    } else {
        black_box(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_condition_is_its_bit() {
        assert_eq!([true, false].map(predicted_bit), [1, 0]);
    }

    #[test]
    fn every_place_has_its_item() {
        let items = [3, 1, 4, 1, 5, 9, 2, 6];
        for (place, &item) in items.iter().enumerate() {
            assert_eq!(predicted(&items, place), item);
            assert_eq!(predicted(&items, place + 8), item);
        }
    }
}
