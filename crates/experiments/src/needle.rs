//! How near to the truth parameters must be before their tree lies on the goal's.

use super::plot::{Plot, Scale};
use super::record::{self, Exact, Fixed};
use super::spec::{Source, species_files};
use super::within::{List, Part, Real, SpeciesName, Whole};
use super::{Journal, Kind, Outputs, Slice, Table, progress};
use pleach_console::output;
use pleach_fit::{
    Evaluate, Evaluator, FIT_LIMITS, FitProblem, Freedom, Gene, Genome, GoalView, Objective, SearchSpace,
    Size, Stream, TreeSeed,
};
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::{Parts, Species};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Spanned;

/// Trees of lists at a distance from the truth.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Around {
    species: String,
    /// Standard deviation of the moves, as a part of the search range.
    distance: Exact,
    /// Numbers that move.
    moved: usize,
    /// Segmentation over lists.
    iou: Fixed<4>,
    iou_sd: Fixed<4>,
    pixel_accuracy: Fixed<4>,
    empty_accuracy: Fixed<4>,
    best_ellipse_iou: Fixed<4>,
}

/// Side of every goal in pixels.
const SIZE: u32 = 256;
/// Seed of every tree, the goal's too: the dissertation's setting.
const TREE_SEED: u64 = 1;
/// Lane of [`Stream::at`].
const LANE: u32 = 0x6e65;

const PLOT: &str = "needle.svg";

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NeedleSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Species by name.
    species: List<Spanned<SpeciesName>>,
    /// Standard deviations of the moves, as parts of the search range.
    distances: List<Spanned<Real<Part>>, 1, 100>,
    /// Lists at each distance.
    draws: Whole<1, 100_000>,
}

impl NeedleSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.all_differ(&self.species, |name| name.to_string(), "")?;
        source.all_differ(&self.distances, |distance| distance.to_string(), "")?;
        Ok(self)
    }
}

impl Kind for NeedleSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Around::default())
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        (vec![PLOT.to_owned()], species_files(&self.species).collect())
    }

    /// One row for each species and distance; a slice has the first few species.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let species = &self.species[..slice.take_of(self.species.len())];
        let bar = progress("species", species.len() as u64);
        for name in species {
            let name = name.get_ref().as_str();
            journal.job(
                |row: &Around| row.species == name,
                || rows_of(&pleach_generators::species(name)?, name, self),
            )?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let mut plot =
            Plot::new("distance of every number, part of its range", "IoU", Scale::Log, Scale::Linear);
        let rows: Vec<Around> = table.records()?;
        let mut lines = vec![
            std::iter::once("IoU at distance".to_owned())
                .chain(self.distances.iter().map(|distance| distance.get_ref().to_string()))
                .chain(["best ellipse".to_owned(), "numbers".to_owned()])
                .collect::<Vec<_>>(),
        ];
        for name in &self.species {
            let name = name.get_ref().as_str();
            let of: Vec<&Around> = rows.iter().filter(|row| row.species == name).collect();
            let points: Vec<(f64, f64)> = of.iter().map(|row| (row.distance.0, row.iou.0)).collect();
            plot.line(name, &points, false);
            let mut line = vec![name.to_owned()];
            line.extend(points.iter().map(|(_, iou)| format!("{iou:.2}")));
            let of_all = |row: &&Around| [row.best_ellipse_iou.to_string(), row.moved.to_string()];
            line.extend(of.last().map(of_all).unwrap_or_default());
            lines.push(line);
        }
        outputs.text(PLOT, &plot.svg())?;
        Ok(output::table(&lines, &(1..lines[0].len()).collect::<Vec<_>>()))
    }
}

fn rows_of(species: &Species, name: &str, spec: &NeedleSpec) -> anyhow::Result<Vec<Around>> {
    let tree = species.grow(TREE_SEED)?;
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIZE, SIZE);
    let mut goal = Bitmap::default();
    // As searches draw, so that the truth itself is a perfect match.
    Rasterizer::for_searches(Detail::Half).draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
    let ellipse = ScoreCard::new(&goal, &goal)?.best_ellipse_iou;
    let generator = &species.generator;
    let truth = Genome::new(species.params.values().to_vec(), TREE_SEED);
    let problem = FitProblem::new(species.clone(), GoalView::new(goal, View::FRONT, frame));
    let fixed = TreeSeed::Fixed(TREE_SEED);
    let space = SearchSpace::new(Arc::clone(generator), &truth.values, &Freedom::default(), fixed)?;
    // Inactive numbers and choices stay as they are.
    let is_moved =
        |gene: &&Gene| !gene.is_choice() && gene.get(&truth) != 0.0 && space.is_active(&truth.values, gene);
    let moved: Vec<_> = space.genes().iter().filter(is_moved).collect();
    let evaluator = Evaluator::new(&problem, Objective::Iou, FIT_LIMITS)?.with_height_matching();
    let mut rows = Vec::new();
    for (round, distance) in (0..).zip(&spec.distances) {
        let distance = **distance.get_ref();
        let near = |draw: u32| {
            let mut draws = Stream::at(TREE_SEED, LANE, round, draw);
            let mut genome = truth.clone();
            for gene in &moved {
                let unit = gene.to_unit(gene.get(&truth)) + distance * draws.normal();
                gene.set(&mut genome, gene.from_unit(unit.clamp(0.0, 1.0)));
            }
            genome
        };
        let genomes: Vec<Genome> = (0..*spec.draws as u32).map(near).collect();
        let mut scores = evaluator.scores(&genomes, Size::ANY);
        scores.retain(|score| score.cost.is_finite());
        let n = scores.len().max(1) as f64;
        let mean = scores.iter().map(|score| score.iou).sum::<f64>() / n;
        let squares = scores.iter().map(|score| (score.iou - mean).powi(2)).sum::<f64>();
        let accuracy = scores.iter().map(|score| score.accuracy).sum::<f64>() / n;
        rows.push(Around {
            species: name.to_owned(),
            distance: Exact(distance),
            moved: moved.len(),
            iou: Fixed(mean),
            iou_sd: Fixed((squares / (n - 1.0).max(1.0)).sqrt()),
            pixel_accuracy: Fixed(accuracy),
            empty_accuracy: Fixed(evaluator.empty_accuracy()),
            best_ellipse_iou: Fixed(ellipse),
        });
    }
    Ok(rows)
}
