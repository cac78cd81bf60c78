//! Which files of a crate name which others.
//!
//! A file names another where a path in its code leads to something that the other declares. Re-exports are
//! followed to the declaration, so that a `mod.rs` that only re-exports is nobody's user and is used by nobody.
//! Code that is compiled for tests alone is left out.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A path of modules or names, from the root of the crate.
type Names = Vec<String>;

/// What a `use` makes known in a module.
#[derive(Debug)]
struct Import {
    /// The name; `*` for all that the path's module has.
    name: String,
    path: Names,
    is_public: bool,
}

/// A module, written in a file of its own or within its parent's.
#[derive(Debug, Default)]
struct Module {
    file: usize,
    imports: Vec<Import>,
    declared: BTreeSet<String>,
    /// Paths of the code, those of one name included.
    paths: BTreeSet<Names>,
}

/// The modules of a crate.
#[derive(Debug, Default)]
pub(crate) struct Crate {
    files: Vec<String>,
    modules: BTreeMap<Names, Module>,
    /// Modules that are compiled for tests alone.
    only_tests: BTreeSet<Names>,
}

/// One file names another: from, to, and the names.
pub(crate) type Edges = BTreeMap<(usize, usize), BTreeSet<String>>;

impl Crate {
    /// Reads all files below `src`.
    pub(crate) fn read(src: &Path) -> Self {
        let mut files = Vec::new();
        collect(src, src, &mut files);
        files.sort();
        Self::new(files.iter().map(|(name, text)| (name.as_str(), text.as_str())))
    }

