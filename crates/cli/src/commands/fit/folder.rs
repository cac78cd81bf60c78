//! The run folder.

use super::aftermath::Aftermath;
use super::asked::Asked;
use super::start::LooksLike;
use super::views::ViewScore;
use crate::{files, output};
use anyhow::{Context, bail};
use pleach_fit::{COLUMNS, FitProblem, FitSettings, FreshSeeds, Outcome, Scored, StopReason};
use pleach_silhouette::goal::Goal;
use pleach_silhouette::picture;
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::{Bitmap, Rasteriser, View};
use pleach_tree::{Species, Tree};
use serde::Serialize;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The folder of one fit.
pub(super) struct RunFolder {
    path: PathBuf,
}

/// What a fit leaves in its folder.
pub(super) struct Results<'a> {
    pub(super) settings: &'a FitSettings,
    pub(super) outcome: &'a Outcome,
    pub(super) best: &'a Scored,
    /// None if the fit was interrupted.
    pub(super) aftermath: Option<&'a Aftermath>,
    pub(super) species: &'a Species,
    pub(super) tree: &'a Tree,
    /// As it was given: what the score card is of.
    pub(super) goal: &'a Goal,
    /// As the search compared with it.
    pub(super) working: &'a Goal,
    pub(super) view: &'a View,
    pub(super) views: Vec<ViewScore>,
    pub(super) holdout_views: Vec<ViewScore>,
    pub(super) height: f64,
    pub(super) foliage: bool,
    pub(super) from: String,
    pub(super) looks_like: Vec<LooksLike>,
    pub(super) options: Asked,
}

/// `summary.json`.
#[derive(Debug, Serialize)]
pub(super) struct Summary {
    species: String,
    generator: String,
    tree_seed: u64,
    robust: u32,
    #[serde(flatten)]
    scores: ScoreCard,
    fresh_seeds: Option<FreshSeeds>,
    determined: Option<Counts>,
    evaluations: u64,
    generations: u64,
    seconds: f64,
    evaluations_per_second: f64,
    optimizer: &'static str,
    optimizer_settings: Value,
    objective: String,
    cost: f64,
    stopped_by: StopReason,
    finished: bool,
    seed: u64,
    from: String,
    looks_like: Vec<LooksLike>,
    /// Further pictures that were fitted; the scores above are of the goal itself.
    views: Vec<ViewScore>,
    /// Pictures that were not.
    holdout_views: Vec<ViewScore>,
    free: Vec<String>,
    fix: Vec<String>,
    height_m: f64,
    metres_per_pixel: f64,
    goal_width: u32,
    goal_height: u32,
    search: SearchScores,
    /// What was asked for; a batch that is resumed compares it.
    options: Asked,
    version: &'static str,
}

/// The result as the search and its history saw it: against the goal at its working size, the mean
/// over views and over the seeds of a robust fit.
#[derive(Debug, Serialize)]
struct SearchScores {
    goal_width: u32,
    goal_height: u32,
    /// Share of inked pixels. Fine twigs and leaves get thicker or thinner as a goal is reduced.
    goal_ink: f64,
    iou: f64,
    pixel_accuracy: f64,
}

/// How many of the free parameters the goal determines.
#[derive(Debug, Serialize)]
struct Counts {
    determined: usize,
    loosely: usize,
    not_seen: usize,
}

impl Summary {
    /// Whether the fit can go on.
    pub(super) const fn interrupted(&self) -> bool {
        !self.finished
    }
}

impl RunFolder {
    /// Opens or makes the folder. An unfinished fit in it is neither overwritten nor gone on with
    /// unless that was asked for.
    pub(super) fn open(path: PathBuf, resume: bool, overwrite: bool) -> anyhow::Result<Self> {
        files::make_folder(&path)?;
        let folder = Self { path };
        let unfinished = folder.is_unfinished();
        if unfinished && !resume && !overwrite {
            bail!(
                "{} holds an unfinished fit; --resume goes on with it, --overwrite starts anew",
                folder.path.display()
            );
        }
        if resume && !unfinished {
            if folder.finished().is_some() {
                bail!("{} holds a finished fit, and no checkpoint to resume from", folder.path.display());
            }
            output::note(format!("{} holds no checkpoint yet: the fit starts", folder.path.display()));
        }
        if overwrite && unfinished {
            // Else a new fit that is killed before its first checkpoint would go on as the old one.
            std::fs::remove_file(folder.checkpoint())
                .with_context(|| format!("cannot remove {}", folder.checkpoint().display()))?;
        }
        Ok(folder)
    }

