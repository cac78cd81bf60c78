//! What is seen of a running fit.

use crate::output;
use indicatif::{ProgressBar, ProgressStyle};
use pleach_fit::{CheckpointError, FitSettings, Observer, Progress};

/// A bar with the best score, evaluations a second and the time left; nothing where nobody watches.
pub(super) struct Bar {
    bar: ProgressBar,
    warned: bool,
}

/// Steps of the bar: it shows the used share of the budget, whatever that is counted in.
const STEPS: u64 = 1000;

impl Bar {
    pub(super) fn new(settings: &FitSettings) -> Self {
        let style = ProgressStyle::with_template("{prefix} {wide_bar} {msg}")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = if output::is_watched() {
            ProgressBar::new(STEPS).with_style(style)
        } else {
            ProgressBar::hidden()
        };
        bar.set_prefix(settings.optimizer.name());
        Self { bar, warned: false }
    }

    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Observer for Bar {
    fn progress(&mut self, progress: &Progress<'_>) {
        let used = progress.used.unwrap_or(0.0).clamp(0.0, 1.0);
        self.bar.set_position((used * STEPS as f64) as u64);
        let seconds = progress.elapsed_now.as_secs_f64();
        let rate = progress.evaluations_now as f64 / seconds.max(1e-9);
        let left = if used > 0.01 {
            format!(", {:.0} s left", progress.elapsed.as_secs_f64() * (1.0 / used - 1.0))
        } else {
            String::new()
        };
        let best = progress.best.map_or_else(
            || "no tree yet".to_owned(),
            |b| format!("IoU {:.3}, {:.2} % of pixels", b.score.iou, 100.0 * b.score.accuracy),
        );
        self.bar.set_message(format!("{best}; {} trees, {rate:.0}/s{left}", progress.evaluations));
    }

    fn checkpoint_failed(&mut self, error: &CheckpointError) {
        // Once is enough: the disk will be as full a second later.
        if !self.warned {
            self.warned = true;
            self.bar.suspend(|| {
                output::note(format!("warning: {error}; the fit goes on without a new checkpoint"))
            });
        }
    }
}
