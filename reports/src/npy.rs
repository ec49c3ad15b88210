//! Arrays for NumPy: little-endian `f64`, written in format version 1.0 and C order, read in every version and either order.
//!
//! Source: NumPy enhancement proposal 1, "A Simple File Format for NumPy Arrays".

use ndarray::{Array2, ArrayD, IxDyn, ShapeBuilder};
use thiserror::Error;

/// What a file begins with.
const MAGIC: &[u8] = b"\x93NUMPY";

/// Numbers with a shape; the last axis is fastest (C order).
#[derive(Debug, Clone, PartialEq)]
pub struct NpyArray {
    /// Numbers along each axis.
    pub shape: Vec<usize>,
    /// The numbers.
    pub values: Vec<f64>,
}

/// Why bytes are no array of `f64`.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NpyError {
    /// Something else, or cut off.
    #[error("it is no .npy file")]
    NoArray,
    /// Other numbers.
    #[error("its dtype is {0}, not float64 ('<f8')")]
    Type(String),
    /// Fewer or more numbers than the shape says.
    #[error("it holds {found} bytes of numbers where its shape needs {needed}")]
    Length {
        /// Bytes there are.
        found: usize,
        /// Bytes there should be.
        needed: usize,
    },
}

impl NpyArray {
    /// The bytes of a `.npy` file.
    ///
    /// ```
    /// use courant_reports::npy::NpyArray;
    /// let array = NpyArray { shape: vec![2, 1], values: vec![0.5, -1.0] };
    /// assert_eq!(NpyArray::from_bytes(&array.to_bytes()), Ok(array));
    /// ```
    pub fn to_bytes(&self) -> Vec<u8> {
        bytes(&self.shape, self.values.iter())
    }

    /// Reads the bytes of a `.npy` file.
    ///
    /// # Errors
    /// When they are none, hold other numbers than `f64`, or not as many as the shape says.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, NpyError> {
        let (header, data) = parts(bytes).ok_or(NpyError::NoArray)?;
        let descr = value(header, "descr").ok_or(NpyError::NoArray)?;
        let descr = descr.split([',', '}']).next().unwrap_or_default().trim();
        if !matches!(descr, "'<f8'" | "\"<f8\"") {
            return Err(NpyError::Type(descr.trim_matches(['\'', '"']).into()));
        }
        let is_fortran = value(header, "fortran_order").ok_or(NpyError::NoArray)?;
        let shape = value(header, "shape").and_then(shape).ok_or(NpyError::NoArray)?;
        let cells = shape.iter().try_fold(8_usize, |all, &size| all.checked_mul(size));
        let needed = cells.ok_or(NpyError::NoArray)?;
        if data.len() != needed {
            return Err(NpyError::Length { found: data.len(), needed });
        }
        let numbers = data.chunks_exact(8).map(|eight| {
            f64::from_le_bytes(eight.try_into().expect("a chunk of eight has eight bytes"))
        });
        let values: Vec<f64> = numbers.collect();
        if !is_fortran.starts_with("True") {
            return Ok(Self { shape, values });
        }
        let array = ArrayD::from_shape_vec(IxDyn(&shape).f(), values);
        let array = array.map_err(|_| NpyError::NoArray)?;
        Ok(Self { shape, values: array.iter().copied().collect() })
    }
}

/// The bytes of a `.npy` file with this array.
///
/// ```
/// let bytes = courant_reports::npy::encode(&ndarray::array![[1.0, 2.0], [3.0, 4.0]]);
/// assert_eq!(&bytes[..6], b"\x93NUMPY");
/// ```
pub fn encode(array: &Array2<f64>) -> Vec<u8> {
    bytes(array.shape(), array.iter())
}

fn bytes<'a>(shape: &[usize], values: impl ExactSizeIterator<Item = &'a f64>) -> Vec<u8> {
    let sizes: String = shape.iter().map(|size| format!("{size}, ")).collect();
    // A Python tuple: only one of one item keeps its comma.
    let shape = if shape.len() == 1 { sizes.trim_end() } else { sizes.trim_end_matches(", ") };
    let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({shape}), }}");
    // Magic, version and length take 10 bytes; the data starts at a multiple of 64.
    let unpadded = 10 + header.len() + 1;
    header.push_str(&" ".repeat(unpadded.next_multiple_of(64) - unpadded));
    header.push('\n');
    let mut bytes = Vec::with_capacity(10 + header.len() + 8 * values.len());
    bytes
        .extend([MAGIC, &[1, 0], &(header.len() as u16).to_le_bytes(), header.as_bytes()].concat());
    // Eight at once: byte by byte it would take thirty times as long.
    values.for_each(|value| bytes.extend_from_slice(&value.to_le_bytes()));
    bytes
}

