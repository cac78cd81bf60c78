//! Trees that stand as the goal does: a search starts from them.

use super::goal_context::GoalContext;
use super::ranking::Alike;
use crate::control::interrupt;
use crate::error::FitError;
use crate::problem::Genome;
use pleach_reading::{Crown, Reader, Reading};
use pleach_silhouette::Bitmap;
use pleach_tree::{Foliage, Stature};

/// Readings of less confidence set no number.
const SURE: f64 = 0.6;
/// A thickness that is right to this factor stays …
const THICKNESS: f64 = 1.1;
/// … and a bare height that is right to this part of the height.
const BARE: f64 = 0.03;
/// How far one number is followed: what is farther off has other causes.
const FARTHEST: f64 = 3.0;
/// Other parts of a tree change with what is set, so numbers are corrected once more.
const STEPS: usize = 2;
/// So many of each family, the ones most like the goal: each is grown twice.
const OF_FAMILY: usize = 6;

/// Those of `alike` that stand otherwise than the goal, once more with numbers that follow from the goal's measures, where
/// their generators have such. None where the goal was not read.
pub(super) fn measured(
    context: &GoalContext<'_>,
    alike: &[Alike],
    foliage: Foliage,
) -> Result<Vec<Alike>, FitError> {
    let Some(goal) = &context.reading else { return Ok(Vec::new()) };
    let goal = stature(goal, None);
    let mut families: Vec<&str> = Vec::new();
    let first = alike.iter().filter(|one| {
        let family = context.family(one.1);
        families.push(family);
        families.iter().filter(|known| **known == family).count() <= OF_FAMILY
    });
    let first: Vec<&Alike> = first.collect();
    let found = interrupt::map(&first, context.stop, |(cost, candidate, genome)| {
        let generator = &context.candidates[*candidate].species.generator;
        let (mut reader, mut picture, mut tree) = (Reader::new(), Bitmap::default(), Reading::default());
        let mut own = genome.clone();
        for _ in 0..STEPS {
            draw(context, *candidate, &own, foliage, &mut picture)?;
            reader.read(&picture, &mut tree);
            let grown = stature(&tree, generator.trunks(&own.values));
            let mut values = own.values.clone();
            generator.adapt(&mut values, &wanted(&goal, &grown), &grown);
            let space = generator.space();
            for (slot, (value, before)) in space.slots().zip(values.iter_mut().zip(&own.values)) {
                let (low, high) = space.search_range(slot);
                // A species that is outside of what is searched stays there.
                *value = if (low..=high).contains(before) { value.clamp(low, high) } else { *before };
            }
            if values == own.values || generator.check(&values).is_err() {
                break;
            }
            own.values = values;
        }
        (own != *genome).then_some((*cost, *candidate, own))
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

/// What of a reading is sure; `trunks` where their number is known.
fn stature(reading: &Reading, trunks: Option<u32>) -> Stature {
    let sure = |value: Option<f64>, confidence: f64| value.filter(|_| confidence >= SURE);
    let counted =
        (reading.feet_confidence >= SURE).then_some(reading.feet.len() as u32).filter(|count| *count > 0);
    // What is read of trunks that stand together is of the bundle.
    let is_bundle = trunks.is_some_and(|known| known as usize != reading.feet.len());
    let crown = &reading.crown;
    Stature {
        trunks: trunks.or(counted),
        thickness: sure(reading.trunk_width(), reading.width_confidence)
            .filter(|_| counted.is_some() && !is_bundle),
        lean: sure(reading.lean_deg, reading.lean_deg_confidence),
        bare_height: sure(reading.bare_height, reading.bare_height_confidence),
        first_fork: sure(reading.first_fork, reading.first_fork_confidence),
        crown: (reading.crown_confidence >= SURE).then(|| {
            // Where the feet are not sure, neither is on which side of them the crown lies.
            let is_placed = reading.feet_confidence >= SURE;
            if is_placed { [crown.left.clone(), crown.right.clone()] } else { even(crown) }
        }),
    }
}

/// An outline that is as wide on both sides.
fn even(crown: &Crown) -> [Vec<f64>; 2] {
    let half: Vec<f64> =
        crown.left.iter().zip(&crown.right).map(|(left, right)| f64::midpoint(*left, *right)).collect();
    [half.clone(), half]
}

/// `goal` without what `grown` is near enough to, and no farther off than numbers are followed.
fn wanted(goal: &Stature, grown: &Stature) -> Stature {
    let thickness = goal.thickness.zip(grown.thickness).and_then(|(goal, grown)| {
        let factor = (goal / grown).clamp(1.0 / FARTHEST, FARTHEST);
        (!(1.0 / THICKNESS..=THICKNESS).contains(&factor)).then_some(factor * grown)
    });
    let is_near = |grown: f64| goal.bare_height.is_some_and(|goal| (goal - grown).abs() <= BARE);
    let bare_height =
        goal.bare_height.map(|bare| grown.bare_height.filter(|grown| is_near(*grown)).unwrap_or(bare));
    Stature { thickness, bare_height, ..goal.clone() }
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
        let tupelo = pleach_generators::preset("black_tupelo").unwrap();
        let slot = tupelo
            .generator
            .space()
            .slots()
            .find(|slot| tupelo.generator.space().slot_name(*slot) == "ratio");
        let slot = slot.unwrap().index();
        let mut values = tupelo.params.values().to_vec();
        values[slot] *= 2.0;
        let thick = with_values(&tupelo, values).unwrap();
        let tree = thick.grow(3).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
        let mut goal = Bitmap::default();
        Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
        let problem = FitProblem::new(tupelo.clone(), GoalView::new(goal, View::FRONT, frame));
        let nearest = |contradictions| {
            let guess = GuessSettings {
                variants: 0,
                keep: 20,
                contradictions,
                race: None,
                ..GuessSettings::default()
            };
            let (candidates, stop) = ([Candidate::from(tupelo.clone())], AtomicBool::new(false));
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
