//! The names of the files in a run folder.

/// The report of a fit, which says whether it is finished.
pub(in super::super) const SUMMARY: &str = "summary.json";
/// The sheet of several trees on one goal.
pub(in super::super) const SHEET: &str = "individuals.png";
/// The state of an unfinished search.
pub(super) const CHECKPOINT: &str = "checkpoint";
/// The same of a finished one, for `--continue`.
pub(super) const STATE: &str = "search-state";
/// The intervals of the numbers, and a sheet of trees that the goal may be of.
pub(in super::super) const POSTERIOR: &str = "posterior.csv";
pub(in super::super) const POSTERIOR_SHEET: &str = "posterior.png";
/// What a fit writes into its folder; trees of several, and overlays of further views, beside it.
pub(super) const FILES: [&str; 18] = [
    "best.toml",
    "best.png",
    "overlay.png",
    "render.png",
    "individual.toml",
    "individual.png",
    "individual-render.png",
    SHEET,
    POSTERIOR,
    POSTERIOR_SHEET,
    "mask.png",
    "reading.json",
    "reading.png",
    "history.csv",
    "parameters.csv",
    SUMMARY,
    CHECKPOINT,
    STATE,
];

/// The species file of one of several trees, the best of which is number 0.
pub(in super::super) fn individual_file(number: usize) -> String {
    if number == 0 { "individual.toml".to_owned() } else { format!("individual-{}.toml", number + 1) }
}

/// The species file of one of the trees that the goal may be of, from 0.
pub(in super::super) fn sample_file(number: usize) -> String {
    format!("posterior-{}.toml", number + 1)
}

/// Whether a file of this name in a run folder is written by fits.
pub(super) fn is_ours(name: &str) -> bool {
    let rest = ["individual-", "posterior-"].iter().find_map(|start| name.strip_prefix(start));
    let number = rest.and_then(|rest| rest.strip_suffix(".toml"));
    let is_tree =
        number.is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()));
    FILES.contains(&name) || is_tree || (name.starts_with("overlay-") && name.ends_with(".png"))
}
