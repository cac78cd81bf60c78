//! Which part of an experiment is run.

/// Which part of an experiment is run.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Only these methods, again for further ones; rows of the others stay as they are (kind treefit).
    /// Empty for all.
    pub methods: Vec<String>,
    /// Go on with a run that was interrupted or killed: rows that it had finished are kept.
    pub resume: bool,
    /// Start over although an unfinished run has left rows.
    pub overwrite: bool,
}
