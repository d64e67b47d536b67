-- Each revision compared with the one before it, for the list of revisions. `state` is waiting, equal, different or
-- not-compared; `line` says it in words, and is empty while it waits.
CREATE TABLE comparison (
    program TEXT NOT NULL REFERENCES program (id),
    number BIGINT NOT NULL,
    state TEXT NOT NULL DEFAULT 'waiting',
    line TEXT NOT NULL DEFAULT '',
    since BIGINT NOT NULL,
    worker TEXT NOT NULL DEFAULT '',
    until BIGINT NOT NULL DEFAULT 0,
    tries BIGINT NOT NULL DEFAULT 0,
    PRIMARY KEY (program, number)
);
CREATE INDEX comparison_waiting ON comparison (since, program, number) WHERE state = 'waiting';
-- Revisions that are here already wait for theirs.
INSERT INTO comparison (program, number, since) SELECT program, number, made FROM revision WHERE number > 1;
