//! Stems as they are found in a file.

use super::NEAR;
use glam::DVec3;

/// A stem that is being put together.
pub(super) struct Draft {
    /// The stem that it stands on, and how many metres along it.
    pub(super) parent: Option<(u32, f64)>,
    /// Whether it goes on as its parent does, at the same level.
    pub(super) is_fork: bool,
    /// Points and radii from base to tip, each apart from the one before it.
    pub(super) knots: Vec<(DVec3, f64)>,
    /// Length up to the last knot, in metres.
    pub(super) length: f64,
    /// Where it begins in the file.
    pub(super) line: u64,
}

impl Draft {
    pub(super) fn new(parent: Option<(u32, f64)>, is_fork: bool, line: u64, base: (DVec3, f64)) -> Self {
        Self { parent, is_fork, knots: vec![base], length: 0.0, line }
    }

    /// Adds a knot, if it is apart from the last one.
    pub(super) fn push(&mut self, point: DVec3, radius: f64) {
        let step = self.knots[self.knots.len() - 1].0.distance(point);
        // Not finite is refused later, with the line.
        if step > NEAR || !step.is_finite() {
            self.length += step;
            self.knots.push((point, radius));
        }
    }
}

/// Whether `numbers`, one for each stem, are levels: 0 for trunks, and for any other that of its parent or one more. They
/// are not if no stem has another than the trunks.
pub(super) fn are_levels(numbers: impl Iterator<Item = (i64, Option<i64>)>) -> bool {
    let mut has_more = false;
    for (number, below) in numbers {
        let fits = match below {
            None => number == 0,
            Some(below) => number == below || number == below + 1,
        };
        if !fits {
            return false;
        }
        has_more |= number > 0;
    }
    has_more
}
