//! Text formatting of numbers and verdicts, common to tables, pages and windows.

use crate::compare::{ComparedWith, Standing, Verdict};

/// Exponent in superscript digits.
fn superscript(exponent: i32) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => c.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(c),
    };
    exponent.to_string().chars().map(digit).collect()
}

/// A power of ten.
#[must_use]
pub fn power_of_ten(exponent: i32) -> String {
    format!("10{}", superscript(exponent))
}

/// Decimal exponent of a number rounded to three digits.
fn exponent(x: f64) -> i32 {
    format!("{:.2e}", x.abs()).split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0)
}

/// Range of exponents for which positional notation is used.
const PLAIN: std::ops::RangeInclusive<i32> = -3..=4;

/// Replaces the hyphen by a minus sign, which is as wide as a plus.
fn signed(text: String) -> String {
    text.replace('-', "−")
}

/// A number with three digits: `0.0123`, `12 300`, `1.23 × 10⁻⁵`; `–` for NaN.
#[must_use]
pub fn number(x: f64) -> String {
    if !x.is_finite() {
        return if x.is_infinite() {
            signed(format!("{}∞", if x < 0.0 { "-" } else { "" }))
        } else {
            "–".into()
        };
    }
    if x == 0.0 {
        return "0".into();
    }
    let e = exponent(x);
    if PLAIN.contains(&e) {
        return signed(grouped(&format!("{x:.*}", usize::try_from(2 - e).unwrap_or(0))));
    }
    signed(format!("{:.2} × {}", x / 10f64.powi(e), power_of_ten(e)))
}

/// Separates thousands, from five digits on.
fn grouped(text: &str) -> String {
    let digits = text.trim_start_matches('-');
    if digits.contains('.') || digits.len() < 5 {
        return text.to_owned();
    }
    let cut = text.len() - 3;
    format!("{}\u{202f}{}", &text[..cut], &text[cut..])
}

/// A number without trailing zeros: `0.1`, `20`.
#[must_use]
pub fn tick(x: f64) -> String {
    let text = number(x);
    let (mantissa, power) = text.split_at(text.find(" ×").unwrap_or(text.len()));
    let short =
        if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    match short {
        "1" if !power.is_empty() => power.trim_start_matches(" × ").to_owned(),
        short => format!("{short}{power}"),
    }
}

/// A value with its error, both to the second digit of the error: `0.0123 ± 0.0004`, `(1.23 ± 0.04) × 10⁻⁵`.
/// A line may break before the ± but not after it.
#[must_use]
pub fn quantity(value: f64, error: f64) -> String {
    if !value.is_finite() || !error.is_finite() || error <= 0.0 || value == 0.0 {
        return number(value);
    }
    let (e, digit) = (exponent(value), exponent(error));
    // At least as many digits as the error has, at most four of the value.
    let digits = (e - digit + 1).clamp(1, 3);
    if PLAIN.contains(&e) {
        let places = usize::try_from(digits - e).unwrap_or(0);
        return signed(format!("{value:.places$} ±\u{a0}{error:.places$}"));
    }
    let (scale, places) = (10f64.powi(e), usize::try_from(digits).unwrap_or(1));
    signed(format!("({:.places$} ±\u{a0}{:.places$}) × {}", value / scale, error / scale, power_of_ten(e)))
}

/// A probability, without its leading zero: `.43`.
#[must_use]
pub fn probability(p: f64) -> String {
    if !p.is_finite() {
        "–".into()
    } else if p < 0.005 {
        number(p)
    } else if p >= 0.995 {
        "1".into()
    } else {
        format!("{p:.2}").trim_start_matches('0').to_owned()
    }
}

/// A fraction in per cent.
#[must_use]
pub fn percent(share: f64) -> String {
    if !share.is_finite() {
        return "–".into();
    }
    let x = 100.0 * share;
    let places = if x.abs() >= 9.95 {
        0
    } else if x.abs() >= 0.095 {
        1
    } else {
        2
    };
    signed(format!("{x:.places$} %"))
}

/// A difference in per cent with its error: `+2.1 % ± 0.3 %`.
fn difference(value: f64, error: f64) -> String {
    let places =
        if 100.0 * error >= 0.95 { 0 } else { usize::try_from(-exponent(100.0 * error)).unwrap_or(1) };
    let places = places.min(3);
    signed(format!("{:+.places$} % ± {:.places$} %", 100.0 * value, 100.0 * error))
}

/// A factor with two or three digits.
#[must_use]
pub fn times(x: f64) -> String {
    let decimals = match x {
        x if !x.is_finite() || x < 1e-4 => return number(x),
        x if x >= 100.0 => 0,
        x if x >= 10.0 => 1,
        x if x >= 0.1 => 2,
        x => usize::try_from(1 - exponent(x)).unwrap_or(2),
    };
    grouped(&format!("{x:.decimals$}"))
}

