//! The known species of Weber and Penn's model, written as other programs have them and read again.

use pleach_generators::{Program, RegistryError, import, presets, read};
use pleach_tree::param::Shape;
use pleach_tree::{Family as _, Species};
use pleach_weber_penn::WeberPennFamily;
use std::fmt::Write as _;

/// The values of a parameter of `species`.
fn values<'a>(species: &'a Species, name: &str) -> &'a [f64] {
    let space = species.generator.space();
    let index = space.params().iter().position(|param| param.name == name).unwrap();
    species.params.list(index)
}

/// `values` between brackets.
fn list(values: &[f64], open: char, close: char) -> String {
    let values: Vec<String> = values.iter().map(f64::to_string).collect();
    format!("{open}{}{close}", values.join(", "))
}

fn known() -> Vec<Species> {
    let species = presets(&WeberPennFamily);
    assert!(species.len() >= 20 && WeberPennFamily.name() == "weber-penn");
    species
}

/// Parameters of pleach that presets of tree-gen do not have.
const OWN: [&str; 5] = ["lean", "bow", "side", "crown_depth", "outline"];

#[test]
fn presets_of_tree_gen_are_the_same_species() {
    for species in known() {
        let mut text = "params = {\n".to_owned();
        let params = species.generator.space().params();
        for (i, param) in params.iter().enumerate().filter(|(_, param)| !OWN.contains(&&*param.name)) {
            let values = species.params.list(i);
            let value =
                if param.shape == Shape::Scalar { values[0].to_string() } else { list(values, '[', ']') };
            let _ = writeln!(text, "    '{}': {value},", param.name);
        }
        text.push_str("    'bevel_res': [10, 10, 10, 10],\n}\n");
        let (read, foreign) = import(text.as_bytes(), &format!("{}.py", species.name)).unwrap();
        assert_eq!((foreign.program, foreign.without_counterpart.len()), (Program::TreeGen, 1));
        assert_eq!(read.name, species.name);
        assert_eq!(read.params, species.params, "{}", species.name);
    }
}

/// Scalars and lists by the names of Sapling and of Arbaro, the latter without the number of the level.
const SCALARS: [(&str, &str, &str); 12] = [
    ("g_scale", "scale", "Scale"),
    ("g_scale_v", "scaleV", "ScaleV"),
    ("ratio", "ratio", "Ratio"),
    ("ratio_power", "ratioPower", "RatioPower"),
    ("shape", "shape", "Shape"),
    ("levels", "levels", "Levels"),
    ("base_splits", "baseSplits", "0BaseSplits"),
    ("leaf_blos_num", "leaves", "Leaves"),
    ("leaf_scale", "leafScale", "LeafScale"),
    ("leaf_scale_x", "leafScaleX", "LeafScaleX"),
    ("leaf_bend", "bend", "LeafBend"),
    ("prune_width", "pruneWidth", "PruneWidth"),
];
const LISTS: [(&str, &str, &str); 14] = [
    ("length", "length", "Length"),
    ("length_v", "lengthV", "LengthV"),
    ("taper", "taper", "Taper"),
    ("seg_splits", "segSplits", "SegSplits"),
    ("split_angle", "splitAngle", "SplitAngle"),
    ("split_angle_v", "splitAngleV", "SplitAngleV"),
    ("curve_res", "curveRes", "CurveRes"),
    ("curve", "curve", "Curve"),
    ("curve_v", "curveV", "CurveV"),
    ("curve_back", "curveBack", "CurveBack"),
    ("down_angle", "downAngle", "DownAngle"),
    ("down_angle_v", "downAngleV", "DownAngleV"),
    ("rotate", "rotate", "Rotate"),
    ("rotate_v", "rotateV", "RotateV"),
];

#[test]
fn sapling_and_arbaro_have_the_same_numbers_under_other_names() {
    for species in known() {
        let (mut preset, mut xml) = ("{".to_owned(), "<arbaro><species name='x'>\n".to_owned());
        for (ours, sapling, arbaro) in SCALARS {
            let value = values(&species, ours)[0];
            let _ = write!(preset, "'{sapling}': '{value}', ");
            let _ = writeln!(xml, "<param name='{arbaro}' value='{value}'/>");
        }
        for (ours, sapling, arbaro) in LISTS {
            let values = values(&species, ours);
            let _ = write!(preset, "'{sapling}': {}, ", list(values, '(', ')'));
            for (level, value) in values.iter().enumerate() {
                let _ = writeln!(xml, "<param name='{level}{arbaro}' value='{value}'/>");
            }
        }
        preset.push('}');
        xml.push_str("</species></arbaro>");
        let (of_sapling, foreign) = import(preset.as_bytes(), "x.py").unwrap();
        assert_eq!(
            (foreign.program, foreign.without_counterpart.len()),
            (Program::Sapling, 0),
            "{}",
            species.name
        );
        let (of_arbaro, foreign) = import(xml.as_bytes(), "x.xml").unwrap();
        assert_eq!(
            (foreign.program, foreign.without_counterpart.len()),
            (Program::Arbaro, 0),
            "{}",
            species.name
        );
        for ours in SCALARS.iter().map(|(ours, ..)| ours).chain(LISTS.iter().map(|(ours, ..)| ours)) {
            for read in [&of_sapling, &of_arbaro] {
                assert_eq!(values(read, ours), values(&species, ours), "{} {ours}", species.name);
            }
        }
    }
}

#[test]
fn species_arguments_may_be_such_files() {
    let species = read("params = {'g_scale': 6, 'levels': 2}".as_bytes(), "folder/small.py").unwrap();
    assert_eq!((species.name.as_str(), values(&species, "g_scale")[0]), ("folder_small.py", 6.0));
    let error = import("g_scale = 3".as_bytes(), "a.toml").unwrap_err();
    assert!(matches!(error, RegistryError::NotForeign { .. }), "{error}");
    let large = import(std::io::repeat(b' '), "a.py").unwrap_err();
    assert!(matches!(large, RegistryError::TooLarge { .. }), "{large}");
}

#[test]
fn numbers_out_of_range_are_told_with_their_place_in_the_other_file() {
    let told = |name: &str, text: &str| import(text.as_bytes(), name).unwrap_err().to_string();
    assert_eq!(
        told("a.py", "params = {\n  'levels': 3,\n  'g_scale': 5000,\n  'branches': [1, 2.5, 3, 4]}"),
        "a.py:3:14: `g_scale` is 5000, which is out of range: allowed is 0.01 to 200\n\
         a.py:4:15: `branches[1]` is 2.5, which is not a whole number"
    );
    let message = told("a.xml", "<arbaro><species>\n<param name='Ratio' value='50'/></species></arbaro>");
    assert_eq!(message, "a.xml:2:28: `ratio` is 50, which is out of range: allowed is 0.0001 to 1");
}
