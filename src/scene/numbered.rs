//! File names with a number in them.

/// Digits of a width: numbers of files are no longer than 99.
const WIDTH_DIGITS_MAX: usize = 2;

/// The pattern with its %d, %4d or %04d replaced by a number; `None` unless there is exactly one, at
/// most 99 wide.
pub(super) fn numbered(pattern: &str, number: usize) -> Option<String> {
    let (before, rest) = pattern.split_once('%')?;
    let (width, after) = rest.split_once('d')?;
    if !width.chars().all(|c| c.is_ascii_digit()) || after.contains('%') {
        return None;
    }
    let digits = width.trim_start_matches('0');
    if digits.len() > WIDTH_DIGITS_MAX {
        return None;
    }
    let digits = digits.parse().unwrap_or(0);
    let number = if width.starts_with('0') {
        format!("{number:0digits$}")
    } else {
        format!("{number:digits$}")
    };
    Some(format!("{before}{number}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_those_of_printf() {
        let cases = [
            ("body%04d.obj", Some("body0007.obj")),
            ("b%d", Some("b7")),
            ("b%3dx", Some("b  7x")),
            ("b%012d", Some("b000000000007")),
            ("%99999d", None),
            ("%0100d", None),
            ("%99999999999999999999999d", None),
            ("b%s", None),
            ("plain", None),
            ("%d%d", None),
        ];
        for (pattern, expected) in cases {
            assert_eq!(numbered(pattern, 7).as_deref(), expected);
        }
    }
}
