//! Formatting and parsing of numbers.

/// Formats a number with at most six significant digits and no trailing zeros.
#[must_use]
pub fn format_number(value: f64) -> String {
    format_digits(value, 6)
}

/// Formats a number with as many significant digits as fit into `room` characters, from one to six.
#[must_use]
pub fn format_within(value: f64, room: usize) -> String {
    let texts = (1..=6).rev().map(|digits| format_digits(value, digits));
    let mut last = String::new();
    for text in texts {
        if text.chars().count() <= room {
            return text;
        }
        last = text;
    }
    last
}

fn format_digits(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".into() } else { value.to_string() };
    }
    if !(1e-4..1e7).contains(&value.abs()) {
        let text = format!("{value:.*e}", digits.saturating_sub(1));
        return match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{}e{exponent}", without_zeros(mantissa)),
            None => text,
        };
    }
    let decimals = digits as i32 - 1 - value.abs().log10().floor() as i32;
    without_zeros(&format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))).to_owned()
}

/// Removes trailing zeros of a decimal fraction.
fn without_zeros(text: &str) -> &str {
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => text,
    }
}

/// Parses a number with or without its unit, with a decimal point or comma.
#[must_use]
pub fn parse_number(text: &str, unit: &str) -> Option<f64> {
    let text = text.trim().replace('−', "-");
    let text = text.strip_suffix(unit.trim()).unwrap_or(&text).trim();
    let number = text.trim_end_matches(|c: char| !c.is_ascii_digit() && c != '.').trim();
    number.replace(',', ".").parse().ok().filter(|x: &f64| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_with_their_unit() {
        assert_eq!(parse_number("540 nm", "nm"), Some(540.0));
        assert_eq!(parse_number("540nm", "nm"), Some(540.0));
        assert_eq!(parse_number(" −1,5 °", "°"), Some(-1.5));
        assert_eq!(parse_number("1e-3", ""), Some(1e-3));
        assert_eq!(parse_number("12 /sr", "nm"), Some(12.0));
        assert_eq!(parse_number("", "nm"), None);
        assert_eq!(parse_number("nm", "nm"), None);
        assert_eq!(parse_number("inf", ""), None);
    }

    #[test]
    fn numbers_are_written_without_noise() {
        assert_eq!(format_number(0.0), "0");
        assert_eq!(format_number(0.1_f32.into()), "0.1");
        assert_eq!(format_number(540.0), "540");
        assert_eq!(format_number(1.0 / 3.0), "0.333333");
        assert_eq!(format_number(-12.5), "-12.5");
        assert_eq!(format_number(1e-6), "1e-6");
        // Digits beyond single precision are not shown.
        assert_eq!(format_number(1e-6_f32.into()), "1e-6");
        assert_eq!(format_number(-2.5e9), "-2.5e9");
    }

    #[test]
    fn numbers_fit_into_their_room() {
        assert_eq!(format_within(-0.075_529_1, 7), "-0.0755");
        assert_eq!(format_within(12.345_678, 7), "12.3457");
        assert_eq!(format_within(1234.5, 4), "1234");
        assert_eq!(format_within(-1.234_56e-7, 6), "-1e-7");
        assert_eq!(format_within(0.5, 7), "0.5");
        // Integer digits are never cut.
        assert_eq!(format_within(1_234_567.0, 3), "1234567");
    }
}
