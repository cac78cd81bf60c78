//! What a fit says at its end.

use super::names::RUNS;
use super::run_folder::names::{POSTERIOR_SHEET, SHEET};
use super::{individual, judged, posterior, several, views};
use pleach::{FitReport, NextStep};
use pleach_fit::{AssessmentSettings, References};
use std::path::Path;

/// The score card that ends a fit, the verdict, and what to do next. `goal` is the picture and `folder`
/// the run folder, as they were given.
pub(super) fn report(summary: &FitReport, goal: &Path, folder: &Path) -> String {
    let mut judged = String::new();
    judged.extend(summary.views.iter().map(|view| views::line("view", view)));
    judged.extend(summary.holdout_views.iter().map(|view| views::line("held out", view)));
    if let Some(fresh) = &summary.fresh_seeds {
        judged += &format!(
            "{} other seeds{}: likeness {:.3} ± {:.3}, IoU {:.3} ± {:.3}, {:.2} ± {:.2} % of pixels (an empty \
             picture {:.2} %)\n",
            fresh.count,
            if fresh.count < AssessmentSettings::default().seeds {
                " (there was time for no more)"
            } else {
                ""
            },
            fresh.likeness.mean,
            fresh.likeness.sd,
            fresh.iou.mean,
            fresh.iou.sd,
            100.0 * fresh.pixel_accuracy.mean,
            100.0 * fresh.pixel_accuracy.sd,
            100.0 * (1.0 - summary.search.goal_ink),
        );
    }
    if let Some(references) = &summary.references {
        judged += &beside(references);
    }
    judged += &judged::said(summary);
    let mut individual =
        summary.individual.as_ref().map_or_else(String::new, |one| individual::beside(one, &summary.scores));
    let mut tree = String::new();
    if summary.individual.is_some() {
        tree += &format!("tree     {}\n", folder.join("individual.toml").display());
    }
    if let Some(sides) = &summary.individuals {
        individual += &several::line(sides);
        tree += &format!("trees    {}\n", folder.join(SHEET).display());
    }
    let mut posterior = summary.posterior.as_ref().map_or_else(String::new, posterior::said);
    if summary.posterior.is_none() && summary.options.posterior.is_some() && summary.finished {
        posterior =
            "\nno interval is known: too few trees around the species of the start grow and are seen\n"
                .to_owned();
    }
    if summary.posterior.as_ref().is_some_and(|known| !known.samples.is_empty()) {
        tree += &format!("samples  {}\n", folder.join(POSTERIOR_SHEET).display());
    }
    let rules = summary.rules.as_ref();
    let rules = rules.map_or_else(String::new, |rules| {
        format!("the grammar, of {} words and signs:\n\n{}\n", rules.grammar_length, rules.grammar)
    });
    format!(
        "{rules}{}\n\n{}{judged}{individual}{posterior}{}{}\n{}species  {}\n{tree}overlay  {}",
        crate::commands::score::card(&summary.scores),
        sizes(summary),
        work(summary),
        times(summary),
        verdict(summary, goal, folder),
        folder.join("best.toml").display(),
        folder.join("overlay.png").display(),
    )
}

/// What other trees and no tree would have.
fn beside(references: &References) -> String {
    let mut others = Vec::new();
    if let (Some(one), Some(species)) = (references.same_species, &references.species) {
        others.push(("another tree of the species".to_owned(), one, format!(" ({species})")));
    }
    if let Some(other) = references.other_species {
        others.push(("of another species".to_owned(), other, String::new()));
    }
    others.push(("an ellipse".to_owned(), references.best_ellipse, String::new()));
    let said: Vec<String> = others
        .into_iter()
        .map(|(what, of, note)| format!("{what} {:.2}, IoU {:.2}{note}", of.likeness, of.iou))
        .collect();
    format!("for this goal, about: {}\n", said.join("; "))
}

/// So many differences between goal and tree are said below the verdict; all are in the summary.
const SHOWN: usize = 3;

/// So many next steps.
const STEPS: usize = 3;

