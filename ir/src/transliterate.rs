//! Texts in the characters of a control that shows capitals alone.
//!
//! Letters become capitals, accents and other alphabets are transliterated, signs are replaced by those that it shows.

/// Appends a text to `shown` in capitals, digits and these signs.
pub fn in_capitals(text: &str, signs: &str, shown: &mut String) {
    let shows = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit() || c == ' ' || signs.contains(c);
    // Whether what was written last is the dash for an opening bracket: the number after it is not negative.
    let mut bracket = false;
    for c in text.chars() {
        if std::mem::take(&mut bracket) && (c.is_ascii_digit() || c == '.') {
            shown.push(' ');
        }
        if shows(c) {
            shown.push(c);
        } else if c.is_ascii_lowercase() {
            shown.push(c.to_ascii_uppercase());
        } else {
            let instead = stand_in(c);
            if instead.chars().all(shows) {
                bracket = matches!(c, '(' | '[' | '{');
                shown.push_str(instead);
            } else {
                shown.push(' ');
            }
        }
    }
}

/// What stands for a character that a control with capitals alone cannot show. Signs first, then
/// Latin letters with accents (Latin-1, Latin Extended-A), Greek and Cyrillic.
pub fn stand_in(c: char) -> &'static str {
    match c {
        '(' | '[' | '{' => "-",
        ')' | ']' | '}' => "",
        '%' => " PCT",
        '#' => "NO.",
        '&' => "+",
        '@' => "AT",
        ';' => ",",
        '!' | '?' => ".",
        '<' => " LT ",
        '>' => " GT ",
        '\\' | '|' => "/",
        '–' | '—' | '‐' | '‑' | '−' | '·' | '•' => "-",
        '\'' | '`' | '´' | '’' | '‘' => "",
        // A line before a number would be its sign: `~0.1 in` is about that much, and not less than nothing.
        '~' | '≈' => " ",
        '"' | '“' | '”' | '„' | '«' | '»' | '^' | '$' | '\t' | '\u{a0}' => " ",
        '…' => "...",
        '°' | 'º' => " DEG",
        'ª' => "A",
        '±' => "+-",
        '×' => "X",
        '÷' => "/",
        '¹' => "1",
        '²' => "2",
        '³' => "3",
        '¼' => "1/4",
        '½' => "1/2",
        '¾' => "3/4",
        'µ' | 'μ' => "U",
        'À'..='Ã' | 'Å' | 'à'..='ã' | 'å' | 'Ā'..='ą' => "A",
        'Ä' | 'ä' | 'Æ' | 'æ' => "AE",
        'Ç' | 'ç' | 'Ć'..='č' => "C",
        'Ð' | 'ð' | 'Ď'..='đ' => "D",
        'È'..='Ë' | 'è'..='ë' | 'Ē'..='ě' => "E",
        'Ĝ'..='ģ' => "G",
        'Ĥ'..='ħ' => "H",
        'Ì'..='Ï' | 'ì'..='ï' | 'Ĩ'..='ı' => "I",
        'Ĳ' | 'ĳ' => "IJ",
        'Ĵ' | 'ĵ' => "J",
        'Ķ'..='ĸ' => "K",
        'Ĺ'..='ł' => "L",
        'Ñ' | 'ñ' | 'Ń'..='ŋ' => "N",
        'Ò'..='Õ' | 'Ø' | 'ò'..='õ' | 'ø' | 'Ō'..='ő' => "O",
        'Ö' | 'ö' | 'Œ' | 'œ' => "OE",
        'Ŕ'..='ř' => "R",
        'ß' | 'ẞ' => "SS",
        'Ś'..='š' | 'Ș' | 'ș' => "S",
        'Þ' | 'þ' => "TH",
        'Ţ'..='ŧ' | 'Ț' | 'ț' => "T",
        'Ù'..='Û' | 'ù'..='û' | 'Ũ'..='ų' => "U",
        'Ü' | 'ü' => "UE",
        'Ŵ' | 'ŵ' => "W",
        'Ý' | 'ý' | 'ÿ' | 'Ŷ'..='Ÿ' => "Y",
        'Ź'..='ž' => "Z",
        _ => other_alphabet(c),
    }
}

fn other_alphabet(c: char) -> &'static str {
    match c {
        'А' | 'а' | 'Α' | 'α' => "A",
        'Б' | 'б' | 'Β' | 'β' => "B",
        'В' | 'в' => "V",
        'Г' | 'г' | 'Γ' | 'γ' => "G",
        'Д' | 'д' | 'Δ' | 'δ' => "D",
        'Е' | 'е' | 'Э' | 'э' | 'Ε' | 'ε' => "E",
        'Ё' | 'ё' => "YO",
        'Ж' | 'ж' => "ZH",
        'З' | 'з' | 'Ζ' | 'ζ' => "Z",
        'И' | 'и' | 'Ι' | 'ι' | 'Η' | 'η' => "I",
        'Й' | 'й' | 'Ы' | 'ы' | 'Υ' | 'υ' => "Y",
        'К' | 'к' | 'Κ' | 'κ' => "K",
        'Л' | 'л' | 'Λ' | 'λ' => "L",
        'М' | 'м' | 'Μ' => "M",
        'Н' | 'н' | 'Ν' | 'ν' => "N",
        'О' | 'о' | 'Ο' | 'ο' | 'Ω' | 'ω' => "O",
        'П' | 'п' | 'Π' | 'π' => "P",
        'Р' | 'р' | 'Ρ' | 'ρ' => "R",
        'С' | 'с' | 'Σ' | 'σ' | 'ς' => "S",
        'Т' | 'т' | 'Τ' | 'τ' => "T",
        'У' | 'у' => "U",
        'Ф' | 'ф' | 'Φ' | 'φ' => "F",
        'Х' | 'х' | 'Χ' | 'χ' => "KH",
        'Ц' | 'ц' => "TS",
        'Ч' | 'ч' => "CH",
        'Ш' | 'ш' => "SH",
        'Щ' | 'щ' => "SHCH",
        'Ъ' | 'ъ' | 'Ь' | 'ь' => "",
        'Ю' | 'ю' => "YU",
        'Я' | 'я' => "YA",
        'Θ' | 'θ' => "TH",
        'Ξ' | 'ξ' => "X",
        'Ψ' | 'ψ' => "PS",
        '⌀' | '∅' => "D",
        c if c.is_control() => " ",
        // Something was here: a reader of the comment is to see that.
        _ => "*",
    }
}
