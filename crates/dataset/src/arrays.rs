//! What a shard holds, array by array.

use crate::columns::Columns;
use crate::options::{DatasetOptions, Format, Layer};
use serde::Serialize;
use serde_json::{Value, json};

/// What a manifest says of an array.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Array {
    /// In npz shards the name of the array, in tar files the end of the name of the file.
    pub(crate) name: String,
    /// Its sides: whole numbers, or the name of one that differs from shard to shard or tree to tree.
    pub(crate) shape: Vec<Value>,
    /// Its type, as NumPy calls it; `png` is a picture.
    pub(crate) dtype: &'static str,
    pub(crate) about: &'static str,
}

const NUMBERS: &str =
    "the numbers of the tree, in the order of `numbers`; NaN where its species has no such number";
const SILHOUETTE: &str = "1 where the tree is";
const WOOD: &str = "1 where stems are, drawn without foliage in the frame of the silhouette";
const DEPTH: &str = "metres from the plane through the trunk's foot that faces the viewer to the nearest surface in the \
                     pixel, negative in front of it; NaN where the silhouette has no tree";
const METERS: &str = "width and height of a pixel in metres";
const KNOTS: &str = "knots of the stems: x, y, z (up) and radius in metres, number of the stem, number of its parent \
                     or -1; stem by stem from base to tip, parents first";

/// The arrays of data sets with these options.
pub(crate) fn arrays(options: &DatasetOptions, columns: &Columns) -> Vec<Array> {
    match options.format {
        Format::Npz => stacked(options, columns),
        Format::WebDataset => single(options, columns),
    }
}

fn array(name: impl Into<String>, shape: &[Value], dtype: &'static str, about: &'static str) -> Array {
    Array { name: name.into(), shape: shape.to_vec(), dtype, about }
}

fn stacked(options: &DatasetOptions, columns: &Columns) -> Vec<Array> {
    let trees = json!("trees");
    let (views, side) = (json!(options.views.len()), json!(options.size));
    let pictures = [trees.clone(), views.clone(), side.clone(), side];
    let each = std::slice::from_ref(&trees);
    let mut all = vec![
        array("species", each, "uint32", "index in `species`"),
        array("number", each, "uint32", "the number among the draws of the species, from 0"),
        array("tree_seed", each, "uint64", "the seed from which the numbers grow this very tree"),
        array("numbers", &[trees.clone(), json!(columns.names.len())], "float64", NUMBERS),
        array("meters_per_pixel", &[trees.clone(), views], "float64", METERS),
        array("silhouettes", &pictures, "uint8", SILHOUETTE),
    ];
    if options.has(Layer::Wood) {
        all.push(array("wood", &pictures, "uint8", WOOD));
    }
    if options.has(Layer::Depth) {
        all.push(array("depth", &pictures, "float32", DEPTH));
    }
    if options.has(Layer::Skeleton) {
        all.push(array("skeletons", &[json!("knots"), json!(6)], "float32", KNOTS));
        let about =
            "the knots of tree i are rows skeleton_offsets[i] to skeleton_offsets[i + 1] of skeletons";
        all.push(array("skeleton_offsets", &[json!("trees + 1")], "uint64", about));
    }
    all
}

fn single(options: &DatasetOptions, columns: &Columns) -> Vec<Array> {
    let side = json!(options.size);
    let picture = [side.clone(), side];
    let about = "species, number, tree_seed and meters_per_pixel of each view, as in npz shards";
    let mut all = vec![
        array("json", &[], "object", about),
        array("numbers.npy", &[json!(columns.names.len())], "float64", NUMBERS),
    ];
    for view in 0..options.views.len() {
        all.push(array(
            format!("view{view}.png"),
            &picture,
            "png",
            "one bit per pixel, black where the tree is",
        ));
        if options.has(Layer::Wood) {
            let about =
                "one bit per pixel, black where stems are, drawn without foliage in the frame of the view";
            all.push(array(format!("wood{view}.png"), &picture, "png", about));
        }
        if options.has(Layer::Depth) {
            all.push(array(format!("depth{view}.npy"), &picture, "float32", DEPTH));
        }
    }
    if options.has(Layer::Skeleton) {
        all.push(array("skeleton.npy", &[json!("knots"), json!(6)], "float32", KNOTS));
    }
    all
}
