//! Why a table cannot be read.

/// What is wrong with a table, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}:{line}: {problem}")]
pub struct TableError {
    /// The name of the file.
    pub name: String,
    /// Line, from 1.
    pub line: u64,
    /// What is wrong there.
    pub problem: Problem,
}

/// What is wrong with a table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// There are no headings.
    #[error("the table is empty, expected a line of headings")]
    Empty,
    /// The bytes are not text.
    #[error("this is {found}, expected a table as text: save it as CSV")]
    NoText {
        /// What it is.
        found: &'static str,
    },
    /// The headings can be read in two ways.
    #[error("{} stand between the headings, so the separator is not clear; put headings that contain one in quotes", marks(.separators))]
    Separators {
        /// The candidates.
        separators: Vec<char>,
    },
    /// More columns than any table has.
    #[error("there are more than {} columns", super::MAX_COLUMNS)]
    TooManyColumns,
    /// Two headings mean the same.
    #[error("the headings `{}` and `{}` mean the same column", shown(.first), shown(.second))]
    Twice {
        /// The first of them.
        first: String,
        /// The second.
        second: String,
    },
    /// A column is missing.
    #[error("no column is called `{name}`; the headings are {}", listed(.headings))]
    NoColumn {
        /// Its name.
        name: String,
        /// The headings that there are.
        headings: Vec<String>,
    },
    /// A row has more or fewer cells than there are headings.
    #[error(
        "the row has {found} cell{plural}, expected {expected} as there are headings; a cell that contains the separator needs quotes",
        plural = if *.found == 1 { "" } else { "s" }
    )]
    Cells {
        /// Cells of the row.
        found: usize,
        /// Headings.
        expected: usize,
    },
    /// A cell is not what its column holds.
    #[error("`{}` {problem}", shown(.heading))]
    Cell {
        /// The heading of its column.
        heading: String,
        /// The end of the sentence.
        problem: String,
    },
    /// The rows cannot be told apart.
    #[error("{detail}")]
    Unreadable {
        /// What the parser said.
        detail: String,
    },
}

/// Text of a file for a message: short, on one line, without control characters.
pub(crate) fn shown(text: &str) -> String {
    const MOST: usize = 40;
    let mut shown: String =
        text.chars().take(MOST).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    if text.chars().nth(MOST).is_some() {
        shown.push('…');
    }
    shown
}

fn listed(headings: &[String]) -> String {
    const MOST: usize = 20;
    let mut list: Vec<String> = headings.iter().take(MOST).map(|heading| shown(heading)).collect();
    if headings.len() > MOST {
        list.push("…".to_owned());
    }
    list.join(", ")
}

fn marks(separators: &[char]) -> String {
    let names = separators.iter().map(|mark| match mark {
        '\t' => "tabs",
        ';' => "semicolons",
        _ => "commas",
    });
    names.collect::<Vec<_>>().join(" and ")
}
