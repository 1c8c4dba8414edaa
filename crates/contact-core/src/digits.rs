//! Numbers as people read them: the digits that are printed follow the error.

/// Digits of a number whose error is not asked for.
const DIGITS: i32 = 4;
/// Digits of an error, and of a number without one.
const OF_ERRORS: i32 = 2;
/// Part of a number below which nobody reads its error: the number alone is right to its four digits.
const UNREAD: f64 = 1e-6;
/// Largest power of ten of a number of two digits that is printed without an exponent: more zeros at
/// its end would pass for digits.
const ZEROS: i32 = 4;
/// Powers of ten from and up to which numbers are printed without an exponent.
const PLAIN: std::ops::RangeInclusive<i32> = -4..=6;

/// Formats a number with four digits, without trailing zeros, with an exponent where it is large or small.
pub fn short(x: f64) -> String {
    digits(x, DIGITS)
}

/// Formats a number whose error is not known, with two digits.
pub fn rough(x: f64) -> String {
    digits(x, OF_ERRORS)
}

/// A number and its error, with the decimals of the first two digits of the error. Without an error
/// (`None`, NaN or infinite) "about" and two digits; without a number "not known". An
/// error below 1e-6 of the number gives the number alone.
///
/// # Examples
///
/// ```
/// use contact_core::digits::with_error;
///
/// assert_eq!(with_error(2.16345, Some(0.0123)), "2.163 +- 0.012");
/// assert_eq!(with_error(1.2184e7, Some(2.4e5)), "(1.218 +- 0.024)e7");
/// assert_eq!(with_error(-0.2, Some(97.0)), "0 +- 97");
/// assert_eq!(with_error(2.16345, None), "about 2.2");
/// assert_eq!(with_error(9.822447996, Some(1e-12)), "9.822");
/// assert_eq!(with_error(f64::NAN, None), "not known");
/// ```
pub fn with_error(value: f64, error: Option<f64>) -> String {
    if value.is_nan() {
        return "not known".into();
    }
    let error = error.filter(|error| error.is_finite()).map(f64::abs);
    match error {
        _ if value.is_infinite() => value.to_string(),
        None => format!("about {}", digits(value, OF_ERRORS)),
        Some(error) if error < UNREAD * value.abs() || error == 0.0 => short(value),
        Some(error) => {
            let size = power(value.abs().max(error));
            let scale = if PLAIN.contains(&size) { 0 } else { size };
            let unit = 10_f64.powi(scale);
            let decimals = (OF_ERRORS - 1 - power(error / unit)).clamp(0, 9) as usize;
            let number = format!("{:.decimals$}", value / unit);
            // A number that its error rounds to zero has no sign.
            let number = if number.contains(|c: char| ('1'..='9').contains(&c)) {
                number.as_str()
            } else {
                number.trim_start_matches('-')
            };
            let text = format!("{number} +- {:.decimals$}", error / unit);
            if scale == 0 {
                text
            } else {
                format!("({text})e{scale}")
            }
        }
    }
}

