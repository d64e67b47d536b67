-- Jobs: many programs translated, one after the other. A task that runs is its worker's until a moment; then others take it.
CREATE TABLE job (
    id TEXT PRIMARY KEY,
    asked TEXT NOT NULL,
    author TEXT NOT NULL,
    made BIGINT NOT NULL,
    ended BIGINT,
    is_cancelled BOOLEAN NOT NULL DEFAULT FALSE
);
CREATE TABLE task (
    job TEXT NOT NULL REFERENCES job (id),
    number BIGINT NOT NULL,
    made BIGINT NOT NULL,
    program TEXT NOT NULL REFERENCES program (id),
    revision BIGINT NOT NULL,
    state TEXT NOT NULL,
    worker TEXT NOT NULL DEFAULT '',
    until BIGINT NOT NULL DEFAULT 0,
    result TEXT NOT NULL DEFAULT '',
    PRIMARY KEY (job, number)
);
CREATE INDEX task_waiting ON task (made, job, number) WHERE state = 'waiting';
CREATE INDEX task_running ON task (until) WHERE state = 'running';
CREATE INDEX task_open ON task (job) WHERE state IN ('waiting', 'running');
