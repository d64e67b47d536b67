-- Accounts. Of passwords, sessions and tokens only digests are here.
CREATE TABLE account (
    name TEXT PRIMARY KEY,
    password TEXT NOT NULL,
    is_disabled BOOLEAN NOT NULL,
    made BIGINT NOT NULL
);
-- Roles by folder; the empty folder is everything. Ranks: 1 reader, 2 editor, 3 reviewer, 4 releaser, 5 admin.
CREATE TABLE account_right (
    account TEXT NOT NULL REFERENCES account (name),
    folder TEXT NOT NULL,
    rank BIGINT NOT NULL,
    PRIMARY KEY (account, folder)
);
-- Rights that hold now: a disabled account has none.
CREATE VIEW holding AS
    SELECT r.account, r.folder, r.rank FROM account_right r
    JOIN account a ON a.name = r.account WHERE NOT a.is_disabled;
CREATE TABLE login (
    digest TEXT PRIMARY KEY,
    account TEXT NOT NULL REFERENCES account (name),
    made BIGINT NOT NULL,
    seen BIGINT NOT NULL
);
CREATE INDEX login_account ON login (account);
CREATE TABLE token (
    id TEXT PRIMARY KEY,
    digest TEXT NOT NULL UNIQUE,
    account TEXT NOT NULL REFERENCES account (name),
    name TEXT NOT NULL,
    scopes TEXT NOT NULL,
    made BIGINT NOT NULL,
    expires BIGINT NOT NULL
);
CREATE INDEX token_account ON token (account, id);
