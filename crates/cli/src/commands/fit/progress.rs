//! What is seen of a running fit.

use super::report;
use crate::output;
use indicatif::{ProgressBar, ProgressStyle};
use pleach_fit::{CheckpointError, FitSettings, Progress};

/// A bar with the cost and likeness of the best tree, trees per second and the time left. Hidden if standard error is
/// not a terminal.
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

    pub(super) fn progress(&mut self, progress: &Progress<'_>) {
        let used = progress.used.unwrap_or(0.0).clamp(0.0, 1.0);
        self.bar.set_position((used * STEPS as f64) as u64);
        let seconds = progress.elapsed_now.as_secs_f64();
        let rate = progress.evaluations_now as f64 / seconds.max(1e-9);
        let left = if used > 0.01 {
            format!(", {:.0} s left", progress.elapsed.as_secs_f64() * (1.0 / used - 1.0))
        } else {
            String::new()
        };
        let trees = report::trees(progress.evaluations);
        self.bar.set_message(format!("{}; {trees}, {}{left}", state(progress), report::rate(rate)));
    }

    pub(super) fn checkpoint_failed(&mut self, error: &CheckpointError) {
        // Once is enough: the disk will be as full a second later.
        if !self.warned {
            self.warned = true;
            self.bar.suspend(|| {
                output::note(format!("warning: {error}; the fit goes on without a new checkpoint"))
            });
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// How good the best tree is: first what the search makes small, since nothing else falls steadily.
fn state(progress: &Progress<'_>) -> String {
    let Some(best) = progress.best else { return "no tree yet".to_owned() };
    let likeness = progress.likeness.map_or_else(String::new, |likeness| format!(", likeness {likeness:.3}"));
    format!("cost {:.4}{likeness}, IoU {:.3}", best.score.cost, best.score.iou)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_fit::{Genome, Score, Scored};
    use std::time::Duration;

    #[test]
    fn what_is_made_small_comes_first() {
        let score = Score { iou: 0.25, ..Score::from_cost(0.5) };
        let best = Scored { genome: Genome::new(Vec::new(), 1), score };
        let progress = |likeness, best| Progress {
            generation: 1,
            evaluations: 20,
            evaluations_now: 20,
            best,
            likeness,
            elapsed: Duration::from_secs(1),
            elapsed_now: Duration::from_secs(1),
            used: None,
        };
        assert_eq!(state(&progress(Some(0.75), Some(&best))), "cost 0.5000, likeness 0.750, IoU 0.250");
        assert_eq!(state(&progress(None, Some(&best))), "cost 0.5000, IoU 0.250");
        assert_eq!(state(&progress(None, None)), "no tree yet");
    }
}
