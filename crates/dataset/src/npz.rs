//! Shards of NumPy arrays: a zip file with an array for each name, stacked over the trees.

use crate::example::{Example, Seen};
use crate::npy::{self, Number};
use crate::options::{DatasetOptions, Layer};
use pleach_silhouette::Bitmap;
use std::io::{self, BufWriter, Seek, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipWriter};

/// How hard the compressor tries: pictures are mostly runs of one value, and more takes twice the time for a tenth of
/// the size.
const LEVEL: i64 = 1;
/// Bytes that are handed to the compressor at once.
const BUFFER: usize = 1 << 16;

/// Writes the arrays of a shard.
pub(crate) fn write(
    out: impl Write + Seek,
    options: &DatasetOptions,
    columns: usize,
    trees: &[Example],
) -> io::Result<()> {
    let mut file = Npz { zip: ZipWriter::new(out) };
    let count = trees.len() as u64;
    let (views, side) = (options.views.len() as u64, u64::from(options.size));
    let pictures = [count, views, side, side];
    let seen = || trees.iter().flat_map(|tree| &tree.views);
    file.array("species", &[count], trees.iter().map(|tree| tree.species))?;
    file.array("number", &[count], trees.iter().map(|tree| tree.number))?;
    file.array("tree_seed", &[count], trees.iter().map(|tree| tree.tree_seed))?;
    let numbers = trees.iter().flat_map(|tree| tree.numbers.iter().copied());
    file.array("numbers", &[count, columns as u64], numbers)?;
    file.array("meters_per_pixel", &[count, views], seen().map(|view| view.meters_per_pixel))?;
    file.pictures("silhouettes", &pictures, seen(), |view| &view.silhouette)?;
    if options.has(Layer::Wood) {
        file.pictures("wood", &pictures, seen(), |view| &view.wood)?;
    }
    if options.has(Layer::Depth) {
        file.array("depth", &pictures, seen().flat_map(|view| view.depth.iter().copied()))?;
    }
    if options.has(Layer::Skeleton) {
        let mut offsets = vec![0];
        for tree in trees {
            offsets.push(offsets[offsets.len() - 1] + tree.skeleton.len() as u64);
        }
        let knots = trees.iter().flat_map(|tree| tree.skeleton.iter().copied().flatten());
        file.array("skeletons", &[offsets[trees.len()], 6], knots)?;
        file.array("skeleton_offsets", &[count + 1], offsets.iter().copied())?;
    }
    file.zip.finish()?.flush()
}

struct Npz<W: Write + Seek> {
    zip: ZipWriter<W>,
}

impl<W: Write + Seek> Npz<W> {
    /// Begins the file of an array, with nothing in its head that depends on when and where it is written.
    fn begin(&mut self, name: &str) -> io::Result<()> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(LEVEL))
            .last_modified_time(DateTime::default())
            .system(System::Unix)
            .unix_permissions(0o644);
        Ok(self.zip.start_file(format!("{name}.npy"), options)?)
    }

    fn array<T: Number>(
        &mut self,
        name: &str,
        shape: &[u64],
        values: impl Iterator<Item = T>,
    ) -> io::Result<()> {
        self.begin(name)?;
        let mut out = BufWriter::with_capacity(BUFFER, &mut self.zip);
        npy::write(&mut out, shape, values)?;
        out.flush()
    }

    /// One byte for each pixel: 1 where there is ink.
    fn pictures<'a>(
        &mut self,
        name: &str,
        shape: &[u64],
        seen: impl Iterator<Item = &'a Seen>,
        picture: impl Fn(&'a Seen) -> &'a Bitmap,
    ) -> io::Result<()> {
        self.begin(name)?;
        let mut out = BufWriter::with_capacity(BUFFER, &mut self.zip);
        npy::write_header::<u8>(&mut out, shape)?;
        let mut row = Vec::new();
        for picture in seen.map(picture) {
            for y in 0..picture.height() {
                row.clear();
                row.extend((0..picture.width()).map(|x| u8::from(picture.get(x, y))));
                out.write_all(&row)?;
            }
        }
        out.flush()
    }
}
