-- Contents by their digests, in pieces. One without a digest is being received.
CREATE TABLE content (
    id INTEGER PRIMARY KEY,
    sha256 TEXT UNIQUE,
    bytes BIGINT NOT NULL,
    begun BIGINT NOT NULL
);
CREATE TABLE content_piece (
    content BIGINT NOT NULL REFERENCES content (id) ON DELETE CASCADE,
    number BIGINT NOT NULL,
    bytes BLOB NOT NULL,
    PRIMARY KEY (content, number)
);
-- Programs where they are now. Their history is in their revisions, of which none is ever changed.
CREATE TABLE program (
    id TEXT PRIMARY KEY,
    folder TEXT NOT NULL,
    name TEXT NOT NULL,
    head BIGINT NOT NULL,
    is_deleted BOOLEAN NOT NULL
);
CREATE UNIQUE INDEX program_place ON program (folder, name) WHERE NOT is_deleted;
CREATE INDEX program_order ON program (folder, name, id);
CREATE TABLE program_tag (
    program TEXT NOT NULL REFERENCES program (id),
    tag TEXT NOT NULL,
    PRIMARY KEY (tag, program)
);
CREATE TABLE revision (
    program TEXT NOT NULL REFERENCES program (id),
    number BIGINT NOT NULL,
    content BIGINT NOT NULL REFERENCES content (id),
    folder TEXT NOT NULL,
    name TEXT NOT NULL,
    dialect TEXT NOT NULL,
    machine TEXT NOT NULL,
    tags TEXT NOT NULL,
    change TEXT NOT NULL,
    author TEXT NOT NULL,
    message TEXT NOT NULL,
    made BIGINT NOT NULL,
    PRIMARY KEY (program, number)
);
-- Requests that may be sent again without being done again.
CREATE TABLE idempotency (
    key TEXT PRIMARY KEY,
    request TEXT NOT NULL,
    program TEXT NOT NULL,
    number BIGINT NOT NULL,
    made BIGINT NOT NULL
);
