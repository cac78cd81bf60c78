//! `pleach grammar`: checks, prints, derives and draws grammars.

use crate::choice::{Choice, one_of};
use crate::{files, input, output};
use anyhow::{Context, anyhow, bail};
use pleach_import::{GrammarProgram, translate_grammar};
use pleach_lsystem::{Derivation, LSystem, LSystemFamily, MAX_BYTES};
use pleach_tree::{Family, SpeciesDoc};
use std::borrow::Cow;
use std::io::Read;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach grammar abop_plant_f                     its normal form
  pleach grammar abop_plant_f --derive 2          the string after two steps
  pleach grammar abop_plant_f --svg plant.svg     the turtle's drawing
  pleach grammar hewitt_palm --check              whether anything is wrong
  pleach grammar bush.lpy --from lpy              one of another program, translated

Of grammars of L-Py and cpfg, headers, constants and rules are read. Python and C in them are errors, and nothing is run.

docs/grammars.md teaches the language in ten minutes.";

const PROGRAMS: &[Choice<GrammarProgram>] = &[
    ("lpy", "L-Py", GrammarProgram::LPy),
    ("cpfg", "cpfg, of the Virtual Laboratory", GrammarProgram::Cpfg),
];

/// Check, print, derive or draw a grammar
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct GrammarCommand {
    /// A file with a grammar, a species (by name or file) that has one, or `-` for a grammar from standard input
    file: String,
    /// The program that the file is a grammar of
    #[arg(long, value_name = "PROGRAM", value_parser = one_of(PROGRAMS))]
    from: Option<GrammarProgram>,
    /// Print the string after this many steps
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(..=100_000))]
    derive: Option<u32>,
    /// Write the turtle's drawing in the plane, after --derive steps or the grammar's own; `-` for standard output
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Print mistakes and oddities, and nothing else
    #[arg(long, conflicts_with_all = ["derive", "svg"])]
    check: bool,
    /// Seed of all draws
    #[arg(long, value_name = "N", default_value = "1", value_parser = input::seed)]
    seed: u64,
}

impl GrammarCommand {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let (system, params) = self.read()?;
        if let Some(warnings) = system.warnings() {
            output::warning(format!("the grammar is odd:\n{warnings}"));
        }
        if self.check {
            let (rules, params) = (system.grammar().rules.len(), system.params().len());
            output::note(format!("{}: no mistakes; {rules} rules, {params} parameters", self.file));
            return Ok(());
        }
        if self.derive.is_none() && self.svg.is_none() {
            return output::data(system.grammar().to_string().trim_end());
        }
        let derivation = Derivation {
            params: params.as_deref(),
            seed: self.seed,
            steps: self.derive.map(|steps| steps as usize),
            parallel: true,
            ..Derivation::default()
        };
        let derived =
            system.derive(&derivation).map_err(|error| anyhow!("{error}\n{}", system.report(&error)))?;
        let Some(path) = &self.svg else {
            return output::data(derived.to_text());
        };
        let drawing = derived.to_svg().with_context(|| format!("{} cannot be drawn", self.file))?;
        files::write_out(path, |out| Ok(out.write_all(drawing.as_bytes())?))?;
        output::wrote(path);
        Ok(())
    }

    /// A grammar of another program as one of pleach.
    fn translated(&self, text: &str, program: GrammarProgram) -> anyhow::Result<String> {
        let grammar = translate_grammar(&self.file, text, program)?;
        if !grammar.left_out.is_empty() {
            output::note(format!("left out are colours and shapes: {}", grammar.left_out.join(" ")));
        }
        Ok(grammar.text)
    }

    /// The grammar, and the values of its parameters where a species has its own.
    fn read(&self) -> anyhow::Result<(LSystem, Option<Vec<f64>>)> {
        let path = Path::new(&self.file);
        let is_preset = LSystemFamily.presets().iter().any(|(name, _)| *name == self.file);
        let is_species = path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("toml"));
        if self.from.is_none() && (is_preset || is_species) {
            let species = input::species(&self.file)?;
            let doc = SpeciesDoc::parse(&self.file, &species.generator.structure())?;
            let Ok(Some(text)) = doc.text("grammar") else {
                bail!("{} is of `{}` and has no grammar", self.file, species.generator.family());
            };
            let system = LSystem::read(&self.file, text)?;
            return Ok((system, Some(species.params.values().to_vec())));
        }
        let mut bytes = Vec::new();
        // One byte more than allowed, to notice a file that is too large.
        let limit = MAX_BYTES as u64 + 1;
        if input::is_standard(path) {
            let read = std::io::stdin().lock().take(limit).read_to_end(&mut bytes);
            read.context("cannot read the grammar")?;
        } else {
            let file = std::fs::File::open(path)
                .with_context(|| format!("cannot read the grammar {}", path.display()))?;
            let read = file.take(limit).read_to_end(&mut bytes);
            read.with_context(|| format!("cannot read the grammar {}", path.display()))?;
        }
        let text = String::from_utf8_lossy(&bytes);
        if let (Cow::Owned(_), Err(error)) = (&text, std::str::from_utf8(&bytes))
            && bytes.len() <= MAX_BYTES
        {
            let at = error.valid_up_to();
            let before = String::from_utf8_lossy(&bytes[..at]);
            let (line, last) = (before.matches('\n').count() + 1, before.rsplit('\n').next());
            let column = last.map_or(0, |last| last.chars().count()) + 1;
            let (file, byte) = (&self.file, bytes[at]);
            bail!("{file}:{line}:{column}: the byte 0x{byte:02x} is not UTF-8 text, expected a grammar");
        }
        let text = match self.from {
            Some(program) => Cow::Owned(self.translated(&text, program)?),
            None => text,
        };
        match LSystem::read(&self.file, &text) {
            Ok(system) => Ok((system, None)),
            Err(report) => {
                let count = report.diagnostics.len();
                bail!("the grammar has {count} mistake{}\n{report}", if count == 1 { "" } else { "s" })
            }
        }
    }
}
