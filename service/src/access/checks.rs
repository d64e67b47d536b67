//! Names, passwords and rights of accounts, as requests and the command line state them.

use super::passwords::{LENGTH, fits};
use crate::http::Problem;
use crate::http::body;
use crate::rights::{Right, Role};

/// Bytes of the name of an account at most.
const NAME: usize = 64;

/// Rights of an account at most.
const RIGHTS: usize = 100;

/// Folders in each other at most, as of programs.
const DEEPEST: usize = 32;

/// Whether an account may have a name: small letters of ASCII, digits, `.`, `_`, `-`, `@`. So no two names look alike.
pub(crate) fn is_account(name: &str) -> bool {
    let is_sign = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"._-@".contains(&byte);
    (1..=NAME).contains(&name.len()) && name.bytes().all(is_sign) && !matches!(name, "." | "..")
}

/// The name of an account.
///
/// # Errors
/// 422.
pub(crate) fn account(name: &str) -> Result<(), Problem> {
    let form = || {
        Problem::content(format!("an account cannot be called `{name}`"))
            .help(format!("1 to {NAME} small letters, digits, `.`, `_`, `-` and `@`"))
    };
    is_account(name).then_some(()).ok_or_else(form)
}

/// The password is neither too short nor too long.
///
/// # Errors
/// 422.
pub(crate) fn password_fits(password: &str) -> Result<(), Problem> {
    let [least, most] = LENGTH;
    let form = || Problem::content(format!("a password has {least} to {most} bytes"));
    fits(password).then_some(()).ok_or_else(form)
}

/// Rights of an account: each folder once, and the admin of everything alone is one.
///
/// # Errors
/// 422.
pub(crate) fn rights(rights: &[Right]) -> Result<(), Problem> {
    if rights.len() > RIGHTS {
        return Err(Problem::content(format!("an account has {RIGHTS} rights at most")));
    }
    for (at, right) in rights.iter().enumerate() {
        folder(&right.folder)?;
        if right.role == Role::Admin && !right.folder.is_empty() {
            return Err(Problem::content("an admin is one of everything").help("\"folder\": \"\""));
        }
        if rights.iter().take(at).any(|other| other.folder == right.folder) {
            return Err(Problem::content(format!("the folder `{}` has two roles", right.folder)));
        }
    }
    Ok(())
}

/// A folder, as programs have them.
fn folder(folder: &str) -> Result<(), Problem> {
    let form = |_| Problem::content(format!("`{folder}` is no folder")).help("names with `/` between them");
    if folder.is_empty() {
        return Ok(());
    }
    let parts: Vec<&str> = folder.split('/').collect();
    if parts.len() > DEEPEST {
        return Err(form(Problem::absent("")));
    }
    parts.into_iter().try_for_each(|part| body::name(part).map(|_| ())).map_err(form)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_accounts_do_not_look_alike() {
        assert!(is_account("ana") && is_account("ana.b-c_2@shop.example") && is_account(&"a".repeat(64)));
        for wrong in ["", ".", "..", "Ana", "an\u{430}", "ana ", "a/b", "a\0", "ann\u{e9}", &"a".repeat(65)] {
            assert!(!is_account(wrong), "{wrong:?}");
        }
    }

    #[test]
    fn rights_are_of_folders() {
        let of = |pairs: &[(&str, Role)]| {
            let all: Vec<Right> = pairs
                .iter()
                .map(|(folder, role)| Right { folder: (*folder).to_owned(), role: *role })
                .collect();
            rights(&all).is_ok()
        };
        assert!(of(&[]) && of(&[("", Role::Admin)]) && of(&[("a/b", Role::Releaser), ("a", Role::Reader)]));
        for wrong in ["a/", "/a", "a//b", "..", "a/../b", ".", "a\nb", &"a/".repeat(40)] {
            assert!(!of(&[(wrong, Role::Reader)]), "{wrong:?}");
        }
        assert!(!of(&[("a", Role::Admin)]) && !of(&[("a", Role::Reader), ("a", Role::Editor)]));
    }
}
