//! Species of Arbaro: XML with a `param` for each number of Weber and Penn's model.
//!
//! What the names mean is in Weber and Penn 1995, appendix: those of levels begin with the number of the level. Angles
//! are degrees, lengths metres.

use crate::attraction::tropism;
use crate::program::Program;
use crate::source::Source;
use crate::translation::{Foreign, LEVELS, Translation};
use pleach_tree::SpeciesError;
use pleach_tree::param::{Problem, shown};
use roxmltree::{Document, ParsingOptions};
use std::ops::Range;

/// Most elements of a file: a species has about eighty.
const MAX_NODES: u32 = 2_000;

/// Numbers that mean the same: Arbaro's name and pleach's.
const SCALARS: [(&str, &str); 18] = [
    ("Shape", "shape"),
    ("Levels", "levels"),
    ("Scale", "g_scale"),
    ("ScaleV", "g_scale_v"),
    ("Ratio", "ratio"),
    ("RatioPower", "ratio_power"),
    ("Flare", "flare"),
    ("0BaseSplits", "base_splits"),
    ("Leaves", "leaf_blos_num"),
    ("LeafScale", "leaf_scale"),
    ("LeafScaleX", "leaf_scale_x"),
    ("LeafBend", "leaf_bend"),
    ("PruneRatio", "prune_ratio"),
    ("PruneWidth", "prune_width"),
    ("PruneWidthPeak", "prune_width_peak"),
    ("PrunePowerLow", "prune_power_low"),
    ("PrunePowerHigh", "prune_power_high"),
    ("BaseSize", "base_size"),
];

/// Numbers of each level that mean the same, and what stands for a level that the file does not give.
const LISTS: [(&str, &str, [f64; LEVELS]); 16] = [
    ("DownAngle", "down_angle", [0.0, 30.0, 30.0, 30.0]),
    ("DownAngleV", "down_angle_v", [0.0; LEVELS]),
    ("Rotate", "rotate", [0.0, 120.0, 120.0, 120.0]),
    ("RotateV", "rotate_v", [0.0; LEVELS]),
    ("Branches", "branches", [1.0, 10.0, 5.0, 5.0]),
    ("BranchDist", "branch_dist", [0.0; LEVELS]),
    ("Length", "length", [1.0, 0.5, 0.5, 0.5]),
    ("LengthV", "length_v", [0.0; LEVELS]),
    ("Taper", "taper", [1.0; LEVELS]),
    ("SegSplits", "seg_splits", [0.0; LEVELS]),
    ("SplitAngle", "split_angle", [0.0; LEVELS]),
    ("SplitAngleV", "split_angle_v", [0.0; LEVELS]),
    ("CurveRes", "curve_res", [3.0, 3.0, 1.0, 1.0]),
    ("Curve", "curve", [0.0; LEVELS]),
    ("CurveV", "curve_v", [0.0; LEVELS]),
    ("CurveBack", "curve_back", [0.0; LEVELS]),
];

/// Shapes of leaves by Arbaro's words.
const LEAF_SHAPES: [(&str, f64); 4] = [("disc", 8.0), ("square", 9.0), ("triangle", 10.0), ("0", 8.0)];

/// A `param` of the file.
struct Entry<'a> {
    name: &'a str,
    value: &'a str,
    span: Range<usize>,
}

pub(crate) fn translate(source: &Source<'_>) -> Result<Foreign, SpeciesError> {
    let options = ParsingOptions { nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let text = source.text.trim_start_matches('\u{feff}');
    let shift = source.text.len() - text.len();
    // Each element would have a copy of the names around it.
    if let Some(at) = text.find("xmlns") {
        let at = shift + at;
        return Err(source.wrong(at..at + 5, "a namespace is here; species of Arbaro have none"));
    }
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let (at, message) = match error {
            roxmltree::Error::DtdDetected => (
                // The parser does not say where.
                text.find("<!DOCTYPE").unwrap_or_default(),
                "a document type is here; species have none, and none is read".to_owned(),
            ),
            roxmltree::Error::NodesLimitReached => {
                (0, format!("the file has more than {MAX_NODES} elements, far more than a species"))
            }
            roxmltree::Error::UnclosedRootNode => {
                (text.len(), "the file ends here, and an element is not closed".to_owned())
            }
            // The parser's words end in the place.
            other => (
                byte_at(text, other.pos()),
                other.to_string().split(" at ").next().unwrap_or_default().to_owned(),
            ),
        };
        let at = shift + at;
        source.wrong(at..at, &message)
    })?;
    let mut species = Translation::new(source, Program::Arbaro);
    let Some(element) = document.descendants().find(|node| node.has_tag_name("species")) else {
        let root = document.root_element();
        let message = format!(
            "`<{}>` has no `<species>` inside it, expected a species of Arbaro",
            shown(root.tag_name().name())
        );
        let start = shift + root.range().start;
        return Err(source.wrong(start..start + 1, &message));
    };
    if let Some(name) = element.attribute("name") {
        species.name(name);
    }
    let mut entries = Vec::new();
    for param in element.children().filter(|node| node.has_tag_name("param")) {
        let (name, value) = (param.attribute("name"), param.attribute_node("value"));
        let (Some(name), Some(value)) = (name, value) else {
            let start = shift + param.range().start;
            let expected = "`name` and `value`".to_owned();
            species.wrong("param", &(start..start + 6), Problem::Missing { expected });
            continue;
        };
        let span = value.range_value();
        entries.push(Entry { name, value: value.value(), span: shift + span.start..shift + span.end });
    }
    read(&mut species, &entries);
    species.finish()
}

