//! Grammars of L-Py and cpfg as grammars of pleach, line by line, so that messages about the result name the right line.
//!
//! Rules have the same notation in all three. What is translated are headers, constants, and symbols of the turtle that
//! pleach does not have. Python and C are errors: nothing is run.

use crate::source::Source;
use pleach_tree::SpeciesError;
use pleach_tree::param::shown;

/// A program whose grammars are translated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GrammarProgram {
    /// Grammars with parts in Python.
    LPy,
    /// Grammars with parts in C, of the group that wrote *The Algorithmic Beauty of Plants*.
    Cpfg,
}

/// A grammar that was translated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ForeignGrammar {
    /// The grammar, with as many lines as the original, and further settings behind them.
    pub text: String,
    /// Symbols that were left out since they only choose colours or draw shapes.
    pub left_out: Vec<String>,
}

/// Words that begin a line of Python or C and no line of a grammar.
const CODE: [&str; 17] = [
    "import",
    "from",
    "def",
    "class",
    "for",
    "if",
    "else",
    "elif",
    "while",
    "return",
    "produce",
    "nproduce",
    "global",
    "print",
    "Start",
    "StartEach",
    "EndEach",
];
/// Lines that pleach's grammars do without, and that end a section of rules.
const DROPPED: [&str; 3] = ["lsystem", "endlsystem", "production"];
/// Those that a section of rules may hold.
const DROPPED_INSIDE: [&str; 3] = ["group", "endgroup", "maximum depth"];
/// Symbols that draw shapes or labels beside the stems.
const SHAPES: [&str; 10] = ["@Gs", "@Gc", "@Ge", "@O", "@o", "@c", "@B", "@b", "@g", "@L"];
/// Sections of rules without a counterpart.
const SECTIONS: [&str; 3] = ["interpretation", "homomorphism", "decomposition"];
/// Settings of L-Py: the angle of turns without one, in degrees, and widths that are radii.
const LPY_SETTINGS: &str = "angle: 60\nthickness: 1\n";

/// Translates a grammar; `origin` is what messages call the file.
///
/// # Errors
/// The first line that has no counterpart, with line and column.
pub fn translate_grammar(
    origin: &str,
    text: &str,
    program: GrammarProgram,
) -> Result<ForeignGrammar, SpeciesError> {
    let source = Source { origin, text };
    let plain = without_comments(&source)?;
    let mut reader =
        Reader { source: &source, program, section: None, left_out: Vec::new(), modules: Vec::new() };
    let (mut translated, mut at) = (String::new(), 0);
    for line in plain.split_inclusive('\n') {
        translated.push_str(&reader.line(line.trim_end(), at)?);
        translated.push('\n');
        at += line.len();
    }
    if program == GrammarProgram::LPy {
        translated.push_str(LPY_SETTINGS);
    }
    Ok(ForeignGrammar { text: translated, left_out: reader.left_out })
}

/// The text with spaces in the place of comments between `/*` and `*/`; as many bytes and lines as before.
fn without_comments(source: &Source<'_>) -> Result<String, SpeciesError> {
    let (mut plain, mut rest) = (String::new(), source.text);
    while let Some(start) = rest.find("/*") {
        let Some(length) = rest[start + 2..].find("*/").map(|length| length + 2) else {
            let at = plain.len() + start;
            return Err(source.wrong(at..at + 2, "a comment begins here and does not end"));
        };
        plain.push_str(&rest[..start]);
        plain.extend(
            rest[start..start + length + 2].bytes().map(|byte| if byte == b'\n' { '\n' } else { ' ' }),
        );
        rest = &rest[start + length + 2..];
    }
    plain.push_str(rest);
    Ok(plain)
}

struct Reader<'a> {
    source: &'a Source<'a>,
    program: GrammarProgram,
    /// The section of rules without a counterpart that the lines are in.
    section: Option<&'static str>,
    left_out: Vec<String>,
    /// Declared names that end in `F`.
    modules: Vec<String>,
}

