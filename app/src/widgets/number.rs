//! Numbers as people write and read them.

/// At most six significant digits, no trailing zeros.
#[must_use]
pub fn format_number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".into() } else { value.to_string() };
    }
    if !(1e-4..1e7).contains(&value.abs()) {
        return format!("{value:e}");
    }
    let decimals = (5 - value.abs().log10().floor() as i32).max(0);
    let text = format!("{value:.*}", usize::try_from(decimals).unwrap_or(0));
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// Reads a number with or without its unit, with a decimal point or comma.
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
    }
}
