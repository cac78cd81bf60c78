//! OBJ with lines instead of surfaces, y up.

use super::{Skeleton, written};
use std::io::{self, Write};

impl Skeleton {
    /// Writes the axes of the stems as Wavefront OBJ, to a buffered `out`: a line for each stem, in metres, y up as in
    /// meshes of this format. Radii are left out, which the format cannot hold.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_lines(&self, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
        writeln!(out, "# the axes of stems: metres, y up")?;
        for node in &self.nodes {
            let [x, y, z] = written(node.position);
            let [x, y, z] = [x, z, if y == 0.0 { 0.0 } else { -y }];
            writeln!(out, "v {x:.8} {y:.8} {z:.8}")?;
        }
        let stems = self.nodes.chunk_by(|a, b| a.stem == b.stem);
        let mut first = 1;
        for stem in stems {
            // A stem without length is a point.
            if stem.len() > 1 {
                write!(out, "l")?;
                (first..first + stem.len()).try_for_each(|number| write!(out, " {number}"))?;
                writeln!(out)?;
            }
            first += stem.len();
        }
        Ok(())
    }
}