/// A number and the range that it lies in, with the digits that the range leaves: two to four.
///
/// # Examples
///
/// ```
/// use contact_core::digits::with_range;
///
/// assert_eq!(with_range(52_345.0, [51_900.0, 52_800.0]), "52350 (51900 to 52800)");
/// assert_eq!(with_range(52_345.0, [11_900.0, f64::INFINITY]), "52000 (12000 or more)");
/// assert_eq!(with_range(f64::INFINITY, [1e7, f64::INFINITY]), "1e7 or more");
/// assert_eq!(with_range(f64::INFINITY, [6.5e6, f64::INFINITY]), "6.5e6 or more");
/// assert_eq!(with_range(f64::INFINITY, [f64::INFINITY; 2]), "endless");
/// assert_eq!(with_range(5e6, [3.2e6, f64::INFINITY]), "5.0e6 (3.2e6 or more)");
/// assert_eq!(with_range(1.83e7, [4.4e6, 1.07e8]), "1.8e7 (4.4e6 to 1.1e8)");
/// ```
pub fn with_range(value: f64, [low, high]: [f64; 2]) -> String {
    if value.is_nan() {
        return "not known".into();
    }
    if low.is_nan() || high.is_nan() {
        return format!("about {}", digits(value, OF_ERRORS));
    }
    if value.is_infinite() {
        return if low.is_finite() {
            format!("{} or more", known_to_two(low))
        } else {
            "endless".into()
        };
    }
    let width = (high - low) / (2.0 * value.abs());
    let count = if width > 0.0 && width.is_finite() {
        (OF_ERRORS - 1 - power(width)).clamp(OF_ERRORS, DIGITS)
    } else if width == 0.0 || (low == high) {
        return short(value);
    } else {
        OF_ERRORS
    };
    // One form for the three.
    let sizes = [value, low, high]
        .into_iter()
        .filter(|x| x.is_finite() && *x != 0.0);
    let largest = if count > OF_ERRORS {
        *PLAIN.end()
    } else {
        ZEROS
    };
    let plain = sizes
        .map(power)
        .all(|size| (*PLAIN.start()..=largest).contains(&size));
    let format_digits = |x: f64| {
        if plain || x == 0.0 || !x.is_finite() {
            digits(x, count)
        } else {
            format!("{x:.*e}", (count - 1) as usize)
        }
    };
    if high.is_infinite() && value.is_finite() {
        return format!("{} ({} or more)", format_digits(value), format_digits(low));
    }
    format!(
        "{} ({} to {})",
        format_digits(value),
        format_digits(low),
        format_digits(high)
    )
}

/// Formats a number that is known to two digits, without zeros that would pass for digits.
///
/// # Examples
///
/// ```
/// use contact_core::digits::known_to_two;
///
/// assert_eq!(known_to_two(18_123.0), "18000");
/// assert_eq!(known_to_two(1e7), "1e7");
/// ```
pub fn known_to_two(x: f64) -> String {
    if x != 0.0 && x.is_finite() && !(*PLAIN.start()..=ZEROS).contains(&power(x)) {
        format!("{x:.1e}").replace(".0e", "e")
    } else {
        rough(x)
    }
}

/// An angle \[degrees\] to a tenth, which is what a plane is known to; never "-0".
///
/// # Examples
///
/// ```
/// use contact_core::digits::degrees;
///
/// assert_eq!(degrees(-0.04), "0 degrees");
/// assert_eq!(degrees(-12.34), "-12.3 degrees");
/// ```
pub fn degrees(angle: f64) -> String {
    format!("{} degrees", short((10.0 * angle).round() / 10.0 + 0.0))
}

/// Part of the size of a grid, or of a contact, below which a place is zero to rounding.
const OF_SIZE: f64 = 1e-9;

/// Sets a coordinate \[m\] that is zero to rounding to zero; `size` \[m\] is the length of the grid or of the
/// contact.
///
/// # Examples
///
/// ```
/// use contact_core::digits::place;
///
/// assert_eq!(place(-2e-16, 1e-3), 0.0);
/// assert_eq!(place(2e-9, 1e-3), 2e-9);
/// ```
pub fn place(at: f64, size: f64) -> f64 {
    if at.abs() < OF_SIZE * size { 0.0 } else { at }
}

/// The power of ten of the first digit.
fn power(x: f64) -> i32 {
    x.abs().log10().floor() as i32
}

/// Formats a number with `count` digits, without trailing zeros.
fn digits(x: f64, count: i32) -> String {
    if x == 0.0 || !x.is_finite() {
        return x.to_string();
    }
    let size = power(x);
    if !PLAIN.contains(&size) {
        return format!("{x:.*e}", (count - 1) as usize);
    }
    let decimals = count - 1 - size;
    if decimals < 0 {
        let unit = 10_f64.powi(-decimals);
        return format!("{:.0}", (x / unit).round() * unit);
    }
    let text = format!("{x:.*}", decimals as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}
