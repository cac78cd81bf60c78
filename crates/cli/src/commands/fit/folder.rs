//! The run folder.

use super::aftermath::Aftermath;
use super::asked::Asked;
use super::start::LooksLike;
use super::views::ViewScore;
use crate::{files, output};
use anyhow::{Context, bail};
use pleach_fit::{
    COLUMNS, FitProblem, FitSettings, FreshSeeds, Outcome, References, Scored, StopReason, Verdict,
};
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
    pub(super) leaves_detected: bool,
    /// What a first guess has told; the aftermath's where there is one.
    pub(super) references: Option<&'a References>,
    pub(super) options: Asked,
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
    pub(super) objective: String,
    pub(super) cost: f64,
    pub(super) stopped_by: StopReason,
    pub(super) finished: bool,
    pub(super) seed: u64,
    pub(super) from: String,
    pub(super) looks_like: Vec<LooksLike>,
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
    pub(super) metres_per_pixel: f64,
    pub(super) goal_width: u32,
    pub(super) goal_height: u32,
    pub(super) search: SearchScores,
    /// What was asked for; a batch that is resumed compares it.
    pub(super) options: Asked,
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
        let first_guess_seconds = outcome.before_search.as_secs_f64();
        let fresh_seeds = results.aftermath.and_then(|aftermath| aftermath.fresh);
        let references = results.aftermath.map(|aftermath| &aftermath.references).or(results.references);
        let fresh = fresh_seeds.as_ref().map(|fresh| fresh.likeness.mean);
        let verdict = references.and_then(|references| {
            Verdict::of(scores.likeness, fresh, references, &scores.crown, &scores.goal_crown)
        });
        let optimizer = serde_json::to_value(&settings.optimizer)?;
        let summary = Summary {
            species: species.name.clone(),
            generator: species.generator.family().to_owned(),
            tree_seed: best.genome.tree_seed,
            robust: settings.robust.get(),
            scores,
            fresh_seeds,
            references: references.cloned(),
            verdict,
            determined: results.aftermath.map(|aftermath| {
                let [determined, loosely, not_seen] = aftermath.counts();
                Counts { determined, loosely, not_seen }
            }),
            evaluations: outcome.evaluations,
            generations: outcome.generations,
            seconds,
            first_guess_seconds,
            search_seconds: seconds - first_guess_seconds,
            judging_seconds: results.aftermath.map(|aftermath| aftermath.seconds),
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
            leaves: results.foliage,
            leaves_detected: results.leaves_detected,
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
