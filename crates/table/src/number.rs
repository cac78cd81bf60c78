//! Numbers with a decimal point or a decimal comma.

use crate::error::shown;
use std::cell::Cell;

/// The decimal mark of a table, with the line where it was seen first: all numbers have the same.
#[derive(Debug, Default)]
pub(crate) struct Marks {
    first: Cell<Option<(char, u64)>>,
}

impl Marks {
    /// The number that `text` in line `line` is; the error continues a sentence.
    pub(crate) fn number(&self, text: &str, line: u64, delimiter: u8) -> Result<f64, String> {
        let is = || format!("is `{}`", shown(text));
        let (commas, points) = (text.matches(',').count(), text.matches('.').count());
        let mark = match (commas, points) {
            (0, 0) => None,
            (1, 0) => Some(','),
            (0, 1) => Some('.'),
            (0, _) | (_, 0) => return Err(format!("{}, expected a number with one decimal mark", is())),
            _ => return Err(format!("{}, expected a number without marks between thousands", is())),
        };
        let number = match mark {
            Some(',') => text.replace(',', ".").parse::<f64>(),
            _ => text.parse(),
        };
        let number = number.ok().filter(|number| number.is_finite());
        let number = number.ok_or_else(|| format!("{}, expected a number", is()))?;
        let Some(mark) = mark else { return Ok(number) };
        if mark == ',' && delimiter == b',' && may_be_thousands(text) {
            return Err(format!(
                "{}, which may be thousands or a decimal comma; write it with a point or without a mark",
                is()
            ));
        }
        match self.first.get() {
            None => self.first.set(Some((mark, line))),
            Some((first, there)) if first != mark => {
                let [first, mark] = [first, mark].map(|mark| if mark == ',' { "comma" } else { "point" });
                return Err(format!(
                    "{}, with a {mark}, while line {there} has a decimal {first}; expected one decimal mark in a table",
                    is()
                ));
            }
            Some(_) => {}
        }
        Ok(number)
    }
}

/// Whether a comma stands as one between thousands does: before three digits, behind one to three.
fn may_be_thousands(text: &str) -> bool {
    let Some((whole, rest)) = text.split_once(',') else { return false };
    let whole = whole.trim_start_matches(['+', '-']);
    rest.len() == 3 && (1..=3).contains(&whole.len()) && !whole.starts_with('0')
}
