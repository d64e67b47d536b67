//! Builds the tables of every grammar (`*.lalrpop`) under `src`.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    lalrpop::Configuration::new().use_cargo_dir_conventions().process()
}
