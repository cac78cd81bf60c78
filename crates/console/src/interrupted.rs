//! The error of a run that was asked to stop.

/// A run was asked to stop (ctrl-C, SIGTERM) and did. The program then ends with exit code 130, like any
/// program that ctrl-C ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interrupted {
    message: String,
}

impl Interrupted {
    /// `message` says what is kept and how to go on.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into() }
    }

    /// Whether `error`, or what caused it, is an interruption.
    #[must_use]
    pub fn is_in(error: &anyhow::Error) -> bool {
        // Anyhow finds it below an added context, the chain finds it as a cause.
        error.is::<Self>() || error.chain().any(|cause| cause.is::<Self>())
    }
}

impl std::fmt::Display for Interrupted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Interrupted {}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::Context;

    #[test]
    fn an_interruption_is_found_below_what_was_said_of_it() {
        let error = || anyhow::Error::from(Interrupted::new("stopped; --resume goes on"));
        assert!(Interrupted::is_in(&error()));
        let told = Err::<(), _>(error()).context("acer.png").context("the second goal").unwrap_err();
        assert!(Interrupted::is_in(&told));
        assert_eq!(
            crate::output::causes(&told, ": "),
            "the second goal: acer.png: stopped; --resume goes on"
        );
        assert!(!Interrupted::is_in(&anyhow::anyhow!("interrupted")));
    }
}