    /// A crate of files: their names below `src`, and their text.
    pub(crate) fn new<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let mut this = Self::default();
        for (name, text) in files {
            let tokens: TokenStream = text.parse().unwrap_or_else(|error| panic!("{name}: {error}"));
            let module = module_of(name);
            let file = this.files.len();
            this.files.push(name.to_owned());
            this.add(file, module, tokens);
        }
        this
    }

    pub(crate) fn file(&self, index: usize) -> &str {
        &self.files[index]
    }

    /// Whether `file` is in the folder of the module of `parent`, which is not the crate's root.
    pub(crate) fn is_below(&self, file: usize, parent: usize) -> bool {
        let parent = self.files[parent].trim_end_matches(".rs").trim_end_matches("/mod");
        let is_root = matches!(parent, "lib" | "main");
        !is_root
            && self.files[file]
                .strip_prefix(parent)
                .is_some_and(|rest| rest.starts_with('/') && rest != "/mod.rs")
    }

    /// Every pair of files of which the first names the second.
    pub(crate) fn edges(&self) -> Edges {
        let mut edges = Edges::new();
        for (at, module) in &self.modules {
            if (0..=at.len()).any(|n| self.only_tests.contains(&at[..n])) {
                continue;
            }
            // A name that is only handed on is not used here.
            let handed_on = |import: &&Import| {
                !import.is_public || module.paths.iter().any(|path| path[0] == import.name)
            };
            let imported = module.imports.iter().filter(handed_on).map(|import| &import.path);
            for path in imported.chain(module.paths.iter().filter(|path| path.len() > 1)) {
                let Some((to, name)) = self.resolve(at, path, 0) else { continue };
                if to != module.file {
                    edges.entry((module.file, to)).or_default().insert(name);
                }
            }
        }
        edges
    }

    /// The file that declares what `path` means in the module `at`, and the name of it. `None` for other
    /// crates, names of no module, and modules as a whole.
    fn resolve(&self, at: &[String], path: &[String], depth: usize) -> Option<(usize, String)> {
        let mut here = at.to_vec();
        let mut rest = path;
        match path.first()?.as_str() {
            "crate" => (here, rest) = (Names::new(), &path[1..]),
            "self" => rest = &path[1..],
            "super" => {
                while rest.first().is_some_and(|name| name == "super") {
                    here.pop()?;
                    rest = &rest[1..];
                }
            }
            first => {
                let child = [at, &[first.to_owned()]].concat();
                let known = |import: &Import| import.name == first;
                if !self.modules.contains_key(&child) && !self.modules.get(at)?.imports.iter().any(known) {
                    return None;
                }
            }
        }
        while let Some((name, more)) = rest.split_first() {
            here.push(name.clone());
            if !self.modules.contains_key(&here) {
                here.pop();
                return self.declaration(&here, name, more, depth);
            }
            rest = more;
        }
        None
    }

    /// The file that declares `name` of the module `at`, where re-exports lead on.
    fn declaration(
        &self,
        at: &[String],
        name: &str,
        more: &[String],
        depth: usize,
    ) -> Option<(usize, String)> {
        let module = self.modules.get(at)?;
        if name == "*" || module.declared.contains(name) || depth > 16 {
            return Some((module.file, name.to_owned()));
        }
        for import in &module.imports {
            if import.name == name {
                return self.resolve(at, &[&import.path[..], more].concat(), depth + 1);
            }
        }
        for import in module.imports.iter().filter(|import| import.name == "*") {
            let mut path = import.path.clone();
            path.pop();
            path.push(name.to_owned());
            if let Some(found) = self.resolve(at, &path, depth + 1)
                && self.modules.values().any(|m| m.file == found.0 && m.declared.contains(name))
            {
                return Some(found);
            }
        }
        Some((module.file, name.to_owned()))
    }

    fn add(&mut self, file: usize, at: Names, tokens: TokenStream) {
        let mut module = self.modules.remove(&at).unwrap_or_default();
        module.file = file;
        self.walk(&at, &mut module, tokens, true);
        self.modules.insert(at, module);
    }

    /// `is_item`: the tokens are those of items of the module, not of what is within one of them.
    fn walk(&mut self, at: &Names, module: &mut Module, tokens: TokenStream, is_item: bool) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let (mut i, mut only_tests) = (0, false);
        while i < tokens.len() {
            match &tokens[i] {
                TokenTree::Punct(hash) if hash.as_char() == '#' => {
                    if let Some(TokenTree::Group(attribute)) = tokens.get(i + 1) {
                        only_tests |= is_for_tests(attribute);
                        i += 1;
                    }
                }
                _ if only_tests => {
                    only_tests = false;
                    let end = (i..tokens.len()).find(|&j| ends_item(&tokens[j])).unwrap_or(tokens.len());
                    if let Some(name) = (i..end).find(|&j| is_word(&tokens[j], "mod")) {
                        self.only_tests.insert([&at[..], &[tokens[name + 1].to_string()]].concat());
                    }
                    i = end;
                }
                // Bounds have a `use<…>` too.
                TokenTree::Ident(word)
                    if word == "use" && !tokens.get(i + 1).is_some_and(|t| is_sign(t, '<')) =>
                {
                    let end = (i..tokens.len()).find(|&j| is_sign(&tokens[j], ';')).unwrap_or(tokens.len());
                    let is_public = i > 0 && is_visibility(&tokens[..i]);
                    imports(&tokens[i + 1..end], &Names::new(), is_public, &mut module.imports);
                    i = end;
                }
                TokenTree::Ident(word) if word == "mod" => {
                    let name = tokens[i + 1].to_string();
                    module.declared.insert(name.clone());
                    if let Some(TokenTree::Group(body)) = tokens.get(i + 2) {
                        self.add(module.file, [&at[..], &[name]].concat(), body.stream());
                    }
                    i += 2;
                }
                // Fields and methods are not names of a module.
                TokenTree::Ident(_) if i > 0 && is_sign(&tokens[i - 1], '.') => {}
                TokenTree::Ident(word) => {
                    if is_item && declares(&word.to_string()) {
                        // `macro_rules! name` has one sign more.
                        let skip = usize::from(tokens.get(i + 1).is_some_and(|next| is_sign(next, '!')));
                        if let Some(TokenTree::Ident(name)) = tokens.get(i + 1 + skip) {
                            module.declared.insert(name.to_string());
                        }
                    }
                    let path = path_from(&tokens[i..]);
                    i += 3 * (path.len() - 1);
                    module.paths.insert(path);
                }
                TokenTree::Group(group) => self.walk(at, module, group.stream(), false),
                _ => {}
            }
            i += 1;
        }
    }
}