/// The verdict, in what tree and goal differ, and the next commands, each on its line; nothing where there is nothing to
/// compare with.
fn verdict(summary: &FitReport, goal: &Path, folder: &Path) -> String {
    let Some(verdict) = &summary.verdict else { return String::new() };
    let mut fit = format!("pleach fit {}", quoted(goal));
    // Where it would be written anyway, nothing needs to be said.
    let usual = Path::new(RUNS).join(goal.file_stem().unwrap_or_default());
    if folder != usual {
        fit += &format!(" --out {}", quoted(folder));
    }
    let best = quoted(&folder.join("best.toml"));
    let command = |step: &NextStep| {
        let command = match step {
            NextStep::GrowMore => {
                return format!("twenty more trees: pleach grow {best} --seeds 0..20 -o forest/");
            }
            NextStep::EverySeed => format!("{fit} --robust 4 --timeout 5m --overwrite"),
            NextStep::CorrectMask => {
                format!("pleach mask {} -o mask.png --overlay look.png", quoted(goal))
            }
            NextStep::Leafy => format!("{fit} --leaves on --overwrite"),
            NextStep::Bare => format!("{fit} --leaves off --overwrite"),
            NextStep::CorrectReading => format!("pleach read {}", quoted(goal)),
            NextStep::AnyFamily => format!("{fit} --generator auto --overwrite"),
            NextStep::SearchLonger => format!("{fit} --continue --timeout 5m"),
            NextStep::TellHeight => format!("{fit} --height METRES --overwrite"),
            // What is not known here yet is only named.
            _ => return step.to_string(),
        };
        format!("{step}: {command}")
    };
    let next: Vec<String> = summary.next.iter().take(STEPS).map(command).collect();
    let next = next.join("\n         ");
    let differences: String =
        summary.readings.differences.iter().take(SHOWN).map(|one| format!("         {one}\n")).collect();
    format!("verdict  {verdict}\n{differences}next     {next}\n\n")
}

/// As a shell takes it for one word.
fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+,:@%=".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        text
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

/// At what size the score card compares, and what the search saw at its own if that is another: the
/// numbers of a sparse crown differ by as much as a tenth, though the tree is the same.
fn sizes(summary: &FitReport) -> String {
    let FitReport { compared_width: width, compared_height: height, search, .. } = summary;
    if (*width, *height) == (search.goal_width, search.goal_height) {
        return format!("compared at {width} × {height} pixels, as in the search\n");
    }
    format!(
        "compared at {width} × {height} pixels, the goal {:.1} % ink; searched, and other seeds \
         compared,\nat {} × {} (--size), the goal {:.1} % ink: there the IoU is {:.4}\n",
        100.0 * summary.scores.goal_crown.ink,
        search.goal_width,
        search.goal_height,
        100.0 * search.goal_ink,
        search.iou,
    )
}

/// How many trees the search has tried, how fast, and why it ended.
fn work(summary: &FitReport) -> String {
    let seconds = summary.search_seconds;
    format!(
        "{} in {seconds:.1} s ({}) by `{}`; {}\n",
        trees(summary.evaluations),
        rate(summary.evaluations as f64 / seconds.max(1e-9)),
        summary.optimizer,
        summary.stopped_by,
    )
}

/// Where the time has gone.
fn times(summary: &FitReport) -> String {
    let guess = (summary.from == "auto" && summary.rules.is_none())
        .then(|| format!("first guess {:.1} s", summary.first_guess_seconds));
    let search = Some(format!("search {:.1} s", summary.search_seconds));
    let judging = summary.judging_seconds.map(|seconds| format!("judging {seconds:.1} s"));
    let individual = summary.individual.as_ref().map(|one| format!("this very tree {:.1} s", one.seconds));
    let parts: Vec<String> = [guess, search, judging, individual].into_iter().flatten().collect();
    parts.join(", ") + "\n"
}

/// `1 tree`, `2 trees`.
pub(super) fn trees(count: u64) -> String {
    format!("{count} {}", if count == 1 { "tree" } else { "trees" })
}

/// Trees per second, to two digits or whole numbers.
pub(super) fn rate(per_second: f64) -> String {
    let digits = match per_second {
        r if r >= 9.95 => 0,
        r if r >= 0.095 => 1,
        _ => 2,
    };
    format!("{per_second:.digits$} trees/s")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_and_counts_read_well() {
        assert_eq!((trees(1), trees(0), trees(4)), ("1 tree".into(), "0 trees".into(), "4 trees".into()));
        let rates = [0.0123, 1.0 / 3.0, 9.94, 9.96, 257.4].map(rate);
        assert_eq!(rates, ["0.01 trees/s", "0.3 trees/s", "9.9 trees/s", "10 trees/s", "257 trees/s"]);
    }

    #[test]
    fn paths_are_quoted_where_a_shell_needs_it() {
        let quoted = |path: &str| quoted(Path::new(path));
        assert_eq!(quoted("runs/oak_2/best.toml"), "runs/oak_2/best.toml");
        assert_eq!(quoted("my trees/a.png"), "'my trees/a.png'");
        assert_eq!(quoted("it's; rm -r"), r"'it'\''s; rm -r'");
    }
}
