//! Spoils input: text, bytes and numbers.

use pleach_fit::Stream;

/// Replacements for numbers: at and beyond the ends of their types.
const NUMBERS: [&str; 22] = [
    "nan",
    "-nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e400",
    "1e-320",
    "-0",
    "-0.0",
    "0",
    "-1",
    "1e5",
    "100000",
    "4294967296",
    "9007199254740993",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "0x7fffffff",
    "1_0__0",
    "true",
];

/// Characters that are not allowed in text, or are often forgotten.
const ODDITIES: [&str; 10] =
    ["\0", "\u{1}", "\u{1b}[31m", "\u{202e}", "\u{feff}", "\r", "\u{7f}", "\u{10ffff}", "é", "../"];

/// Brackets and tables within each other.
const NESTED: [(&str, &str); 3] = [("[", "]"), ("{a=", "}"), ("{\"a\":", "}")];

/// Most edits of one input.
const EDITS: usize = 4;
/// Largest result in bytes: what is repeated does not grow without end.
const MAX_BYTES: usize = 1 << 18;

/// A spoilt copy of a text; not always text.
pub(super) fn text(original: &str, draws: &mut Stream) -> Vec<u8> {
    let mut bytes = original.as_bytes().to_vec();
    for _ in 0..edits(draws) {
        edit_text(&mut bytes, draws);
        bytes.truncate(MAX_BYTES);
    }
    bytes
}

/// A spoilt copy of a file of numbers and pixels.
pub(super) fn binary(original: &[u8], draws: &mut Stream) -> Vec<u8> {
    let mut bytes = original.to_vec();
    for _ in 0..edits(draws) {
        edit_bytes(&mut bytes, draws);
        bytes.truncate(MAX_BYTES);
    }
    bytes
}

/// How many edits: one in half of the cases, so that many get past the first check.
fn edits(draws: &mut Stream) -> usize {
    if draws.chance(0.5) { 1 } else { 1 + draws.below(EDITS) }
}

fn edit_text(bytes: &mut Vec<u8>, draws: &mut Stream) {
    match draws.below(9) {
        // Numbers are what files are made of.
        0..=3 => {
            let numbers = numbers(bytes);
            if numbers.is_empty() {
                return edit_bytes(bytes, draws);
            }
            let at = numbers[draws.below(numbers.len())].clone();
            if draws.chance(0.5) {
                // Another number of about the same size.
                let digits: Vec<usize> = at.filter(|&i| bytes[i].is_ascii_digit()).collect();
                bytes[digits[draws.below(digits.len())]] = b'0' + draws.below(10) as u8;
            } else {
                bytes.splice(at, NUMBERS[draws.below(NUMBERS.len())].bytes());
            }
        }
        4 => insert(bytes, ODDITIES[draws.below(ODDITIES.len())].as_bytes(), draws),
        5 => {
            let depth = 1 << draws.below(16);
            let (open, close) = NESTED[draws.below(NESTED.len())];
            insert(bytes, (open.repeat(depth) + &close.repeat(draws.below(2) * depth)).as_bytes(), draws);
        }
        6 => insert(bytes, &vec![b'a' + draws.below(26) as u8; 1 << draws.below(16)], draws),
        7 => {
            // A line again, somewhere else.
            let lines: Vec<Vec<u8>> = bytes.split_inclusive(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
            if !lines.is_empty() {
                insert(bytes, &lines[draws.below(lines.len())], draws);
            }
        }
        _ => edit_bytes(bytes, draws),
    }
}

fn edit_bytes(bytes: &mut Vec<u8>, draws: &mut Stream) {
    if bytes.is_empty() {
        bytes.push(draws.bits() as u8);
        return;
    }
    let at = draws.below(bytes.len());
    let span = at..(at + 1 + draws.below(64)).min(bytes.len());
    match draws.below(7) {
        0 => bytes[at] ^= 1 << draws.below(8),
        1 => bytes[at] = draws.bits() as u8,
        2 => bytes.truncate(at),
        3 => drop(bytes.drain(span)),
        4 => {
            let piece = bytes[span].to_vec();
            insert(bytes, &piece, draws);
        }
        5 => bytes[span].fill([0, 0xff, 0x80, b' '][draws.below(4)]),
        _ => {
            let word = (draws.bits() as u32 >> draws.below(32)).to_be_bytes();
            for (byte, new) in bytes[span].iter_mut().zip(word) {
                *byte = new;
            }
        }
    }
}

fn insert(bytes: &mut Vec<u8>, piece: &[u8], draws: &mut Stream) {
    let at = draws.below(bytes.len() + 1);
    bytes.splice(at..at, piece.iter().copied());
}

/// Positions of numbers.
fn numbers(bytes: &[u8]) -> Vec<std::ops::Range<usize>> {
    let is_part = |b: u8| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+');
    let mut list: Vec<std::ops::Range<usize>> = Vec::new();
    for (at, &byte) in bytes.iter().enumerate().filter(|(_, byte)| is_part(**byte)) {
        match list.last_mut() {
            Some(last) if last.end == at => last.end = at + 1,
            _ => list.push(at..at + 1),
        }
        debug_assert!(is_part(byte));
    }
    list.retain(|span| bytes[span.clone()].iter().any(u8::is_ascii_digit));
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_spoilt_is_the_same_each_time_and_never_large() {
        let original = "a = [1.5, -2]\nb = \"palm\"\n".repeat(20);
        let mut changed = 0;
        let mut unreadable = 0;
        for case in 0..2000 {
            let of = || text(&original, &mut Stream::at(1, 2, case, 0));
            let spoilt = of();
            assert_eq!(spoilt, of());
            assert!(spoilt.len() <= MAX_BYTES);
            changed += usize::from(spoilt != original.as_bytes());
            unreadable += usize::from(std::str::from_utf8(&spoilt).is_err());
        }
        assert!(changed > 1950 && (1..1000).contains(&unreadable), "{changed} {unreadable}");
        // Of nothing, something or nothing is made.
        assert!((0..100).all(|case| binary(&[], &mut Stream::at(1, 2, case, 0)).len() <= MAX_BYTES));
    }

    #[test]
    fn numbers_are_found() {
        let found = numbers(b"a = -1.5e3, x-y = [07]");
        let texts: Vec<&[u8]> = found.iter().map(|s| &b"a = -1.5e3, x-y = [07]"[s.clone()]).collect();
        assert_eq!(texts, [&b"-1.5"[..], b"3", b"07"]);
    }
}
