//! Bars that only a person sees.

use crate::output;
use indicatif::{ProgressBar, ProgressStyle};

/// A bar that counts `what` up to `total`; hidden unless standard error is a terminal.
#[must_use]
pub fn bar(what: &str, total: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{pos}/{len} {prefix} {wide_bar} {eta} left");
    let bar = if output::is_watched() { ProgressBar::new(total) } else { ProgressBar::hidden() };
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_prefix(what.to_owned());
    bar
}
