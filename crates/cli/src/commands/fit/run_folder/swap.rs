//! A finished run takes the place of an earlier one, whole or not at all.
//!
//! While the earlier result stands, the new run writes into a folder of its own inside the run folder.
//! Once everything is there, a marker says so, and the swap only goes forward: the earlier files are
//! removed, the marker gets another name, the new files are moved. After a kill at any moment the next
//! command that looks at the folder ends what was begun.

use super::names::{SUMMARY, is_ours};
use crate::files;
use crate::regular::Found;
use anyhow::Context;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Where a run waits while an earlier result stands.
pub(super) const STAGE: &str = "unfinished";
/// Marks a stage that is complete: the earlier files may go.
const COMPLETE: &str = "swap-complete";
/// Marks a stage whose files are being moved: the earlier ones are gone.
const MOVING: &str = "swap-moving";

/// Puts the complete run in the stage of `home` in the place of what is there.
pub(super) fn swap(home: &Path) -> anyhow::Result<()> {
    files::write_text(&home.join(STAGE).join(COMPLETE), "")?;
    finish(home)
}

/// Whether a swap in `home` was begun and not ended.
pub(super) fn is_begun(home: &Path) -> bool {
    [COMPLETE, MOVING].iter().any(|marker| home.join(STAGE).join(marker).exists())
}

/// Ends a swap that was begun, if there is one.
pub(super) fn finish(home: &Path) -> anyhow::Result<()> {
    let stage = home.join(STAGE);
    if stage.join(COMPLETE).exists() {
        clear(home)?;
        rename(&stage.join(COMPLETE), &stage.join(MOVING))?;
    }
    if stage.join(MOVING).exists() {
        let mut names: Vec<String> = names(&stage)?.into_iter().filter(|name| is_ours(name)).collect();
        // A folder without a summary is not a result, so the summary comes last.
        names.sort_by_key(|name| name == SUMMARY);
        for name in names {
            rename(&stage.join(&name), &home.join(&name))?;
        }
        remove(&stage.join(MOVING))?;
        // It stays if it holds files that are not ours.
        let _ = fs::remove_dir(&stage);
    }
    Ok(())
}

/// Removes the files of a run from `folder`, the summary first.
pub(super) fn clear(folder: &Path) -> anyhow::Result<()> {
    let mut ours: Vec<String> = names(folder)?.into_iter().filter(|name| is_ours(name)).collect();
    ours.sort_by_key(|name| name != SUMMARY);
    ours.iter().try_for_each(|name| remove(&folder.join(name)))
}

/// Removes from `folder` what a run that was killed while it wrote a file has left of it. Only who has the
/// lock may do that: others' files are being written.
pub(super) fn remove_temporary(folder: &Path) -> anyhow::Result<()> {
    let is_begun = |file: &str| is_ours(file) || [COMPLETE, MOVING].contains(&file);
    for name in names(folder)?.iter().filter(|name| files::temporary_of(name).is_some_and(is_begun)) {
        let path = folder.join(name);
        if Found::at(&path)? == Found::File {
            remove(&path)?;
        }
    }
    Ok(())
}

/// Names of the files in `folder`; empty if it is not there.
fn names(folder: &Path) -> anyhow::Result<Vec<String>> {
    let cannot = || format!("cannot read the folder {}", folder.display());
    match fs::read_dir(folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(Vec::new()),
        Err(error) => Err(error).with_context(cannot),
        Ok(entries) => entries
            .map(|entry| Ok(entry?.file_name().into_string().unwrap_or_default()))
            .collect::<std::io::Result<Vec<_>>>()
            .with_context(cannot),
    }
}

/// Removes a file, if it is there.
pub(super) fn remove(path: &Path) -> anyhow::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            Err(error).with_context(|| format!("cannot remove {}", path.display()))
        }
        _ => Ok(()),
    }
}

pub(super) fn rename(from: &Path, to: &Path) -> anyhow::Result<()> {
    fs::rename(from, to).with_context(|| format!("cannot move {} to {}", from.display(), to.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a kill leaves after `steps` file operations of a swap, and what the next command makes of it.
    #[test]
    fn a_swap_that_is_cut_off_anywhere_ends_as_if_it_had_not_been() {
        let new = ["best.toml", "best.png", "overlay-2.png", "summary.json"];
        for cut in 0..6 {
            let folder = tempfile::tempdir().unwrap();
            let (home, stage) = (folder.path(), folder.path().join(STAGE));
            fs::create_dir(&stage).unwrap();
            for name in ["best.toml", "parameters.csv", "summary.json", "notes.txt"] {
                fs::write(home.join(name), "old").unwrap();
            }
            for name in new {
                fs::write(stage.join(name), "new").unwrap();
            }
            fs::write(stage.join(COMPLETE), "").unwrap();
            // The order in which `finish` works, cut off.
            match cut {
                0 => {}
                1 => fs::remove_file(home.join("summary.json")).unwrap(),
                2 => clear(home).unwrap(),
                _ => {
                    clear(home).unwrap();
                    rename(&stage.join(COMPLETE), &stage.join(MOVING)).unwrap();
                    for name in &new[..cut - 2] {
                        rename(&stage.join(name), &home.join(name)).unwrap();
                    }
                }
            }
            assert!(is_begun(home));
            finish(home).unwrap();
            assert!(!is_begun(home) && !stage.exists());
            let mut left = names(home).unwrap();
            left.sort();
            assert_eq!(
                left,
                ["best.png", "best.toml", "notes.txt", "overlay-2.png", "summary.json"],
                "{cut}"
            );
            assert!(new.iter().all(|name| fs::read(home.join(name)).unwrap() == b"new"));
        }
    }
}