impl Reader<'_> {
    /// A line without its end, which begins at byte `at`, as pleach's grammars have it.
    fn line(&mut self, line: &str, at: usize) -> Result<String, SpeciesError> {
        let trimmed = line.trim_start();
        let span = at + line.len() - trimmed.len()..at + line.len();
        let wrong = |message: String| Err(self.source.wrong(span.clone(), &message));
        if let Some(definition) = trimmed.strip_prefix("#define") {
            let (name, value) =
                definition.trim().split_once(char::is_whitespace).unwrap_or((definition.trim(), ""));
            if !is_name(name) || value.trim().is_empty() {
                return wrong(
                    "a macro is here that is not a constant, expected `#define NAME VALUE`".to_owned(),
                );
            }
            return Ok(format!("const {name} = {}", value.trim()));
        }
        if trimmed.starts_with("#include") {
            return wrong("`#include` is here, which reads C; nothing is run or included".to_owned());
        }
        if trimmed.is_empty() || trimmed.starts_with('#') {
            return Ok(line.to_owned());
        }
        let lower = trimmed.to_lowercase();
        let is_head = |word: &str| {
            lower.strip_prefix(word).is_some_and(|rest| {
                let number = rest.trim();
                let is_numbered = word.ends_with("group")
                    && rest.starts_with(char::is_whitespace)
                    && number.bytes().all(|byte| byte.is_ascii_digit());
                rest.is_empty() || number.starts_with(':') || is_numbered
            })
        };
        if DROPPED_INSIDE.iter().any(|word| is_head(word)) {
            return Ok(String::new());
        }
        if DROPPED.iter().any(|word| is_head(word)) {
            self.section = None;
            return Ok(String::new());
        }
        if let Some(section) = SECTIONS.into_iter().find(|word| is_head(word)) {
            self.section = Some(section);
            return Ok(String::new());
        }
        if let Some(section) = self.section {
            return wrong(format!("a rule of `{section}:` is here, which grammars of pleach do not have"));
        }
        let word: String = trimmed.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        let behind = trimmed[word.len()..].trim_start();
        let is_rule = trimmed.contains("->");
        let is_code = CODE.contains(&word.as_str()) && !is_rule
            || (trimmed.ends_with(':') && !is_rule && !lower.starts_with("axiom"));
        if is_code || trimmed.starts_with(['{', '}', '@']) {
            let shown = shown(trimmed);
            return wrong(format!("`{shown}` is code in Python or C, and no code is run"));
        }
        if let Some(value) = behind.strip_prefix('=').filter(|value| !value.starts_with('=') && !is_rule) {
            if value.contains(['"', '\'', '[', '{']) {
                return wrong(format!("`{word}` is not a number, and grammars have no other constants"));
            }
            return Ok(format!("const {word} = {}", value.split('#').next().unwrap_or_default().trim()));
        }
        if word == "module" && !is_rule {
            let names = modules(behind);
            self.modules.extend(names.iter().filter(|name| name.ends_with('F')).cloned());
            return Ok(if names.is_empty() { String::new() } else { format!("module {}", names.join(", ")) });
        }
        if lower.starts_with("derivation length") {
            return Ok(trimmed.to_owned());
        }
        if let Some((_, successor)) = trimmed.split_once("-->")
            && let Some((_, last)) = successor.rsplit_once(':')
            && last.trim().parse::<f64>().is_ok()
        {
            return wrong(format!(
                "a probability is behind the rule, expected it in the arrow: `-{}->`",
                last.trim()
            ));
        }
        // A rule may be indented; what goes on from the line before has no arrow.
        match trimmed.contains("-->") {
            true => self.symbols(trimmed, span.start),
            false => self.symbols(line, at),
        }
    }

    /// Where the comment of `line` begins, or its end. cpfg sets widths by `#(w)`.
    fn comment(&self, line: &str) -> usize {
        let is_comment = |at: usize| self.program == GrammarProgram::LPy || !line[at + 1..].starts_with('(');
        line.match_indices('#').map(|(at, _)| at).find(|at| is_comment(*at)).unwrap_or(line.len())
    }

    /// A line of symbols that begins at byte `start`, without those that only choose colours or draw shapes, and with
    /// `!` for widths.
    fn symbols(&mut self, line: &str, start: usize) -> Result<String, SpeciesError> {
        let end = self.comment(line);
        // Before the arrow are names of numbers, and behind it their values.
        let arrow = line[..end].find("-->").unwrap_or(0);
        let (mut text, mut at, mut depth) = (String::new(), 0, 0_usize);
        while let Some(c) = line[at..end].chars().next() {
            let rest = &line[at..end];
            let behind = at + c.len_utf8();
            match c {
                '(' => depth += 1,
                ')' => depth = depth.saturating_sub(1),
                '_' | '#' if depth == 0 && line[behind..end].starts_with('(') => {
                    text.push('!');
                    at = behind;
                    continue;
                }
                'F' if depth == 0 && self.program == GrammarProgram::LPy => {
                    let is_name = self.modules.iter().any(|name| line[..behind].ends_with(name.as_str()));
                    let of_piece = arguments_length(&line[behind..end]).filter(|_| !is_name);
                    let arguments = of_piece.map_or("", |length| &line[behind..behind + length]);
                    if let [length, radius] = split_arguments(arguments)[..] {
                        if at < arrow {
                            let message = "a rule for `F` with a radius is here, and `F` has none in grammars of pleach; \
                                           give the radius by `_` before it";
                            return Err(self.source.wrong(start + at..start + behind, message));
                        }
                        text.push_str(&format!("!({})F({})", radius.trim(), length.trim()));
                        at = behind + arguments.len();
                        continue;
                    }
                }
                ';' | ',' | '@' if depth == 0 => {
                    let symbol = match SHAPES.iter().find(|shape| rest.starts_with(**shape)) {
                        Some(shape) => shape,
                        None if c != '@' => &rest[..1],
                        None => {
                            let message =
                                "a symbol of the turtle is here that grammars of pleach do not have";
                            return Err(self.source.wrong(start + at..start + behind, message));
                        }
                    };
                    let arguments = at + symbol.len();
                    let Some(length) = arguments_length(&line[arguments..end]) else {
                        let message = "arguments begin here and do not end in this line";
                        let from = start + arguments;
                        return Err(self.source.wrong(from..from + 1, message));
                    };
                    if !self.left_out.iter().any(|known| known == symbol) {
                        self.left_out.push(symbol.to_owned());
                    }
                    at = arguments + length;
                    continue;
                }
                _ => {}
            }
            text.push(c);
            at = behind;
        }
        text.push_str(&line[end..]);
        Ok(text)
    }
}