fn read(species: &mut Translation<'_>, entries: &[Entry<'_>]) {
    let mut known: Vec<String> = Vec::new();
    for (theirs, ours) in SCALARS {
        known.push(theirs.to_owned());
        let Some(entry) = find(entries, theirs) else { continue };
        let Some(value) = number(species, entry) else { continue };
        match ours {
            // Weber and Penn have a bare base on the trunk alone.
            "base_size" => species.set_list(ours, &[value, 0.0, 0.0, 0.0], &entry.span),
            _ => species.set(ours, value, &entry.span),
        }
    }
    let mut segments = 1.0;
    for (theirs, ours, usual) in LISTS {
        let (mut values, mut span) = (usual, None);
        for (level, value) in values.iter_mut().enumerate() {
            let name = format!("{level}{theirs}");
            if let Some(entry) = find(entries, &name)
                && let Some(given) = number(species, entry)
            {
                *value = if ours == "rotate_v" { given.abs() } else { given };
                species.place(&format!("{ours}[{level}]"), &entry.span);
                span.get_or_insert(entry.span.clone());
            }
            known.push(name);
        }
        if ours == "curve_res" {
            segments = values[2];
        }
        species.set_list(ours, &values, &span.unwrap_or(0..0));
    }
    let scale = find(entries, "0Scale").and_then(|entry| Some((number(species, entry)?, entry)));
    if let Some((scale, entry)) = scale {
        species.set_list("radius_mod", &[scale, 1.0, 1.0, 1.0], &entry.span);
    }
    let up = find(entries, "AttractionUp").and_then(|entry| Some((number(species, entry)?, entry)));
    let (up, span) = up.map_or((0.0, 0..0), |(up, entry)| (up, entry.span.clone()));
    species.set_list("tropism", &[0.0, 0.0, tropism(up, segments)], &span);
    species.set_list("bend_v", &[0.0; LEVELS], &(0..0));
    if let Some(entry) = find(entries, "LeafShape") {
        match LEAF_SHAPES.iter().find(|(word, _)| *word == entry.value) {
            Some((_, shape)) => species.set("leaf_shape", *shape, &entry.span),
            None => species.note(format!("leaves are `{}` there and elliptic here", shown(entry.value))),
        }
    }
    known.extend(["0Scale", "AttractionUp", "LeafShape", "Species"].map(str::to_owned));
    for entry in entries.iter().filter(|entry| !known.iter().any(|name| name == entry.name)) {
        // Lobes, flattened stems and the like that are 0 do nothing.
        if entry.value.parse::<f64>() != Ok(0.0) {
            species.omit_name(entry.name);
        }
    }
}

/// The last entry of this name.
fn find<'a, 'b>(entries: &'a [Entry<'b>], name: &str) -> Option<&'a Entry<'b>> {
    entries.iter().rev().find(|entry| entry.name == name)
}

fn number(species: &mut Translation<'_>, entry: &Entry<'_>) -> Option<f64> {
    let number = entry.value.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    if number.is_none() {
        let found = format!("the string `{}`", shown(entry.value));
        species.wrong(entry.name, &entry.span, Problem::WrongType { expected: "a number", found });
    }
    number
}

/// The byte of `text` at a line and a column, which count from 1.
fn byte_at(text: &str, place: roxmltree::TextPos) -> usize {
    let before: usize =
        text.split_inclusive('\n').take(place.row.saturating_sub(1) as usize).map(str::len).sum();
    let line = &text[before..];
    let column = place.col.saturating_sub(1) as usize;
    before + line.char_indices().nth(column).map_or(line.len(), |(at, _)| at)
}
