//! The map of the house against the manifests: which crate knows which, and on which floor it lives.

use crate::tree::{Tree, text};
use std::collections::BTreeMap;

/// The crates of each floor and what each crate depends on, by `ARCHITECTURE.md`.
struct Map {
    floors: BTreeMap<String, u32>,
    arrows: BTreeMap<String, Vec<String>>,
}

impl Map {
    fn read() -> Self {
        let mut map = Self { floors: BTreeMap::new(), arrows: BTreeMap::new() };
        for line in text("ARCHITECTURE.md").lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            match words[..] {
                [floor, ref crates @ ..] if floor.len() == 1 && floor.parse::<u32>().is_ok() => {
                    let floor = floor.parse().expect("it is a number");
                    map.floors.extend(crates.iter().map(|name| ((*name).to_owned(), floor)));
                }
                [name, "→", ref others @ ..] if map.floors.contains_key(name) => {
                    map.arrows.insert(name.to_owned(), sorted(others.iter().copied()));
                }
                _ => {}
            }
        }
        map
    }
}

fn sorted<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.sort();
    names
}

/// The crates of the project that a manifest depends on, without those that only its tests want.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut in_dependencies = false;
    let mut names = Vec::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            in_dependencies =
                line == "[dependencies]" || line.starts_with("[target.") && line.ends_with(".dependencies]");
        } else if in_dependencies && line.starts_with("pleach") {
            let name = line.split(['.', ' ', '=']).next().unwrap_or(line);
            names.push(name.strip_prefix("pleach-").unwrap_or(name));
        }
    }
    sorted(names.into_iter())
}

#[test]
fn the_map_shows_the_crates_as_the_manifests_have_them() {
    let map = Map::read();
    let tree = Tree::read();
    let manifests = tree
        .files
        .iter()
        .filter_map(|path| Some((path.strip_suffix("/Cargo.toml")?, path.as_str())))
        .filter_map(|(folder, path)| match folder {
            "species" => Some((folder, path)),
            _ => Some((folder.strip_prefix("crates/")?, path)),
        });
    let mut seen = 0;
    for (name, path) in manifests {
        seen += 1;
        let floor =
            *map.floors.get(name).unwrap_or_else(|| panic!("ARCHITECTURE.md has no floor for `{name}`"));
        let known = dependencies(&text(path));
        let drawn = map.arrows.get(name).cloned().unwrap_or_default();
        assert_eq!(drawn, known, "what `{name}` depends on, by ARCHITECTURE.md and by {path}");
        for other in known {
            assert!(
                map.floors[&other] < floor,
                "`{name}`, on floor {floor}, depends on `{other}`, which is not below"
            );
        }
    }
    assert_eq!(seen, map.floors.len(), "crates on the map that are not there: {:?}", map.floors.keys());
}

#[test]
fn every_decision_is_in_the_index_under_its_number() {
    let index = text("docs/decisions/README.md");
    let tree = Tree::read();
    let mut numbers = Vec::new();
    for path in
        tree.files.iter().filter(|path| path.starts_with("docs/decisions/") && !path.ends_with("README.md"))
    {
        let name = path.rsplit('/').next().unwrap_or(path);
        let number: u32 =
            name.split('-').next().and_then(|number| number.parse().ok()).expect("NNN-title.md");
        assert!(
            index.contains(&format!("[{number:03}]({name})")),
            "docs/decisions/README.md does not list {name}"
        );
        let title = format!("# {number}. ");
        assert!(text(path).starts_with(&title), "{path} does not begin with `{title}`");
        assert!(!numbers.contains(&number), "two decisions have the number {number}");
        numbers.push(number);
    }
    assert!(numbers.len() > 50, "{} decisions", numbers.len());
}
