//! The profiles that come with ncc.

use std::sync::LazyLock;

use ncc_dialects::builtin;

use crate::profile::Profile;

/// Data files, in the order of `ncc machines`.
const SHIPPED: &[&str] = &[
    include_str!("../data/romi-discovery-4022.toml"),
    include_str!("../data/fanuc-vmc.toml"),
    include_str!("../data/haas-vf2.toml"),
    include_str!("../data/sinumerik-vmc.toml"),
    include_str!("../data/linuxcnc-mill.toml"),
    include_str!("../data/grbl-router.toml"),
    include_str!("../data/grbl-engraver.toml"),
    include_str!("../data/mach3-router.toml"),
    include_str!("../data/uccnc-mill.toml"),
];

static PROFILES: LazyLock<Vec<Profile>> = LazyLock::new(|| {
    let read =
        |text: &&str| Profile::parse(text, &builtin).unwrap_or_else(|e| panic!("shipped profile: {e:?}"));
    SHIPPED.iter().map(read).collect()
});

/// The shipped profiles.
pub fn shipped() -> &'static [Profile] {
    &PROFILES
}

/// A shipped profile by its id.
pub fn find(id: &str) -> Option<&'static Profile> {
    PROFILES.iter().find(|profile| profile.id() == id)
}

/// The data file of a shipped profile.
pub fn shipped_text(id: &str) -> Option<&'static str> {
    PROFILES.iter().position(|profile| profile.id() == id).and_then(|at| SHIPPED.get(at)).copied()
}