/// The header, a Python dictionary, and the data.
fn parts(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let rest = bytes.strip_prefix(MAGIC)?;
    let (version, rest) = rest.split_first_chunk::<2>()?;
    let (length, rest) = match version[0] {
        1 => {
            let (length, rest) = rest.split_first_chunk::<2>()?;
            (usize::from(u16::from_le_bytes(*length)), rest)
        }
        _ => {
            let (length, rest) = rest.split_first_chunk::<4>()?;
            (usize::try_from(u32::from_le_bytes(*length)).ok()?, rest)
        }
    };
    let (header, data) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(header).ok()?, data))
}

/// What follows a key.
fn value<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    let (_, after) = header.split_once(key)?;
    Some(after.trim_start_matches(['\'', '"']).trim_start().strip_prefix(':')?.trim_start())
}

/// `(3, 5)`.
fn shape(text: &str) -> Option<Vec<usize>> {
    let (inside, _) = text.strip_prefix('(')?.split_once(')')?;
    let sizes = inside.split(',').map(str::trim).filter(|size| !size.is_empty());
    sizes.map(|size| size.parse().ok()).collect()
}

/// The axes of a map, beside its arrays `[x, y]`: names that begin with `stem`, and contents.
pub(crate) fn axes(stem: &str, x: &[f64], y: &[f64]) -> [(String, Vec<u8>); 2] {
    [("x", x), ("y", y)]
        .map(|(name, values)| (format!("{stem}_{name}.npy"), bytes(&[values.len()], values.iter())))
}

/// The same of rows that stand one after another.
///
/// # Panics
/// When the last row is not whole.
pub fn encode_rows(values: Vec<f64>, width: usize) -> Vec<u8> {
    let array = Array2::from_shape_vec((values.len() / width, width), values);
    encode(&array.expect("whole rows"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_layout_is_that_of_the_format_description() {
        let array = Array2::from_shape_fn((3, 5), |(i, j)| i as f64 - 0.5 * j as f64);
        let bytes = encode(&array);
        let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!((10 + length) % 64, 0);
        let header = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
        assert!(header.contains("'shape': (3, 5)") && header.ends_with('\n'));
        let data: Vec<f64> = bytes[10 + length..]
            .chunks(8)
            .map(|chunk| f64::from_le_bytes(chunk.try_into().unwrap()))
            .collect();
        assert_eq!(data, array.iter().copied().collect::<Vec<_>>());
    }

    fn with_header(header: &str, numbers: &[f64]) -> Vec<u8> {
        let length = (header.len() as u16).to_le_bytes();
        let data: Vec<u8> = numbers.iter().flat_map(|value| value.to_le_bytes()).collect();
        [MAGIC, &[1, 0], &length, header.as_bytes(), &data].concat()
    }

    #[test]
    fn arrays_of_either_order_are_read() {
        let line = NpyArray { shape: vec![3], values: vec![1.0, 2.0, 3.0] };
        assert!(String::from_utf8_lossy(&line.to_bytes()).contains("'shape': (3,), "));
        assert_eq!(NpyArray::from_bytes(&line.to_bytes()), Ok(line));
        let fortran = "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 2), }\n";
        let read = NpyArray::from_bytes(&with_header(fortran, &[1.0, 3.0, 2.0, 4.0])).unwrap();
        assert_eq!(read.values, [1.0, 2.0, 3.0, 4.0]);
    }

    #[test]
    fn what_is_no_array_of_f64_is_named() {
        assert_eq!(NpyArray::from_bytes(b"1 2 3"), Err(NpyError::NoArray));
        let single = "{'descr': '<f4', 'fortran_order': False, 'shape': (1,), }\n";
        let error = NpyArray::from_bytes(&with_header(single, &[])).unwrap_err();
        assert!(error.to_string().contains("<f4"));
        let short = "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }\n";
        let error = NpyArray::from_bytes(&with_header(short, &[1.0]));
        assert_eq!(error, Err(NpyError::Length { found: 8, needed: 16 }));
    }
}
