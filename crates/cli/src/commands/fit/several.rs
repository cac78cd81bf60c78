//! Several trees that all lie on one goal: `--individuals`.

use super::drawing::{Drawing, Drawn};
use super::run_folder::Claim;
use super::summary::write_species;
use crate::files;
use pleach_fit::FoundIndividual;
use pleach_silhouette::picture::{self, Picture};
use pleach_silhouette::score::{ScoreCard, blurred_iou};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Foliage, Growth, Limits, Species, Tree};
use serde::Serialize;

/// The contact sheet.
pub(super) const SHEET: &str = "individuals.png";
/// Trees in a row of the sheet, each with its view from the side.
const TREES_IN_A_ROW: usize = 4;
/// The direction of the view from the side.
const SIDE: f64 = 90.0;
/// How far the seeds of free trees are from the kind's own: beyond those that it was judged by.
const FIRST_FREE: u64 = 3000;
/// Longer side of a picture over the blur that side views are compared with.
const BLUR: f64 = 64.0;
const INK: [u8; 3] = [0; 3];

/// What `summary.json` says of several trees.
#[derive(Debug, Serialize)]
pub(super) struct Several {
    trees: Vec<One>,
    /// The mean blurred IoU (1/64) of every two of their views from the side: 1 where they are one tree.
    side_blurred_iou: f64,
    /// The same of as many free trees of the kind.
    free_side_blurred_iou: f64,
}

#[derive(Debug, Serialize)]
struct One {
    file: String,
    stems: usize,
    iou: f64,
    likeness: f64,
    boundary_f: f64,
}

impl Several {
    /// In a line.
    pub(super) fn line(&self) -> String {
        let least = |of: fn(&One) -> f64| self.trees.iter().map(of).fold(1.0, f64::min);
        format!(
            "{} trees lie on the goal with IoU {:.3} or more and likeness {:.3} or more; from the side every two of \
             them share {:.0} % (blurred IoU), free trees of the kind {:.0} %\n",
            self.trees.len(),
            least(|one| one.iou),
            least(|one| one.likeness),
            100.0 * self.side_blurred_iou,
            100.0 * self.free_side_blurred_iou
        )
    }
}

/// The file of a tree, the best of which is number 0.
fn file(number: usize) -> String {
    if number == 0 { "individual.toml".to_owned() } else { format!("individual-{}.toml", number + 1) }
}

/// Whether a file of this name is one tree of several.
pub(super) fn is_file(name: &str) -> bool {
    let number = name.strip_prefix("individual-").and_then(|rest| rest.strip_suffix(".toml"));
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
}

/// Writes the species files of all trees but the first, which is `first`, and a sheet of all; nothing if there is
/// but one.
pub(super) fn write(
    claim: &Claim,
    drawing: &Drawing<'_>,
    found: &[FoundIndividual],
    first: &Drawn,
    kind: &Species,
) -> anyhow::Result<Option<Several>> {
    if found.len() < 2 {
        return Ok(None);
    }
    let goal = &drawing.goals.working;
    let frame = drawing.problem.goals[0].registered.frame(&goal.frame(drawing.args.height));
    let mut pen = Pen::new(drawing, &frame);
    let (mut cells, mut sides, mut trees) = (Vec::new(), Vec::new(), Vec::new());
    for (number, one) in found.iter().enumerate() {
        let grown;
        let drawn = if number == 0 {
            first
        } else {
            grown = drawing.draw_individual(one)?;
            &grown
        };
        let front = pen.draw(&drawn.tree, &drawing.view, &frame);
        let side = pen.draw_side(&drawn.tree);
        let card = ScoreCard::new(&front, &goal.bitmap)?;
        let (file, stems) = (file(number), one.individual().len());
        if number > 0 {
            let comment =
                format!("A tree on the same goal as individual.toml: {stems} stems have draws of their own.");
            write_species(&claim.file(&file), &drawn.species, &[comment])?;
        }
        let label = format!("{}  IoU {:.3}, likeness {:.3}", number + 1, card.iou, card.likeness);
        cells.push((label, picture::overlay(&front, &goal.bitmap)));
        let mut turned = Picture::new(side.width(), side.height());
        turned.stamp(&side, 0, 0, INK);
        cells.push((format!("{}  from the side", number + 1), turned));
        let ScoreCard { iou, likeness, boundary_f, .. } = card;
        trees.push(One { file, stems, iou, likeness, boundary_f });
        sides.push(side);
    }
    let cells: Vec<(&str, Picture)> =
        cells.iter().map(|(label, picture): &(String, Picture)| (label.as_str(), picture.clone())).collect();
    let sheet = picture::sheet_of_pictures(&cells, 2 * TREES_IN_A_ROW.min(found.len()));
    files::write_whole(&claim.file(SHEET), |out| Ok(sheet.write_png(out)?))?;

    let own = kind.tree_seed.unwrap_or_default();
    let mut free = Vec::new();
    for seed in (0..found.len() as u64).map(|i| own.wrapping_add(FIRST_FREE + i)) {
        let growth =
            Growth { limits: Limits::default(), foliage: drawing.problem.foliage, ..Growth::seed(seed) };
        // One that is too large to grow says nothing of the others.
        if let Ok(tree) = kind.grow_with(&growth) {
            free.push(pen.draw_side(&tree));
        }
    }
    Ok(Some(Several { trees, side_blurred_iou: alike(&sides), free_side_blurred_iou: alike(&free) }))
}

/// Draws the trees of a sheet.
struct Pen {
    rasterizer: Rasterizer,
    foliage: Foliage,
    side: View,
    /// A square about the trunk: from the side a tree may be wider than its picture.
    side_frame: Frame,
}

impl Pen {
    fn new(drawing: &Drawing<'_>, front: &Frame) -> Self {
        let side = View { azimuth: drawing.view.azimuth + SIDE.to_radians(), ..drawing.view };
        let width = front.width.max(front.height);
        let side_frame = Frame { width, axis_column: f64::from(width) / 2.0, ..*front };
        Self { rasterizer: Rasterizer::new(), foliage: drawing.problem.foliage, side, side_frame }
    }

    fn draw(&mut self, tree: &Tree, view: &View, frame: &Frame) -> Bitmap {
        let mut bitmap = Bitmap::default();
        self.rasterizer.draw(tree, view, frame, self.foliage.into(), &mut bitmap);
        bitmap
    }

    fn draw_side(&mut self, tree: &Tree) -> Bitmap {
        let (side, frame) = (self.side, self.side_frame);
        self.draw(tree, &side, &frame)
    }
}

/// The mean blurred IoU of every two pictures; 1 of less than two.
fn alike(pictures: &[Bitmap]) -> f64 {
    let pairs = pictures.iter().enumerate().flat_map(|(i, a)| pictures[..i].iter().map(move |b| (a, b)));
    let (sum, count) = pairs.fold((0.0, 0), |(sum, count), (a, b)| {
        let sigma = f64::from(a.width().max(a.height())) / BLUR;
        (sum + blurred_iou(a, b, sigma), count + 1)
    });
    if count == 0 { 1.0 } else { sum / f64::from(count) }
}
