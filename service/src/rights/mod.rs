//! Roles, the acts that they allow, and the user who asks for an act.
//!
//! ```text
//! ana  editor    plates      reads and changes the programs of `plates` and `plates/left`
//! ana  reviewer  plates/left  approves translations of `plates/left` too
//! ```
//!
//! A right is an account, a folder and a role; it holds in the folder and in those below it. Not here: requests
//! (`access`), and the tables of accounts (`store`).

mod who;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

pub(crate) use self::who::{Via, Who};

/// An act on programs of a folder, or on the service.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Act {
    /// Reads programs, translations and jobs.
    #[default]
    Read,
    /// Changes programs, makes translations and jobs, puts drafts into review.
    Change,
    /// Approves a translation, or makes it a draft again.
    Review,
    /// Releases a translation, or makes it obsolete.
    Release,
    /// Changes machines and accounts, reads the audit.
    Administer,
}

/// A role: it has its act and those of the roles before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Reads.
    Reader,
    /// Changes programs, makes translations and jobs.
    Editor,
    /// Approves translations.
    Reviewer,
    /// Releases translations.
    Releaser,
    /// Changes accounts and machines, reads the audit.
    Admin,
}

impl Role {
    /// All roles, the weakest first.
    const ALL: [(&str, Role, Act); 5] = [
        ("reader", Role::Reader, Act::Read),
        ("editor", Role::Editor, Act::Change),
        ("reviewer", Role::Reviewer, Act::Review),
        ("releaser", Role::Releaser, Act::Release),
        ("admin", Role::Admin, Act::Administer),
    ];

    /// The names of all roles, the weakest first.
    pub const NAMES: [&str; 5] = ["reader", "editor", "reviewer", "releaser", "admin"];

    /// The role of a name.
    pub fn named(name: &str) -> Option<Role> {
        Role::ALL.iter().find(|(own, ..)| *own == name).map(|(_, role, _)| *role)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        Role::ALL.iter().find(|(_, own, _)| *own == self).map_or("", |(name, ..)| name)
    }

    /// Its place among the roles, from 1, as the database keeps it.
    pub(crate) fn rank(self) -> i64 {
        Role::ALL.iter().zip(1..).find(|((_, own, _), _)| *own == self).map_or(0, |(_, rank)| rank)
    }

    /// The role of a rank.
    pub(crate) fn ranked(rank: i64) -> Option<Role> {
        Role::ALL.into_iter().map(|(_, role, _)| role).find(|role| role.rank() == rank)
    }

    /// The weakest role with an act.
    pub(crate) fn of(act: Act) -> Role {
        Role::ALL.iter().find(|(.., own)| *own == act).map_or(Role::Admin, |(_, role, _)| *role)
    }

    /// Whether it has an act.
    fn has(self, act: Act) -> bool {
        self >= Role::of(act)
    }
}

/// A role in a folder and those below it; the empty folder is everything.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Right {
    /// The folder.
    #[serde(default)]
    pub(crate) folder: String,
    /// The role.
    pub(crate) role: Role,
}

impl Right {
    /// The admin of everything.
    pub(crate) fn all() -> Right {
        Right { folder: String::new(), role: Role::Admin }
    }

    /// Whether it holds in a folder.
    fn holds_in(&self, folder: &str) -> bool {
        is_in(folder, &self.folder)
    }
}

/// Whether a folder is another one, or below it; the empty one has all. Names of folders are compared by their bytes.
pub(crate) fn is_in(folder: &str, other: &str) -> bool {
    other.is_empty()
        || folder.strip_prefix(other).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

/// Acts of a token. Each scope includes to read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Scope {
    /// Reads.
    Read,
    /// Changes programs, makes translations and jobs.
    Change,
    /// Approves and releases translations.
    Release,
    /// Changes accounts and machines, reads the audit.
    Admin,
}

impl Scope {
    const ALL: [(&str, Scope); 4] = [
        ("read", Scope::Read),
        ("change", Scope::Change),
        ("release", Scope::Release),
        ("admin", Scope::Admin),
    ];

    /// The names of all scopes.
    pub const NAMES: [&str; 4] = ["read", "change", "release", "admin"];

    /// The scope of a name.
    pub fn named(name: &str) -> Option<Scope> {
        Scope::ALL.iter().find(|(own, _)| *own == name).map(|(_, scope)| *scope)
    }

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        Scope::ALL.iter().find(|(_, own)| *own == self).map_or("", |(name, _)| name)
    }

    /// Whether it allows an act.
    fn has(self, act: Act) -> bool {
        match act {
            Act::Read => true,
            Act::Change => self == Scope::Change,
            Act::Review | Act::Release => self == Scope::Release,
            Act::Administer => self == Scope::Admin,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_holds_in_its_folder_and_below() {
        let right = |folder: &str| Right { folder: folder.to_owned(), role: Role::Reader };
        for folder in ["plates", "plates/left", "plates/left/a"] {
            assert!(right("plates").holds_in(folder) && right("").holds_in(folder), "{folder}");
        }
        // Another case, another letter of the same look, a prefix that is no folder, and the folder above.
        for folder in ["", "plates2", "Plates", "pl\u{430}tes", "plate", "plates\u{301}", "a/plates"] {
            assert!(!right("plates").holds_in(folder), "{folder:?}");
        }
        assert!(!right("plates/left").holds_in("plates"));
    }

    #[test]
    fn roles_and_scopes_have_their_acts() {
        let acts = [Act::Read, Act::Change, Act::Review, Act::Release, Act::Administer];
        for (count, (name, role, _)) in Role::ALL.iter().enumerate() {
            assert_eq!(acts.iter().filter(|act| role.has(**act)).count(), count + 1, "{name}");
            assert_eq!((Role::named(name), Role::ranked(role.rank())), (Some(*role), Some(*role)));
        }
        let allowed = |scope: Scope| acts.map(|act| scope.has(act));
        assert_eq!(allowed(Scope::Read), [true, false, false, false, false]);
        assert_eq!(allowed(Scope::Change), [true, true, false, false, false]);
        assert_eq!(allowed(Scope::Release), [true, false, true, true, false]);
        assert_eq!(allowed(Scope::Admin), [true, false, false, false, true]);
        assert_eq!(Role::ALL.map(|(name, ..)| name), Role::NAMES);
        assert_eq!(Scope::ALL.map(|(name, _)| name), Scope::NAMES);
    }
}
