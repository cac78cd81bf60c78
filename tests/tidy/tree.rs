//! The files of the repository, without what is built or fetched.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Folders that are built, fetched or written by runs, and the repository's own.
const SKIPPED: [&str; 9] =
    [".git", "target", "node_modules", "dist", "runs", "findings", "__pycache__", "venv", ".pytest_cache"];

/// Every file and folder, relative to the root and with `/` between the names.
pub(crate) struct Tree {
    pub(crate) files: BTreeSet<String>,
    pub(crate) folders: BTreeSet<String>,
}

impl Tree {
    pub(crate) fn read() -> Self {
        let mut tree = Self { files: BTreeSet::new(), folders: BTreeSet::new() };
        tree.visit(&pleach_tests::root(), "");
        assert!(tree.files.len() > 500, "the walk over the repository finds its files");
        tree
    }

    fn visit(&mut self, folder: &Path, name: &str) {
        for entry in fs::read_dir(folder).expect("a folder of the repository is readable") {
            let entry = entry.expect("a folder of the repository is readable");
            let Ok(file_name) = entry.file_name().into_string() else { continue };
            let path = if name.is_empty() { file_name.clone() } else { format!("{name}/{file_name}") };
            let kind = entry.file_type().expect("an entry has a type");
            if !kind.is_dir() {
                self.files.insert(path);
            } else if !SKIPPED.contains(&file_name.as_str()) {
                self.visit(&entry.path(), &path);
                self.folders.insert(path);
            }
        }
    }

    /// The files whose names end in one of these.
    pub(crate) fn with_extension(&self, extensions: &[&str]) -> impl Iterator<Item = &str> {
        self.files.iter().map(String::as_str).filter(move |file| {
            file.rsplit_once('.').is_some_and(|(_, extension)| extensions.contains(&extension))
        })
    }

    /// Whether there is a file or folder of this path.
    pub(crate) fn has(&self, path: &str) -> bool {
        path.is_empty() || self.files.contains(path) || self.folders.contains(path)
    }

    /// Everything there is, files and folders.
    pub(crate) fn paths(&self) -> impl Iterator<Item = &str> {
        self.files.iter().chain(&self.folders).map(String::as_str)
    }
}

/// The text of a file of the repository.
pub(crate) fn text(path: &str) -> String {
    let bytes = fs::read(pleach_tests::root().join(path)).expect("a file of the repository is readable");
    String::from_utf8_lossy(&bytes).into_owned()
}

/// `path` seen from `folder`, with its `..` resolved; `None` where it leaves the repository.
pub(crate) fn join(folder: &str, path: &str) -> Option<String> {
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

/// The folder that a file is in.
pub(crate) fn folder(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}
