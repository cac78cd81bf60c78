//! `pleach score`: how alike two silhouettes are.

use crate::{input, output};
use anyhow::ensure;
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::score::{Likeness, ScoreCard};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  pleach score best.png goal.png           the score card as a table
  pleach score best.png goal.png --json    for scripts
  pleach mask oak.jpg -o - | pleach score - mine.png

Each score stands beside what says nothing would have: pixel accuracy beside that of an empty picture, \
IoU beside that of the best single ellipse.

Likeness says how much two silhouettes look like trees of one kind, from 0 to 1; it is about mass, rim, \
strokes and gaps, and not about twigs in their places. It stands beside its parts.";

/// Print the score card of two silhouettes of one size
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Score {
    /// The picture to be judged; - for standard input
    image: PathBuf,
    /// The goal; - for standard input
    goal: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Score {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let options = GoalOptions::default();
        ensure!(
            !(input::is_standard(&self.image) && input::is_standard(&self.goal)),
            "only one of the two pictures can come from standard input"
        );
        let image = Goal::from_encoded(&input::picture(&self.image)?, &options)?;
        let goal = Goal::from_encoded(&input::picture(&self.goal)?, &options)?;
        let scores = ScoreCard::new(&image.bitmap, &goal.bitmap)?;
        if self.json { output::json(&scores) } else { output::line(card(&scores)) }
    }
}

/// The score card as a table.
pub(crate) fn card(scores: &ScoreCard) -> String {
    let row = |name: &str, value: f64, beside: String| vec![name.to_owned(), format!("{value:.4}"), beside];
    let rows = vec![
        row("likeness", scores.likeness, parts(&scores.likeness_parts)),
        row("IoU", scores.iou, format!("best single ellipse {:.4}", scores.best_ellipse_iou)),
        row("pixel accuracy", scores.pixel_accuracy, format!("empty picture {:.4}", scores.empty_accuracy)),
        row("Dice", scores.dice, String::new()),
        row("boundary F", scores.boundary_f, String::new()),
        row("blurred IoU", scores.blurred_iou.sixteenth, "blurred by 1/16 of the height".to_owned()),
        row("", scores.blurred_iou.thirty_second, "1/32".to_owned()),
        row("", scores.blurred_iou.sixty_fourth, "1/64".to_owned()),
        row(
            "Chamfer",
            scores.chamfer,
            "mean distance of the outlines, in image heights; 0 is best".to_owned(),
        ),
    ];
    output::table(&rows, &[1])
}

fn parts(likeness: &Likeness) -> String {
    let parts = Likeness::PARTS.iter().zip(likeness.parts());
    parts.map(|(name, part)| format!("{name} {part:.2}")).collect::<Vec<_>>().join(", ")
}