    /// The folder as it is, made or not.
    pub(super) const fn at(path: PathBuf) -> Self {
        Self { path }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether there is a fit to go on with.
    pub(super) fn is_unfinished(&self) -> bool {
        self.checkpoint().exists()
    }

    /// The summary of a finished fit, if the folder holds one.
    pub(super) fn finished(&self) -> Option<Value> {
        let text = std::fs::read_to_string(self.summary()).ok()?;
        let summary: Value = serde_json::from_str(&text).ok()?;
        (!self.is_unfinished() && summary["finished"] == true).then_some(summary)
    }

    /// Removes the summary of an earlier fit, so that nobody takes it for the next one's.
    pub(super) fn forget(&self) -> anyhow::Result<()> {
        match std::fs::remove_file(self.summary()) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(error).with_context(|| format!("cannot remove {}", self.summary().display()))
            }
            _ => Ok(()),
        }
    }

    fn summary(&self) -> PathBuf {
        self.path.join("summary.json")
    }

    pub(super) fn checkpoint(&self) -> PathBuf {
        self.path.join("checkpoint")
    }

    /// Removes the checkpoint of a finished fit.
    pub(super) fn remove_checkpoint(&self) {
        if let Err(error) = std::fs::remove_file(self.checkpoint()) {
            output::note(format!("warning: {} stays: {error}", self.checkpoint().display()));
        }
    }

    /// Writes everything but the checkpoint.
    pub(super) fn write(&self, results: Results<'_>) -> anyhow::Result<Summary> {
        let Results { settings, outcome, best, species, goal, .. } = results;
        let frame = goal.frame(results.height);
        let mut bitmap = Bitmap::default();
        Rasteriser::new().draw(results.tree, results.view, &frame, results.foliage, &mut bitmap);
        let scores = ScoreCard::of(&bitmap, &goal.bitmap)?;

        let mut comments = vec![
            format!(
                "Fitted by pleach {} in {} evaluations ({}).",
                env!("CARGO_PKG_VERSION"),
                outcome.evaluations,
                settings.optimizer.name()
            ),
            format!(
                "IoU {:.4}, pixel accuracy {:.4} with tree_seed below.",
                scores.iou, scores.pixel_accuracy
            ),
        ];
        if let Some(aftermath) = results.aftermath {
            comments.extend(aftermath.comments(species.generator.space()));
            write_table(&self.path.join("parameters.csv"), aftermath.table(species.generator.space()))?;
        }
        files::write_text(&self.path.join("best.toml"), &species.to_toml(&comments))?;
        files::write_whole(&self.path.join("best.png"), |file| Ok(bitmap.write_png(file)?))?;
        let overlay = picture::overlay(&bitmap, &goal.bitmap);
        files::write_whole(&self.path.join("overlay.png"), |file| Ok(overlay.write_png(file)?))?;
        let header = COLUMNS.iter().map(|c| c.name.to_owned()).collect();
        let rows = outcome.history.iter().map(|row| row.cells().collect());
        write_table(&self.path.join("history.csv"), std::iter::once(header).chain(rows))?;

        let seconds = outcome.elapsed.as_secs_f64();
        let optimizer = serde_json::to_value(&settings.optimizer)?;
        let summary = Summary {
            species: species.name.clone(),
            generator: species.generator.family().to_owned(),
            tree_seed: best.genome.tree_seed,
            robust: settings.robust.get(),
            scores,
            fresh_seeds: results.aftermath.and_then(|aftermath| aftermath.fresh),
            determined: results.aftermath.map(|aftermath| {
                let [determined, loosely, not_seen] = aftermath.counts();
                Counts { determined, loosely, not_seen }
            }),
            evaluations: outcome.evaluations,
            generations: outcome.generations,
            seconds,
            evaluations_per_second: outcome.evaluations as f64 / seconds.max(1e-9),
            optimizer: settings.optimizer.name(),
            optimizer_settings: optimizer.get(settings.optimizer.name()).cloned().unwrap_or_default(),
            objective: settings.objective.to_string(),
            cost: best.score.cost,
            stopped_by: outcome.stop,
            finished: outcome.stop != StopReason::Interrupted,
            seed: settings.seed,
            from: results.from,
            looks_like: results.looks_like,
            views: results.views,
            holdout_views: results.holdout_views,
            free: settings.freedom.free.clone(),
            fix: settings.freedom.fix.clone(),
            height_m: results.height,
            metres_per_pixel: frame.metres_per_pixel,
            goal_width: goal.bitmap.width(),
            goal_height: goal.bitmap.height(),
            search: SearchScores {
                goal_width: results.working.bitmap.width(),
                goal_height: results.working.bitmap.height(),
                goal_ink: results.working.bitmap.ink() as f64 / results.working.bitmap.area() as f64,
                iou: best.score.iou,
                pixel_accuracy: best.score.accuracy,
            },
            options: results.options,
            version: env!("CARGO_PKG_VERSION"),
        };
        files::write_text(&self.summary(), &(serde_json::to_string_pretty(&summary)? + "\n"))?;
        Ok(summary)
    }
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

