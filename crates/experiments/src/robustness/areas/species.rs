//! Spoilt species files.

use super::{Area, draws, grown, refused};
use crate::robustness::mutate;
use crate::robustness::verdict::Verdict;
use pleach_generators::{families, read_file, read_text};
use std::path::Path;

const LANE: u32 = 1;

/// The files of all species that come with pleach.
pub(in super::super) struct SpeciesFiles {
    texts: Vec<&'static str>,
}

impl SpeciesFiles {
    pub(in super::super) fn new() -> Self {
        Self { texts: families().iter().flat_map(|f| f.presets()).map(|(_, text)| *text).collect() }
    }
}

impl Area for SpeciesFiles {
    fn name(&self) -> &'static str {
        "species files"
    }

    fn input(&self, case: u64) -> Vec<u8> {
        let mut draws = draws(LANE, case);
        let text = self.texts[draws.below(self.texts.len())];
        mutate::text(text, &mut draws)
    }

    fn judge(&self, case: u64, folder: &Path) -> Verdict {
        let input = self.input(case);
        let read = match std::str::from_utf8(&input) {
            Ok(text) => read_text("species.toml", text).map_err(|e| e.to_string()),
            // Only a file can hold what is not text.
            Err(_) => {
                let file = folder.join("species.toml");
                if let Err(error) = std::fs::write(&file, &input) {
                    return Verdict::Wrong(format!("the case could not be made: {error}"));
                }
                read_file(&file).map_err(|e| e.to_string())
            }
        };
        let species = match read {
            Ok(species) => species,
            Err(message) => return refused(message, true),
        };
        match read_text("again.toml", &species.to_toml(&[])) {
            Ok(again) if again.params == species.params => grown(&species, case),
            Ok(_) => Verdict::Wrong("written and read again it has other parameters".to_owned()),
            Err(error) => Verdict::Wrong(format!("written it cannot be read again: {error}")),
        }
    }
}