/// Bytes of the arguments in parentheses that `text` begins with: 0 if there are none, `None` if they do not end.
fn arguments_length(text: &str) -> Option<usize> {
    if !text.starts_with('(') {
        return Some(0);
    }
    let mut depth = 0_usize;
    text.char_indices().find_map(|(at, c)| {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        (depth == 0).then_some(at + 1)
    })
}

/// The arguments in `text`, which is empty or has parentheses around it.
fn split_arguments(text: &str) -> Vec<&str> {
    let inner = text.strip_prefix('(').and_then(|text| text.strip_suffix(')')).unwrap_or_default();
    let (mut arguments, mut first, mut depth) = (Vec::new(), 0, 0_usize);
    for (at, c) in inner.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                arguments.push(&inner[first..at]);
                first = at + 1;
            }
            _ => {}
        }
    }
    arguments.push(&inner[first..]);
    arguments
}

/// Declared symbols of several letters; those of one need no declaration.
fn modules(list: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut depth = 0_usize;
    for part in list.trim_end_matches(':').split_inclusive([',', '(', ')']) {
        let name = part.trim_end_matches([',', '(', ')']).trim();
        if depth == 0 && name.chars().count() > 1 {
            names.push(name.to_owned());
        }
        match part.chars().last() {
            Some('(') => depth += 1,
            Some(')') => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    names
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_alphanumeric() || c == '_')
}
