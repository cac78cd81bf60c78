//! Settings, declared names, parameters and constants.

use super::cursor::{Cursor, Parsed};
use super::is_reserved;
use crate::diagnostic::Fault;
use crate::syntax::{
    ConstDecl, Dialect, Expr, Grammar, ModuleName, Name, ParamDecl, ParamUnit, Setting, SettingKey, Shape,
};
use pleach_tree::param::nearest;

/// Names of header lines beside those of settings.
const OTHERS: [&str; 3] = ["axiom", "dialect", "ignore"];

impl Cursor<'_> {
    /// Reads a statement that is not a production; false if it is one.
    pub(super) fn header(&mut self, grammar: &mut Grammar, has_axiom: &mut bool) -> Parsed<bool> {
        self.skip();
        let start = self.at;
        if self.take_word("param") {
            let param = self.param()?;
            grammar.params.push(param);
            return Ok(true);
        }
        if self.take_word("const") {
            let name = self.name("the name of the constant")?;
            self.expect('=', "`=` and the value")?;
            grammar.consts.push(ConstDecl { name, value: self.expr()? });
            return Ok(true);
        }
        let Some(name) = self.key() else { return Ok(false) };
        let duplicate =
            |cursor: &Self| Err(cursor.fault(name.span, Fault::Duplicate { name: name.text.clone() }));
        match name.text.to_ascii_lowercase().as_str() {
            "axiom" if *has_axiom => return duplicate(self),
            "axiom" => {
                *has_axiom = true;
                grammar.axiom = self.items()?;
            }
            "dialect" => grammar.dialect = self.dialect()?,
            "ignore" => {
                self.skip();
                while self.peek().is_some() {
                    let symbol = self.symbol()?;
                    grammar.ignore.push(symbol);
                    self.skip();
                }
            }
            lower => {
                let key = if lower == "derivation length" { "steps" } else { lower };
                let Some(key) = SettingKey::from_name(key) else {
                    let known = SettingKey::ALL.into_iter().map(SettingKey::name).chain(OTHERS);
                    let nearest = nearest(lower, known);
                    let fault = Fault::Unknown { what: "setting", name: name.text.clone(), nearest };
                    return Err(self.fault(name.span, fault));
                };
                if grammar.settings.iter().any(|s| s.key == key) {
                    return duplicate(self);
                }
                let values = if key.shape() == Shape::Vector { self.vector()? } else { vec![self.expr()?] };
                grammar.settings.push(Setting { key, values, span: self.since(start) });
            }
        }
        Ok(true)
    }

    /// Takes a word of two letters and more, or several words, and the colon after them.
    fn key(&mut self) -> Option<Name> {
        let start = self.at;
        let len = self.rest().find(':')?;
        let text = self.rest()[..len].trim_end();
        let is_key = text.len() > 1
            && text.chars().all(|c| c.is_ascii_alphanumeric() || "_ ".contains(c))
            && text.starts_with(|c: char| c.is_ascii_alphabetic())
            && !self.modules.iter().any(|m| m == text);
        if !is_key {
            return None;
        }
        self.at += text.len();
        let name = Name { text: text.to_owned(), span: self.since(start) };
        self.at = start + len + 1;
        Some(name)
    }

    fn dialect(&mut self) -> Parsed<Dialect> {
        self.skip();
        let (start, word) = (self.at, self.word());
        self.at += word.len();
        Dialect::ALL.into_iter().find(|d| d.name() == word).ok_or_else(|| {
            let name = word.to_owned();
            let near = nearest(word, Dialect::ALL.map(Dialect::name)).or_else(|| Some("abop".to_owned()));
            self.fault(self.since(start), Fault::Unknown { what: "dialect", name, nearest: near })
        })
    }

    fn vector(&mut self) -> Parsed<Vec<Expr>> {
        let start = self.at;
        self.expect('(', "three numbers in parentheses, as in `(0, 0, -1)`")?;
        self.nodes = 0;
        let values = self.list(')')?;
        if values.len() != 3 {
            let (name, found) = ("tropism".to_owned(), values.len());
            let fault = Fault::Arguments { name, found, min: 3, max: 3 };
            return Err(self.fault(self.since(start), fault));
        }
        Ok(values)
    }

    /// Reads `module Fl = F, Fr = F`.
    pub(super) fn module(&mut self, grammar: &mut Grammar) -> Parsed<()> {
        loop {
            self.skip();
            let (start, word) = (self.at, self.word());
            if word.is_empty() {
                return Err(self.unexpected("the name of a module"));
            }
            self.at += word.len();
            let name = Name { text: word.to_owned(), span: self.since(start) };
            if is_reserved(word) {
                return Err(self.fault(name.span, Fault::Reserved { name: name.text }));
            }
            if grammar.modules.iter().any(|m| m.name == name) {
                return Err(self.fault(name.span, Fault::Duplicate { name: name.text }));
            }
            let alias = if self.take('=') { Some(self.symbol()?) } else { None };
            if grammar.modules.len() == super::MAX_MODULES {
                let fault = Fault::TooMany { what: "names of modules", limit: super::MAX_MODULES };
                return Err(self.fault(name.span, fault));
            }
            grammar.modules.push(ModuleName { name, alias });
            if !self.take(',') {
                return if self.rest().is_empty() { Ok(()) } else { Err(self.unexpected("`,` or `=`")) };
            }
        }
    }

    fn param(&mut self) -> Parsed<ParamDecl> {
        let name = self.name("the name of the parameter")?;
        self.expect('=', "`=` and the default")?;
        let default = self.signed()?;
        if !self.take_word("in") {
            return Err(self.unexpected("`in` and the range, as in `in 0..1`"));
        }
        let range = self.range()?;
        let search = if self.take_word("search") { Some(self.range()?) } else { None };
        let unit = ParamUnit::ALL.into_iter().find(|unit| self.take_word(unit.name())).unwrap_or_default();
        let doc = if self.take('"') {
            let rest = self.rest();
            let Some(len) = rest.find(['"', '\n']).filter(|&i| rest[i..].starts_with('"')) else {
                return Err(self.unexpected("a line of text that ends with `\"`"));
            };
            self.at += len + 1;
            rest[..len].to_owned()
        } else {
            String::new()
        };
        let (min, max) = range;
        if !(min..=max).contains(&default) {
            let fault = Fault::OutOfRange { name: name.text, value: default, min, max };
            return Err(self.fault(name.span, fault));
        }
        if let Some((low, high)) = search.filter(|s| s.0 < min || s.1 > max) {
            let value = if low < min { low } else { high };
            let fault = Fault::OutOfRange { name: "search".to_owned(), value, min, max };
            return Err(self.fault(name.span, fault));
        }
        Ok(ParamDecl { name, default, range, search, unit, doc })
    }

    fn range(&mut self) -> Parsed<(f64, f64)> {
        self.skip();
        let start = self.at;
        let min = self.signed()?;
        self.skip();
        if !self.rest().starts_with("..") {
            return Err(self.unexpected("`..` and the end of the range"));
        }
        self.at += 2;
        let max = self.signed()?;
        if min < max {
            Ok((min, max))
        } else {
            Err(self.fault(self.since(start), Fault::EmptyRange { min, max }))
        }
    }

    fn signed(&mut self) -> Parsed<f64> {
        let negative = self.take('-');
        self.skip();
        match self.number().filter(|n| n.is_finite()) {
            // Adding 0 makes -0 a 0, which has one normal form.
            Some(number) => Ok(if negative { -number } else { number } + 0.0),
            None => Err(self.unexpected("a number")),
        }
    }
}
