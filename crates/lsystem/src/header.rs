//! The settings of a header as numbers.

use crate::derive::{DeriveError, Machine, header_error};
use crate::diagnostic::{Diagnostic, Fault};
use crate::program::Program;
use crate::syntax::SettingKey;
use glam::DVec3;

/// The settings of a grammar, evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    numbers: Vec<f64>,
    tropism: DVec3,
}

impl Header {
    pub(crate) fn new(program: &Program, globals: &[f64]) -> Result<Self, DeriveError> {
        let numbers = SettingKey::ALL.iter().map(|key| key.default(program.dialect)).collect();
        let mut header = Self { numbers, tropism: DVec3::ZERO };
        let mut machine = Machine::with_globals(program, globals);
        for (key, codes) in &program.settings {
            let (min, max) = key.range();
            let mut values = [0.0; 3];
            for (value, &code) in values.iter_mut().zip(codes) {
                let number =
                    machine.eval(code).map_err(|trouble| header_error(program, code.start, trouble))?;
                if !(min..=max).contains(&number) {
                    let fault = Fault::OutOfRange { name: key.name().to_owned(), value: number, min, max };
                    let span = program.spans[code.start as usize];
                    return Err(DeriveError {
                        step: 0,
                        diagnostic: Diagnostic::new(span, fault),
                        rule: None,
                    });
                }
                *value = number;
            }
            if *key == SettingKey::Tropism {
                header.tropism = values.into();
            }
            header.numbers[*key as usize] = values[0];
        }
        Ok(header)
    }

    /// The value of a setting that is a number or a word.
    #[must_use]
    pub fn get(&self, key: SettingKey) -> f64 {
        self.numbers[key as usize]
    }

    /// The vector that stems bend towards.
    #[must_use]
    pub const fn tropism(&self) -> DVec3 {
        self.tropism
    }

    /// Number of derivation steps.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.get(SettingKey::Steps) as usize
    }
}
