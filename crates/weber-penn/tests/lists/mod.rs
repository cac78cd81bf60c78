//! Random lists of numbers within their declared ranges.

use pleach_tree::Key;
use pleach_weber_penn::space;

/// The numbers of case number `case`, drawn from the search's ranges, the declared ranges, their corners, or a
/// few corners on top of the defaults.
pub(crate) fn values(case: u64) -> Vec<f64> {
    let key = Key::root(case);
    let space = space();
    let mut values = space.defaults();
    for (slot, value) in space.slots().zip(&mut values) {
        let (kind, i) = (space.kind_of(slot), slot.index() as u32);
        let (low, high) = kind.range();
        let (unit, corner) = (key.unit(1, i), if key.unit(2, i) < 0.5 { low } else { high });
        let between = |(low, high): (f64, f64)| kind.repair(low + (high - low) * unit);
        *value = match case % 5 {
            0 => between(space.search_range(slot)),
            1 => between((low, high)),
            2 => corner,
            3 if key.unit(3, i) < 0.1 => corner,
            // Counts are mostly far below what is allowed.
            4 if !kind.is_choice() => kind.repair(between((low, high)) * unit.powi(4)),
            _ => *value,
        };
    }
    values
}
