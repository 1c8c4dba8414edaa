//! Bytes to text.

/// Text of a file of numbers: UTF-8, UTF-16, or else Latin-1, in which instruments write their µ.
pub fn decode_any(bytes: Vec<u8>) -> Result<String, String> {
    let text = match decode_utf8_or_utf16(bytes) {
        Ok(text) => text,
        Err((wrong, bytes))
            if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) =>
        {
            return Err(wrong);
        }
        Err((_, bytes)) => bytes.into_iter().map(char::from).collect(),
    };
    // The end-of-file mark of DOS.
    let text = text.trim_end_matches('\u{1a}');
    let is_control =
        |c: char| (c < ' ' || c == '\u{7f}') && !matches!(c, '\t' | '\n' | '\r' | '\u{c}');
    match text.chars().position(is_control) {
        None => Ok(text.to_owned()),
        Some(position) => Err(format!(
            "is no text (character {} is none) and no NumPy array; fret.read_surface reads the files of \
             instruments",
            position + 1
        )),
    }
}

/// Text of a scene or a table of materials: UTF-8 or UTF-16.
pub(in crate::scene) fn decode_unicode(bytes: Vec<u8>) -> Result<String, String> {
    decode_utf8_or_utf16(bytes).map_err(|(wrong, _)| format!("{wrong}: save it as UTF-8"))
}

/// Decodes Unicode by its first two bytes, or by the zeros between the letters of UTF-16 without them. The error
/// has a message and the bytes.
fn decode_utf8_or_utf16(bytes: Vec<u8>) -> Result<String, (String, Vec<u8>)> {
    let start = &bytes[..bytes.len().min(64)];
    let zeros = |odd: usize| {
        start.len() >= 4
            && start
                .iter()
                .enumerate()
                .all(|(i, b)| (i % 2 == odd) == (*b == 0))
    };
    let read: fn([u8; 2]) -> u16 = match start {
        [0xFF, 0xFE, ..] => u16::from_le_bytes,
        [0xFE, 0xFF, ..] => u16::from_be_bytes,
        _ if zeros(1) => u16::from_le_bytes,
        _ if zeros(0) => u16::from_be_bytes,
        _ => {
            return String::from_utf8(bytes)
                .map(|text| match text.strip_prefix('\u{feff}') {
                    Some(rest) => rest.to_owned(),
                    None => text,
                })
                .map_err(|e| {
                    let at = e.utf8_error().valid_up_to() + 1;
                    (format!("is not UTF-8 text at byte {at}"), e.into_bytes())
                });
        }
    };
    let (units, odd_byte) = bytes.as_chunks::<2>();
    let letters = char::decode_utf16(units.iter().map(|pair| read(*pair)));
    let letters = letters.filter(|c| *c != Ok('\u{feff}'));
    match letters.collect::<Result<String, _>>() {
        Ok(text) if odd_byte.is_empty() => Ok(text),
        _ => Err(("begins as UTF-16 text and is none".into(), bytes)),
    }
}

#[cfg(test)]
mod tests {
    use super::{decode_any, decode_unicode};

    #[test]
    fn letters_of_any_width_are_text() {
        let text = "x [µm]\n−1,5\n";
        let utf16 = |order: fn(u16) -> [u8; 2], mark: bool| {
            let mark = mark.then_some(0xFEFF);
            let units = mark.into_iter().chain(text.encode_utf16());
            units.flat_map(order).collect::<Vec<u8>>()
        };
        let plain = "x,y\n1,2\n";
        let unmarked: Vec<u8> = plain.encode_utf16().flat_map(u16::to_le_bytes).collect();
        for bytes in [
            text.as_bytes().to_vec(),
            [&b"\xEF\xBB\xBF"[..], text.as_bytes()].concat(),
            utf16(u16::to_le_bytes, true),
            utf16(u16::to_be_bytes, true),
        ] {
            assert_eq!(decode_unicode(bytes.clone()).as_deref(), Ok(text));
            assert_eq!(decode_any(bytes).as_deref(), Ok(text));
        }
        assert_eq!(decode_any(unmarked).as_deref(), Ok(plain));
        assert_eq!(decode_any(b"x [\xB5m]".to_vec()).as_deref(), Ok("x [µm]"));
        let refused = decode_unicode(b"x [\xB5m]".to_vec()).expect_err("no UTF-8");
        assert!(refused.contains("byte 4"), "{refused}");
        assert!(decode_any(vec![0x88, 0x1B, 3, 0x6F, 0, 1]).is_err());
        assert!(
            decode_any(vec![0xFF, 0xFE, 0x31]).is_err()
                && decode_unicode(vec![0xFF, 0xFE, 0x31]).is_err()
        );
    }
}
