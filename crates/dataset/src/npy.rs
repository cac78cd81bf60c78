//! NumPy's format of one array: a line that says what it is, and its bytes.
//!
//! [The specification](https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html), version 1.0.

use std::io::{self, Write};

/// The beginning of every such file: the format's name and version.
const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
/// The array begins at a multiple of this many bytes.
const ALIGNMENT: usize = 64;

/// A number that arrays are made of.
pub(crate) trait Number: Copy {
    /// NumPy's short name of it, little-endian.
    const DESCR: &'static str;
    /// Its bytes, to `out`.
    fn write(self, out: &mut impl Write) -> io::Result<()>;
}

macro_rules! number {
    ($($type:ty: $descr:literal),*) => {$(
        impl Number for $type {
            const DESCR: &'static str = $descr;

            fn write(self, out: &mut impl Write) -> io::Result<()> {
                out.write_all(&self.to_le_bytes())
            }
        }
    )*};
}

number!(u8: "|u1", u32: "<u4", u64: "<u8", f32: "<f4", f64: "<f8");

/// Writes what comes before the numbers of an array of this shape, which follow in C order.
pub(crate) fn write_header<T: Number>(out: &mut impl Write, shape: &[u64]) -> io::Result<()> {
    let mut sides: Vec<String> = shape.iter().map(u64::to_string).collect();
    // A tuple of one has a comma.
    if sides.len() == 1 {
        sides.push(String::new());
    }
    let shape = sides.join(", ");
    let mut header =
        format!("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", T::DESCR, shape.trim());
    let before = MAGIC.len() + 2;
    let length = (before + header.len() + 1).next_multiple_of(ALIGNMENT) - before;
    header.extend(std::iter::repeat_n(' ', length - header.len() - 1));
    header.push('\n');
    out.write_all(MAGIC)?;
    // A shape of some sides is far from 64 kB.
    out.write_all(&(length as u16).to_le_bytes())?;
    out.write_all(header.as_bytes())
}

/// Writes an array.
pub(crate) fn write<T: Number>(
    out: &mut impl Write,
    shape: &[u64],
    values: impl Iterator<Item = T>,
) -> io::Result<()> {
    write_header::<T>(out, shape)?;
    let mut values = values;
    values.try_for_each(|value| value.write(out))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file<T: Number>(shape: &[u64], values: &[T]) -> Vec<u8> {
        let mut bytes = Vec::new();
        write(&mut bytes, shape, values.iter().copied()).unwrap();
        bytes
    }

    #[test]
    fn bytes_are_those_of_numpy() {
        // numpy.save("a.npy", numpy.array([[1, -2.5, numpy.inf]], "<f4"))
        let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 3), }";
        let header = format!("{header:117}\n");
        let numbers = [0, 0, 128, 63, 0, 0, 32, 192, 0, 0, 128, 127];
        let expected = [b"\x93NUMPY\x01\x00\x76\x00", header.as_bytes(), &numbers];
        assert_eq!(file(&[1, 3], &[1.0, -2.5, f32::INFINITY]), expected.concat());
    }

    #[test]
    fn numbers_begin_at_a_multiple_of_64() {
        for sides in 1..8 {
            let bytes = file::<u8>(&vec![0; sides], &[]);
            assert_eq!(bytes.len() % 64, 0, "{sides} sides");
            assert_eq!(bytes.last(), Some(&b'\n'));
        }
        let text = String::from_utf8_lossy(&file(&[1], &[3_u32])[10..]).into_owned();
        assert!(text.starts_with("{'descr': '<u4', 'fortran_order': False, 'shape': (1,), }"), "{text}");
    }
}
