//! The summary: medians of each set, and whether the program's own numbers agree with a person.

use super::eye::Eye;
use super::row::{Row, Which};
use super::verdict::rank;
use crate::spearman::spearman;
use pleach_console::output;

/// A number of a row, if it has one.
type Column = fn(&Row) -> Option<f64>;

/// What medians are taken of: name, decimals, value. Of ratios it is the factor by which they are off, either way.
const SHOWN: [(&str, usize, Column); 12] = [
    ("IoU", 3, |row| Some(row.iou.0)),
    ("crown IoU", 3, |row| Some(row.crown_iou.0)),
    ("left off", 3, |row| Some(row.left_off.0)),
    ("right off", 3, |row| Some(row.right_off.0)),
    ("boundary F", 3, |row| Some(row.boundary_f.0)),
    ("crown F", 3, |row| Some(row.crown_f.0)),
    ("likeness", 3, |row| Some(row.likeness.0)),
    ("width ×", 2, |row| Some(factor(row.width.0))),
    ("trunk ×", 2, |row| Some(factor(row.trunk?.0))),
    ("lean off", 1, |row| Some(row.lean_off?.0)),
    ("fork off", 3, |row| Some(row.fork_off?.0)),
    ("ellipse", 3, |row| Some(row.best_ellipse_iou.0)),
];

/// What a person's scores are compared with: name, value of a row.
const AGREE: [(&str, Column); 7] = [
    ("IoU", |row| Some(row.iou.0)),
    ("crown IoU", |row| Some(row.crown_iou.0)),
    ("boundary F", |row| Some(row.boundary_f.0)),
    ("crown F", |row| Some(row.crown_f.0)),
    ("likeness", |row| Some(row.likeness.0)),
    ("verdict", |row| rank(if row.which == Which::Kind { &row.kind_verdict } else { &row.tree_verdict })),
    ("share", |row| Some(row.share?.0)),
];

/// By which factor a ratio is off 1.
fn factor(ratio: f64) -> f64 {
    ratio.max(1.0 / ratio.max(1e-9))
}

pub(super) fn report(sets: &[&str], rows: &[Row], eyes: &[Eye]) -> String {
    let head = ["set", "tree", "pictures"].into_iter().chain(SHOWN.map(|shown| shown.0));
    let mut lines: Vec<Vec<String>> =
        vec![head.chain(["same feet", "above ellipse"]).map(str::to_owned).collect()];
    for (set, which) in sets.iter().flat_map(|set| Which::ALL.map(|which| (set, which))) {
        let of: Vec<&Row> = rows.iter().filter(|row| row.set == **set && row.which == which).collect();
        if of.is_empty() {
            continue;
        }
        let mut line = vec![(*set).to_owned(), which.name().to_owned(), of.len().to_string()];
        line.extend(SHOWN.map(|(_, decimals, column)| {
            let median = median(of.iter().filter_map(|row| column(row)).collect());
            median.map_or_else(String::new, |median| format!("{median:.decimals$}"))
        }));
        let feet: f64 = of.iter().map(|row| row.same_feet.0).sum();
        line.push(format!("{:.0} %", 100.0 * feet / of.len() as f64));
        line.push(of.iter().filter(|row| row.iou.0 > row.best_ellipse_iou.0).count().to_string());
        lines.push(line);
    }
    let medians = output::table(&lines, &(2..lines[0].len()).collect::<Vec<_>>());
    format!(
        "medians of each set; × is the factor by which a ratio is off\n\n{medians}{}{}",
        verdicts(sets, rows),
        agreement(sets, rows, eyes)
    )
}

/// How often each verdict is given on the kinds of a set.
fn verdicts(sets: &[&str], rows: &[Row]) -> String {
    let mut text = String::new();
    for set in sets {
        let kinds = || rows.iter().filter(|row| row.set == **set && row.which == Which::Kind);
        let mut words: Vec<&str> = kinds().map(|row| row.kind_verdict.as_str()).collect();
        words.sort_by(|a, b| rank(b).partial_cmp(&rank(a)).unwrap_or(std::cmp::Ordering::Equal));
        words.dedup();
        let count = |word: &&str| kinds().filter(|row| row.kind_verdict == **word).count();
        let said: Vec<String> = words
            .iter()
            .map(|word| {
                format!("{} {}", count(word), if word.is_empty() { "without a verdict" } else { word })
            })
            .collect();
        text += &format!("\nkinds of {set}: {}", said.join(", "));
    }
    format!("\n{text}")
}

