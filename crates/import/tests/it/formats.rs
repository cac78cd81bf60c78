//! What each program's names become.

use pleach_import::{Foreign, Program, is_foreign, translate};

fn read(name: &str, text: &str) -> Foreign {
    assert!(is_foreign(name, text), "{name}");
    translate(name, text).unwrap_or_else(|error| panic!("{error}"))
}

/// The line of the species file that sets `parameter`.
fn line<'a>(foreign: &'a Foreign, parameter: &str) -> &'a str {
    let start = format!("{parameter} = ");
    let found = foreign.toml.lines().find_map(|line| line.strip_prefix(start.as_str()));
    found.unwrap_or_else(|| panic!("no {parameter} in\n{}", foreign.toml))
}

#[test]
fn tree_gen() {
    let text = "# a palm\nparams = {\n    'shape': 4, 'g_scale': 6, 'levels': 1, 'leaf_shape': 0,\n    'base_size': 0.3,\n    \
                'down_angle': [-0, 90, 45, 45], 'tropism': (0, 0, -1.5), 'bevel_res': [5, 5, 5, 5], 'nothing': None,\n}\n";
    let species = read("palm.py", text);
    assert_eq!(species.program, Program::TreeGen);
    assert_eq!(line(&species, "g_scale"), "6");
    assert_eq!(line(&species, "leaf_shape"), "8");
    assert_eq!(line(&species, "base_size"), "[0.3, 0.02, 0.02, 0.02]");
    assert_eq!(line(&species, "down_angle"), "[0, 90, 45, 45]");
    assert_eq!(line(&species, "tropism"), "[0, 0, -1.5]");
    assert_eq!(species.without_counterpart, ["bevel_res"]);
    let place = species.places.iter().find(|(name, _)| name == "g_scale").unwrap();
    assert_eq!(&text[place.1.clone()], "6");
}

#[test]
fn sapling() {
    let text = "{'scale': 13.0, 'scaleV': 3.0, 'shape': '7', 'levels': 3, 'baseSize': 0.4, 'baseSize_s': 0.25, \
                'branches': (0, 50, 30, 10), 'downAngle': (90.0, 60.0, 45.0, 45.0), 'leafDownAngle': 50.0, \
                'rotateV': (15.0, -10.0, 0.0, 0.0), 'rootFlare': 1.2, 'scale0': 1.1, 'radiusTweak': (1, 1, 0.9, 1), \
                'attractUp': (0.0, 0.0, 0.5, 0.5), 'curveRes': (8, 5, 3, 1), 'leafShape': 'hex', 'bend': 0.2, \
                'leaves': 25, 'prune': False, 'pruneRatio': 1.0, 'showLeaves': False, 'armAnim': False, 'bevel': True, \
                'handleType': '0', 'seed': 3}";
    let species = read("white_birch.py", text);
    assert_eq!(species.program, Program::Sapling);
    for (parameter, value) in [
        ("g_scale", "13"),
        ("shape", "7"),
        ("base_size", "[0.4, 0.1, 0.025, 0.00625]"),
        ("branches", "[1, 50, 30, 10]"),
        ("down_angle", "[90, 60, 45, 50]"),
        ("rotate_v", "[15, 10, 0, 0]"),
        ("radius_mod", "[1.1, 1, 0.9, 1]"),
        ("tropism", "[0, 0, 1.5]"),
        ("leaf_shape", "8"),
        ("leaf_bend", "0.2"),
        ("leaf_blos_num", "25"),
        ("prune_ratio", "0"),
        ("bare", "true"),
    ] {
        assert_eq!(line(&species, parameter), value, "{parameter}");
    }
    assert_eq!(line(&species, "flare"), "0.2");
    assert_eq!(species.without_counterpart, ["bevel", "handleType", "seed"]);
    let custom =
        read("x.py", "{'shape': '8', 'customShape': (0.5, 1.0, 0.25, 0.1), 'ratioPower': 1.2, 'levels': 6}");
    assert_eq!((line(&custom, "shape"), line(&custom, "outline")), ("3", "[0.5, 1, 0.7, 0.4, 0.1]"));
    assert_eq!(line(&custom, "levels"), "4");
    assert!(custom.notes[0].contains("levels are 6 there"), "{:?}", custom.notes);
}

