//! From quantities to colours, on a scale that pictures share.

/// A colour scale from 0 to `top`; larger values get the colour of `top`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale {
    /// The value at the bright end.
    pub top: u32,
}

impl Scale {
    /// The scale for pictures that are to be compared: its top exceeds all but
    /// five in a thousand of their values, so that a few extreme pixels do not
    /// darken everything else.
    pub fn shared<'a>(pictures: impl IntoIterator<Item = &'a [u32]>) -> Self {
        let mut values: Vec<u32> = pictures.into_iter().flatten().copied().collect();
        if values.is_empty() {
            return Self { top: 1 };
        }
        let rank = (values.len() * 995 / 1000).min(values.len() - 1);
        let (_, &mut top, _) = values.select_nth_unstable(rank);
        Self { top: top.max(1) }
    }

    /// Three bytes a pixel, dark for few and bright for many, evenly spaced to
    /// the eye.
    pub fn colours(self, values: &[u32]) -> Vec<u8> {
        let colour = |&value: &u32| {
            let fraction = f64::from(value.min(self.top)) / f64::from(self.top);
            let colour = colorous::INFERNO.eval_continuous(fraction);
            [colour.r, colour.g, colour.b]
        };
        values.iter().flat_map(colour).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shared_scale_covers_all_pictures_and_ignores_extremes() {
        let ordinary = vec![10; 1000];
        let mut other = vec![20; 1000];
        other[0] = 1_000_000;
        assert_eq!(Scale::shared([&ordinary[..], &other[..]]).top, 20);
        assert_eq!(Scale::shared([]).top, 1);
        let scale = Scale { top: 20 };
        assert_eq!(scale.colours(&[20]), scale.colours(&[1_000_000]));
        assert_ne!(scale.colours(&[0]), scale.colours(&[20]));
    }
}
