-- The case study's documents: a name, and the parts that were put in under it, in pieces.
CREATE TABLE document (
    id INTEGER PRIMARY KEY,
    name TEXT NOT NULL UNIQUE,
    machine TEXT NOT NULL,
    dialect TEXT NOT NULL,
    tag TEXT NOT NULL,
    changed BIGINT NOT NULL
);
CREATE TABLE document_piece (
    document BIGINT NOT NULL REFERENCES document (id) ON DELETE CASCADE,
    part TEXT NOT NULL,
    number BIGINT NOT NULL,
    bytes BLOB NOT NULL,
    PRIMARY KEY (document, part, number)
);
-- Profiles of machines, as their owners wrote them.
CREATE TABLE machine (
    name TEXT PRIMARY KEY,
    text TEXT NOT NULL,
    tag TEXT NOT NULL,
    changed BIGINT NOT NULL
);
