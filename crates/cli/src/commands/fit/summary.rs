//! `summary.json` and the other files of a result.

use super::drawing::{Drawing, Drawn};
use super::individual::{self, IndividualSummary};
use super::judged;
use super::request::{Request, method_settings};
use super::run_folder::{Claim, SUMMARY};
use super::several::{self, Several};
use super::start::{self, LooksLike, looks_like};
use super::views::ViewScore;
use crate::files;
use pleach_fit::{COLUMNS, Fitted, FreshSeeds, References, Row, Runner, StopReason, Verdict};
use pleach_silhouette::goal::GoalWarning;
use pleach_silhouette::picture::Picture;
use pleach_silhouette::score::ScoreCard;
use pleach_tree::dendrometry::Dendrometry;
use pleach_tree::{Foliage, Species};
use serde::Serialize;
use serde_json::Value;
use std::path::Path;

/// Pixels a side of the shaded picture of a result.
pub(super) const RENDER_SIZE: u32 = 512;

/// What a fit leaves in its folder.
pub(super) struct Results<'a> {
    pub(super) fitted: &'a Fitted,
    /// The best individual as it is drawn.
    pub(super) drawn: Drawn,
    pub(super) drawing: &'a Drawing<'a>,
    /// Further pictures, with what was fitted over them.
    pub(super) views: Vec<(ViewScore, Picture)>,
    pub(super) holdout_views: Vec<(ViewScore, Picture)>,
    pub(super) from: String,
    /// Whether it was seen in the goal whether there are leaves.
    pub(super) leaves_detected: bool,
    pub(super) request: Request,
}

/// `summary.json`.
#[derive(Debug, Serialize)]
pub(super) struct Summary {
    pub(super) species: String,
    pub(super) generator: String,
    pub(super) tree_seed: u64,
    pub(super) robust: u32,
    #[serde(flatten)]
    pub(super) scores: ScoreCard,
    pub(super) fresh_seeds: Option<FreshSeeds>,
    /// The goal's own tree; the scores above are of the tree of the kind that the search has found.
    pub(super) individual: Option<IndividualSummary>,
    /// With `--individuals`: all trees of the goal, the best first.
    pub(super) individuals: Option<Several>,
    /// What likeness and IoU stand beside, at the search's size.
    pub(super) references: Option<References>,
    pub(super) verdict: Option<Verdict>,
    pub(super) determined: Option<Counts>,
    pub(super) evaluations: u64,
    pub(super) generations: u64,
    /// First guess and search together: what `--timeout` is of.
    pub(super) seconds: f64,
    pub(super) first_guess_seconds: f64,
    pub(super) search_seconds: f64,
    /// None if the fit was interrupted.
    pub(super) judging_seconds: Option<f64>,
    pub(super) evaluations_per_second: f64,
    pub(super) optimizer: &'static str,
    pub(super) optimizer_settings: Value,
    /// The grammar that a search over rules has found.
    #[serde(flatten)]
    pub(super) rules: Option<Rules>,
    pub(super) objective: String,
    pub(super) cost: f64,
    pub(super) stopped_by: StopReason,
    pub(super) finished: bool,
    pub(super) seed: u64,
    pub(super) from: String,
    pub(super) looks_like: Vec<LooksLike>,
    /// How the families did in the race for the goal, best first; empty if only one was asked.
    pub(super) families: Vec<Runner>,
    /// Whether the trees have leaves.
    pub(super) leaves: bool,
    /// Whether that was seen in the goal, and not said.
    pub(super) leaves_detected: bool,
    /// Further pictures that were fitted; the scores above are of the goal itself.
    pub(super) views: Vec<ViewScore>,
    /// Pictures that were not.
    pub(super) holdout_views: Vec<ViewScore>,
    pub(super) free: Vec<String>,
    pub(super) fix: Vec<String>,
    pub(super) height_m: f64,
    /// The fitted tree in metres.
    pub(super) tree_m: Dendrometry,
    /// The name in `summary.json` is older than the spelling of identifiers.
    #[serde(rename = "metres_per_pixel")]
    pub(super) meters_per_pixel: f64,
    /// Where the trunk's foot and the ground are in the goal, in pixels from its left and its top.
    pub(super) axis_column: f64,
    pub(super) ground_row: f64,
    pub(super) goal_width: u32,
    pub(super) goal_height: u32,
    /// The part of the picture that the scores are of, with paper beside the tree: other than the goal's size
    /// where the picture ends at the tree or shows little else than paper.
    pub(super) compared_width: u32,
    pub(super) compared_height: u32,
    pub(super) search: SearchScores,
    /// What about the goal, or its mask, is not as a fit expects.
    pub(super) warnings: Vec<GoalWarning>,
    /// What was asked for: a later run compares it.
    #[serde(flatten)]
    pub(super) request: Request,
    pub(super) version: &'static str,
}

