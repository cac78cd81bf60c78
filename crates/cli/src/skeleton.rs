//! A tree as JSON: stems with knots and radii, leaves and blossoms.
//!
//! Written piece by piece, since a willow's skeleton is a hundred megabytes as one value.

use pleach_tree::{Leaf, Species, StemKind, Tree};
use std::io::Write;

/// Writes the skeleton of `tree`. Metres; z is up.
pub(crate) fn write(out: &mut impl Write, species: &Species, seed: u64, tree: &Tree) -> anyhow::Result<()> {
    let text = |text: &str| serde_json::to_string(text);
    writeln!(out, "{{")?;
    writeln!(
        out,
        r#""species": {}, "generator": {},"#,
        text(&species.name)?,
        text(species.generator.family())?
    )?;
    writeln!(out, r#""seed": {seed},"#)?;
    writeln!(out, r#""units": "metres, z up; a knot is [x, y, z, radius], a handle [x, y, z]","#)?;
    write!(out, r#""stems": ["#)?;
    for (i, stem) in tree.stems.iter().enumerate() {
        writeln!(out, "{}", if i == 0 { "" } else { "," })?;
        let kind = match stem.kind {
            StemKind::Trunk => "trunk",
            StemKind::Branch => "branch",
            StemKind::Fork => "clone",
            StemKind::Root => "root",
        };
        let parent = stem.parent.map_or_else(|| "null".to_owned(), |p| p.to_string());
        write!(
            out,
            r#"{{"level": {}, "kind": "{kind}", "parent": {parent}, "offset": {}, "#,
            stem.level,
            number(stem.offset)
        )?;
        let knots = tree.knots_of(stem);
        list(out, "knots", knots, |k| point([k.point.x, k.point.y, k.point.z, k.radius]))?;
        list(out, "handles_in", knots, |k| point(k.handle_in.to_array()))?;
        list(out, "handles_out", knots, |k| point(k.handle_out.to_array()))?;
        // The lists end in a comma; the last key does not.
        write!(out, r#""length": {}}}"#, number(tree.length_of(stem)))?;
    }
    writeln!(out, "\n],")?;
    let shapes: Vec<&str> = tree.leaf_shapes.iter().map(|shape| shape.name()).collect();
    leaves(out, "leaves", &shapes, &tree.leaves)?;
    writeln!(out, ",")?;
    let shapes: Vec<&str> = tree.blossom_shapes.iter().map(|shape| shape.name()).collect();
    leaves(out, "blossoms", &shapes, &tree.blossoms)?;
    if !tree.blobs.is_empty() {
        writeln!(out, ",")?;
        blobs(out, tree)?;
    }
    writeln!(out, "\n}}")?;
    Ok(())
}

fn list<T>(
    out: &mut impl Write,
    name: &str,
    items: &[T],
    show: impl Fn(&T) -> String,
) -> std::io::Result<()> {
    write!(out, r#""{name}": ["#)?;
    for (i, item) in items.iter().enumerate() {
        write!(out, "{}{}", if i == 0 { "" } else { ", " }, show(item))?;
    }
    write!(out, "], ")
}

/// Leaves of one shape, or, where there are several, a list of shapes and for each leaf the number of
/// its own.
fn leaves(out: &mut impl Write, name: &str, shapes: &[&str], leaves: &[Leaf]) -> anyhow::Result<()> {
    match shapes {
        [shape] => write!(out, r#""{name}": {{"shape": {}, "list": ["#, serde_json::to_string(shape)?)?,
        _ => write!(out, r#""{name}": {{"shapes": {}, "list": ["#, serde_json::to_string(shapes)?)?,
    }
    for (i, leaf) in leaves.iter().enumerate() {
        writeln!(out, "{}", if i == 0 { "" } else { "," })?;
        let wide = |v: [f32; 3]| point(v.map(f64::from));
        write!(
            out,
            r#"{{"stem": {}, "position": {}, "along": {}, "across": {}"#,
            leaf.stem,
            wide(leaf.position.to_array()),
            wide(leaf.along.to_array()),
            wide(leaf.across.to_array())
        )?;
        match shapes.len() {
            1 => write!(out, "}}")?,
            _ => write!(out, r#", "shape": {}}}"#, leaf.shape)?,
        }
    }
    Ok(write!(out, "]}}")?)
}

/// Closed surfaces of foliage, each with vertices and triangles of its own.
fn blobs(out: &mut impl Write, tree: &Tree) -> std::io::Result<()> {
    write!(out, r#""blobs": ["#)?;
    for (i, blob) in tree.blobs.iter().enumerate() {
        writeln!(out, "{}", if i == 0 { "" } else { "," })?;
        write!(out, r#"{{"stem": {}, "#, blob.stem)?;
        let vertices = &tree.blob_vertices[blob.vertices()];
        list(out, "vertices", vertices, |v| point(v.to_array().map(f64::from)))?;
        let triangles = &tree.blob_triangles[blob.triangles()];
        list(out, "triangles", triangles, |[a, b, c]| format!("[{a}, {b}, {c}]"))?;
        // The lists end in a comma; the last key does not.
        write!(out, r#""closed": true}}"#)?;
    }
    write!(out, "]")
}

fn point<const N: usize>(values: [f64; N]) -> String {
    let values: Vec<String> = values.iter().map(|&v| number(v)).collect();
    format!("[{}]", values.join(", "))
}

/// A length in metres to a hundredth of a millimetre, without trailing zeros.
fn number(value: f64) -> String {
    let text = format!("{value:.5}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
