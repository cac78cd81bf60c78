//! `pleach score`: how alike two silhouettes are.

use crate::{input, output};
use anyhow::ensure;
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::score::ScoreCard;
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
    let mut last = "";
    let shown = ScoreCard::COLUMNS.iter().filter(|column| !column.is_baseline);
    let rows: Vec<Vec<String>> = shown
        .map(|column| {
            let words = if column.words == last { "" } else { column.words };
            last = column.words;
            vec![words.to_owned(), format!("{:.4}", (column.value)(scores)), (column.note)(scores)]
        })
        .collect();
    output::table(&rows, &[1])
}
