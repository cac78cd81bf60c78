//! This very tree: `--individual`, and what is said and written of it.

use super::drawing::Drawn;
use super::options;
use super::run_folder::Claim;
use super::summary::{RENDER_SIZE, write_species};
use crate::output;
use pleach::plan::Effort;
use pleach_fit::FoundIndividual;
use pleach_silhouette::Bitmap;
use pleach_silhouette::score::ScoreCard;
use serde::Serialize;

/// What `--individual` says.
pub(super) fn effort(given: &str) -> Result<Effort, String> {
    if given == "off" {
        return Ok(Effort::Off);
    }
    if let Some(count) = given.strip_suffix("trees") {
        let count = count.parse().ok().filter(|count| (1..=1_000_000_000).contains(count));
        return count
            .map(Effort::Trees)
            .ok_or_else(|| "expected a number of trees such as 400trees".to_owned());
    }
    options::duration(given).map(Effort::Time).map_err(|error| format!("{error}, `400trees`, or `off`"))
}

/// What `summary.json` says of the goal's own tree.
#[derive(Debug, Serialize)]
pub(super) struct IndividualSummary {
    /// Stems with draws of their own.
    pub(super) stems: usize,
    #[serde(flatten)]
    pub(super) scores: ScoreCard,
    /// By the objective `overlap`, of the tree that the search began with and of this one.
    pub(super) cost_before: f64,
    pub(super) cost: f64,
    /// Trees grown, and single stems tried.
    pub(super) trees: u64,
    pub(super) trials: u64,
    pub(super) trials_per_second: f64,
    pub(super) seconds: f64,
}

/// Writes individual.toml and its pictures, and says what they are worth.
pub(super) fn write(
    claim: &Claim,
    goal: &Bitmap,
    found: &FoundIndividual,
    drawn: &Drawn,
) -> anyhow::Result<IndividualSummary> {
    let scores = ScoreCard::new(&drawn.bitmap, goal)?;
    let (stems, seconds) = (found.individual().len(), found.elapsed.as_secs_f64());
    let comments = [format!(
        "This very tree: {stems} stems have draws of their own, chosen among {} by pleach {}. IoU {:.4}, likeness \
         {:.4}. Other seeds of this file are trees of its kind.",
        found.trials,
        env!("CARGO_PKG_VERSION"),
        scores.iou,
        scores.likeness
    )];
    write_species(&claim.file("individual.toml"), &drawn.species, &comments)?;
    drawn.write_silhouettes(goal, &claim.file("individual.png"), &claim.file("overlay-individual.png"))?;
    drawn.write_render(&claim.file("individual-render.png"), RENDER_SIZE)?;
    let (trees, trials) = (found.trees, found.trials);
    Ok(IndividualSummary {
        stems,
        scores,
        cost_before: found.before.cost,
        cost: found.score.cost,
        trees,
        trials,
        trials_per_second: trials as f64 / seconds.max(1e-9),
        seconds,
    })
}

impl IndividualSummary {
    /// The scores of the tree of the `kind` and of this one, side by side.
    pub(super) fn beside(&self, kind: &ScoreCard) -> String {
        let one = &self.scores;
        let row = |name: &str, kind: f64, one: f64, note: String| {
            vec![name.to_owned(), format!("{kind:.4}"), format!("{one:.4}"), note]
        };
        let head = ["", "the kind", "this very tree", ""].map(str::to_owned).to_vec();
        let ellipse = format!("best single ellipse {:.4}", one.best_ellipse_iou);
        let rows = vec![
            head,
            row("likeness", kind.likeness, one.likeness, String::new()),
            row("IoU", kind.iou, one.iou, ellipse),
            row("boundary F", kind.boundary_f, one.boundary_f, String::new()),
            row(
                "blurred IoU",
                kind.blurred_iou.sixty_fourth,
                one.blurred_iou.sixty_fourth,
                "1/64".to_owned(),
            ),
        ];
        format!(
            "\n{}\n{} of its stems have draws of their own ({} tried, {:.0} a second)\n\n",
            output::table(&rows, &[1, 2]),
            self.stems,
            self.trials,
            self.trials_per_second
        )
    }
}
