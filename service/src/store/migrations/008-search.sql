-- Facts of programs as they are now: a row for each that is not deleted. `turn` goes up with each change of what the facts depend
-- on, and `done` is the turn that they are of. Lengths are in micrometres, times in milliseconds.
CREATE TABLE fact (
    id INTEGER PRIMARY KEY,
    program TEXT NOT NULL UNIQUE REFERENCES program (id),
    folder TEXT NOT NULL,
    name TEXT NOT NULL,
    machine TEXT NOT NULL,
    turn BIGINT NOT NULL DEFAULT 1,
    done BIGINT NOT NULL DEFAULT 0,
    since BIGINT NOT NULL,
    worker TEXT NOT NULL DEFAULT '',
    until BIGINT NOT NULL DEFAULT 0,
    tries BIGINT NOT NULL DEFAULT 0,
    ncc TEXT NOT NULL DEFAULT '',
    inputs TEXT NOT NULL DEFAULT '',
    document TEXT NOT NULL DEFAULT '',
    ms BIGINT,
    x_min BIGINT,
    x_max BIGINT,
    y_min BIGINT,
    y_max BIGINT,
    z_min BIGINT,
    z_max BIGINT,
    x_span BIGINT,
    y_span BIGINT,
    z_span BIGINT
);
CREATE INDEX fact_order ON fact (folder, name, program);
CREATE INDEX fact_machine ON fact (machine);
CREATE INDEX fact_waiting ON fact (since, id) WHERE done < turn;
CREATE INDEX fact_ms ON fact (ms);
CREATE INDEX fact_x_min ON fact (x_min);
CREATE INDEX fact_x_max ON fact (x_max);
CREATE INDEX fact_y_min ON fact (y_min);
CREATE INDEX fact_y_max ON fact (y_max);
CREATE INDEX fact_z_min ON fact (z_min);
CREATE INDEX fact_z_max ON fact (z_max);
CREATE INDEX fact_x_span ON fact (x_span);
CREATE INDEX fact_y_span ON fact (y_span);
CREATE INDEX fact_z_span ON fact (z_span);
-- Terms by which programs are found: words, codes, tools, tags. `place` is the first byte of the line, less than 0 of a term that
-- is in no line.
CREATE TABLE term (
    term TEXT NOT NULL,
    fact BIGINT NOT NULL REFERENCES fact (id) ON DELETE CASCADE,
    line BIGINT NOT NULL,
    place BIGINT NOT NULL,
    PRIMARY KEY (term, fact)
) WITHOUT ROWID;
CREATE INDEX term_fact ON term (fact, term);
-- Programs that are here already wait for their facts.
INSERT INTO fact (program, folder, name, machine, since)
SELECT p.id, p.folder, p.name, r.machine, r.made FROM program p JOIN revision r ON r.program = p.id AND r.number = p.head
WHERE NOT p.is_deleted;
