//! Arrays for NumPy: format version 1.0, little-endian `f64`, C order.

use ndarray::Array2;

/// The bytes of a `.npy` file with this array.
///
/// ```
/// let bytes = courant_reports::npy::encode(&ndarray::array![[1.0, 2.0], [3.0, 4.0]]);
/// assert_eq!(&bytes[..6], b"\x93NUMPY");
/// ```
pub fn encode(array: &Array2<f64>) -> Vec<u8> {
    let (rows, columns) = array.dim();
    let mut header =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    // Magic, version and length take 10 bytes; the data starts at a multiple of 64.
    let unpadded = 10 + header.len() + 1;
    header.push_str(&" ".repeat(unpadded.next_multiple_of(64) - unpadded));
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend(array.iter().flat_map(|value| value.to_le_bytes()));
    bytes
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
}
