//! Which vectors the machine has, and code compiled for each.

use super::{F32x4, Lanes, Pair};

/// The vectors of an instruction set. Where it has none of a width, two of half
/// the width stand for it, with the same results bit for bit.
pub trait InstructionSet {
    /// Eight lanes.
    type Eight: Lanes;
    /// Sixteen lanes.
    type Sixteen: Lanes;
}

/// Code written once over [`InstructionSet`], compiled for each of them.
pub trait SimdWork {
    /// What it yields.
    type Output;

    /// Does it. This and everything in it that touches vectors must be
    /// `#[inline(always)]`: only what is inlined into the instance for an
    /// instruction set uses its instructions.
    fn run<I: InstructionSet>(self) -> Self::Output;
}

/// An instruction set that this machine has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SimdLevel(Level);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2,
}

/// What every machine has: SSE2 on x86-64, arrays elsewhere.
struct Baseline;

impl InstructionSet for Baseline {
    type Eight = Pair<F32x4>;
    type Sixteen = Pair<Pair<F32x4>>;
}

impl SimdLevel {
    /// What every machine has.
    pub const BASELINE: Self = Self(Level::Baseline);

    /// The widest vectors of this machine. Cheap: it is found out once.
    #[inline]
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if x86::has_avx2() {
                return Self(Level::Avx2);
            }
        }
        Self::BASELINE
    }

    /// All levels of this machine, the narrowest first: what tests go through.
    pub fn available() -> impl Iterator<Item = Self> {
        let best = Self::detect();
        let all = [
            Level::Baseline,
            #[cfg(target_arch = "x86_64")]
            Level::Avx2,
        ];
        all.into_iter()
            .map(Self)
            .filter(move |&level| level <= best)
    }

    /// Its usual name.
    pub fn name(self) -> &'static str {
        match self.0 {
            Level::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "AVX2",
        }
    }

    /// Does `work` with the vectors of this level.
    #[inline]
    #[allow(unsafe_code)]
    pub fn run<W: SimdWork>(self, work: W) -> W::Output {
        match self.0 {
            Level::Baseline => work.run::<Baseline>(),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: a level is made only by `detect` and `available`, which
            // find these instructions on the machine.
            Level::Avx2 => unsafe { x86::run_avx2(work) },
        }
    }
}

/// One entry per instruction set. None enables fused multiply-add, which would
/// change bits.
#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::super::Pair;
    use super::super::x86::F32x8;
    use super::{InstructionSet, SimdWork};

    struct Avx2;

    impl InstructionSet for Avx2 {
        type Eight = F32x8;
        type Sixteen = Pair<F32x8>;
    }

    #[inline]
    pub(super) fn has_avx2() -> bool {
        std::arch::is_x86_feature_detected!("avx2")
            && std::arch::is_x86_feature_detected!("bmi1")
            && std::arch::is_x86_feature_detected!("popcnt")
    }

    #[target_feature(enable = "avx2,bmi1,popcnt")]
    pub(super) fn run_avx2<W: SimdWork>(work: W) -> W::Output {
        work.run::<Avx2>()
    }
}
