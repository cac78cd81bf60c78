//! A search that keeps to its budget, notifies its observers and saves its state.

mod course;
mod drive;
mod pace;
mod queue;
#[cfg(test)]
mod tests;

pub(crate) use course::Course;
pub(super) use drive::drive;
