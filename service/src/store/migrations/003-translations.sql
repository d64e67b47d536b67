-- Translations of programs: what went in, and what came out.
CREATE TABLE translation (
    id TEXT PRIMARY KEY,
    key TEXT NOT NULL,
    program TEXT NOT NULL REFERENCES program (id),
    revision BIGINT NOT NULL,
    asked TEXT NOT NULL,
    inputs TEXT NOT NULL,
    output BIGINT NOT NULL REFERENCES content (id),
    report BIGINT NOT NULL REFERENCES content (id),
    map BIGINT NOT NULL REFERENCES content (id),
    certificate BIGINT REFERENCES content (id),
    author TEXT NOT NULL,
    made BIGINT NOT NULL
);
CREATE INDEX translation_key ON translation (key);
CREATE INDEX translation_program ON translation (program, made);
