//! Documents name what is there: files, folders, sections, types, functions, options.

use crate::markdown::{Found, Markdown};
use crate::tree::{Tree, folder, join, text};
use crate::words::Words;
use std::fmt::Write as _;

/// Names in documents that are not in the tree, and why that is right: document, name, reason.
/// One that no longer applies has to go.
const EXCEPTIONS: &[(&str, &str, &str)] = &[
    ("docs/decisions/007-the-cast-lint-is-off.md", "cast_possible_truncation", "a lint that is off"),
    ("README.md", "web/dist", "built"),
    ("docs/decisions/060-two-scripts-of-checks.md", "incompatible_msrv", "a lint of clippy"),
    ("docs/releasing.md", "--dry-run", "an option of cargo"),
    ("docs/releasing.md", "web/dist", "built"),
    ("docs/cluster.md", "KillWait", "a setting of Slurm"),
    ("docs/cluster.md", "MaxArraySize", "a setting of Slurm"),
    ("docs/style.md", "LEAST_RADIUS", "an example of what not to write"),
    ("docs/style.md", "MOST_SIDE", "an example of what not to write"),
    ("web/README.md", "web/dist", "built"),
];

/// A record of what was, under the names that it had.
const HISTORY: &str = "CHANGELOG.md";

/// Endings of files that only sources have. Others may be files of the reader.
const SOURCES: [&str; 9] = ["rs", "py", "pyi", "ts", "tsx", "mjs", "js", "sh", "md"];

/// What is wrong in the documents, with the exceptions that were needed.
struct Check {
    tree: Tree,
    used: Vec<bool>,
    faults: String,
}

impl Check {
    fn new() -> Self {
        Self { tree: Tree::read(), used: vec![false; EXCEPTIONS.len()], faults: String::new() }
    }

    fn documents(&self) -> Vec<String> {
        self.tree.with_extension(&["md"]).map(str::to_owned).collect()
    }

    fn fault(&mut self, document: &str, found: &Found, what: &str) {
        let excepted =
            EXCEPTIONS.iter().position(|(place, name, _)| *place == document && *name == found.text);
        match excepted {
            Some(index) => self.used[index] = true,
            None => {
                let _ = writeln!(self.faults, "{document}:{}: `{}` {what}", found.line, found.text);
            }
        }
    }

    fn finish(self) {
        assert!(self.faults.is_empty(), "documents and sources part ways:\n{}", self.faults);
    }
}

#[test]
fn links_lead_to_files_and_sections() {
    let mut check = Check::new();
    for document in check.documents() {
        for link in Markdown::parse(&text(&document)).links {
            let (path, anchor) = link.text.split_once('#').unwrap_or((&link.text, ""));
            if path.contains(':') {
                continue; // of the web
            }
            let target = if path.is_empty() { Some(document.clone()) } else { join(folder(&document), path) };
            match target.filter(|target| check.tree.has(target)) {
                None => check.fault(&document, &link, "leads nowhere"),
                Some(target) if !anchor.is_empty() => {
                    if !Markdown::parse(&text(&target)).anchors.iter().any(|known| known == anchor) {
                        check.fault(&document, &link, "leads to no heading");
                    }
                }
                Some(_) => {}
            }
        }
    }
    check.finish();
}

#[test]
fn paths_names_and_options_in_documents_are_in_the_tree() {
    let mut check = Check::new();
    let words = Words::read(&check.tree);
    for document in check.documents().into_iter().filter(|document| document != HISTORY) {
        for span in Markdown::parse(&text(&document)).spans {
            if looks_like_a_path(&check.tree, &span.text) {
                if !path_exists(&check.tree, &document, &span.text) {
                    check.fault(&document, &span, "is not in the tree");
                }
            } else if let Some(names) = names(&span.text) {
                if !words.has_together(&names) {
                    check.fault(&document, &span, "is not in the sources");
                }
            } else {
                for option in options(&span.text).filter(|option| !words.has_option(option)) {
                    let found = Found { line: span.line, text: format!("--{option}") };
                    check.fault(&document, &found, "is not an option");
                }
            }
        }
    }
    for ((document, name, _), _) in EXCEPTIONS.iter().zip(&check.used).filter(|(_, used)| !**used) {
        let _ = writeln!(check.faults, "{document}: the exception for `{name}` is not needed any more");
    }
    check.finish();
}

#[test]
fn listings_and_comments_name_files_that_are_there() {
    let mut check = Check::new();
    let roots = ["crates/", "experiments/", "targets/", "species/", "docs/", "tests/", "examples/", "web/"];
    for document in check.documents().into_iter().filter(|document| document != HISTORY) {
        for line in Markdown::parse(&text(&document)).listings {
            for word in line.text.split(|c: char| c.is_whitespace() || "\"'(),=`".contains(c)) {
                if roots.iter().any(|root| word.starts_with(root))
                    && !path_exists(&check.tree, &document, word)
                {
                    check.fault(
                        &document,
                        &Found { line: line.line, text: word.to_owned() },
                        "is not in the tree",
                    );
                }
            }
        }
    }
    let sources: Vec<String> =
        check.tree.with_extension(&["rs", "ts", "tsx", "mjs", "py"]).map(str::to_owned).collect();
    for source in sources {
        for (index, line) in text(&source).lines().enumerate() {
            let line = line.trim_start();
            let Some(comment) = line.strip_prefix("//").or_else(|| line.strip_prefix("# ")) else { continue };
            for word in comment.split(|c: char| c.is_whitespace() || "\"'(),;=`[]".contains(c)) {
                let word = word.trim_end_matches(['.', ':', '…']);
                let is_source = word.rsplit_once('.').is_some_and(|(stem, ending)| {
                    !stem.is_empty() && !stem.contains(':') && SOURCES.contains(&ending)
                });
                if is_source && !path_exists(&check.tree, &source, word) {
                    check.fault(
                        &source,
                        &Found { line: index + 1, text: word.to_owned() },
                        "is not in the tree",
                    );
                }
            }
        }
    }
    check.finish();
}

