//! Numbers that follow from a measure of the goal: a search starts from them.

use super::goal_context::GoalContext;
use super::ranking::Alike;
use crate::control::interrupt;
use crate::error::FitError;
use crate::problem::Genome;
use pleach_reading::{Reader, Reading};
use pleach_silhouette::Bitmap;
use pleach_tree::{Foliage, Slot, TrunkSlots};

/// Readings of less confidence set no number.
const SURE: f64 = 0.6;
/// A thickness that is right to this factor stays …
const THICKNESS: f64 = 1.1;
/// … and a bare height that is right to this part of the height.
const BARE: f64 = 0.03;
/// How far one number is followed: what is farther off has other causes.
const FARTHEST: f64 = 3.0;
/// Other parts of a tree change with its trunk, so numbers are corrected once more.
const STEPS: usize = 2;

/// Those of `alike` whose trunks are of another thickness, or bare to another height, than the goal's, once more with the
/// numbers of a tree whose are the goal's. None where the goal was not read.
pub(super) fn measured(
    context: &GoalContext<'_>,
    alike: &[Alike],
    foliage: Foliage,
) -> Result<Vec<Alike>, FitError> {
    let Some(goal) = &context.reading else { return Ok(Vec::new()) };
    let found = interrupt::map(alike, context.stop, |(cost, candidate, genome)| {
        let species = &context.candidates[*candidate].species;
        let slots = species.generator.trunk();
        if slots == TrunkSlots::default() {
            return None;
        }
        let trunks = species.generator.trunks(&genome.values);
        let (mut reader, mut picture, mut tree) = (Reader::new(), Bitmap::default(), Reading::default());
        let mut own = genome.clone();
        for _ in 0..STEPS {
            draw(context, *candidate, &own, foliage, &mut picture)?;
            reader.read(&picture, &mut tree);
            if trunks.is_some_and(|known| known as usize != tree.feet.len()) {
                // What was measured is a bundle of trunks.
                tree.width_confidence = 0.0;
            }
            if !follow(context, *candidate, slots, (goal, &tree), &mut own) {
                break;
            }
        }
        (own != *genome).then(|| (*cost, *candidate, own))
    })?;
    Ok(found.into_iter().flatten().collect())
}

/// The picture of an individual as the first goal shows it; `None` if it does not grow.
fn draw(
    context: &GoalContext<'_>,
    candidate: usize,
    genome: &Genome,
    foliage: Foliage,
    picture: &mut Bitmap,
) -> Option<()> {
    let evaluator = context.models.evaluator(candidate);
    let (view, frame) = *evaluator.placed(genome).first()?;
    // Of several seeds, the last.
    evaluator.show(genome, foliage, |tree, rasterizer| {
        rasterizer.draw(tree, &view, &frame, foliage.into(), picture);
    })
}

/// Moves the numbers of `genome`, whose picture was read as `tree`, towards those of a tree like `goal`. Tells whether
/// there was anything to move.
fn follow(
    context: &GoalContext<'_>,
    candidate: usize,
    slots: TrunkSlots,
    (goal, tree): (&Reading, &Reading),
    genome: &mut Genome,
) -> bool {
    let generator = &context.candidates[candidate].species.generator;
    let mut values = genome.values.clone();
    let mut set = |slot: Slot, value: f64| {
        let (low, high) = generator.space().search_range(slot);
        // A species that is outside of what is searched stays there.
        let at = &mut values[slot.index()];
        if (low..=high).contains(at) {
            *at = value.clamp(low, high);
        }
    };
    let sure = |a: f64, b: f64| a.min(b) >= SURE;
    if let Some((slot, (goal_width, width))) = slots.thickness.zip(goal.trunk_width().zip(tree.trunk_width()))
        && sure(goal.width_confidence, tree.width_confidence)
        && sure(goal.feet_confidence, tree.feet_confidence)
    {
        let factor = (goal_width / width).clamp(1.0 / FARTHEST, FARTHEST);
        if !(1.0 / THICKNESS..=THICKNESS).contains(&factor) {
            set(slot, genome.values[slot.index()] * factor);
        }
    }
    if let Some((slot, (goal_bare, bare))) = slots.bare_height.zip(goal.bare_height.zip(tree.bare_height))
        && sure(goal.bare_height_confidence, tree.bare_height_confidence)
        && (goal_bare - bare).abs() > BARE
    {
        set(slot, genome.values[slot.index()] + goal_bare - bare);
    }
    if values == genome.values || generator.check(&values).is_err() {
        return false;
    }
    genome.values = values;
    true
}

#[cfg(test)]
mod tests {
    use crate::guess::{Candidate, Contradictions, GuessLibrary, GuessSettings};
    use crate::problem::{FitProblem, GoalView, with_values};
    use crate::run::FitSettings;
    use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
    use pleach_tree::Parts;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn a_search_starts_from_the_trunk_that_was_measured() {
        let acer = pleach_generators::preset("black_tupelo").unwrap();
        let slot = acer.generator.trunk().thickness.unwrap().index();
        let mut values = acer.params.values().to_vec();
        values[slot] *= 2.0;
        let thick = with_values(&acer, values).unwrap();
        let tree = thick.grow(3).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
        let mut goal = Bitmap::default();
        Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
        let problem = FitProblem::new(acer.clone(), GoalView::new(goal, View::FRONT, frame));
        let nearest = |contradictions| {
            let guess = GuessSettings {
                variants: 0,
                keep: 20,
                contradictions,
                race: None,
                ..GuessSettings::default()
            };
            let (candidates, stop) = ([Candidate::from(acer.clone())], AtomicBool::new(false));
            let found = GuessLibrary::new()
                .first_guess(&problem, &FitSettings::default(), &candidates, &guess, &stop, |_, _| ())
                .unwrap();
            let off =
                found.nearest.iter().map(|one| (one.values[slot] / thick.params.values()[slot] - 1.0).abs());
            off.fold(f64::INFINITY, f64::min)
        };
        assert!(nearest(Contradictions::Ignored) > 0.4);
        assert!(nearest(Contradictions::Counted) < 0.15);
    }
}
