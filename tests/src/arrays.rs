//! NumPy arrays and archives of them, read without the code that writes them.

use std::collections::BTreeMap;
use std::io::{Cursor, Read as _};

/// An array as it lies in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// NumPy's short name of its numbers, such as `<f8`.
    pub descr: String,
    /// Its sides.
    pub shape: Vec<usize>,
    bytes: Vec<u8>,
}

impl Array {
    /// Reads a file of one array.
    ///
    /// # Panics
    /// If it is none of version 1.0 in C order, or its length is wrong.
    #[must_use]
    pub fn read(file: &[u8]) -> Self {
        assert_eq!(&file[..8], b"\x93NUMPY\x01\x00", "version 1.0");
        let end = 10 + usize::from(u16::from_le_bytes([file[8], file[9]]));
        assert_eq!(end % 64, 0, "aligned");
        let header = std::str::from_utf8(&file[10..end]).expect("a header of ASCII");
        assert!(header.contains("'fortran_order': False"), "{header}");
        let after = |key: &str| header.split_once(key).expect("a key").1;
        let descr = after("'descr': '").split('\'').next().expect("a type").to_owned();
        let sides = after("'shape': (").split(')').next().expect("a shape").split(',');
        let shape: Vec<usize> = sides
            .map(str::trim)
            .filter(|side| !side.is_empty())
            .map(|side| side.parse().expect("a side"))
            .collect();
        let width: usize = descr[2..].parse().expect("bytes of a number");
        let bytes = file[end..].to_vec();
        assert_eq!(bytes.len(), shape.iter().product::<usize>() * width, "{header}");
        Self { descr, shape, bytes }
    }

    fn numbers<T, const N: usize>(&self, descr: &str, from: impl Fn([u8; N]) -> T) -> Vec<T> {
        assert_eq!(self.descr, descr);
        self.bytes.as_chunks().0.iter().map(|bytes| from(*bytes)).collect()
    }

    /// Its numbers, of type uint8.
    #[must_use]
    pub fn u8s(&self) -> Vec<u8> {
        self.numbers("|u1", |[byte]| byte)
    }

    /// Its numbers, of type uint32.
    #[must_use]
    pub fn u32s(&self) -> Vec<u32> {
        self.numbers("<u4", u32::from_le_bytes)
    }

    /// Its numbers, of type uint64.
    #[must_use]
    pub fn u64s(&self) -> Vec<u64> {
        self.numbers("<u8", u64::from_le_bytes)
    }

    /// Its numbers, of type float32.
    #[must_use]
    pub fn f32s(&self) -> Vec<f32> {
        self.numbers("<f4", f32::from_le_bytes)
    }

    /// Its numbers, of type float64.
    #[must_use]
    pub fn f64s(&self) -> Vec<f64> {
        self.numbers("<f8", f64::from_le_bytes)
    }
}

/// The arrays of an npz file by name.
///
/// # Panics
/// If it is none.
#[must_use]
pub fn npz(file: &[u8]) -> BTreeMap<String, Array> {
    let mut archive = zip::ZipArchive::new(Cursor::new(file)).expect("a zip file");
    let mut arrays = BTreeMap::new();
    for i in 0..archive.len() {
        let mut entry = archive.by_index(i).expect("an entry");
        let mut bytes = Vec::new();
        let _ = entry.read_to_end(&mut bytes).expect("an entry that unpacks");
        let name = entry.name().expect("a name").strip_suffix(".npy").expect("an array").to_owned();
        let _ = arrays.insert(name, Array::read(&bytes));
    }
    arrays
}

/// The files of a tar file by name.
///
/// # Panics
/// If it is none.
#[must_use]
pub fn tar(file: &[u8]) -> BTreeMap<String, Vec<u8>> {
    let mut archive = tar::Archive::new(file);
    let entries = archive.entries().expect("a tar file").map(|entry| {
        let mut entry = entry.expect("an entry");
        let name = entry.path().expect("a name").to_str().expect("a name of UTF-8").to_owned();
        let mut bytes = Vec::new();
        let _ = entry.read_to_end(&mut bytes).expect("an entry that reads");
        (name, bytes)
    });
    entries.collect()
}
