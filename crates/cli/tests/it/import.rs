//! Species of other programs, through the program.

use pleach_tests::Dir;

const PALM: &str = "params = {
    'shape': 4, 'g_scale': 6, 'g_scale_v': 1, 'levels': 2, 'ratio': 0.02,
    'branches': [1, 12, 0, 0], 'length': [1, 0.5, 0, 0], 'base_size': [0.9, 0.02, 0.02, 0.02],
    'leaf_blos_num': 20, 'bevel_res': [10, 10, 10, 10],
}
";

pub(crate) const BIRCH: &str = "<?xml version='1.0' ?>
<arbaro>
  <species name='small birch'>
    <param name='Shape' value='4'/>
    <param name='Levels' value='3'/>
    <param name='Scale' value='8'/>
    <param name='BaseSize' value='0.2'/>
    <param name='Ratio' value='0.015'/>
    <param name='Lobes' value='3'/>
    <param name='Leaves' value='12'/>
    <param name='1Branches' value='20'/>
    <param name='2Branches' value='8'/>
    <param name='1Length' value='0.3'/>
    <param name='AttractionUp' value='0.5'/>
  </species>
</arbaro>
";

pub(crate) const ASH: &str = r#"{"seed": 1, "type": "deciduous", "branch": {"levels": 2, "angle": {"1": 48},
    "children": {"0": 7, "1": 4}, "length": {"0": 12, "1": 6, "2": 2}}, "leaves": {"type": "ash", "count": 9, "size": 0.4}}"#;

pub(crate) const MAPLE: &str = "{'scale': 7.0, 'shape': '1', 'levels': 2, 'branches': (0, 30, 0, 0), 'ratioPower': 1.2, 'leaves': 15, \
                     'curveRes': (6, 4, 1, 1), 'handleType': '0'}";

#[test]
fn a_species_is_translated_and_grows_the_same_tree_as_its_file() {
    let dir = Dir::new();
    for (name, text, program) in [
        ("palm.py", PALM, "tree-gen"),
        ("birch.xml", BIRCH, "Arbaro"),
        ("ash.json", ASH, "ez-tree"),
        ("maple.py", MAPLE, "Sapling"),
    ] {
        let _ = dir.file(name, text);
        let run = dir.run(["import", name, "-o", "it.toml"]);
        let notes = run.stderr();
        assert_eq!(run.code(), 0, "{run}");
        assert!(notes.contains(&format!("Translated from a species of {program}.")), "{notes}");
        let written = std::fs::read_to_string(dir.path("it.toml")).unwrap();
        assert!(written.starts_with(&format!("# Translated from a species of {program}.")), "{written}");
        let statistics = |species: &str| dir.run(["grow", species, "--stats-only", "--json"]).json();
        let (direct, translated) = (statistics(name), statistics("it.toml"));
        assert_eq!(direct, translated, "{name}");
        assert!(
            direct["leaves"].as_u64().unwrap() > 50 && direct["height_m"].as_f64().unwrap() > 3.0,
            "{direct}"
        );
        assert_eq!(dir.run(["import", name, "-q"]).ok(), written, "{name}: standard output has the same");
    }
}

#[test]
fn what_has_no_counterpart_is_listed() {
    let dir = Dir::new();
    let stderr = |name: &str, text: &str| {
        let _ = dir.file(name, text);
        dir.run(["import", name, "-o", "it.toml"]).stderr()
    };
    assert!(stderr("palm.py", PALM).contains("Without a counterpart: bevel_res."));
    assert!(stderr("birch.xml", BIRCH).contains("Without a counterpart: Lobes."));
    assert!(stderr("ash.json", ASH).contains("The tree is the nearest one of Weber and Penn's model"));
    assert!(stderr("maple.py", MAPLE).contains("Without a counterpart: handleType."));
    // Wherever such a file stands for a species.
    let grown = dir.run(["grow", "maple.py", "--stats-only"]);
    let _ = grown.ok();
    assert!(
        grown.stderr().contains("maple.py has entries without a counterpart here: handleType"),
        "{grown}"
    );
    let _ = dir.run(["silhouette", "maple.py", "--size", "64", "-o", "goal.png"]).ok();
    let fit = ["fit", "goal.png", "--from", "maple.py", "--evaluations", "3", "--individual", "off"];
    let fitted = dir.run(fit);
    let _ = fitted.ok();
    assert_eq!(fitted.stderr().matches("without a counterpart").count(), 1, "{fitted}");
}

#[test]
fn names_are_those_of_the_species_the_file_or_the_option() {
    let dir = Dir::new();
    let _ = dir.file("birch.xml", BIRCH);
    let _ = dir.file("maple.py", MAPLE);
    assert!(dir.run(["import", "birch.xml"]).ok().contains("name = \"small birch\""));
    assert!(dir.run(["import", "maple.py"]).ok().contains("name = \"maple\""));
    assert!(dir.run(["import", "maple.py", "--name", "acer"]).ok().contains("name = \"acer\""));
    dir.run(["import", "maple.py", "--name", "a/b"]).fails(2, &["--name", "a/b"]);
}

#[test]
fn bad_files_end_in_an_error_with_a_place() {
    let dir = Dir::new();
    let fails = |name: &str, text: &str, words: &[&str]| {
        let _ = dir.file(name, text);
        dir.run(["import", name]).fails(1, words);
        dir.run(["grow", name, "--stats-only"]).fails(1, words);
    };
    fails("code.py", "params = {'g_scale': open('x').read()}", &["code.py:1:22", "`open`", "not run"]);
    fails("script.py", "import os\n", &["script.py:1:1", "`import`"]);
    fails("deep.py", &"[".repeat(60_000), &["deep.py:1:17", "16 deep"]);
    fails("deep.json", &"{\"branch\":".repeat(6_000), &["deep.json:1:", "16 deep"]);
    fails("deep.xml", &"<arbaro>".repeat(8_000), &["deep.xml:1:"]);
    fails("long.py", &"[".repeat(100_000), &["long.py:1:1", "100000 bytes", "at most 65536"]);
    let bomb = "<!DOCTYPE a [<!ENTITY b 'ha'><!ENTITY c '&b;&b;'>]>\n<arbaro>&c;</arbaro>";
    fails("bomb.xml", bomb, &["bomb.xml:1:1", "document type"]);
    fails(
        "range.py",
        "params = {'shape': 4,\n'g_scale': 5000}",
        &["range.py:2:12", "`g_scale` is 5000", "0.01 to 200"],
    );
    fails("other.json", "{\"a\": 1}", &["other.json:1:1", "tree-gen, Sapling or ez-tree"]);
    let _ = dir.file("own.toml", "g_scale = 3\n");
    dir.run(["import", "own.toml"]).fails(1, &["own.toml", "not a species of another program"]);
    dir.run(["import", "missing.py"]).fails(1, &["missing.py"]);
}

#[test]
fn a_file_of_a_gigabyte_is_not_read() {
    let dir = Dir::new();
    std::fs::File::create(dir.path("large.py")).unwrap().set_len(1 << 30).unwrap();
    dir.run(["import", "large.py"]).fails(1, &["large.py is too large", "bytes"]);
}