/// The rank correlation of a person's scores with the numbers of the rows; empty without scores.
fn agreement(sets: &[&str], rows: &[Row], eyes: &[Eye]) -> String {
    let head = ["set", "tree", "scored"].into_iter().chain(AGREE.map(|agree| agree.0));
    let mut lines: Vec<Vec<String>> = vec![head.map(str::to_owned).collect()];
    for set in sets {
        for (which, score) in
            [(Which::Kind, (|eye| eye.kind) as fn(&Eye) -> Option<f64>), (Which::Tree, |eye| eye.tree)]
        {
            let scored: Vec<(&Row, f64)> = rows
                .iter()
                .filter(|row| row.set == **set && row.which == which)
                .filter_map(|row| Some((row, score(eyes.iter().find(|eye| eye.picture == row.picture)?)?)))
                .collect();
            if scored.is_empty() {
                continue;
            }
            let mut line = vec![(*set).to_owned(), which.name().to_owned(), scored.len().to_string()];
            line.extend(AGREE.map(|(_, column)| {
                let pairs: Vec<(f64, f64)> =
                    scored.iter().filter_map(|(row, score)| Some((column(row)?, *score))).collect();
                spearman(&pairs).map_or_else(String::new, |rho| format!("{rho:.2}"))
            }));
            lines.push(line);
        }
    }
    if lines.len() == 1 {
        return String::new();
    }
    let table = output::table(&lines, &(2..lines[0].len()).collect::<Vec<_>>());
    format!("\n\nrank correlation with a person's scores\n\n{table}")
}

/// The middle value, or the mean of the two in the middle.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = *values.get(values.len() / 2)?;
    Some(f64::midpoint(values[(values.len() - 1) / 2], upper))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Fixed;

    fn row(picture: &str, set: &str, which: Which, iou: f64, verdict: &str) -> Row {
        Row {
            picture: picture.to_owned(),
            set: set.to_owned(),
            which,
            iou: Fixed(iou),
            width: Fixed(0.5),
            kind_verdict: verdict.to_owned(),
            best_ellipse_iou: Fixed(0.6),
            ..Row::default()
        }
    }

    #[test]
    fn sets_are_kept_apart_and_scores_are_compared() {
        let roughly = "roughly of its kind";
        let rows = [
            row("a", "tuned", Which::Kind, 0.4, roughly),
            row("b", "tuned", Which::Kind, 0.5, "of its kind"),
            row("c", "tuned", Which::Kind, 0.9, roughly),
            row("d", "judged", Which::Kind, 0.1, ""),
            row("d", "judged", Which::Tree, 0.2, ""),
        ];
        let text = report(&["tuned", "judged"], &rows, &[]);
        let line = |text: &str, start: &[&str]| {
            let lines = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
            lines.into_iter().find(|words| words.starts_with(start)).unwrap_or_default().join(" ")
        };
        assert!(line(&text, &["tuned", "kind"]).starts_with("tuned kind 3 0.500 "), "{text}");
        assert!(line(&text, &["tuned", "kind"]).ends_with(" 2.00 0.600 0 % 1"), "{text}");
        assert!(line(&text, &["judged", "tree"]).starts_with("judged tree 1 0.200 "), "{text}");
        assert!(text.contains("kinds of tuned: 1 of its kind, 2 roughly of its kind\n"), "{text}");
        assert!(text.contains("kinds of judged: 1 without a verdict"), "{text}");
        assert!(!text.contains("person"), "{text}");

        let eye =
            |picture: &str, kind: f64| Eye { picture: picture.to_owned(), kind: Some(kind), tree: None };
        let text = report(&["tuned", "judged"], &rows, &[eye("a", 1.0), eye("b", 2.0), eye("c", 4.0)]);
        let said = text.split_once("person").unwrap().1;
        assert!(line(said, &["tuned", "kind"]).starts_with("tuned kind 3 1.00"), "{text}");
        assert!(!said.contains("judged"), "{text}");
    }
}
