//! What the end-to-end tests of the program (`crates/cli/tests`) and tests of files share: the program, a fresh
//! directory, and readable failures.

pub mod arrays;
pub mod tool;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// The root of the repository.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()
        .expect("the repository is where it was built")
}

/// The program, in the profile of the test that asks: cargo has built it if the test belongs to its package.
#[must_use]
pub fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        let here = std::env::current_exe().expect("a test has a path");
        let profile = here.ancestors().nth(2).expect("a test lies in target/PROFILE/deps");
        profile.join(format!("pleach{}", std::env::consts::EXE_SUFFIX))
    })
}

/// A goal of the folder `targets`.
///
/// # Panics
/// If the folder is not where it should be.
#[must_use]
pub fn target(name: &str) -> String {
    root().join("targets").join(name).to_str().expect("a path of UTF-8").to_owned()
}

/// How long a test waits for what a program is to do soon.
const SOON: Duration = Duration::from_secs(60);

/// Waits until there is such a file or folder.
///
/// # Panics
/// If it does not come within a minute.
#[track_caller]
pub fn wait_for(what: &Path) {
    let started = Instant::now();
    while !what.exists() {
        assert!(started.elapsed() < SOON, "no {} within a minute", what.display());
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Waits until a checkpoint has been written over at least once. The first is written before the search has
/// tried a tree, so that a fit that is stopped then has no result to write.
///
/// # Panics
/// If that does not happen within a minute.
#[track_caller]
pub fn wait_for_progress(checkpoint: &Path) {
    wait_for(checkpoint);
    let written = || std::fs::metadata(checkpoint).and_then(|file| file.modified()).ok();
    let (started, first) = (Instant::now(), written());
    while written() <= first {
        assert!(started.elapsed() < SOON, "{} is not written over within a minute", checkpoint.display());
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// A chunk of a PNG file: length, kind, data and checksum.
///
/// # Panics
/// If `data` is longer than a chunk can be.
#[must_use]
pub fn png_chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let checked = [kind.as_slice(), data].concat();
    let length = u32::try_from(data.len()).expect("a chunk has less than 4 GiB");
    [&length.to_be_bytes(), &checked[..], &crc32fast::hash(&checked).to_be_bytes()].concat()
}

/// The bytes of a file.
///
/// # Panics
/// If it cannot be read.
#[must_use]
#[track_caller]
pub fn read(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What of a fit must be the same bits: the species, its picture, and the history without its time
/// column.
///
/// # Panics
/// If `folder` does not hold a finished fit.
#[must_use]
#[track_caller]
pub fn results(folder: &Path) -> (Vec<u8>, Vec<u8>, Vec<String>) {
    let history = String::from_utf8(read(&folder.join("history.csv"))).expect("a table of UTF-8");
    let rows = history.lines().map(|line| line.rsplit_once(',').expect("columns").0.to_owned()).collect();
    (read(&folder.join("best.toml")), read(&folder.join("best.png")), rows)
}

/// The arguments of a small fit: acer grows in a millisecond. Of the kind alone. For smaller goals no drawings of the
/// known species are built in, and the result is compared with trees that are grown for it, which takes longer.
#[must_use]
pub fn small<'a>(goal: &'a str, out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["fit", goal, "--out", out, "--size", "140", "--from", "acer", "--individual", "off"], more].concat()
}

/// A fresh directory in which the program is run; removed at the end.
#[derive(Debug)]
pub struct Dir(tempfile::TempDir);

impl Default for Dir {
    fn default() -> Self {
        Self::new()
    }
}

impl Dir {
    /// Makes the directory.
    #[must_use]
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary directory"))
    }

    /// A path inside.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file and gives its path.
    #[must_use]
    pub fn file(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        std::fs::write(&path, content).expect("a file in a fresh directory");
        path
    }

    /// The program, ready to be given more arguments, with this directory as the working directory.
    pub fn command<S: AsRef<OsStr>>(&self, args: impl IntoIterator<Item = S>) -> Command {
        let mut command = Command::new(program());
        command.current_dir(self.0.path()).args(args);
        command
    }

    /// Runs the program.
    pub fn run<S: AsRef<OsStr>>(&self, args: impl IntoIterator<Item = S>) -> Run {
        let mut command = self.command(args);
        let output = command.output().expect("the program starts");
        Run { what: format!("{command:?}"), output }
    }
}

/// A finished run.
#[derive(Debug)]
pub struct Run {
    what: String,
    output: Output,
}

impl Run {
    /// A run of a command that a test put together itself.
    #[must_use]
    pub const fn new(what: String, output: Output) -> Self {
        Self { what, output }
    }

    /// Exit code; −1 for a signal.
    #[must_use]
    pub fn code(&self) -> i32 {
        self.output.status.code().unwrap_or(-1)
    }

    /// Standard output.
    #[must_use]
    pub fn stdout(&self) -> String {
        String::from_utf8_lossy(&self.output.stdout).into_owned()
    }

    /// Standard error.
    #[must_use]
    pub fn stderr(&self) -> String {
        String::from_utf8_lossy(&self.output.stderr).into_owned()
    }

    /// Standard output of a run that ended with 0.
    ///
    /// # Panics
    /// If it did not.
    #[track_caller]
    #[must_use]
    pub fn ok(&self) -> String {
        assert_eq!(self.code(), 0, "{self}");
        self.stdout()
    }

    /// Standard output of a run that ended with 0, as JSON.
    ///
    /// # Panics
    /// If it did not, or is no JSON.
    #[track_caller]
    #[must_use]
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.ok()).unwrap_or_else(|e| panic!("{e}\n{self}"))
    }

    /// Checks that the run failed with `code` and that standard error holds all of `words`, and no
    /// sign of a panic.
    ///
    /// # Panics
    /// If it is otherwise.
    #[track_caller]
    pub fn fails(&self, code: i32, words: &[&str]) {
        assert_eq!(self.code(), code, "{self}");
        let message = self.stderr();
        assert!(!message.contains("panicked"), "{self}");
        for word in words {
            assert!(message.contains(word), "`{word}` is not in the message\n{self}");
        }
    }
}

impl std::fmt::Display for Run {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let line = "─".repeat(60);
        writeln!(f, "{}\nended with {}", self.what, self.output.status)?;
        writeln!(f, "{line} standard output\n{}", self.stdout())?;
        write!(f, "{line} standard error\n{}", self.stderr())
    }
}
