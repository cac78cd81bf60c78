//! Species files with a grammar in them, and those that come with pleach.

use crate::diagnostic::Diagnostic;
use crate::evolve::blank;
use crate::generator::{GRAMMAR, GrammarGenerator, NAME};
use pleach_tree::param::Problem;
use pleach_tree::species::{Form, Issue, Key, Value};
use pleach_tree::{Family, Generator, SpeciesDoc};
use std::sync::Arc;

/// Reads species files with a grammar in them.
#[derive(Clone, Copy, Debug, Default)]
pub struct LSystemFamily;

impl Family for LSystemFamily {
    fn name(&self) -> &'static str {
        NAME
    }

    fn summary(&self) -> &'static str {
        "grammars of Lindenmayer systems (Prusinkiewicz and Lindenmayer 1990; Hewitt 2017)"
    }

    fn keys(&self) -> &'static [Key] {
        &[Key {
            name: GRAMMAR,
            form: Form::Text,
            default: "there is none: it has to be given",
            doc: "the grammar, a text of several lines; its parameters are keys of the file",
        }]
    }

    fn read(&self, doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Option<Arc<dyn Generator>> {
        let Some(node) = doc.get(GRAMMAR) else {
            let expected = "the grammar in a string of several lines".to_owned();
            issues.push(doc.issue(0..0, GRAMMAR, Problem::Missing { expected }));
            return None;
        };
        let Value::Text(text) = &node.value else {
            let found = node.value.type_name();
            issues.push(doc.issue(
                node.span.clone(),
                GRAMMAR,
                Problem::WrongType { expected: "a string", found },
            ));
            return None;
        };
        match GrammarGenerator::read(text) {
            Ok(generator) => Some(Arc::new(generator)),
            Err(report) => {
                for diagnostic in report.diagnostics.iter().take(MAX_TOLD) {
                    let Diagnostic { span, fault } = diagnostic;
                    let place = doc.span_within(node, span.start..span.end);
                    let problem = Problem::Syntax { message: fault.to_string() };
                    issues.push(Issue { help: fault.help(), ..doc.issue(place, "", problem) });
                }
                None
            }
        }
    }

    fn blank(&self) -> Option<&'static str> {
        Some(concat!(
            "generator = \"lsystem\"\nname = \"evolved\"\ngrammar = '''\n",
            blank!(),
            "axiom: F(1)\n'''\n"
        ))
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        pleach_species::LSYSTEM
    }
}

/// Most mistakes of one grammar that are reported.
const MAX_TOLD: usize = 20;
