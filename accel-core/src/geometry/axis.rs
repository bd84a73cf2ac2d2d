//! The three coordinate axes.

use glam::Vec3;

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Axis {
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
    /// The third coordinate.
    Z,
}

impl Axis {
    /// All three, in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// The axis of the component largest in magnitude; the first of equals.
    #[inline]
    pub fn largest(v: Vec3) -> Self {
        let v = v.abs();
        if v.x >= v.y && v.x >= v.z {
            Self::X
        } else if v.y >= v.z {
            Self::Y
        } else {
            Self::Z
        }
    }

    /// 0, 1 or 2.
    #[inline]
    pub fn index(self) -> usize {
        self as usize
    }

    /// This axis' component of `v`.
    #[inline]
    pub fn of(self, v: Vec3) -> f32 {
        match self {
            Self::X => v.x,
            Self::Y => v.y,
            Self::Z => v.z,
        }
    }

    /// `v` rotated cyclically so that this axis' component comes last.
    #[inline]
    pub fn rotate_last(self, v: Vec3) -> Vec3 {
        match self {
            Self::X => Vec3::new(v.y, v.z, v.x),
            Self::Y => Vec3::new(v.z, v.x, v.y),
            Self::Z => v,
        }
    }

    /// The unit vector along this axis.
    pub fn unit(self) -> Vec3 {
        Vec3::AXES[self.index()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn largest_prefers_the_first_of_equals_and_ignores_signs() {
        assert_eq!(Axis::largest(Vec3::new(-2.0, 2.0, 1.0)), Axis::X);
        assert_eq!(Axis::largest(Vec3::new(0.0, -1.0, 1.0)), Axis::Y);
        assert_eq!(Axis::largest(Vec3::new(0.0, 0.5, -1.0)), Axis::Z);
    }

    #[test]
    fn rotation_puts_the_axis_last_and_keeps_the_cycle() {
        let v = Vec3::new(1.0, 2.0, 3.0);
        for axis in Axis::ALL {
            assert_eq!(axis.rotate_last(v).z, axis.of(v));
        }
        assert_eq!(Axis::X.rotate_last(v), Vec3::new(2.0, 3.0, 1.0));
        assert_eq!(Axis::Y.rotate_last(v), Vec3::new(3.0, 1.0, 2.0));
    }
}
