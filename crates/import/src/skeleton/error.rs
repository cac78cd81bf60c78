//! Why a skeleton cannot be read.

use super::{MAX_REACH, MAX_ROWS, MAX_SKELETON_BYTES};
use pleach_table::TableError;

/// What is wrong with the skeleton of a tree, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SkeletonError {
    /// Something about a line.
    #[error("{origin}:{line}: {problem}")]
    At {
        /// The name of the file.
        origin: String,
        /// Line, from 1.
        line: u64,
        /// What is wrong there.
        problem: SkeletonProblem,
    },
    /// The table cannot be read.
    #[error(transparent)]
    Table(#[from] TableError),
}

impl SkeletonError {
    pub(super) fn new(origin: &str, line: u64, problem: SkeletonProblem) -> Self {
        Self::At { origin: origin.to_owned(), line, problem }
    }
}

/// What is wrong with a skeleton.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SkeletonProblem {
    /// The file is larger than any skeleton.
    #[error("the file has more than {} bytes, which a skeleton may have", MAX_SKELETON_BYTES)]
    TooManyBytes,
    /// There are more nodes or cylinders than any tree has.
    #[error("there are more than {} nodes or cylinders", MAX_ROWS)]
    TooManyRows,
    /// A line of SWC has too few numbers.
    #[error("the line has {found} numbers, expected seven: number, type, x, y, z, radius, parent")]
    TooFewNumbers {
        /// Numbers of the line.
        found: usize,
    },
    /// A word of SWC is not the number that it should be.
    #[error("the {what} is `{text}`, expected {expected}")]
    NoNumber {
        /// What the number says.
        what: &'static str,
        /// The text.
        text: String,
        /// What would be right.
        expected: &'static str,
    },
    /// Two rows have the same number.
    #[error("the number {number} is there already, in line {first}")]
    Twice {
        /// The number.
        number: i64,
        /// Line of the first row that has it.
        first: u64,
    },
    /// A row has a parent that is not there.
    #[error("the parent is {parent}, and no row has this number")]
    NoParent {
        /// The number.
        parent: i64,
    },
    /// Rows are each other's parents.
    #[error("the row is above itself: its parents lead back to it")]
    Cycle,
    /// A radius below zero.
    #[error("the radius is {radius}, expected 0 or more, in metres")]
    Radius {
        /// The radius.
        radius: f64,
    },
    /// A cylinder without an axis.
    #[error("the axis has no length, expected a direction")]
    NoAxis,
    /// A length below zero.
    #[error("the length is {length}, expected 0 or more, in metres")]
    Length {
        /// The length.
        length: f64,
    },
    /// Neither ends nor axes are known.
    #[error("the columns of cylinders are missing: {what}")]
    NoColumns {
        /// Those that are missing.
        what: &'static str,
    },
    /// A point that is far from any tree.
    #[error(
        "a point of the stem that begins here is more than {} m from the foot of the tree, or as thick; lengths are metres",
        MAX_REACH
    )]
    TooFar,
    /// No two points are joined.
    #[error("there is no stem: expected two points at least that are joined")]
    NoStem,
    /// Every radius is 0.
    #[error("every radius is 0, so there is nothing to draw")]
    NoRadius,
}
