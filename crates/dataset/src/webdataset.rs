//! Shards of a WebDataset: a tar file with some files for each tree, which share the beginning of their names.

use crate::example::Example;
use crate::npy;
use crate::options::{DatasetOptions, Layer};
use serde::Serialize;
use std::io::{self, Write};
use tar::{Builder, EntryType, Header};

/// What is said of a tree beside its arrays.
#[derive(Serialize)]
struct About<'a> {
    /// Index of the species.
    species: u32,
    species_name: &'a str,
    number: u32,
    tree_seed: u64,
    /// Of each view.
    meters_per_pixel: Vec<f64>,
}

/// Writes the files of a shard. `names` are those of the species.
pub(crate) fn write(
    out: impl Write,
    options: &DatasetOptions,
    names: &[String],
    trees: &[Example],
) -> io::Result<()> {
    let mut tar = Tar { tar: Builder::new(out) };
    for tree in trees {
        let key = format!("{:010}", tree.draw);
        let about = About {
            species: tree.species,
            species_name: &names[tree.species as usize],
            number: tree.number,
            tree_seed: tree.tree_seed,
            meters_per_pixel: tree.views.iter().map(|view| view.meters_per_pixel).collect(),
        };
        tar.file(&key, "json", &serde_json::to_vec(&about)?)?;
        tar.array(&key, "numbers.npy", &[tree.numbers.len() as u64], tree.numbers.iter().copied())?;
        let side = u64::from(options.size);
        for (i, view) in tree.views.iter().enumerate() {
            tar.file(&key, &format!("view{i}.png"), &view.silhouette.to_png())?;
            if options.has(Layer::Wood) {
                tar.file(&key, &format!("wood{i}.png"), &view.wood.to_png())?;
            }
            if options.has(Layer::Depth) {
                tar.array(&key, &format!("depth{i}.npy"), &[side, side], view.depth.iter().copied())?;
            }
        }
        if options.has(Layer::Skeleton) {
            let knots = tree.skeleton.iter().copied().flatten();
            tar.array(&key, "skeleton.npy", &[tree.skeleton.len() as u64, 6], knots)?;
        }
    }
    tar.tar.into_inner()?.flush()
}

struct Tar<W: Write> {
    tar: Builder<W>,
}

impl<W: Write> Tar<W> {
    /// A file whose head does not depend on when, where and by whom it is written.
    fn file(&mut self, key: &str, name: &str, bytes: &[u8]) -> io::Result<()> {
        let mut header = Header::new_ustar();
        header.set_entry_type(EntryType::Regular);
        header.set_mode(0o644);
        header.set_mtime(0);
        header.set_uid(0);
        header.set_gid(0);
        header.set_size(bytes.len() as u64);
        self.tar.append_data(&mut header, format!("{key}.{name}"), bytes)
    }

    fn array<T: npy::Number>(
        &mut self,
        key: &str,
        name: &str,
        shape: &[u64],
        values: impl Iterator<Item = T>,
    ) -> io::Result<()> {
        let mut bytes = Vec::new();
        npy::write(&mut bytes, shape, values)?;
        self.file(key, name, &bytes)
    }
}