/// The result as the search and its history saw it: against the goal at its working size, the mean
/// over views and over the seeds of a robust fit.
#[derive(Debug, Serialize)]
pub(super) struct SearchScores {
    pub(super) goal_width: u32,
    pub(super) goal_height: u32,
    /// Share of inked pixels. Fine twigs and leaves get thicker or thinner as a goal is reduced.
    pub(super) goal_ink: f64,
    pub(super) iou: f64,
    pub(super) pixel_accuracy: f64,
}

/// How many of the free parameters the goal determines.
#[derive(Debug, Serialize)]
pub(super) struct Counts {
    pub(super) determined: usize,
    pub(super) loosely: usize,
    pub(super) not_seen: usize,
    /// For want of time.
    pub(super) not_tried: usize,
}

/// Rules that were searched.
#[derive(Debug, Serialize)]
pub(super) struct Rules {
    /// The grammar.
    pub(super) grammar: String,
    /// Its words and signs.
    pub(super) grammar_length: usize,
}

impl Rules {
    fn new(species: &Species) -> Option<Self> {
        let variation = species.generator.variation()?;
        let grammar = variation.own();
        Some(Self { grammar_length: variation.length(&grammar), grammar })
    }
}

impl Summary {
    /// Whether the fit can go on.
    pub(super) const fn interrupted(&self) -> bool {
        !self.finished
    }
}

