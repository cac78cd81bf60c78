//! `pleach mask`: from a photograph to the silhouette of the tree in it.

use super::fit::places;
use crate::{files, output};
use anyhow::{Context, bail};
use pleach_silhouette::goal::Goal;
use pleach_silhouette::mask::{Background, Mask, MaskOptions, Means, Photo};
use serde::Serialize;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach mask oak.jpg -o oak.png --overlay look.png   and look at what was found
  pleach mask oak.jpg -o oak.png --seed-point 800,420  the tree at that pixel, not the largest one
  pleach mask shed.jpg -o tree.png --background plain  a tree before an even wall
  pleach mask oak.jpg -o oak.png && pleach fit oak.png
  pleach fit oak.jpg --mask auto                      the same in one go

The tree is what differs from the background, and that is what the picture's edges show: a sky, with
or without a ground below it, or a wall. Houses, hills, shadows and other trees are taken for tree.
A picture with an alpha channel is its own mask.";

/// Make a silhouette from a photograph
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct MaskCommand {
    /// The photograph: PNG, JPEG or WebP
    photo: PathBuf,
    /// The mask to write: a PNG of the photograph's size, black tree on white, one bit a pixel
    #[arg(short, long, value_name = "FILE")]
    out: PathBuf,
    /// Also write the photograph with all but the tree faded, as PNG
    #[arg(long, value_name = "FILE")]
    overlay: Option<PathBuf>,
    /// What is behind the tree
    #[arg(long, value_enum, default_value_t = Behind::Auto)]
    background: Behind,
    /// A pixel on the tree: column from the left and row from the top, from 0. By default the largest
    /// thing is the tree
    #[arg(long, value_name = "X,Y", value_parser = point)]
    seed_point: Option<(u32, u32)>,
    /// Fill holes of up to this many pixels; 1 of 100,000 of the picture's by default
    #[arg(long, value_name = "PIXELS")]
    fill_holes: Option<u64>,
    /// Print what was found as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Behind {
    /// Sky and ground if colours step clearly at the sides, else plain
    Auto,
    /// A sky, probably with a ground below it: a faint step at the sides is enough
    Sky,
    /// One smooth background all around
    Plain,
}

fn point(text: &str) -> Result<(u32, u32), String> {
    text.split_once(',')
        .and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)))
        .ok_or_else(|| "expected X,Y in whole pixels, such as 800,420".to_owned())
}

/// What was found, as JSON.
#[derive(Debug, Serialize)]
struct Found {
    width: u32,
    height: u32,
    ink: f64,
    ground_row: f64,
    axis_column: f64,
    top_row: f64,
    by: &'static str,
    threshold: Option<f64>,
    horizon_rows: Option<[f64; 2]>,
    dropped_pixels: u64,
    filled_pixels: u64,
    touches: Vec<&'static str>,
}

impl MaskCommand {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let outputs: Vec<&Path> = std::iter::once(&self.out).chain(&self.overlay).map(|p| &**p).collect();
        for path in &outputs {
            if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("png")) {
                bail!("{} is no .png: pictures are written as PNG", path.display());
            }
            if same_file(path, &self.photo) {
                bail!("{} is the photograph itself: choose another name", path.display());
            }
        }
        if let [mask, overlay] = outputs[..]
            && mask == overlay
        {
            bail!("mask and overlay would both be {}", mask.display());
        }
        let photo = Photo::load(&self.photo)?;
        let options = MaskOptions {
            background: match self.background {
                Behind::Auto => Background::Auto,
                Behind::Sky => Background::Sky,
                Behind::Plain => Background::Plain,
            },
            seed_point: self.seed_point,
            fill_holes: self.fill_holes,
        };
        let mask = Mask::of(&photo, &options).with_context(|| cannot(&self.photo))?;
        let goal = Goal::from_bitmap(mask.bitmap.clone()).with_context(|| cannot(&self.photo))?;
        files::write_whole(&self.out, |file| Ok(mask.bitmap.write_png(file)?))?;
        if let Some(path) = &self.overlay {
            let overlay = mask.overlay(&photo);
            files::write_whole(path, |file| Ok(overlay.write_png(file)?))?;
        }
        if self.json {
            output::json(&found(&mask, &goal))?;
        } else {
            output::line(format!("{}\n{}\n{}", means(&mask), places(&goal), edges(&mask)))?;
        }
        for path in outputs {
            output::note(format!("wrote {}", path.display()));
        }
        Ok(())
    }
}

/// What could not be done.
pub(super) fn cannot(photo: &Path) -> String {
    format!("cannot make a mask of {}", photo.display())
}

/// Whether both paths lead to one file that is there.
fn same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// How the tree was told from the background.
pub(super) fn means(mask: &Mask) -> String {
    match mask.means {
        Means::Opacity => "the picture has an alpha channel: the tree is what is opaque".to_owned(),
        Means::Colour { threshold, horizon } => {
            let behind = horizon.map_or_else(
                || "one background".to_owned(),
                |h| format!("sky down to row {:.0}, ground below", (h.left + h.right) / 2.0),
            );
            format!(
                "{behind}; the tree is what is more than {threshold:.1} spreads away in colour\n\
                 {} other pixels dropped, {} in small holes filled",
                mask.dropped, mask.filled
            )
        }
    }
}

fn sides(mask: &Mask) -> Vec<&'static str> {
    let touches = mask.touches;
    [(touches.left, "left"), (touches.top, "top"), (touches.right, "right")]
        .into_iter()
        .filter_map(|(touches, name)| touches.then_some(name))
        .collect()
}

fn edges(mask: &Mask) -> String {
    match &sides(mask)[..] {
        [] => "the crown is all in the picture".to_owned(),
        sides => format!("the crown touches the frame: {}; what lies beyond is not seen", sides.join(", ")),
    }
}

fn found(mask: &Mask, goal: &Goal) -> Found {
    let (by, threshold, horizon) = match mask.means {
        Means::Opacity => ("opacity", None, None),
        Means::Colour { threshold, horizon } => ("colour", Some(threshold), horizon),
    };
    Found {
        width: mask.bitmap.width(),
        height: mask.bitmap.height(),
        ink: mask.bitmap.ink() as f64 / mask.bitmap.area() as f64,
        ground_row: goal.ground_row,
        axis_column: goal.axis_column,
        top_row: goal.top_row,
        by,
        threshold,
        horizon_rows: horizon.map(|h| [h.left, h.right]),
        dropped_pixels: mask.dropped,
        filled_pixels: mask.filled,
        touches: sides(mask),
    }
}
