//! Each example of the book's pages, run by a shell against a started server.

use std::fs;
use std::process::{Command, Stdio};

use ncc_service::Limits;

use crate::client::{Server, repository};

/// The address that the page has.
const PRINTED: &str = "127.0.0.1:8274";

/// Examples of a page: what is typed, and lines of what is printed.
fn examples(page: &str) -> Vec<(String, Vec<String>)> {
    let mut examples: Vec<(String, Vec<String>)> = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        let mut block =
            || lines.by_ref().take_while(|line| *line != "```").map(str::to_owned).collect::<Vec<_>>();
        match line {
            "```sh" => examples.push((block().join("\n"), Vec::new())),
            "```text" => examples.last_mut().expect("an example before").1 = block(),
            _ => {}
        }
    }
    examples
}

#[test]
fn the_examples_of_the_pages_do_what_they_say() {
    if cfg!(windows) || !is_there("curl", "--version") {
        println!("skipped: no curl, or no shell, to run the examples of the book");
        return;
    }
    for (page, least) in [("serve", 5), ("serve-users", 3)] {
        examples_of(page, least);
    }
}

/// Whether this computer has a program.
fn is_there(program: &str, argument: &str) -> bool {
    let done = Command::new(program).arg(argument).stdout(Stdio::null()).status();
    done.is_ok_and(|status| status.success())
}

/// Runs the examples of a page, so many at least, against a server of their own.
fn examples_of(page: &str, least: usize) {
    let page = fs::read_to_string(repository(&format!("docs/book/src/use/{page}.md"))).expect("the page");
    let examples = examples(&page);
    assert!(examples.len() >= least, "{} examples", examples.len());
    let server = Server::telling(&["http://127.0.0.1:8090/ncc".to_owned()], Limits::default());
    let folder = tempfile::tempdir().expect("a folder");
    fs::copy(repository("corpus/mach9/table9.cn"), folder.path().join("table9.cn")).expect("a program");
    let has_openssl = is_there("openssl", "version");
    for (typed, printed) in examples {
        if typed.contains("openssl") && !has_openssl {
            println!("skipped: no openssl for the example that checks a signature");
            continue;
        }
        let script = typed.replace(PRINTED, &server.address.to_string());
        let done =
            Command::new("sh").args(["-euc", &script]).current_dir(folder.path()).output().expect("a shell");
        let text = String::from_utf8_lossy(&done.stdout);
        assert!(done.status.success(), "{typed}\n{text}");
        assert!(!printed.is_empty(), "nothing is said to be printed of\n{typed}");
        for line in printed {
            // Numbers and names after a comma may follow.
            assert!(
                text.lines().any(|own| own.starts_with(&line)),
                "{line}\nis not printed by\n{typed}\n{text}"
            );
        }
    }
}
