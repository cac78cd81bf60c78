//! Numbers as text with a given number of decimals. The standard formatter took four fifths of an OBJ's time.

/// Appends `number` with `decimals` digits after the point; never −0.
pub(super) fn push(text: &mut Vec<u8>, number: f32, decimals: usize) {
    let scale = 10_u64.pow(decimals as u32);
    let scaled = (f64::from(number.abs()) * scale as f64).round() as u64;
    if number < 0.0 && scaled > 0 {
        text.push(b'-');
    }
    digits(text, scaled / scale, 1);
    text.push(b'.');
    digits(text, scaled % scale, decimals);
}

/// Appends a whole number with at least `least` digits.
pub(super) fn digits(text: &mut Vec<u8>, mut number: u64, least: usize) {
    let mut buffer = [b'0'; 20];
    let mut at = buffer.len();
    while number > 0 || buffer.len() - at < least {
        at -= 1;
        buffer[at] = b'0' + (number % 10) as u8;
        number /= 10;
    }
    text.extend_from_slice(&buffer[at..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_the_standard_formatter_would() {
        for number in [0.0, -0.0, 1.0, -1.5, 0.000_004, -0.000_004, 12.345_678, -1234.5, 0.999_999_9_f32] {
            let mut text = Vec::new();
            push(&mut text, number, 5);
            let expected = format!("{:.5}", f64::from(number));
            let expected = if expected == "-0.00000" { "0.00000".to_owned() } else { expected };
            assert_eq!(String::from_utf8(text).unwrap(), expected);
        }
    }
}