#[test]
fn arbaro() {
    let text = "<?xml version='1.0' ?>\n<arbaro>\n  <species name='my tree'>\n    <!-- general -->\n    \
                <param name='Shape' value='7'/><param name='Levels' value='3'/><param name='Scale' value='13'/>\n    \
                <param name='BaseSize' value='0.4'/><param name='Lobes' value='5'/><param name='LobeDepth' value='0.0'/>\n    \
                <param name='0Scale' value='1.2'/><param name='1Branches' value='50'/><param name='2Branches' value='30'/>\n    \
                <param name='1DownAngle' value='60'/><param name='2CurveRes' value='3'/><param name='AttractionUp' value='0.5'/>\n    \
                <param name='LeafShape' value='disc'/><param name='Leaves' value='-25'/>\n  </species>\n</arbaro>\n";
    let species = read("tree.xml", text);
    assert_eq!(species.program, Program::Arbaro);
    for (parameter, value) in [
        ("name", "\"my tree\""),
        ("shape", "7"),
        ("levels", "3"),
        ("base_size", "[0.4, 0, 0, 0]"),
        ("radius_mod", "[1.2, 1, 1, 1]"),
        ("branches", "[1, 50, 30, 5]"),
        ("down_angle", "[0, 60, 30, 30]"),
        ("tropism", "[0, 0, 1.5]"),
        ("leaf_shape", "8"),
        ("leaf_blos_num", "-25"),
    ] {
        assert_eq!(line(&species, parameter), value, "{parameter}");
    }
    assert_eq!(species.without_counterpart, ["Lobes"]);
}

#[test]
fn ez_tree() {
    let text = r#"{"seed": 36330, "type": "evergreen", "bark": {"type": "pine"},
        "branch": {"levels": 2, "angle": {"1": 48, "2": 75}, "children": {"0": 90, "1": 4},
            "force": {"direction": {"x": 0, "y": 1, "z": 0}, "strength": 0.01},
            "gnarliness": {"0": 0.05, "1": 0.1, "2": 0.0}, "length": {"0": 40, "1": 10, "2": 5},
            "radius": {"0": 1.0, "1": 0.5, "2": 0.7}, "sections": {"0": 10, "1": 8, "2": 6},
            "segments": {"0": 8, "1": 6, "2": 4}, "start": {"1": 0.2, "2": 0.3}, "taper": {"0": 0.7}, "twist": {"0": 0.1}},
        "leaves": {"type": "pine", "count": 20, "angle": 30, "start": 0.1, "size": 1.5}}"#;
    let species = read("pine.json", text);
    assert_eq!(species.program, Program::EzTree);
    for (parameter, value) in [
        ("levels", "3"),
        ("shape", "0"),
        ("g_scale", "40"),
        ("length", "[1, 0.25, 0.917431193, 1.415384615]"),
        ("ratio", "0.025"),
        ("radius_mod", "[1, 0.29, 0.3815, 0.455]"),
        ("branches", "[1, 90, 4, 4]"),
        ("down_angle", "[0, 48, 75, 30]"),
        ("base_size", "[0.2, 0.3, 0.1, 0]"),
        ("curve_res", "[10, 8, 6, 4]"),
        ("leaf_blos_num", "37"),
        ("leaf_scale", "1.5"),
        ("leaf_shape", "2"),
    ] {
        assert_eq!(line(&species, parameter), value, "{parameter}");
    }
    assert!(line(&species, "tropism").starts_with("[0, 0, 0.197"), "{}", line(&species, "tropism"));
    assert_eq!(species.without_counterpart, ["seed", "bark", "segments", "twist"]);
    assert!(species.notes.iter().any(|note| note.contains("nearest one of Weber and Penn")));
}

#[test]
fn species_files_are_not_foreign() {
    for text in [
        "",
        "# pleach\ngenerator = \"weber-penn\"\n",
        "g_scale = 3\n",
        "individual = { a = 1 }\n",
        "name = \"{\"\n",
    ] {
        assert!(!is_foreign("a.toml", text), "{text}");
    }
    assert!(is_foreign("stdin", "\u{feff}  <arbaro/>") && is_foreign("stdin", "# x\nparams = {}"));
    assert!(is_foreign("A.PY", "import os"));
}
