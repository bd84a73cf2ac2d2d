//! The two statements that matter: `v` and `f`.

use super::error::StatementError;
use super::faults::FaultKind;

/// The words of a statement, separated by blanks and tabs.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(|byte| byte.is_ascii_whitespace() || *byte == 0x0B)
        .filter(|word| !word.is_empty())
}

/// What leaving out a statement of this keyword means: nothing for those that
/// only name, group, shade or texture what the faces already say.
pub(super) fn fault_of_omission(keyword: &[u8]) -> Option<FaultKind> {
    match keyword {
        b"vt" | b"vn" | b"g" | b"o" | b"s" | b"mg" | b"mtllib" | b"usemtl" | b"maplib"
        | b"usemap" | b"lod" | b"bevel" | b"c_interp" | b"d_interp" | b"shadow_obj"
        | b"trace_obj" => None,
        b"p" | b"l" => Some(FaultKind::PointOrLine),
        b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm"
        | b"trim" | b"hole" | b"scrv" | b"sp" | b"end" | b"con" | b"ctech" | b"stech" => {
            Some(FaultKind::FreeForm)
        }
        b"call" | b"csh" => Some(FaultKind::ExternalCall),
        _ => Some(FaultKind::UnknownStatement),
    }
}

/// The values of a `v` statement that are passed on, and what was odd.
#[derive(Debug, PartialEq)]
pub(super) struct VertexStatement<'a> {
    /// The coordinates as written; each parses as `f32`.
    pub coordinates: [&'a str; 3],
    /// Whether all three are finite as `f32`.
    pub finite: bool,
    /// Whether numbers follow them.
    pub extra_values: bool,
}

impl<'a> VertexStatement<'a> {
    /// Reads the words after `v`. Words after the third must be numbers too:
    /// anything else there is a lost line end, and with it a lost vertex.
    pub fn parse(mut words: impl Iterator<Item = &'a [u8]>) -> Result<Self, StatementError> {
        let mut coordinates = [""; 3];
        let mut finite = true;
        for (found, coordinate) in coordinates.iter_mut().enumerate() {
            let word = words
                .next()
                .ok_or(StatementError::TooFewCoordinates { found })?;
            let value;
            (*coordinate, value) = number(word)?;
            finite &= value.is_finite();
        }
        let mut extra_values = false;
        for word in words {
            number(word)?;
            extra_values = true;
        }
        Ok(Self {
            coordinates,
            finite,
            extra_values,
        })
    }
}

fn number(word: &[u8]) -> Result<(&str, f32), StatementError> {
    std::str::from_utf8(word)
        .ok()
        .and_then(|text| Some((text, text.parse().ok()?)))
        .ok_or_else(|| StatementError::MalformedNumber { value: quote(word) })
}

/// The vertex a corner such as `7`, `-1`, `7/2`, `7//3` or `7/2/3` refers to,
/// from 0, when `vertices` stand above it.
///
/// Only those count: an index of a later vertex is far more often the sign of
/// a damaged file than of a writer that puts faces first.
pub(super) fn corner_vertex(word: &[u8], vertices: u32) -> Result<u32, StatementError> {
    let mut parts = word.splitn(3, |&byte| byte == b'/');
    let position = parts.next().unwrap_or_default();
    if !is_integer(position) || !parts.all(|part| part.is_empty() || is_integer(part)) {
        return Err(StatementError::MalformedCorner { value: quote(word) });
    }
    let out_of_range = || StatementError::IndexOutOfRange {
        value: quote(word),
        vertices,
    };
    let index = std::str::from_utf8(position)
        .ok()
        .and_then(|text| text.parse::<i64>().ok())
        .ok_or_else(out_of_range)?;
    let from_zero = match index {
        0 => return Err(StatementError::ZeroIndex { value: quote(word) }),
        1.. => index - 1,
        _ => i64::from(vertices) + index,
    };
    u32::try_from(from_zero)
        .ok()
        .filter(|&vertex| vertex < vertices)
        .ok_or_else(out_of_range)
}

fn is_integer(text: &[u8]) -> bool {
    let digits = text
        .strip_prefix(b"-")
        .or(text.strip_prefix(b"+"))
        .unwrap_or(text);
    !digits.is_empty() && digits.iter().all(u8::is_ascii_digit)
}

/// A word for a message: bytes that do not print are escaped, and a long word
/// is shortened.
fn quote(word: &[u8]) -> String {
    const SHOWN: usize = 40;
    let shown = word[..word.len().min(SHOWN)].escape_ascii();
    let dots = if word.len() > SHOWN { "..." } else { "" };
    format!("{shown}{dots}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_count_from_one_forwards_and_from_the_latest_backwards() {
        assert_eq!(corner_vertex(b"1", 3), Ok(0));
        assert_eq!(corner_vertex(b"3/9/9", 3), Ok(2));
        assert_eq!(corner_vertex(b"+2//7", 3), Ok(1));
        assert_eq!(corner_vertex(b"-1", 3), Ok(2));
        assert_eq!(corner_vertex(b"-3/1", 3), Ok(0));
    }

    #[test]
    fn no_index_wraps() {
        for word in [
            "4",
            "-4",
            "4294967297",
            "18446744073709551617",
            "-9223372036854775808",
        ] {
            let error = corner_vertex(word.as_bytes(), 3).unwrap_err();
            let value = word.to_owned();
            assert_eq!(
                error,
                StatementError::IndexOutOfRange { value, vertices: 3 }
            );
        }
    }

    #[test]
    fn a_corner_is_up_to_three_integers() {
        for word in ["", "/1", "1/x", "1.5", "0x1", "--1", "1/2/3/4", "-", "1/-"] {
            let error = corner_vertex(word.as_bytes(), 3).unwrap_err();
            let value = word.to_owned();
            assert_eq!(error, StatementError::MalformedCorner { value });
        }
    }

    #[test]
    fn a_quoted_word_is_printable_and_short() {
        assert_eq!(quote(b"1\xFF2"), r"1\xff2");
        assert_eq!(quote(&[b'9'; 1000]).len(), 43);
    }
}
