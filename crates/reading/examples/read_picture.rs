//! Reads pictures with an alpha channel, or dark on light, and draws what was read over them:
//! `cargo run --release -p pleach-reading --example read_picture -- OUT_FOLDER PICTURE…`.
#![allow(clippy::print_stdout, reason = "it is a program")]

use pleach_reading::{Reader, Reading, annotate};
use pleach_silhouette::Bitmap;
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("name a folder for the drawings, then pictures")?;
    let (mut reader, mut reading) = (Reader::new(), Reading::default());
    for path in arguments {
        let image = image::open(&path)?.to_rgba8();
        let has_alpha = image.pixels().any(|pixel| pixel.0[3] < 128);
        let picture = Bitmap::from_fn(image.width(), image.height(), |x, y| {
            let [red, green, blue, alpha] = image.get_pixel(x, y).0;
            let dark = u32::from(red) + u32::from(green) + u32::from(blue) < 384;
            if has_alpha { alpha >= 128 } else { dark }
        });
        reader.read(&picture, &mut reading);
        println!("{path}\n{reading}");
        for (name, value) in reader.evidence().values() {
            print!("{name} {value:.3}  ");
        }
        println!("\n");
        let name = Path::new(&path).file_stem().unwrap_or_default();
        let out = Path::new(&folder).join(name).with_extension("png");
        annotate(&picture, &reading).write_png(&mut std::fs::File::create(out)?)?;
    }
    Ok(())
}
