//! The texts of the built-in dictionaries, for the loader and for the build script that prepares them.

/// Data files of the built-in dialects, in the order of `ncc dialects`.
pub(crate) const BUILTIN: [(&str, &str); 9] = [
    ("mach9", include_str!("../../data/mach9.toml")),
    ("fanuc", include_str!("../../data/fanuc.toml")),
    ("haas", include_str!("../../data/haas.toml")),
    ("siemens", include_str!("../../data/siemens.toml")),
    ("linuxcnc", include_str!("../../data/linuxcnc.toml")),
    ("grbl", include_str!("../../data/grbl.toml")),
    ("mach3", include_str!("../../data/mach3.toml")),
    ("canon", include_str!("../../data/canon.toml")),
    ("ir", include_str!("../../data/ir.toml")),
];

/// Their names alone: who asks for them alone does not bring the texts into a program.
pub(crate) const IDS: [&str; BUILTIN.len()] = {
    let mut ids = [""; BUILTIN.len()];
    let mut at = 0;
    while at < ids.len() {
        ids[at] = BUILTIN[at].0;
        at += 1;
    }
    ids
};
