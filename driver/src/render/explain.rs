//! `ncc explain`: the page of a code.

use super::messages::files::FILES;

/// Headings that every page has, in this order.
pub const HEADINGS: [&str; 4] = ["## What it means", "## Why it matters", "## Example", "## What to do"];

/// The page of a code as it is typed: `NC0107`, in any case, or `107`.
pub fn page(code: &str) -> Option<&'static str> {
    let number = self::code(code)?;
    FILES.iter().find(|files| files.code == number).map(|files| files.page)
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
    FILES.iter().any(|files| files.code == number).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::messages::files::Files;
    use crate::simulate::told;
    use ncc_check::Rule;
    use ncc_frontends::recognise;
    use ncc_ir::diag::Fault;
    use ncc_machines::Wrong;

    #[test]
    fn every_code_has_a_page() {
        let codes: Vec<u16> = FILES.iter().map(|files| files.code).collect();
        for code in Fault::CODES
            .iter()
            .chain(Wrong::CODES)
            .chain(Wrong::PROJECT_CODES)
            .chain(Rule::CODES)
            .chain(told::CODES)
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
                    || told::CODES.contains(code)
                    || *code == recognise::CODE,
                "NC{code:04} is no code any more"
            );
        }
    }

    #[test]
    fn pages_have_their_headings() {
        for Files { code, page, .. } in FILES {
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