/// The species that an individual is.
pub(super) fn species(problem: &FitProblem, best: &Scored, name: &str) -> anyhow::Result<Species> {
    Ok(Species {
        name: name.to_owned(),
        description: String::new(),
        generator: Arc::clone(&problem.generator),
        params: problem.generator.space().check(best.genome.values.clone())?,
        tree_seed: Some(best.genome.tree_seed),
        appearance: Default::default(),
    })
}

/// At what size the score card compares, and what the search saw at its own if that is another: the
/// numbers of a sparse crown differ by as much as a tenth, though the tree is the same.
fn sizes(summary: &Summary) -> String {
    let Summary { goal_width, goal_height, search, .. } = summary;
    if (*goal_width, *goal_height) == (search.goal_width, search.goal_height) {
        return format!("compared at {goal_width} × {goal_height} pixels, as in the search\n");
    }
    format!(
        "compared at {goal_width} × {goal_height} pixels, the goal {:.1} % ink; searched, and other seeds \
         compared,\nat {} × {} (--size), the goal {:.1} % ink: there the IoU is {:.4}\n",
        100.0 * summary.scores.goal_crown.ink,
        search.goal_width,
        search.goal_height,
        100.0 * search.goal_ink,
        search.iou,
    )
}

/// The score card that ends a fit.
pub(super) fn report(summary: &Summary, folder: &RunFolder) -> String {
    let mut judged = String::new();
    judged.extend(summary.views.iter().map(|view| view.line("view")));
    judged.extend(summary.holdout_views.iter().map(|view| view.line("held out")));
    if let Some(fresh) = &summary.fresh_seeds {
        judged += &format!(
            "{} other seeds: likeness {:.3} ± {:.3}, IoU {:.3} ± {:.3}, {:.2} ± {:.2} % of pixels\n",
            fresh.count,
            fresh.likeness.mean,
            fresh.likeness.sd,
            fresh.iou.mean,
            fresh.iou.sd,
            100.0 * fresh.pixel_accuracy.mean,
            100.0 * fresh.pixel_accuracy.sd,
        );
    }
    if let Some(Counts { determined, loosely, not_seen }) = summary.determined {
        judged += &format!(
            "of the parameters the goal determines {determined}, loosely {loosely}; {not_seen} are not seen\n"
        );
    }
    format!(
        "{}\n\n{}{judged}{} trees in {:.1} s ({:.0} a second) by `{}`; {}\n\n\
         overlay  {}\nspecies  {}",
        crate::commands::score::card(&summary.scores),
        sizes(summary),
        summary.evaluations,
        summary.seconds,
        summary.evaluations_per_second,
        summary.optimizer,
        summary.stopped_by,
        folder.path.join("overlay.png").display(),
        folder.path.join("best.toml").display(),
    )
}