/// Efficiency relative to the baseline.
#[must_use]
pub fn speedup(standing: &Standing) -> String {
    match (standing.speedup, standing.speedup_interval) {
        (x, _) if x.is_nan() => "–".into(),
        (_, [1.0, 1.0]) => "1 (baseline)".into(),
        (x, _) => times(x),
    }
}

/// 95 % interval of the speed-up, `[3.0, 3.4]`; `None` for the baseline.
#[must_use]
pub fn interval(standing: &Standing) -> Option<String> {
    match standing.speedup_interval {
        [1.0, 1.0] => None,
        // The cost is known only after two timed passes.
        [lo, hi] if !lo.is_finite() || !hi.is_finite() => None,
        [lo, hi] => Some(format!("[{}, {}]", times(lo), times(hi))),
    }
}

/// Display text for the image that a view was compared with.
#[must_use]
pub fn against(against: &ComparedWith) -> String {
    match against {
        ComparedWith::Reference(origin) => origin.clone(),
        ComparedWith::Others(labels) => format!("mean of {labels}"),
        ComparedWith::Nothing(why) => format!("nothing: {why}"),
    }
}

/// z beyond which the verdict states the difference of the whole region instead of the worst block.
const FAR: f64 = 4.0;

/// The verdict with its supporting number: `agrees (p = .43)`, `biased: +2.1 % ± 0.3 %`.
#[must_use]
pub fn verdict(standing: &Standing) -> String {
    let Some(found) = standing.agreement else {
        let why = match &standing.against {
            ComparedWith::Nothing(why) => why,
            _ => "there is no image to compare it with",
        };
        return format!("undecided: {why}");
    };
    let text = match found.verdict {
        Verdict::Agrees => format!("agrees (p = {})", probability(found.p)),
        Verdict::Undecided if found.excluded > 0 && found.p.is_nan() => {
            "undecided: pixels without a finite value".into()
        }
        Verdict::Undecided => "undecided: too noisy to tell".into(),
        Verdict::Differs => match found.worst.filter(|_| found.z.abs() < FAR) {
            Some(worst) => format!(
                "biased: {} near pixel {}, {}",
                difference(worst.difference, worst.error),
                (worst.region.x0 + worst.region.x1) / 2,
                (worst.region.y0 + worst.region.y1) / 2
            ),
            None => format!("biased: {}", difference(found.difference, found.error)),
        },
    };
    match standing.declared_bias {
        Some(why) => format!("{text}; {why}"),
        None => text,
    }
}

/// Quotes a word for a shell where necessary.
#[must_use]
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=./:,+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_correctly_rounded() {
        for (x, text) in [
            (0.012_345, "0.0123"),
            (0.0, "0"),
            (1.0, "1.00"),
            (999.6, "1000"),
            (12_345.0, "12\u{202f}345"),
            (-1.234e-7, "−1.23 × 10⁻⁷"),
            (9.999e-8, "1.00 × 10⁻⁷"),
            (4.5e12, "4.50 × 10¹²"),
            (f64::NAN, "–"),
            (f64::INFINITY, "∞"),
        ] {
            assert_eq!(number(x), text);
        }
        assert_eq!([0.1, 20.0, 1e-6, 2.5e7].map(tick), ["0.1", "20", "10⁻⁶", "2.5 × 10⁷"]);
        assert_eq!([0.000_276_2, 0.314, 3.2, 3621.0].map(times), ["0.00028", "0.31", "3.20", "3621"]);
        assert_eq!(quantity(0.012_34, 0.000_42), "0.01234 ±\u{a0}0.00042");
        assert_eq!(quantity(1.234e-6, 4.2e-8), "(1.234 ±\u{a0}0.042) × 10⁻⁶");
        assert_eq!(quantity(2.0, f64::INFINITY), "2.00");
        assert_eq!([0.43, 0.0012, 1.0, f64::NAN].map(probability), [".43", "0.00120", "1", "–"]);
        assert_eq!([0.5, 0.021, 0.000_4].map(percent), ["50 %", "2.1 %", "0.04 %"]);
        assert_eq!(difference(0.021, 0.003), "+2.1 % ± 0.3 %");
        assert_eq!(difference(-0.212, 0.031), "−21 % ± 3 %");
        assert_eq!(difference(0.002_12, 0.000_2), "+0.21 % ± 0.02 %");
    }

    #[test]
    fn shells_leave_quoted_words_alone() {
        assert_eq!(quoted("a=1.5"), "a=1.5");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(quoted(""), "''");
    }
}
