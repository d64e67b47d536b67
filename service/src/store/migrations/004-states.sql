-- States of translations: what each has gone through, in order. None is ever changed.
CREATE TABLE state (
    translation TEXT NOT NULL REFERENCES translation (id),
    number BIGINT NOT NULL,
    state TEXT NOT NULL,
    author TEXT NOT NULL,
    message TEXT NOT NULL,
    made BIGINT NOT NULL,
    PRIMARY KEY (translation, number)
);
-- The state in which each is now; `target` is what it was translated for.
ALTER TABLE translation ADD COLUMN state TEXT NOT NULL DEFAULT 'draft';
ALTER TABLE translation ADD COLUMN target TEXT NOT NULL DEFAULT '';
CREATE UNIQUE INDEX released ON translation (program, target) WHERE state = 'released';
