//! Species of other programs as text of species files.
//!
//! | program | file | read as |
//! | --- | --- | --- |
//! | tree-gen (Hewitt) | a dictionary of Python literals, after `params =` or alone | the same numbers |
//! | Sapling Tree Gen | a dictionary of Python literals | the same model, other names |
//! | Arbaro | XML, a `param` per number | the same model, other names |
//! | ez-tree | JSON | the nearest tree of Weber and Penn's model |
//!
//! No file is run: literals are read by a parser that knows nothing else, XML without document types and so without
//! entities of its own. Everything is in metres and degrees, as in these programs. One unit of ez-tree is a metre, as in
//! the glTF files that it writes.
//!
//! ```
//! let preset = "params = {'g_scale': 6, 'levels': 2, 'bevel_res': [10, 10, 10, 10]}";
//! let foreign = pleach_import::translate("preset", preset)?;
//! assert_eq!(foreign.program.name(), "tree-gen");
//! assert!(foreign.toml.contains("g_scale = 6"));
//! assert_eq!(foreign.without_counterpart, ["bevel_res"]);
//! # Ok::<(), pleach_tree::SpeciesError>(())
//! ```
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod arbaro;
mod attraction;
mod ez_tree;
mod grammar;
mod literal;
mod program;
mod sapling;
mod skeleton;
mod source;
mod translation;
mod tree_gen;

pub use grammar::{ForeignGrammar, GrammarProgram, translate_grammar};
pub use program::Program;
pub use skeleton::{MAX_SKELETON_BYTES, SkeletonError, SkeletonProblem, is_skeleton, read_skeleton};
pub use translation::Foreign;

use literal::{Node, Value};
use pleach_tree::SpeciesError;
use source::Source;
use std::path::Path;

/// Most bytes of a file: presets have some thousand, and what is wrong with each of many entries takes time to say.
const MAX_LENGTH: usize = 1 << 16;

/// Whether `text`, which a file called `origin` holds, is meant for another program: the file's name ends in `.py`,
/// `.json` or `.xml`, or the text begins as no species file does.
#[must_use]
pub fn is_foreign(origin: &str, text: &str) -> bool {
    let ending = Path::new(origin).extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let start = literal::after_comments(text);
    matches!(ending.as_str(), "py" | "json" | "xml")
        || start.starts_with(['<', '{'])
        || literal::after_assignment(start)
            .is_some_and(|(name, value)| name == "params" && value.starts_with('{'))
}

/// Translates the species that `text` describes; `origin` is what messages call the file.
///
/// # Errors
/// The first thing that cannot be read, or every number that cannot be what it is, with line and column.
pub fn translate(origin: &str, text: &str) -> Result<Foreign, SpeciesError> {
    let source = Source { origin, text };
    if text.len() > MAX_LENGTH {
        let message =
            format!("the file has {} bytes, expected a species of at most {MAX_LENGTH}", text.len());
        return Err(source.wrong(0..0, &message));
    }
    if literal::after_comments(text).starts_with('<') {
        return arbaro::translate(&source);
    }
    let preset = literal::parse(&source)?;
    match program_of(&preset) {
        Some(Program::TreeGen) => tree_gen::translate(&source, &preset),
        Some(Program::Sapling) => sapling::translate(&source, &preset),
        Some(Program::EzTree) => ez_tree::translate(&source, &preset),
        Some(Program::Arbaro) | None => Err(source.wrong(
            preset.span.clone(),
            "this is not a species of tree-gen, Sapling or ez-tree, expected names such as `g_scale`, `ratioPower` or `branch`",
        )),
    }
}

/// The program that most keys of `preset` belong to. `None` if it is of none: a file of settings may have one name of
/// theirs by chance, so two have to be known, and a tree of ez-tree has branches.
fn program_of(preset: &Node) -> Option<Program> {
    let Value::Dict(entries) = &preset.value else { return None };
    let count = |knows: fn(&str) -> bool| {
        let known = |key: &Node| matches!(&key.value, Value::Text(name) if knows(name));
        entries.iter().filter(|(key, _)| known(key)).count()
    };
    let has_branches = preset.value.get("branch").is_some();
    let counts = [
        (if has_branches { count(ez_tree::knows) } else { 0 }, Program::EzTree),
        (count(sapling::knows), Program::Sapling),
        (count(tree_gen::knows), Program::TreeGen),
    ];
    counts
        .into_iter()
        .filter(|(count, program)| *count > usize::from(*program != Program::EzTree))
        .max_by_key(|(count, _)| *count)
        .map(|(_, program)| program)
}
