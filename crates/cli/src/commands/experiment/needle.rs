//! How near to the truth parameters must be before their tree lies on the goal's.

use super::plot::{Plot, Scale};
use super::{Slice, Table, progress};
use crate::{files, output};
use pleach_fit::settings::LIMITS;
use pleach_fit::stream::Stream;
use pleach_fit::{
    Evaluate, Evaluator, FitProblem, Freedom, Genome, GoalView, Objective, SearchSpace, Size, TreeSeed,
    Unknown,
};
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::{Bitmap, Detail, Frame, Rasteriser, View};
use pleach_tree::Species;
use serde::Deserialize;
use std::path::Path;
use std::sync::Arc;

const COLUMNS: [&str; 8] =
    ["species", "distance", "moved", "iou", "iou_sd", "pixel_accuracy", "empty_accuracy", "best_ellipse_iou"];

/// Side of every goal in pixels.
const SIZE: u32 = 256;
/// Seed of every tree, the goal's too: the dissertation's setting.
const TREE_SEED: u64 = 1;
/// Lane of [`Stream::at`].
const LANE: u32 = 0x6e65;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NeedleSpec {
    /// Species by name.
    species: Vec<String>,
    /// Standard deviations of the moves, as parts of the search range.
    distances: Vec<f64>,
    /// Lists at each distance.
    draws: u32,
}

pub(super) fn run(folder: &Path, spec: &NeedleSpec) -> anyhow::Result<String> {
    let table = table(spec, Slice::default())?;
    table.write(&folder.join("results.csv"))?;
    let mut plot = Plot::new("distance of every number, part of its range", "IoU", Scale::Log, Scale::Linear);
    let mut lines = vec![
        std::iter::once("IoU at distance".to_owned())
            .chain(spec.distances.iter().map(ToString::to_string))
            .chain(["best ellipse".to_owned(), "numbers".to_owned()])
            .collect::<Vec<_>>(),
    ];
    for name in &spec.species {
        let of: Vec<&Vec<String>> = table.rows.iter().filter(|row| row[0] == *name).collect();
        let points: Vec<(f64, f64)> =
            of.iter().filter_map(|row| Some((row[1].parse().ok()?, row[3].parse().ok()?))).collect();
        plot.line(name, &points, false);
        let mut line = vec![name.clone()];
        line.extend(points.iter().map(|(_, iou)| format!("{iou:.2}")));
        let last = of.last().map_or(&[][..], |row| row.as_slice());
        line.extend([7, 2].map(|at| last.get(at).cloned().unwrap_or_default()));
        lines.push(line);
    }
    files::write_text(&folder.join("needle.svg"), &plot.svg())?;
    Ok(output::table(&lines, &(1..lines[0].len()).collect::<Vec<_>>()))
}

/// One row a species and distance; a slice has the first few species.
pub(super) fn table(spec: &NeedleSpec, slice: Slice) -> anyhow::Result<Table> {
    let count = slice.repetitions.map_or(spec.species.len(), |n| (n as usize).min(spec.species.len()));
    let species = &spec.species[..count];
    let bar = progress("species", species.len() as u64);
    let mut rows = Vec::new();
    for name in species {
        rows.extend(rows_of(&pleach_generators::species(name)?, spec)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(Table { columns: COLUMNS.to_vec(), rows })
}

fn rows_of(species: &Species, spec: &NeedleSpec) -> anyhow::Result<Vec<Vec<String>>> {
    let tree = species.grow(TREE_SEED)?;
    let frame = Frame::automatic(&tree, &View::FRONT, true, SIZE, SIZE);
    let mut goal = Bitmap::default();
    // As searches draw, so that the truth itself is a perfect match.
    Rasteriser::with_detail(Detail::Half).draw(&tree, &View::FRONT, &frame, true, &mut goal);
    let ellipse = ScoreCard::of(&goal, &goal)?.best_ellipse_iou;
    let generator = &species.generator;
    let truth = Genome::new(species.params.values().to_vec(), TREE_SEED);
    let problem = FitProblem {
        generator: Arc::clone(generator),
        base: truth.values.clone(),
        goals: vec![GoalView { goal, view: View::FRONT, frame, unknown: Unknown::default() }],
        foliage: true,
    };
    let fixed = TreeSeed::Fixed(TREE_SEED);
    let space = SearchSpace::new(Arc::clone(generator), &truth.values, &Freedom::default(), fixed)?;
    // What is switched off, and what another choice would make another tree, stays as it is.
    let is_moved = |gene: &&pleach_fit::space::Gene| {
        !gene.is_choice() && gene.of(&truth) != 0.0 && space.is_read(&truth.values, gene)
    };
    let moved: Vec<_> = space.genes().iter().filter(is_moved).collect();
    let evaluator = Evaluator::new(&problem, Objective::Iou, LIMITS)?.matching_height();
    let mut rows = Vec::new();
    for (round, &distance) in (0..).zip(&spec.distances) {
        let near = |draw: u32| {
            let mut draws = Stream::at(TREE_SEED, LANE, round, draw);
            let mut genome = truth.clone();
            for gene in &moved {
                let unit = gene.to_unit(gene.of(&truth)) + distance * draws.normal();
                gene.set(&mut genome, gene.from_unit(unit.clamp(0.0, 1.0)));
            }
            genome
        };
        let genomes: Vec<Genome> = (0..spec.draws).map(near).collect();
        let mut scores = evaluator.scores(&genomes, Size::ANY);
        scores.retain(|score| score.cost.is_finite());
        let n = scores.len().max(1) as f64;
        let mean = scores.iter().map(|score| score.iou).sum::<f64>() / n;
        let squares = scores.iter().map(|score| (score.iou - mean).powi(2)).sum::<f64>();
        let accuracy = scores.iter().map(|score| score.accuracy).sum::<f64>() / n;
        rows.push(vec![
            species.name.clone(),
            distance.to_string(),
            moved.len().to_string(),
            format!("{mean:.4}"),
            format!("{:.4}", (squares / (n - 1.0).max(1.0)).sqrt()),
            format!("{accuracy:.4}"),
            format!("{:.4}", evaluator.empty_accuracy()),
            format!("{ellipse:.4}"),
        ]);
    }
    Ok(rows)
}
