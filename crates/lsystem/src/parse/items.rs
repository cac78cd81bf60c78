//! Axioms, successors and contexts.

use super::cursor::{Cursor, Parsed};
use crate::diagnostic::Fault;
use crate::syntax::{Context, Item, Name, Predecessor, Span, Values};

/// Most arguments of a module.
const MAX_ARGS: usize = 16;

/// Signs that are symbols; brackets and braces are read as groups.
const SIGNS: &str = "+-&^/\\|!'.~$%";

impl Cursor<'_> {
    /// Reads items up to the end, an arrow or a closing bracket.
    pub(super) fn items(&mut self) -> Parsed<Vec<Item>> {
        let mut items = Vec::new();
        loop {
            self.skip();
            if self.arrow() > 0 || self.weighted_arrow() {
                return Ok(items);
            }
            match self.peek() {
                None | Some(']' | '}') => return Ok(items),
                Some('[') => items.push(Item::Branch(self.group('[', ']')?)),
                Some('{') => items.push(Item::Polygon(self.group('{', '}')?)),
                Some(_) if self.keyword("for") => items.push(self.repetition()?),
                Some(_) if self.keyword("let") => {
                    let name = self.name("a name after `let`")?;
                    self.expect('=', "`=` and the value")?;
                    let value = self.expr()?;
                    self.expect(';', "`;` after the value")?;
                    items.push(Item::Let { name, value });
                }
                Some(_) => {
                    let name = self.symbol()?;
                    let args = if self.take('(') {
                        self.nodes = 0;
                        self.list(')')?
                    } else {
                        Vec::new()
                    };
                    if args.len() > MAX_ARGS {
                        let limit = MAX_ARGS;
                        return Err(self.fault(name.span, Fault::TooMany { what: "arguments", limit }));
                    }
                    items.push(Item::Module { name, args });
                }
            }
        }
    }

    /// Takes a keyword that white space follows; `F` in `Ffor` is a symbol of its own.
    fn keyword(&mut self, word: &str) -> bool {
        let found = self.rest().strip_prefix(word).is_some_and(|rest| rest.starts_with(char::is_whitespace));
        if found {
            self.at += word.len();
        }
        found
    }

    fn group(&mut self, open: char, close: char) -> Parsed<Vec<Item>> {
        let start = self.at;
        self.descend()?;
        self.bump();
        let items = self.items()?;
        self.depth -= 1;
        if self.take(close) {
            return Ok(items);
        }
        Err(self.fault(Span { start, end: start + 1 }, Fault::Unclosed { open, close }))
    }

    fn repetition(&mut self) -> Parsed<Item> {
        let name = self.name("a name after `for`")?;
        if !self.take_word("in") {
            return Err(self.unexpected("`in`"));
        }
        let values = if self.take('[') {
            self.nodes = 0;
            Values::List(self.list(']')?)
        } else {
            let from = self.expr()?;
            self.skip();
            if !self.rest().starts_with("..") {
                return Err(self.unexpected("`..` and the end"));
            }
            self.at += 2;
            Values::Range(from, self.expr()?)
        };
        self.skip();
        if self.peek() != Some('{') {
            return Err(self.unexpected("`{` and what is repeated"));
        }
        Ok(Item::For { name, values, body: self.group('{', '}')? })
    }

    /// Reads one symbol: the longest declared module, else one character.
    pub(super) fn symbol(&mut self) -> Parsed<Name> {
        self.skip();
        let start = self.at;
        let declared = self.modules.iter().find(|name| self.rest().starts_with(name.as_str()));
        if let Some(name) = declared {
            self.at += name.len();
            return Ok(Name { text: name.clone(), span: self.since(start) });
        }
        match self.peek() {
            None => Err(self.unexpected("a symbol")),
            Some(c) if c.is_ascii_alphabetic() || SIGNS.contains(c) => {
                self.bump();
                Ok(Name { text: c.to_string(), span: self.since(start) })
            }
            Some(found) => {
                self.bump();
                let fault = match found {
                    ')' | ']' | '}' => Fault::Unopened { close: found },
                    _ => Fault::NotASymbol { found },
                };
                Err(self.fault(self.since(start), fault))
            }
        }
    }

    /// Reads a symbol with the names of its parameters.
    fn formal(&mut self) -> Parsed<Predecessor> {
        let name = self.symbol()?;
        let mut params = Vec::new();
        if self.peek() == Some('(') {
            self.bump();
            loop {
                params.push(self.name("the name of a parameter")?);
                if !self.take(',') {
                    break;
                }
            }
            self.expect(')', "`)` or `,`")?;
        }
        if params.len() > MAX_ARGS {
            return Err(self.fault(name.span, Fault::TooMany { what: "parameters", limit: MAX_ARGS }));
        }
        Ok(Predecessor { name, params })
    }

    /// Reads `left < pred > right`.
    pub(super) fn head(&mut self) -> Parsed<(Vec<Predecessor>, Predecessor, Vec<Context>)> {
        let mut left = vec![self.formal()?];
        loop {
            self.skip();
            match self.peek() {
                None | Some('<' | '>' | ':' | '-' | '\u{2192}') => break,
                Some(_) => left.push(self.formal()?),
            }
        }
        let pred = if self.take('<') {
            self.formal()?
        } else {
            if left.len() > 1 {
                return Err(self.fault(
                    left[1].name.span,
                    Fault::Expected {
                        expected: "`<`, `>`, `:` or `->` after the symbol",
                        found: format!("`{}`", left[1].name.text),
                    },
                ));
            }
            left.remove(0)
        };
        let right = if self.take('>') { self.contexts()? } else { Vec::new() };
        Ok((left, pred, right))
    }

    fn contexts(&mut self) -> Parsed<Vec<Context>> {
        let mut parts = Vec::new();
        loop {
            self.skip();
            match self.peek() {
                None | Some(':' | '\u{2192}' | ']') => break,
                Some('-') if self.arrow() > 0 || self.weighted_arrow() => break,
                Some('[') => {
                    let start = self.at;
                    self.descend()?;
                    self.bump();
                    let inside = self.contexts()?;
                    self.depth -= 1;
                    if !self.take(']') {
                        let fault = Fault::Unclosed { open: '[', close: ']' };
                        return Err(self.fault(Span { start, end: start + 1 }, fault));
                    }
                    parts.push(Context::Branch(inside));
                }
                Some(_) => parts.push(Context::Module(self.formal()?)),
            }
        }
        if parts.is_empty() { Err(self.unexpected("a symbol after `>`")) } else { Ok(parts) }
    }
}
