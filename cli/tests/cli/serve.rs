//! `ncc serve user` and `ncc serve audit`: accounts of a database, without a server.

use super::*;

/// A command with a password from a pipe.
fn with_password(folder: &Path, args: &[&str], password: &str) -> (i32, String) {
    let mut child = Command::new(NCC)
        .args(args)
        .current_dir(folder)
        .env_remove("NCC_DATABASE_URL")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(password.as_bytes()).unwrap();
    let done = child.wait_with_output().unwrap();
    let text = [done.stdout, done.stderr].concat();
    (done.status.code().unwrap_or(-1), String::from_utf8_lossy(&text).into_owned())
}

#[test]
fn accounts_are_made_with_a_password_from_a_pipe() {
    let folder = folder();
    let folder = folder.path();
    let user =
        |args: &[&str], password: &str| with_password(folder, &[&["serve", "user"], args].concat(), password);
    let (code, told) = user(&["add", "ben", "--role", "reader"], "correct horse\n");
    assert!(code == 2 && told.contains("--role admin"), "{told}");
    let (code, told) = user(&["add", "ana", "--role", "admin"], "short\n");
    assert!(code == 2 && told.contains("10 to 1024 bytes"), "{told}");
    assert_eq!(user(&["add", "ana", "--role", "admin"], "correct horse\n"), (0, String::new()));
    assert_eq!(user(&["add", "ben", "--role", "editor", "--folder", "plates"], "correct horse\n").0, 0);
    assert_eq!(user(&["list"], ""), (0, "ana: admin\nben: editor in plates\n".to_owned()));
    // A password is no argument, and a role is one of the roles.
    assert_eq!(user(&["add", "eva", "--role", "admin", "--password", "correct horse"], "").0, 2);
    assert_eq!(user(&["add", "eva", "--role", "king"], "correct horse\n").0, 2);
    assert_eq!(user(&["add", "Eva", "--role", "reader"], "correct horse\n").0, 2);
    let (code, token) = user(&["token", "ben", "--for", "erp", "--scope", "change"], "");
    assert!(code == 0 && token.starts_with("ncc_") && token.trim().len() == 56, "{token}");
    assert_eq!(user(&["disable", "ben"], "").0, 0);
    assert_eq!(user(&["disable", "ana"], "").0, 2);
    assert_eq!(user(&["password", "nobody"], "correct horse\n").0, 2);
    assert_eq!(user(&["list"], "").1, "ana: admin\nben: editor in plates (disabled)\n");
    let (code, told) = with_password(folder, &["serve", "audit"], "");
    assert!(code == 0 && told.starts_with("4 entries, each follows the one before it"), "{told}");
    // Others may not ask without TLS, whatever accounts there are.
    let (code, told) = with_password(folder, &["serve", "--listen", "0.0.0.0:0"], "");
    assert!(code == 2 && told.contains("--tls-cert FILE"), "{told}");
    let alone = ["serve", "--listen", "0.0.0.0:0", "--database", "other.sqlite"];
    let (code, told) = with_password(folder, &alone, "");
    assert!(code == 2 && told.contains("ncc serve user add"), "{told}");
}