/// Whether this is the path of something in the tree, by its form: `crates/fit`, `plan/mod.rs`.
fn looks_like_a_path(tree: &Tree, text: &str) -> bool {
    let odd = |c: char| c.is_whitespace() || "<>()=$…|\\;\"'".contains(c);
    if text.is_empty() || text.contains(odd) || text.contains("://") || text.starts_with(['-', '/', '~']) {
        return false;
    }
    let first = text.split('/').next().unwrap_or(text);
    let in_a_folder = text.contains('/')
        && tree.folders.iter().any(|path| path == first || path.strip_prefix("crates/") == Some(first));
    let is_source = text.rsplit_once('.').is_some_and(|(_, ending)| SOURCES.contains(&ending));
    in_a_folder || is_source
}

/// Whether there is such a path: from the root, from the document, or as the end of one.
///
/// `crates/` and `src/` may be left out (`fit/guess/`), `{a,b}` is each, and `*` and words in capitals stand for any.
fn path_exists(tree: &Tree, document: &str, path: &str) -> bool {
    let path = path.trim_end_matches(['/', ',', '.']);
    if let Some((before, rest)) = path.split_once('{')
        && let Some((choices, after)) = rest.split_once('}')
    {
        return choices.split(',').all(|one| path_exists(tree, document, &format!("{before}{one}{after}")));
    }
    let path = path.split_once(':').map_or(path, |(path, _)| path);
    if tree.has(path) || join(folder(document), path).is_some_and(|path| tree.has(&path)) {
        return true;
    }
    let whole = path.starts_with("crates/");
    // Names in capitals that are names: `README.md`.
    let is_known = |name: &str| tree.files.iter().any(|path| path.rsplit('/').next() == Some(name));
    let wanted: Vec<(&str, bool)> =
        path.split('/').filter(|part| whole || *part != "src").map(|part| (part, is_known(part))).collect();
    tree.paths().any(|known| {
        let known: Vec<&str> = known.split('/').filter(|part| whole || *part != "src").collect();
        let long_enough = if whole { known.len() == wanted.len() } else { known.len() >= wanted.len() };
        let is_same = |(name, (form, literal)): (&&str, &(&str, bool))| {
            name == form || (!literal && is_like(name, form))
        };
        long_enough && known.iter().rev().zip(wanted.iter().rev()).all(is_same)
    })
}

/// Whether a name is of a form in which `*` and words in capitals stand for anything.
fn is_like(name: &str, form: &str) -> bool {
    let mut pieces = vec![String::new()];
    let mut capitals = 0;
    for c in form.chars() {
        capitals = if c.is_ascii_uppercase() { capitals + 1 } else { 0 };
        let last = pieces.last_mut().expect("there is one");
        if c == '*' || capitals == 2 {
            last.truncate(last.len() - usize::from(capitals == 2));
            pieces.push(String::new());
        } else if capitals < 2 {
            last.push(c);
        }
    }
    let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
    if pieces.len() == 1 || name == form {
        return name == form;
    }
    name.len() >= first.len() + last.len()
        && name.starts_with(first.as_str())
        && name.ends_with(last.as_str())
}

/// The names that a code span consists of, if it is code: `Type::method`, `SomeType`, `some_function`.
fn names(text: &str) -> Option<Vec<&str>> {
    let text = text.split_once(['(', '<', '!', '{', ' ']).map_or(text, |(name, _)| name);
    let parts: Vec<&str> = text.split("::").filter(|part| !part.is_empty()).collect();
    let is_name = |part: &&str| {
        part.starts_with(|c: char| c.is_ascii_alphabetic())
            && part.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    };
    if parts.is_empty() || !parts.iter().all(is_name) {
        return None;
    }
    if let [name] = parts[..] {
        let humps = name.chars().skip(1).any(|c| c.is_ascii_uppercase())
            && name.chars().any(|c| c.is_ascii_lowercase());
        let snake = name.contains('_');
        return (humps || snake).then_some(parts);
    }
    // The crate that a path begins with stands in manifests, spelt otherwise.
    let crates =
        |part: &&str| !(part.starts_with("pleach_") || matches!(*part, "std" | "crate" | "pleach" | "super"));
    Some(parts.into_iter().filter(crates).collect())
}

/// The options of a command of the program, or an option by itself.
fn options(text: &str) -> impl Iterator<Item = &str> {
    let ours = text.starts_with("--") || text.starts_with("pleach ");
    text.split_whitespace()
        .filter(move |_| ours)
        .filter_map(|word| word.strip_prefix("--"))
        .map(|option| {
            option.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-')).next().unwrap_or(option)
        })
        .filter(|option| !option.is_empty())
}

#[test]
fn forms_of_paths() {
    assert!(
        is_like("acer.png", "NAME.png")
            && is_like("mod.rs", "mod.rs")
            && is_like("grammar_acer.toml", "grammar_*.toml")
    );
    assert!(!is_like("acer.toml", "NAME.png") && !is_like("mod.rs", "mad.rs"));
    assert_eq!(names("Type::method()"), Some(vec!["Type", "method"]));
    assert_eq!(names("plain"), None);
    assert_eq!(options("pleach fit --size 3 --from=x").collect::<Vec<_>>(), ["size", "from"]);
}
