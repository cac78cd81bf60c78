//! Spoilt `experiment.toml`.

use super::{Area, draws, refused};
use crate::kinds::Spec;
use crate::outputs::Outputs;
use crate::robustness::mutate;
use crate::robustness::verdict::Verdict;
use crate::spec::Source;
use std::path::{Component, Path};

const LANE: u32 = 5;

/// One of each kind.
const TEXTS: [&str; 10] = [
    include_str!("../templates/fits.toml"),
    include_str!("../templates/growth.toml"),
    include_str!("../templates/blend.toml"),
    include_str!("../templates/likeness.toml"),
    include_str!("../templates/treefit.toml"),
    include_str!("../templates/needle.toml"),
    include_str!("../templates/families.toml"),
    include_str!("../templates/yao.toml"),
    include_str!("../templates/stylised.toml"),
    include_str!("../templates/robustness.toml"),
];

/// Options of every kind of experiment; nothing is run.
pub(in super::super) struct Experiments;

impl Area for Experiments {
    fn name(&self) -> &'static str {
        "experiments"
    }

    fn input(&self, case: u64) -> Vec<u8> {
        let mut draws = draws(LANE, case);
        let text = TEXTS[draws.below(TEXTS.len())];
        mutate::text(text, &mut draws)
    }

    fn judge(&self, case: u64, folder: &Path) -> Verdict {
        let path = folder.join("experiment.toml");
        if let Err(error) = std::fs::write(&path, self.input(case)) {
            return Verdict::Wrong(format!("the case could not be made: {error}"));
        }
        let named = |error: anyhow::Error, has_place| {
            let message = pleach_console::output::causes(&error, "\n");
            refused(message.replace(&*folder.to_string_lossy(), "folder"), has_place)
        };
        let spec = match Source::read(folder).and_then(|source| Spec::read(&source)) {
            Ok(spec) => spec,
            Err(error) => return named(error, true),
        };
        let (written, read) = spec.kind().files(folder);
        let is_inside =
            |name: &String| Path::new(name).components().all(|c| matches!(c, Component::Normal(_)));
        if let Some(outside) = written.iter().find(|name| !is_inside(name)) {
            return Verdict::Wrong(format!("{outside:?} would be written"));
        }
        match Outputs::declare(folder, written, read) {
            Ok(_) => Verdict::Accepted,
            Err(error) => named(error, false),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn templates_are_experiments_until_they_are_spoilt() {
        for text in TEXTS {
            let folder = tempfile::tempdir().unwrap();
            std::fs::write(folder.path().join("experiment.toml"), text).unwrap();
            let spec =
                Spec::read(&Source::read(folder.path()).unwrap()).unwrap_or_else(|e| panic!("{e}\n{text}"));
            let (written, read) = spec.kind().files(folder.path());
            let _ = Outputs::declare(folder.path(), written, read).unwrap();
        }
    }
}
