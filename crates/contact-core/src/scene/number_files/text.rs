//! Bytes to text.

/// Text of a file of numbers: UTF-8, UTF-16, or else Latin-1, in which instruments write their µ.
pub fn tolerant(bytes: Vec<u8>) -> Result<String, String> {
    let text = match unicode(bytes) {
        Ok(text) => text,
        Err((wrong, bytes))
            if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) =>
        {
            return Err(wrong);
        }
        Err((_, bytes)) => bytes.into_iter().map(char::from).collect(),
    };
    // The end of a file of DOS.
    let text = text.trim_end_matches('\u{1a}');
    let foreign =
        |c: char| (c < ' ' || c == '\u{7f}') && !matches!(c, '\t' | '\n' | '\r' | '\u{c}');
    match text.chars().position(foreign) {
        None => Ok(text.to_owned()),
        Some(at) => Err(format!(
            "is no text (character {} is none) and no NumPy array; fret.read_surface reads the files of \
             instruments",
            at + 1
        )),
    }
}

/// Text of a scene or a table of materials: UTF-8 or UTF-16.
pub(in crate::scene) fn strict(bytes: Vec<u8>) -> Result<String, String> {
    unicode(bytes).map_err(|(wrong, _)| format!("{wrong}: save it as UTF-8"))
}

/// Unicode by its first two bytes, or by the zeros between the letters of UTF-16 without them; what
/// is wrong, and the bytes, if it is none.
fn unicode(bytes: Vec<u8>) -> Result<String, (String, Vec<u8>)> {
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
    let (units, rest) = bytes.as_chunks::<2>();
    let letters = char::decode_utf16(units.iter().map(|pair| read(*pair)));
    let letters = letters.filter(|c| *c != Ok('\u{feff}'));
    match letters.collect::<Result<String, _>>() {
        Ok(text) if rest.is_empty() => Ok(text),
        _ => Err(("begins as UTF-16 text and is none".into(), bytes)),
    }
}

#[cfg(test)]
mod tests {
    use super::{strict, tolerant};

    #[test]
    fn letters_of_any_width_are_text() {
        let text = "x [µm]\n−1,5\n";
        let wide = |order: fn(u16) -> [u8; 2], mark: bool| {
            let mark = mark.then_some(0xFEFF);
            let units = mark.into_iter().chain(text.encode_utf16());
            units.flat_map(order).collect::<Vec<u8>>()
        };
        let plain = "x,y\n1,2\n";
        let unmarked: Vec<u8> = plain.encode_utf16().flat_map(u16::to_le_bytes).collect();
        for bytes in [
            text.as_bytes().to_vec(),
            [&b"\xEF\xBB\xBF"[..], text.as_bytes()].concat(),
            wide(u16::to_le_bytes, true),
            wide(u16::to_be_bytes, true),
        ] {
            assert_eq!(strict(bytes.clone()).as_deref(), Ok(text));
            assert_eq!(tolerant(bytes).as_deref(), Ok(text));
        }
        assert_eq!(tolerant(unmarked).as_deref(), Ok(plain));
        assert_eq!(tolerant(b"x [\xB5m]".to_vec()).as_deref(), Ok("x [µm]"));
        let refused = strict(b"x [\xB5m]".to_vec()).expect_err("no UTF-8");
        assert!(refused.contains("byte 4"), "{refused}");
        assert!(tolerant(vec![0x88, 0x1B, 3, 0x6F, 0, 1]).is_err());
        assert!(
            tolerant(vec![0xFF, 0xFE, 0x31]).is_err() && strict(vec![0xFF, 0xFE, 0x31]).is_err()
        );
    }
}
