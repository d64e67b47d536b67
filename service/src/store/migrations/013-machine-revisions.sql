-- Every state of a profile, so that none is overwritten. An empty text is the end of the machine of this name.
CREATE TABLE machine_revision (
    name TEXT NOT NULL,
    number BIGINT NOT NULL,
    text TEXT NOT NULL,
    tag TEXT NOT NULL,
    author TEXT NOT NULL,
    made BIGINT NOT NULL,
    PRIMARY KEY (name, number)
);
-- Profiles that are here already have their first revision; who kept it was not noted with them.
INSERT INTO machine_revision (name, number, text, tag, author, made) SELECT name, 1, text, tag, '', changed FROM machine;
