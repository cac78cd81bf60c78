//! Does a measure fall steadily when one parameter walks away from the truth?

use super::line::{Line, MIN_STEPS, Walk};
use super::measures::{self, MEASURES, Seen};
use super::pictures::silhouette;
use super::{LikenessSpec, Rows, SIDE, progress, stop};
use crate::spearman::spearman;
use pleach_silhouette::{Frame, View};
use pleach_tree::{Growth, Limits, Parts, Species};
use rayon::prelude::*;

/// Step of a walk, as a part of the true value.
pub(super) const STEP: f64 = 0.1;
/// Seed of all trees: only the parameter changes.
const SEED: u64 = 1;

/// All walks of `species` that are long enough and change the picture at all.
pub(super) fn lines(species: &[Species], spec: &LikenessSpec) -> anyhow::Result<Vec<Line>> {
    let bar = progress("walks", species.len() as u64);
    let mut lines = Vec::new();
    for one in species {
        let goal = Goal::new(one)?;
        for parameter in &spec.walks {
            let parameter = parameter.get_ref();
            stop::check()?;
            for sign in [-1.0, 1.0] {
                let walk = goal.walk(one, parameter, sign, *spec.walk_steps as u32)?;
                if walk.len() >= MIN_STEPS && walk.iter().any(|(_, values)| values[0] < 1.0) {
                    lines.push(Line { species: one.name.clone(), parameter: parameter.clone(), sign, walk });
                }
            }
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(lines)
}

/// How well each measure keeps the order of distance along each walk: −1 is best.
pub(super) fn rows(lines: &[Line], rows: &mut Rows) {
    for line in lines {
        let against = format!("{} {}", line.parameter, if line.sign < 0.0 { "less" } else { "more" });
        for (m, measure) in MEASURES.iter().enumerate() {
            let away = line.walk.iter().map(|(step, values)| (f64::from(*step), values[m]));
            let points: Vec<(f64, f64)> = std::iter::once((0.0, 1.0)).chain(away).collect();
            rows.add(
                ["walk", &line.species, &against, measure],
                line.walk.len() as u64,
                spearman(&points).unwrap_or(0.0),
            );
        }
    }
}

/// The tree that walks set out from.
struct Goal {
    seen: Seen,
    frame: Frame,
}

impl Goal {
    fn new(species: &Species) -> anyhow::Result<Self> {
        let tree = species.grow(SEED)?;
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIDE, SIDE);
        Ok(Self { seen: Seen::new(silhouette(&tree, &frame, true)), frame })
    }

    /// Up to `steps` steps of `parameter` in the direction of `sign`, seen in the goal's frame.
    ///
    /// Steps that the declared range does not allow, that do not change a whole number, and trees of
    /// more than the usual size are left out; a true value of 0 has nowhere to go.
    fn walk(&self, species: &Species, parameter: &str, sign: f64, steps: u32) -> anyhow::Result<Walk> {
        let space = species.generator.space();
        let slot = space.select(parameter).map_err(|e| anyhow::anyhow!("`{parameter}`: {e}"))?[0];
        let truth = species.params.get(slot);
        let places: Vec<(u32, f64)> = (1..=steps)
            .map(|step| (step, truth + sign * STEP * f64::from(step) * truth.abs()))
            .map(|(step, value)| (step, if space.kind_of(slot).is_whole() { value.round() } else { value }))
            .filter(|(_, value)| *value != truth && space.check_slot(slot, *value).is_ok())
            .collect();
        let walked = places.into_par_iter().map(|(step, value)| {
            let mut values = species.params.values().to_vec();
            values[slot.index()] = value;
            let there = Species { params: space.check(values)?, ..species.clone() };
            let usual = Limits::default();
            let limits =
                Limits { stems: usual.stems / 5, leaves: usual.leaves / 5, knots: usual.knots / 5, ..usual };
            let tree = there.grow_with(&Growth { limits, parallel: false, ..Growth::seed(SEED) });
            let look = |tree| Seen::new(silhouette(&tree, &self.frame, true));
            Ok(tree.ok().map(|tree| (step, measures::compare(&look(tree), &self.seen))))
        });
        Ok(walked.collect::<anyhow::Result<Vec<_>>>()?.into_iter().flatten().collect())
    }
}
