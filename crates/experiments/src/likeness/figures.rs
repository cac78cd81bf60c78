//! The sheet of ranked pictures, and the curves of the walks.

use super::super::plot::{Plot, Scale};
use super::blobs::{self, BLOBS};
use super::line::Line;
use super::measures::{self, MEASURES, Seen};
use super::pictures;
use super::walk::STEP;
use super::{LikenessSpec, Outputs, species};
use anyhow::Context;
use pleach_silhouette::picture;

/// Pictures in a row of the sheet, the goal among them.
const COLUMNS: usize = 8;

/// Measures whose curves are drawn.
pub(super) const CURVES: [&str; 2] = ["likeness", "iou"];
pub(super) const SHEET: &str = "sheet.png";

pub(super) fn curve_file(measure: &str) -> String {
    format!("walk-{measure}.svg")
}

/// For some goals, what comes first by likeness and what by IoU among trees of all species and the
/// goal's blobs.
pub(super) fn sheet(outputs: &Outputs, spec: &LikenessSpec) -> anyhow::Result<()> {
    let tuned = **spec.tuned_seeds.get_ref();
    let seed = tuned + 1;
    let trees = pictures::draw(&species(&spec.species)?, seed + 1, true)?;
    let mut cells = Vec::new();
    for name in &spec.sheet {
        let name = name.get_ref();
        let goal = trees
            .iter()
            .find(|d| d.species == *name && d.seed == seed)
            .with_context(|| format!("`{name}` is not among the species"))?;
        let others = trees.iter().filter(|d| d.seed > tuned && !(d.species == *name && d.seed == seed));
        let mut candidates: Vec<(String, &Seen)> =
            others.map(|d| (format!("{} {}", d.species.replace('_', " "), d.seed), &d.seen)).collect();
        let shapes = blobs::blobs_like(&goal.seen.bitmap).map(Seen::new);
        candidates.extend(BLOBS.iter().map(|s| (*s).to_owned()).zip(&shapes));
        for (m, head) in [(0, "by likeness"), (1, "by IoU")] {
            cells.push((format!("goal {}, {head}", name.replace('_', " ")), goal.seen.bitmap.clone()));
            let mut ranked: Vec<(f64, &str, &Seen)> = candidates
                .iter()
                .map(|(label, seen)| (measures::compare(seen, &goal.seen)[m], label.as_str(), *seen))
                .collect();
            ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
            let best = ranked.into_iter().take(COLUMNS - 1);
            cells.extend(
                best.map(|(value, label, seen)| (format!("{value:.2} {label}"), seen.bitmap.clone())),
            );
        }
    }
    let sheet = picture::sheet(&cells, COLUMNS);
    outputs.picture(SHEET, &sheet)
}

/// Likeness and IoU over the distance from the truth, a line a parameter, the mean over species.
pub(super) fn curves(outputs: &Outputs, lines: &[Line], spec: &LikenessSpec) -> anyhow::Result<()> {
    for measure in CURVES {
        let m = MEASURES.iter().position(|name| *name == measure).context("a measure")?;
        let mut plot = Plot::new("% away from the true value", measure, Scale::Linear, Scale::Linear);
        for parameter in &spec.walks {
            let parameter = parameter.get_ref();
            let mut points = vec![(0.0, 1.0)];
            for sign in [-1.0, 1.0] {
                let of: Vec<&Line> =
                    lines.iter().filter(|l| l.parameter == *parameter && l.sign == sign).collect();
                for step in 1..=*spec.walk_steps as u32 {
                    let at = of.iter().flat_map(|l| l.walk.iter().filter(|(s, _)| *s == step));
                    let values: Vec<f64> = at.map(|(_, values)| values[m]).collect();
                    // A mean over half of the species would jump where the others stop.
                    if !values.is_empty() && values.len() == of.len() {
                        let mean = values.iter().sum::<f64>() / values.len() as f64;
                        points.push((100.0 * STEP * sign * f64::from(step), mean));
                    }
                }
            }
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            plot.line(parameter, &points, false);
        }
        outputs.text(&curve_file(measure), &plot.svg())?;
    }
    Ok(())
}
