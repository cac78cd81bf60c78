//! The experiments of a folder, each with its question.

use super::spec::Source;
use anyhow::{Context, bail};
use pleach_console::output;
use std::path::Path;

/// The default folder of experiments.
pub const FOLDER: &str = "experiments";

/// A line for each experiment in `folder`.
///
/// # Errors
/// If the folder cannot be read or holds no experiment.
pub fn list(folder: &Path) -> anyhow::Result<String> {
    let unreadable = || format!("cannot read the folder {}", folder.display());
    let entries = std::fs::read_dir(folder).with_context(unreadable)?;
    let mut paths = Vec::new();
    for entry in entries {
        let path = entry.with_context(unreadable)?.path();
        if path.join("experiment.toml").is_file() {
            paths.push(path);
        }
    }
    if paths.is_empty() {
        bail!("{} holds no experiment: no folder in it has an experiment.toml", folder.display());
    }
    paths.sort();
    let mut rows = vec![["experiment", "kind", "question"].map(str::to_owned).to_vec()];
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // One that cannot be read does not hide the others.
        let (kind, question) = match Source::read(&path).and_then(|source| source.head()) {
            Ok(head) => (head.kind.name().to_owned(), head.question),
            Err(error) => (String::new(), output::causes(&error, ": ")),
        };
        rows.push(vec![name, kind, question.split_whitespace().collect::<Vec<_>>().join(" ")]);
    }
    Ok(format!(
        "{}\n\nrun one with `pleach experiment run {}`",
        output::table(&rows, &[]),
        folder.join("NAME").display()
    ))
}
