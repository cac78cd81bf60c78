//! Whether a goal has leaves.

use super::goal_context::GoalContext;
use super::library::{Entry, Resemblance, compare};
use super::near::Near;
use crate::error::FitError;
use pleach_reading::Reading;
use pleach_tree::Foliage;

/// Whether the goals have leaves, as given or `detected`, and how such trees compare with them.
pub(super) fn leaves(
    context: &GoalContext<'_>,
    entries: &[Entry],
    detected: bool,
    near: &Near,
) -> Result<(Foliage, Vec<Option<Resemblance>>), FitError> {
    let given = context.problem.foliage;
    let found = compare(context, entries, given, near)?;
    if !detected {
        return Ok((given, found));
    }
    let other = if given == Foliage::None { Foliage::All } else { Foliage::None };
    let found_other = compare(context, entries, other, near)?;
    let [leafy, bare] = if given == Foliage::None { [&found_other, &found] } else { [&found, &found_other] };
    // Species that never have leaves say nothing for or against them.
    let counts: Vec<bool> = leafy.iter().map(|one| one.as_ref().is_some_and(|one| one.has_foliage)).collect();
    let (leafy, bare) = (most_alike(leafy, &counts), most_alike(bare, &counts));
    let foliage =
        if has_leaves(leafy, bare, is_read_as_bare(context)) { Foliage::All } else { Foliage::None };
    Ok(if foliage == given { (given, found) } else { (other, found_other) })
}

/// Likeness of the tree that is most like the goal, among those that count.
fn most_alike(found: &[Option<Resemblance>], counts: &[bool]) -> f64 {
    let counting = found.iter().zip(counts).filter(|(_, counts)| **counts);
    counting.filter_map(|(found, _)| found.as_ref()).map(|one| one.likeness).fold(0.0, f64::max)
}

/// Whether a goal has leaves, from the largest likeness that trees with leaves have to it, and those without, and from
/// its reading. If in doubt, it has.
fn has_leaves(leafy: f64, bare: f64, is_read_as_bare: bool) -> bool {
    let by = if is_read_as_bare { -LEAFY_BY } else { BARE_BY };
    leafy + by >= bare
}

/// Whether the reading of the first goal surely says that it is bare.
fn is_read_as_bare(context: &GoalContext<'_>) -> bool {
    let is_large = context.problem.goals.first().is_some_and(|goal| goal.frame.height >= LARGE);
    let says_so = |reading: &Reading| !reading.leaves && reading.leaves_confidence >= SURE;
    is_large && context.reading.as_ref().is_some_and(says_so)
}

/// By how much more a goal must be like a bare tree than like a leafy one to count as bare.
///
/// Sparse small leaves of another program look like twigs to likeness: `targets/arbaro_lombardy_poplar.png`
/// is 0.0375 more like our bare trees. Of the bare trees of another program
/// `targets/treegen_apple_bare.png` is by 0.10, `targets/treegen_acer_bare.png` is not (−0.01). To lose
/// leaves is worse than to keep them.
const BARE_BY: f64 = 0.04;

/// Confidence from which on a reading that says that a goal is bare is believed. Of drawings of fifteen species, 160, 256
/// and 512 pixels high, with two seeds each, those with leaves are never read as bare with more than 0.79, and seven in ten
/// of the bare ones are with 0.9 or more. Likeness alone takes a bare acer for a leafy one at some sizes and not at others.
const SURE: f64 = 0.9;

/// Height in pixels from which on a goal's reading is believed. At 64 a leafy acer is read as bare, and surely.
const LARGE: u32 = 128;

/// By how much more such a goal must be like a leafy tree than like a bare one to count as leafy.
const LEAFY_BY: f64 = 0.05;
