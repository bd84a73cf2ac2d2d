use super::*;
use crate::ray::{max_or_keep, min_or_keep};

const SPECIAL: [f32; 8] = [
    0.0,
    -0.0,
    1.5,
    -2.0,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    1e-45,
];

/// Every operation on every pair of special values, in the first lane and in the
/// last, beside the scalar one.
fn agrees_with_scalars<L: Lanes>() {
    let spread = |value: f32, shift: usize| {
        let lanes: Vec<f32> = (0..L::COUNT)
            .map(|lane| SPECIAL[(lane + shift) % 8])
            .collect();
        let mut vector = L::from_slice(&lanes);
        vector.lanes_mut()[L::COUNT - 1] = value;
        vector
    };
    for (shift, a) in SPECIAL.into_iter().enumerate() {
        for b in SPECIAL {
            let (x, y) = (spread(a, 0), spread(b, shift));
            same(x + y, x, y, |a, b| a + b);
            same(x - y, x, y, |a, b| a - b);
            same(x * y, x, y, |a, b| a * b);
            same(x / y, x, y, |a, b| a / b);
            same(x.max_or_keep(y), x, y, max_or_keep);
            same(x.min_or_keep(y), x, y, min_or_keep);
            let mask = |compare: fn(&f32, &f32) -> bool| {
                let pairs = x.lanes().iter().zip(y.lanes()).enumerate();
                pairs
                    .map(|(lane, (a, b))| u32::from(compare(a, b)) << lane)
                    .sum::<u32>()
            };
            assert_eq!(x.le_mask(y), mask(f32::le), "{x:?} {y:?}");
            assert_eq!(x.lt_mask(y), mask(f32::lt), "{x:?} {y:?}");
            same_doubles(x, y);
            let all = L::splat(a);
            assert!(all.lanes().iter().all(|lane| lane.to_bits() == a.to_bits()));
        }
    }
    assert_eq!(L::ALL.count_ones() as usize, L::COUNT);
    let words: Vec<u32> = (0..L::COUNT)
        .map(|lane| SPECIAL[lane % 8].to_bits())
        .collect();
    same(
        L::from_bits(&words),
        spread(SPECIAL[(L::COUNT - 1) % 8], 0),
        L::splat(0.0),
        |a, _| a,
    );
    let indices = (0..L::COUNT).fold(0, |all, lane| all | (lane as u64 * 5 % 8) << (3 * lane));
    let picked = L::pick(&SPECIAL, indices);
    let expected = L::from_fn(|lane| SPECIAL[lane * 5 % 8]);
    same(picked, expected, expected, |a, _| a);
    let counted = L::from_fn(|lane| lane as f32);
    assert!((0..L::COUNT).all(|lane| counted.lanes()[lane] == lane as f32));
}

fn same<L: Lanes>(result: L, x: L, y: L, scalar: impl Fn(f32, f32) -> f32) {
    for (lane, &actual) in result.lanes().iter().enumerate() {
        let expected = scalar(x.lanes()[lane], y.lanes()[lane]);
        // A NaN that an operation makes may have either sign.
        let is_same =
            actual.to_bits() == expected.to_bits() || (actual.is_nan() && expected.is_nan());
        assert!(is_same, "lane {lane}: {actual} {expected}");
    }
}

/// As [`same`], in double precision, rounded afterwards.
fn same_doubles<L: Lanes>(x: L, y: L) {
    let scalar = |operation: fn(f64, f64) -> f64| {
        move |a: f32, b: f32| operation(f64::from(a), f64::from(b)) as f32
    };
    let (a, b) = (x.to_doubles(), y.to_doubles());
    same(L::from_doubles(a), x, y, |a, _| a);
    same(L::from_doubles(a + b), x, y, scalar(|a, b| a + b));
    same(L::from_doubles(a - b), x, y, scalar(|a, b| a - b));
    same(L::from_doubles(a * b), x, y, scalar(|a, b| a * b));
    same(L::from_doubles(a / b), x, y, scalar(|a, b| a / b));
    assert_eq!(a.le_mask(b), x.le_mask(y));
    let third = L::Doubles::splat(1.0 / 3.0);
    same(
        L::from_doubles(a * third),
        x,
        y,
        scalar(|a, _| a * (1.0 / 3.0)),
    );
    assert_eq!(L::Doubles::COUNT, L::COUNT);
}

struct Check;

impl SimdWork for Check {
    type Output = [usize; 2];
    #[inline(always)]
    fn run<I: InstructionSet>(self) -> [usize; 2] {
        agrees_with_scalars::<F32x4>();
        agrees_with_scalars::<I::Eight>();
        agrees_with_scalars::<I::Sixteen>();
        [I::Eight::COUNT, I::Sixteen::COUNT]
    }
}

#[test]
fn every_width_at_every_level_agrees_with_scalars() {
    let levels: Vec<_> = SimdLevel::available().collect();
    assert_eq!(levels[0], SimdLevel::BASELINE);
    assert_eq!(levels.last(), Some(&SimdLevel::detect()));
    for level in levels {
        assert_eq!(level.run(Check), [8, 16], "{}", level.name());
    }
}
