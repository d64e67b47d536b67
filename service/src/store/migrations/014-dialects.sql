-- Dictionaries of the shop's dialects, by their names, and every state of each: an empty text is the end of the dialect of this name.
CREATE TABLE dialect (name TEXT PRIMARY KEY, text TEXT NOT NULL, tag TEXT NOT NULL, changed BIGINT NOT NULL);
CREATE TABLE dialect_revision (
    name TEXT NOT NULL,
    number BIGINT NOT NULL,
    text TEXT NOT NULL,
    tag TEXT NOT NULL,
    author TEXT NOT NULL,
    made BIGINT NOT NULL,
    PRIMARY KEY (name, number)
);
