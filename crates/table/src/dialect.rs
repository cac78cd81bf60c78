//! What separates the cells.

use crate::error::Problem;

/// How a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dialect {
    /// What is between cells.
    pub(crate) delimiter: u8,
    /// Byte where the headings begin.
    pub(crate) start: usize,
    /// Lines before the headings.
    pub(crate) skipped: u64,
}

impl Dialect {
    /// The dialect of a table with this text, or what is wrong in which line.
    pub(crate) fn new(text: &str) -> Result<Self, (u64, Problem)> {
        let (mut start, mut skipped) = (0, 0);
        let mut told = None;
        for line in text.split_inclusive('\n') {
            // Some programs tell others the separator by a first line of their own.
            let named = line.trim_end_matches(['\r', '\n']).strip_prefix("sep=");
            let named = named.filter(|_| told.is_none() && skipped == 0);
            if let Some(mark @ ("," | ";" | "\t")) = named {
                told = mark.bytes().next();
            } else if !line.trim().is_empty() {
                break;
            }
            start += line.len();
            skipped += 1;
        }
        let delimiter = match told {
            Some(delimiter) => delimiter,
            None => separator(&text[start..]).map_err(|problem| (skipped + 1, problem))?,
        };
        check_widths(&text[start..], delimiter).map_err(|line| (skipped + line, Problem::TooManyColumns))?;
        Ok(Self { delimiter, start, skipped })
    }
}

/// Most cells of a row, those of empty columns among them: some spreadsheets write all that they have.
const MAX_CELLS: usize = 20_000;

/// The line, from 1, where a row has more cells than any table, if there is one. A reader would hold all of them.
fn check_widths(text: &str, delimiter: u8) -> Result<(), u64> {
    /// Where in a cell a byte is. Quotes count at its beginning alone, and two in a row are one that is meant.
    enum At {
        Beginning,
        Plain,
        Quoted,
        Quote,
    }
    let (mut at, mut cells, mut line) = (At::Beginning, 1, 1);
    for byte in text.bytes() {
        line += u64::from(byte == b'\n');
        at = match (at, byte) {
            (At::Quoted, b'"') => At::Quote,
            (At::Quoted, _) | (At::Beginning | At::Quote, b'"') => At::Quoted,
            (_, b'\n' | b'\r') => {
                cells = 1;
                At::Beginning
            }
            (_, byte) if byte == delimiter => {
                cells += 1;
                if cells > MAX_CELLS {
                    return Err(line);
                }
                At::Beginning
            }
            _ => At::Plain,
        };
    }
    Ok(())
}

/// The separator of the headings: the only one that stands between them outside of quotes.
fn separator(text: &str) -> Result<u8, Problem> {
    let mut quoted = false;
    let mut found: Vec<char> = Vec::new();
    for sign in text.chars() {
        match sign {
            '"' => quoted = !quoted,
            '\n' | '\r' if !quoted => break,
            ',' | ';' | '\t' if !quoted && !found.contains(&sign) => found.push(sign),
            _ => {}
        }
    }
    match found[..] {
        [] => Ok(b','),
        [only] => Ok(only as u8),
        _ => Err(Problem::Separators { separators: found }),
    }
}