/// Writes everything but the checkpoint into the folder of `claim`.
pub(super) fn write(claim: &Claim, results: Results<'_>) -> anyhow::Result<Summary> {
    let Results { fitted, drawn, drawing, .. } = results;
    let Fitted { settings, outcome, best, judged, .. } = fitted;
    let (goal, working) = (&drawing.goals.full, &drawing.goals.working);
    let scores = ScoreCard::new(&drawn.bitmap, &goal.bitmap)?;
    claim.ensure_there()?;

    let mut comments = vec![
        format!(
            "Fitted by pleach {} in {} evaluations ({}).",
            env!("CARGO_PKG_VERSION"),
            outcome.evaluations,
            settings.method_name()
        ),
        format!("IoU {:.4}, pixel accuracy {:.4} with tree_seed below.", scores.iou, scores.pixel_accuracy),
    ];
    if let Some(judged) = judged {
        let space = drawn.species.generator.space();
        comments.extend(judged::comments(judged, space));
        write_table(&claim.file("parameters.csv"), judged::table(judged, &best.genome, space))?;
    }
    write_species(&claim.file("best.toml"), &drawn.species, &comments)?;
    drawn.write_silhouettes(&goal.bitmap, &claim.file("best.png"), &claim.file("overlay.png"))?;
    write_history(&claim.file("history.csv"), &outcome.history)?;
    // Shaded pictures take most of the time and the memory of all of this, so that there is one at a time, and one
    // tree.
    drawn.write_render(&claim.file("render.png"), RENDER_SIZE)?;
    let tree_m = Dendrometry::new(&drawn.tree);
    let Drawn { species, tree, .. } = drawn;
    drop(tree);
    let (individual, individuals) = match fitted.individuals.first() {
        Some(found) => {
            let one = drawing.draw_individual(found)?;
            (
                Some(individual::write(claim, &goal.bitmap, found, &one)?),
                several::write(claim, drawing, &fitted.individuals, &one, &species)?,
            )
        }
        None => (None, None),
    };
    let views = write_overlays(claim, "overlay-view", results.views)?;
    let holdout_views = write_overlays(claim, "overlay-holdout", results.holdout_views)?;

    let seconds = outcome.elapsed.as_secs_f64();
    let first_guess_seconds = outcome.before_search.as_secs_f64();
    let frame = goal.original_frame(&drawing.frame());
    let verdict = fitted.verdict(&scores);
    let summary = Summary {
        species: species.name.clone(),
        generator: species.generator.family().to_owned(),
        tree_seed: best.genome.tree_seed,
        robust: settings.robust.get(),
        scores,
        fresh_seeds: judged.as_ref().and_then(|judged| judged.held_out),
        individual,
        individuals,
        references: fitted.references().cloned(),
        verdict,
        determined: judged.as_ref().map(|judged| {
            let [determined, loosely, not_seen, not_tried] = judged::counts(judged);
            Counts { determined, loosely, not_seen, not_tried }
        }),
        evaluations: outcome.evaluations,
        generations: outcome.generations,
        seconds,
        first_guess_seconds,
        search_seconds: seconds - first_guess_seconds,
        judging_seconds: judged.as_ref().map(|judged| judged.elapsed.as_secs_f64()),
        evaluations_per_second: outcome.evaluations as f64 / seconds.max(1e-9),
        optimizer: settings.method_name(),
        optimizer_settings: method_settings(settings)?,
        rules: settings.rules.as_ref().and_then(|_| Rules::new(&species)),
        objective: settings.objective.to_string(),
        cost: best.score.cost,
        stopped_by: outcome.stop,
        finished: outcome.stop != StopReason::Interrupted,
        seed: settings.seed,
        from: results.from,
        looks_like: looks_like(fitted.guess.as_ref()),
        families: start::families(fitted.guess.as_ref()),
        leaves: fitted.problem.foliage != Foliage::None,
        leaves_detected: results.leaves_detected,
        views,
        holdout_views,
        free: settings.freedom.free.clone(),
        fix: settings.freedom.fix.clone(),
        height_m: drawing.args.height,
        tree_m,
        meters_per_pixel: frame.meters_per_pixel,
        axis_column: frame.axis_column,
        ground_row: frame.ground_row,
        goal_width: frame.width,
        goal_height: frame.height,
        compared_width: goal.bitmap.width(),
        compared_height: goal.bitmap.height(),
        search: SearchScores {
            goal_width: working.bitmap.width(),
            goal_height: working.bitmap.height(),
            goal_ink: working.bitmap.ink() as f64 / working.bitmap.area() as f64,
            iou: best.score.iou,
            pixel_accuracy: best.score.accuracy,
        },
        warnings: drawing.goals.warnings.clone(),
        request: results.request,
        version: env!("CARGO_PKG_VERSION"),
    };
    files::write_text(&claim.file(SUMMARY), &(serde_json::to_string_pretty(&summary)? + "\n"))?;
    Ok(summary)
}

/// Writes the overlay of each further view as `NAME-1.png`, `NAME-2.png` …
fn write_overlays(
    claim: &Claim,
    name: &str,
    views: Vec<(ViewScore, Picture)>,
) -> anyhow::Result<Vec<ViewScore>> {
    let write = |(i, (score, overlay)): (usize, (ViewScore, Picture))| {
        files::write_whole(&claim.file(&format!("{name}-{}.png", i + 1)), |file| {
            Ok(overlay.write_png(file)?)
        })?;
        Ok(score)
    };
    views.into_iter().enumerate().map(write).collect()
}

/// Writes a species file with comments at its head.
pub(super) fn write_species(path: &Path, species: &Species, comments: &[String]) -> anyhow::Result<()> {
    files::write_text(path, &species.to_toml(comments))
}

/// Writes `history.csv`.
pub(super) fn write_history(path: &Path, rows: &[Row]) -> anyhow::Result<()> {
    let header = COLUMNS.iter().map(|c| c.name.to_owned()).collect();
    let rows = rows.iter().map(|row| row.cells().collect());
    write_table(path, std::iter::once(header).chain(rows))
}

pub(super) fn write_table(path: &Path, rows: impl IntoIterator<Item = Vec<String>>) -> anyhow::Result<()> {
    files::write_whole(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        for row in rows {
            csv.write_record(row)?;
        }
        Ok(csv.flush()?)
    })
}
