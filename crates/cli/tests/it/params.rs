//! `pleach params` and `pleach species`, as a user would run them.

use pleach_tests::Dir;
use serde_json::Value;

const GROUPS: [&str; 9] =
    ["crown", "trunk", "branches", "stems", "splits", "leaves", "blossoms", "pruning", "stature"];

fn names(list: &Value) -> Vec<&str> {
    list.as_array().unwrap().iter().map(|entry| entry["name"].as_str().unwrap()).collect()
}

#[test]
fn scripts_find_the_keys_that_they_know() {
    let dir = Dir::new();
    let params = dir.run(["params", "--json"]).json();
    for entry in params.as_array().unwrap() {
        for key in [
            "name", "values", "kind", "min", "max", "unit", "default", "search", "group", "choices",
            "negative", "doc", "source",
        ] {
            assert!(entry.get(key).is_some(), "{key} of {entry}");
        }
    }
    // Keys that are not parameters have null for what only parameters have.
    let keys = |entry: &Value| entry.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    let of_parameters = keys(&params[0]);
    for entry in params.as_array().unwrap() {
        let own = keys(entry);
        assert!(of_parameters.iter().all(|key| own.contains(key)), "{of_parameters:?} in {entry}");
    }
    let (first, last) =
        (&params[0], &params[names(&params).iter().rposition(|n| *n == "prune_power_high").unwrap()]);
    assert_eq!(
        (&first["name"], &first["group"], &first["parameter"]),
        (&"shape".into(), &"crown".into(), &true.into())
    );
    assert_eq!((&last["min"], &last["max"], &last["default"][0]), (&0.0.into(), &100.0.into(), &0.5.into()));
    let species = dir.run(["species", "--json"]).json();
    for entry in species.as_array().unwrap() {
        let generators =
            ["weber-penn", "lsystem", "fractal", "least-cost-path", "stylised", "space-colonization"];
        let known = entry["generator"].as_str().is_some_and(|name| generators.contains(&name));
        assert!(entry["species"].is_string() && known, "{entry}");
        assert!(entry["description"].is_string(), "{entry}");
    }
    let palm = dir.run(["species", "palm", "--json"]).json();
    assert_eq!((&palm["species"], &palm["generator"]), (&"palm".into(), &"weber-penn".into()));
    assert_eq!(palm["parameters"]["taper"][0], 2.15);
    assert_eq!(
        (&palm["appearance"]["evergreen"], &palm["appearance"]["bark_pattern"]),
        (&true.into(), &"ringed".into())
    );
}

#[test]
fn the_page_knows_the_same_keys() {
    let types = std::fs::read_to_string(pleach_tests::root().join("web/src/engine/protocol.ts")).unwrap();
    let fields = |interface: &str| -> Vec<&str> {
        let head = format!("export interface {interface} {{\n");
        let body = &types[types.find(&head).unwrap() + head.len()..];
        let lines = body[..body.find("\n}").unwrap()].lines().filter(|line| !line.trim().starts_with("/**"));
        let mut fields: Vec<&str> = lines.map(|line| line.trim().split(':').next().unwrap()).collect();
        fields.sort_unstable();
        fields
    };
    let dir = Dir::new();
    let mut length = dir.run(["params", "length", "--json"]).json();
    // The page has parameters alone.
    assert_eq!(length.as_object_mut().unwrap().remove("parameter"), Some(true.into()));
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(&length), fields("Parameter"));
    assert_eq!(length["slots"].as_array().unwrap().len(), 4);
    assert_eq!(keys(&length["slots"][1]), fields("Slot"));
    assert_eq!(length["slots"][0]["handle"], Value::Null);
    assert_eq!(length["slots"][1]["handle"], serde_json::json!({ "name": "crown width", "order": 2 }));
}

