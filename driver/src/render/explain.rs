//! `ncc explain`: the page of a code.

/// Headings that every page has, in this order.
pub const HEADINGS: [&str; 4] = ["## What it means", "## Why it matters", "## Example", "## What to do"];

macro_rules! pages {
    ($($code:literal)*) => {
        /// Pages by code.
        const PAGES: &[(u16, &str)] =
            &[$(($code, include_str!(concat!("../../messages/NC0", stringify!($code), "/page.md")))),*];
    };
}

pages! {
    101 102 103 104 105 106 107 108 109 110 111 112 113 114 115 120
    201 202 203 204 205 206 207 208 209 210 211 212 213 214 215 216 217 218 219 220 221 222 223 224 225 226
    227 228 229 230 231 232 233 234 235 236 237 238 240 241 250
    301 302 303 304 305 306 307 308 309 310 311 312 313 320 321 322 323 324 325 326 327 328 329 330 331 332
    336 337 338 339 340 342 343 345 346 350
    401 402 403 404 405 406 407 408 409 410 411 412 413 414 415 416 417 418 419 420 421 422 423 424 425 426 427
    430 431 432 433 440 442 443 444 450
    501 502 503 504 505 506 507 508 509 510 520 521 522 523
    601 602 603 604 605 606 607 608 609 610
    701 702 703 704 705 706 707 708 709 710 711 712 713 714 715 716 717 718 719
    801 802 803 804 805 806 807 808 809 810 811 812 813 814
}

/// The page of a code as it is typed: `NC0107`, in any case, or `107`.
pub fn page(code: &str) -> Option<&'static str> {
    let number = self::code(code)?;
    PAGES.iter().find(|(code, _)| *code == number).map(|(_, page)| *page)
}

/// The number of a code as it is typed, if there is such a message.
pub fn code(code: &str) -> Option<u16> {
    let code = code.trim();
    let digits = match code.get(..2) {
        Some(letters) if letters.eq_ignore_ascii_case("NC") => &code[2..],
        Some(_) | None => code,
    };
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let number: u16 = digits.parse().ok()?;
    PAGES.iter().any(|(code, _)| *code == number).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_check::Rule;
    use ncc_frontends::recognise;
    use ncc_ir::diag::Fault;
    use ncc_machines::Wrong;

    #[test]
    fn every_code_has_a_page() {
        let codes: Vec<u16> = PAGES.iter().map(|(code, _)| *code).collect();
        for code in Fault::CODES
            .iter()
            .chain(Wrong::CODES)
            .chain(Wrong::PROJECT_CODES)
            .chain(Rule::CODES)
            .chain(&[recognise::CODE])
        {
            assert!(codes.contains(code), "NC{code:04} has no page");
        }
        for code in &codes {
            assert!(
                Fault::CODES.contains(code)
                    || Wrong::CODES.contains(code)
                    || Wrong::PROJECT_CODES.contains(code)
                    || Rule::CODES.contains(code)
                    || *code == recognise::CODE,
                "NC{code:04} is no code any more"
            );
        }
    }

    #[test]
    fn pages_have_their_headings() {
        for (code, page) in PAGES {
            assert!(page.starts_with(&format!("# NC{code:04}: ")), "NC{code:04}: title");
            let found: Vec<&str> = page.lines().filter(|line| line.starts_with("## ")).collect();
            assert_eq!(found, HEADINGS, "NC{code:04}");
            for part in page.split("\n## ").skip(1) {
                let text = part.split_once('\n').map_or("", |(_, text)| text).trim();
                assert!(text.len() >= 8, "NC{code:04}: a heading without text");
            }
            assert!(page.ends_with('\n') && page.lines().all(|l| l.chars().count() <= 100), "NC{code:04}");
        }
    }

    #[test]
    fn codes_are_found_as_people_type_them() {
        for code in ["NC0107", "nc0107", "NC107", "107", " 0107 "] {
            assert!(page(code).is_some_and(|p| p.starts_with("# NC0107")), "{code}");
        }
        for code in ["", "NC", "NC9999", "E0107", "NC+107", "NC01070107", "日本"] {
            assert_eq!(page(code), None, "{code}");
        }
    }
}
