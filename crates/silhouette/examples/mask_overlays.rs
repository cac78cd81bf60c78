//! Masks of all photographs of a folder, to be looked at: `NAME.png` shows the tree with the rest faded.
//!
//! ```text
//! cargo run --release -p pleach-silhouette --example mask_overlays -- PHOTOS OUT [BOXES.csv]
//! ```
//!
//! With a table of boxes, a line `NAME,x,y,width,height` in pixels for each photograph, the tree is looked for in its
//! box; names are compared by their beginning. Prints confidence, milliseconds and segmentation.

#![allow(clippy::print_stdout, reason = "an example's output")]

use pleach_silhouette::mask::{Mask, MaskOptions, Photo, PixelBox};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(photos), Some(out)) = (arguments.next(), arguments.next()) else {
        return Err("usage: mask_overlays PHOTOS OUT [BOXES.csv]".into());
    };
    let boxes = match arguments.next() {
        Some(path) => read_boxes(&std::fs::read_to_string(path)?)?,
        None => Vec::new(),
    };
    std::fs::create_dir_all(&out)?;
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(photos)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<_>>()?;
    paths.sort();
    for path in paths {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let region = boxes.iter().find(|(start, _)| name.starts_with(start.as_str())).map(|found| found.1);
        if region.is_none() && !boxes.is_empty() {
            continue;
        }
        let photo = Photo::load(&path)?;
        let start = Instant::now();
        let made = Mask::from_photo(&photo, &MaskOptions { region, ..MaskOptions::default() });
        let took = start.elapsed().as_secs_f64() * 1e3;
        match made {
            Ok(mask) => {
                println!("{name:.12} {:.3} {took:.0} ms {:?}", mask.confidence, mask.segmentation);
                let mut file = std::fs::File::create(Path::new(&out).join(format!("{name}.png")))?;
                mask.overlay(&photo).write_png(&mut file)?;
            }
            Err(error) => println!("{name:.12} {took:.0} ms {error}"),
        }
    }
    Ok(())
}

fn read_boxes(text: &str) -> Result<Vec<(String, PixelBox)>, Box<dyn Error>> {
    let mut found = Vec::new();
    for line in text.lines().filter(|line| !line.trim().is_empty()) {
        let mut cells = line.split(',').map(str::trim);
        let name = cells.next().unwrap_or_default().to_owned();
        let numbers = cells.map(str::parse).collect::<Result<Vec<u32>, _>>()?;
        let &[x, y, width, height] = numbers.as_slice() else {
            return Err(format!("{line}: expected NAME,x,y,width,height").into());
        };
        found.push((name, PixelBox { x, y, width, height }));
    }
    Ok(found)
}