/// The files below `dir`, with `/` between folders.
fn collect(src: &Path, dir: &Path, files: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(dir).unwrap_or_else(|error| panic!("{}: {error}", dir.display())) {
        let path = entry.expect("an entry of a folder").path();
        if path.is_dir() {
            collect(src, &path, files);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = std::fs::read_to_string(&path).expect("a source of UTF-8");
            let below = path.strip_prefix(src).expect("a file below src");
            files.push((below.to_str().expect("a name of UTF-8").replace('\\', "/"), text));
        }
    }
}

/// The module that a file holds.
fn module_of(file: &str) -> Names {
    let stem = file.trim_end_matches(".rs");
    let mut names: Names = stem.split('/').map(str::to_owned).collect();
    if names.last().is_some_and(|last| last == "mod") || stem == "lib" || stem == "main" {
        names.pop();
    }
    names
}

fn is_sign(token: &TokenTree, sign: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == sign)
}

fn is_word(token: &TokenTree, word: &str) -> bool {
    matches!(token, TokenTree::Ident(ident) if ident == word)
}

fn ends_item(token: &TokenTree) -> bool {
    is_sign(token, ';') || matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace)
}

/// Whether tokens end in `pub` or `pub(…)`.
fn is_visibility(before: &[TokenTree]) -> bool {
    match before {
        [.., last] if is_word(last, "pub") => true,
        [.., word, TokenTree::Group(_)] => is_word(word, "pub"),
        _ => false,
    }
}

fn declares(word: &str) -> bool {
    matches!(word, "struct" | "enum" | "union" | "trait" | "type" | "fn" | "const" | "static" | "macro_rules")
}

/// Whether an attribute is `cfg(test)` or `cfg(all(test, …))`.
fn is_for_tests(attribute: &Group) -> bool {
    let text = attribute.stream().to_string().replace(' ', "");
    text == "cfg(test)" || text.starts_with("cfg(all(test,")
}

/// The names with `::` between them that tokens begin with.
fn path_from(tokens: &[TokenTree]) -> Names {
    let mut path = vec![tokens[0].to_string()];
    let mut rest = &tokens[1..];
    while let [first, second, TokenTree::Ident(name), more @ ..] = rest {
        if !is_sign(first, ':') || !is_sign(second, ':') {
            break;
        }
        path.push(name.to_string());
        rest = more;
    }
    path
}

/// What a tree of `use` makes known.
fn imports(tokens: &[TokenTree], before: &Names, is_public: bool, found: &mut Vec<Import>) {
    for branch in tokens.split(|token| is_sign(token, ',')) {
        let mut path = before.clone();
        let mut name = None;
        let mut is_list = false;
        let mut tokens = branch.iter().peekable();
        while let Some(token) = tokens.next() {
            match token {
                TokenTree::Ident(word) if word == "as" => name = tokens.next().map(ToString::to_string),
                // `a::{self, …}` is `a`.
                TokenTree::Ident(word) if word == "self" && !path.is_empty() => {}
                TokenTree::Ident(word) => path.push(word.to_string()),
                TokenTree::Punct(punct) if punct.as_char() == '*' => path.push("*".to_owned()),
                TokenTree::Group(group) => {
                    let list: Vec<TokenTree> = group.stream().into_iter().collect();
                    imports(&list, &path, is_public, found);
                    is_list = true;
                }
                _ => {}
            }
        }
        if let Some(last) = path.last()
            && !is_list
            && path.len() > usize::from(before.is_empty())
        {
            let name = name.unwrap_or_else(|| last.clone());
            found.push(Import { name, path, is_public });
        }
    }
}
