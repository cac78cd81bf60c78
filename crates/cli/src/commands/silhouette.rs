//! `pleach silhouette`: the binary picture of a tree.

use crate::input::{LeafArgs, LimitArgs};
use crate::{files, input, output};
use anyhow::{Context, bail};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View, four_views};
use pleach_tree::{Growth, Parts};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  pleach silhouette acer                      drawn in the terminal
  pleach silhouette acer --seed 7 -o acer.png
  pleach silhouette acer --view 90,20 --no-leaves -o side.png
  pleach silhouette acer --four-views -o four.png
  pleach silhouette acer -o - > acer.png      to standard output

The PNG is black on white, one bit per pixel. The ground is the bottom edge, the trunk's foot is in the \
middle, and the larger of height and width fills 95 % of the picture. Azimuth 0 looks along +y with +x \
to the right.

With --four-views the quarters of the picture show the tree from the south (azimuth 0), the south-east (45) \
and the east (90), and from above with north at the top, all at one scale; +x is east, +y north.";

/// Draw the binary picture of a tree
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Silhouette {
    /// A species, by name or file; `-` reads the file from standard input
    species: String,
    /// Seed of the tree; the species file's own, or 1, by default
    #[arg(long, value_name = "N", value_parser = input::seed)]
    seed: Option<u64>,
    /// Height and width in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 512, value_parser = clap::value_parser!(u32).range(8..=8192))]
    size: u32,
    /// Direction of view in degrees: azimuth, and elevation where it is not 0
    #[arg(long, value_name = "AZ[,EL]", default_value = "0", allow_hyphen_values = true, value_parser = input::view)]
    view: View,
    /// Four views in one picture: from the south, the south-east, the east and above
    #[arg(long, conflicts_with = "view")]
    four_views: bool,
    #[command(flatten)]
    leaves: LeafArgs,
    /// Draw roots too, where the generator grows any
    #[arg(long)]
    roots: bool,
    /// The PNG to write, or `-` for standard output; without it the picture is drawn in the terminal
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    limits: LimitArgs,
}

impl Silhouette {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let species = input::species(&self.species)?;
        let seed = self.seed.or(species.tree_seed).unwrap_or(1);
        let foliage = self.leaves.foliage(&species);
        input::note_leafless(&species, foliage);
        let growth = Growth { limits: self.limits.limits(), foliage, parallel: true, ..Growth::seed(seed) };
        let tree = species
            .grow_with(&growth)
            .with_context(|| format!("{} does not grow from seed {seed}", species.name))?;

        let parts = Parts::from(foliage);
        let parts = if self.roots { parts | Parts::ROOTS } else { parts };
        let draw = |size: u32| {
            if self.four_views {
                return four_views(&tree, parts, size);
            }
            let frame = Frame::automatic(&tree, &self.view, parts, size, size);
            let mut bitmap = Bitmap::default();
            Rasterizer::new().draw(&tree, &self.view, &frame, parts, &mut bitmap);
            bitmap
        };
        let Some(path) = &self.out else {
            return output::line(in_characters(&draw(160)));
        };
        let png = path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("png"));
        if !png && !files::is_stdout(path) {
            bail!("{} is not a .png: silhouettes are written as PNG", path.display());
        }
        let bitmap = draw(self.size);
        files::write_out(path, |mut out| Ok(bitmap.write_png(&mut out)?))?;
        output::wrote(path);
        Ok(())
    }
}

/// Two by four pixels per character, as Braille dots: a terminal's finest picture.
fn in_characters(bitmap: &Bitmap) -> String {
    /// Bits of a Braille pattern by row and column.
    const DOTS: [[u32; 2]; 4] = [[0, 3], [1, 4], [2, 5], [6, 7]];
    let mut lines = Vec::new();
    for y in (0..bitmap.height()).step_by(4) {
        let mut line = String::new();
        for x in (0..bitmap.width()).step_by(2) {
            let mut bits = 0;
            for (dy, row) in (0..).zip(DOTS) {
                for (dx, bit) in (0..).zip(row) {
                    bits |= u32::from(bitmap.get(x + dx, y + dy)) << bit;
                }
            }
            line.push(if bits == 0 { ' ' } else { char::from_u32(0x2800 + bits).unwrap_or(' ') });
        }
        lines.push(line.trim_end().to_owned());
    }
    lines.join("\n")
}
