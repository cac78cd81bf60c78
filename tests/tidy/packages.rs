//! What every package that is published has: licences, a page, words to be found by, and no path that only this
//! repository knows.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::tree::{Tree, text};
use std::path::{Path, PathBuf};
use toml::{Table, Value};

struct Package {
    folder: PathBuf,
    manifest: Table,
}

impl Package {
    fn name(&self) -> &str {
        self.manifest["package"]["name"].as_str().unwrap()
    }

    fn words(&self, key: &str) -> Vec<&str> {
        let words = self.manifest["package"].get(key).and_then(Value::as_array);
        words.map_or(Vec::new(), |words| words.iter().map(|word| word.as_str().unwrap()).collect())
    }
}

fn manifest(folder: &Path) -> Table {
    std::fs::read_to_string(folder.join("Cargo.toml")).unwrap().parse().unwrap()
}

/// The members of the workspace but those with `publish = false`.
fn published() -> Vec<Package> {
    let root = pleach_tests::root();
    let crates = std::fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let folders = crates.filter(|folder| folder.join("Cargo.toml").exists()).chain([root.join("species")]);
    let packages = folders.map(|folder| Package { manifest: manifest(&folder), folder });
    let published: Vec<Package> =
        packages.filter(|one| one.manifest["package"].get("publish").is_none()).collect();
    assert!(published.len() > 15, "{}", published.len());
    published
}

#[test]
fn packages_hold_the_licences_and_a_page() {
    let root = pleach_tests::root();
    for package in published() {
        for name in ["LICENSE-MIT", "LICENSE-APACHE"] {
            let theirs = std::fs::read(package.folder.join(name));
            let why = format!("copy {name} into {}", package.folder.display());
            assert!(theirs.expect(&why) == std::fs::read(root.join(name)).unwrap(), "{why}");
        }
        let page = package.manifest["package"].get("readme").and_then(Value::as_str).unwrap_or("README.md");
        assert!(package.folder.join(page).is_file(), "{} has no README.md", package.name());
    }
}

#[test]
fn packages_are_found_by_words_that_the_registry_takes() {
    for package in published() {
        let name = package.name();
        let documentation = package.manifest["package"]["documentation"].as_str();
        assert_eq!(documentation, Some(format!("https://docs.rs/{name}").as_str()), "{name}");
        let (keywords, categories) = (package.words("keywords"), package.words("categories"));
        assert!((1..=5).contains(&keywords.len()) && (1..=5).contains(&categories.len()), "{name}");
        for keyword in keywords {
            let plain = |c: char| c.is_ascii_alphanumeric() || "-_+".contains(c);
            assert!(keyword.len() <= 20 && keyword.chars().all(plain), "{name}: {keyword}");
        }
    }
}

/// A dependency on this workspace for tests has a path and no version: with a version the registry would want the
/// other package first, and the other this one.
#[test]
fn dependencies_for_tests_are_no_circle() {
    for package in published() {
        let Some(dependencies) = package.manifest.get("dev-dependencies").and_then(Value::as_table) else {
            continue;
        };
        for (name, dependency) in dependencies.iter().filter(|(name, _)| name.starts_with("pleach")) {
            let is_path = dependency.get("path").is_some() && dependency.get("version").is_none();
            assert!(is_path, "{}: `{name}` under [dev-dependencies] wants `path = …` alone", package.name());
        }
    }
}

/// Clones on Windows have none without a privilege.
#[cfg(unix)]
#[test]
fn no_folder_is_a_link() {
    for package in published() {
        for entry in std::fs::read_dir(&package.folder).unwrap() {
            let path = entry.unwrap().path();
            assert!(!path.is_symlink(), "{} is a link", path.display());
        }
    }
}

/// See `docs/decisions/062-errors-may-grow.md`.
#[test]
fn public_errors_may_grow() {
    let mut seen = 0;
    for path in Tree::read().with_extension(&["rs"]).filter(|path| path.contains("/src/")) {
        let source = text(path);
        let lines: Vec<&str> = source.lines().collect();
        for (i, line) in lines.iter().enumerate().filter(|(_, line)| line.starts_with("pub enum ")) {
            let attributes: Vec<&str> =
                lines[..i].iter().rev().take_while(|line| line.starts_with("#[")).copied().collect();
            if attributes.iter().any(|line| line.contains("thiserror::Error")) {
                seen += 1;
                assert!(
                    attributes.contains(&"#[non_exhaustive]"),
                    "{path}:{}: {line} is an error and wants #[non_exhaustive]",
                    i + 1
                );
            }
        }
    }
    assert!(seen > 15, "{seen} errors");
}