#[test]
fn everything_that_a_file_may_say_is_listed() {
    let dir = Dir::new();
    let keys = [
        "generator",
        "name",
        "description",
        "tree_seed",
        "appearance",
        "appearance.bark",
        "appearance.bark_pattern",
        "appearance.leaf",
        "appearance.autumn",
        "appearance.blossom",
        "appearance.evergreen",
        "appearance.season",
        "prune_inside",
        "prune_obstacles",
    ];
    let json = dir.run(["params", "--json"]).json();
    let table = dir.run(["params"]).ok();
    let of_table = |name: &str| table.lines().any(|line| line.split_whitespace().next() == Some(name));
    for key in keys {
        let entry = json.as_array().unwrap().iter().find(|entry| entry["name"] == key);
        assert_eq!(entry.unwrap()["parameter"], false, "{key}");
        assert!(of_table(key), "{key}\n{table}");
        let one = dir.run(["params", key]).ok();
        assert!(one.starts_with(&format!("{key}: ")), "{one}");
    }
    assert!(dir.run(["params", "appearance"]).ok().contains("appearance.evergreen"));
    assert!(dir.run(["params", "prune_inside"]).ok().contains("shape = \"sphere\", center = [x, y, z]"));
    // What is listed is read: a file that says all of it.
    let text = dir.run(["species", "acer", "--seed", "3"]).ok();
    let head = "prune_inside = [{ shape = \"sphere\", center = [0, 0, 6], radius = 9 }]\n";
    let _ = dir.file(
        "all.toml",
        format!("{head}{text}evergreen = true\nblossom = \"#ffffff\"\nseason = \"spring\"\n"),
    );
    assert_eq!(dir.run(["species", "all.toml", "--json"]).json()["appearance"].as_object().unwrap().len(), 7);
}

#[test]
fn groups_levels_and_numbers_are_told() {
    let dir = Dir::new();
    let table = dir.run(["params"]).ok();
    let mut rest = table.as_str();
    for group in GROUPS {
        let heading = format!("\n\n{group}\n");
        rest = &rest[rest.find(&heading).unwrap_or_else(|| panic!("{group} in order\n{table}")) + 1..];
    }
    let crown = dir.run(["params", "crown", "--json"]).json();
    assert_eq!(names(&crown), ["shape", "g_scale", "g_scale_v", "levels"]);
    let crown = dir.run(["params", "crown"]).ok();
    assert_eq!(crown.lines().count(), 5, "{crown}");
    // A parameter and a group of one name.
    let branches = dir.run(["params", "branches"]).ok();
    assert!(branches.contains("group of that name") && branches.contains("down_angle_v[4]"), "{branches}");
    let number = dir.run(["params", "length[1]", "--json"]).json();
    assert_eq!((&number["name"], &number["default"][0]), (&"length[1]".into(), &0.3.into()));
    let number = dir.run(["params", "length[1]"]).ok();
    assert!(number.starts_with("length[1]: ") && number.contains("searched  0.1..1"), "{number}");
    let level = dir.run(["params", "level:2", "--json"]).json();
    assert!(names(&level).contains(&"curve_v[2]") && names(&level).iter().all(|n| n.ends_with("[2]")));
    assert!(dir.run(["params", "level:2"]).ok().contains("curve_v[2]"));
}

#[test]
fn unknown_names_are_told_what_there_is() {
    let dir = Dir::new();
    let run = dir.run(["params", "foo"]);
    run.fails(
        1,
        &["`foo` is not a known name", "Groups are crown, trunk, branches, stems, splits", "level:3"],
    );
    assert!(!run.stderr().contains("did you mean"), "{run}");
    dir.run(["params", "lenght[1]"]).fails(1, &["did you mean `length[1]`?"]);
    dir.run(["params", "apearance"]).fails(1, &["did you mean `appearance`?"]);
    dir.run(["params", "level:7"]).fails(1, &["level:0"]);
    // The same words for what a fit is to search.
    let goal = dir.path("goal.png");
    let _ = dir.run(["silhouette", "acer", "--size", "64", "-o", goal.to_str().unwrap()]).ok();
    let free = ["fit", "goal.png", "--out", "x", "--from", "acer", "--evaluations", "5", "--free", "foo"];
    dir.run(free).fails(1, &["`foo` is not a known name. Groups are crown, trunk"]);
}

#[test]
fn examples_and_help_fit_a_narrow_terminal() {
    let dir = Dir::new();
    for command in ["blend", "map", "params", "species"] {
        let help = dir.run([command, "--help"]).ok();
        let examples = help.split("Examples:").nth(1).unwrap_or_else(|| panic!("{command}\n{help}"));
        for line in examples.lines().filter(|line| line.starts_with("  ")) {
            assert!(line.chars().count() <= 80, "{command}: {line}");
        }
    }
}
