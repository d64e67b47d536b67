//! Jobs and their tasks.
//!
//! A task is claimed by a worker for a while. If the worker does not end it by then, as after a crash, another one claims it.
//! Only its worker can end it, so each task ends once. A job may be read by whoever may read all of its programs.

use std::collections::BTreeMap;

use super::documents::now;
use super::hooks::events::job_ended;
use super::programs::holds_in;
use super::session::{Row, Session, values};
use super::{Store, StoreError};
use crate::rights::{Act, Role};

/// A job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Job {
    /// Its name.
    pub(crate) id: String,
    /// The request for each program, JSON.
    pub(crate) asked: String,
    /// Whose it is.
    pub(crate) author: String,
    /// When it was made, seconds since 1970 (UTC).
    pub(crate) made: i64,
    /// When its last task ended.
    pub(crate) ended: Option<i64>,
    /// Whether it was cancelled.
    pub(crate) is_cancelled: bool,
    /// Number of tasks by state.
    pub(crate) counts: BTreeMap<String, i64>,
}

/// The end of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// The program was translated.
    Done,
    /// It was refused.
    Refused,
    /// The job was cancelled.
    Cancelled,
}

impl End {
    const fn name(self) -> &'static str {
        match self {
            End::Done => "done",
            End::Refused => "refused",
            End::Cancelled => "cancelled",
        }
    }
}

/// A task that a worker has claimed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Task {
    /// Its job.
    pub(crate) job: String,
    /// Counted from 1.
    pub(crate) number: i64,
    /// The program.
    pub(crate) program: String,
    /// The revision.
    pub(crate) revision: i64,
    /// The request, JSON.
    pub(crate) asked: String,
    /// Whose job it is.
    pub(crate) author: String,
}

/// A task with its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TaskResult {
    /// Counted from 1.
    pub(crate) number: i64,
    /// The program.
    pub(crate) program: String,
    /// Its folder and name in the revision.
    pub(crate) place: [String; 2],
    /// The revision.
    pub(crate) revision: i64,
    /// `waiting`, `running`, `done`, `refused`, `cancelled`.
    pub(crate) state: String,
    /// The result, JSON; empty until the task ends.
    pub(crate) result: String,
}

impl Store {
    /// Number of tasks by state, of all jobs.
    pub(crate) fn tasks_by_state(&self) -> Result<Vec<(String, i64)>, StoreError> {
        self.database.read(|from| {
            from.read("SELECT state, COUNT(*) FROM task GROUP BY state", values![], |mut row| {
                Ok((row.text(0)?, row.int(1)?))
            })
        })
    }

    /// Keeps a job with a task for each program, in order.
    pub(crate) fn create_job(
        &self,
        id: &str,
        asked: &str,
        author: &str,
        programs: &[(String, i64)],
    ) -> Result<(), StoreError> {
        self.database.write(|to| {
            let made = now();
            to.change(
                "INSERT INTO job (id, asked, author, made, ended) VALUES ($1, $2, $3, $4, $5)",
                values![id, asked, author, made, programs.is_empty().then_some(made)],
            )?;
            for (number, (program, revision)) in programs.iter().enumerate() {
                self.may_with(to, program, Act::Change)?;
                to.change(
                    "INSERT INTO task (job, number, made, program, revision, state) VALUES ($1, $2, $3, $4, $5, 'waiting')",
                    values![id, number as i64 + 1, made, program, *revision],
                )?;
            }
            self.note(to, "job.create", id, &format!("{} programs", programs.len()))?;
            if programs.is_empty() { job_ended(to, id) } else { Ok(()) }
        })
    }

    /// Claims the next task for a worker, for so many seconds.
    pub(crate) fn claim(&self, worker: &str, seconds: i64) -> Result<Option<Task>, StoreError> {
        // Most of the time there is none, and nobody waits for the writer.
        let is_open = self.database.read(|from| {
            let waits =
                from.maybe_row("SELECT number FROM task WHERE state = 'waiting' LIMIT 1", values![])?;
            let left = "SELECT number FROM task WHERE state = 'running' AND until < $1 LIMIT 1";
            Ok(waits.is_some() || from.maybe_row(left, values![now()])?.is_some())
        })?;
        if !is_open {
            return Ok(None);
        }
        self.database.write(|to| {
            let time = now();
            // A task of a cancelled job does not wait, but a worker that has died may have left one.
            let left = to.read(
                "UPDATE task SET state = 'cancelled' WHERE state = 'running' AND until < $1
                 AND job IN (SELECT id FROM job WHERE is_cancelled) RETURNING job",
                values![time],
                |mut row| row.text(0),
            )?;
            left.iter().try_for_each(|job| end_job(to, job))?;
            let claim = |one: &str| {
                let sql = format!(
                    "UPDATE task SET state = 'running', worker = $1, until = $2 WHERE (job, number) IN (
                         SELECT job, number FROM task WHERE {one} LIMIT 1)
                     RETURNING job, number, program, revision"
                );
                to.maybe_row(&sql, values![worker, time + seconds, time])
            };
            let claimed = match claim("state = 'running' AND until < $3 ORDER BY until")? {
                Some(row) => Some(row),
                None => claim("state = 'waiting' ORDER BY made, job, number")?,
            };
            let Some(mut row) = claimed else { return Ok(None) };
            let job = row.text(0)?;
            let mut of = to.row("SELECT asked, author FROM job WHERE id = $1", values![&job])?;
            Ok(Some(Task {
                job,
                number: row.int(1)?,
                program: row.text(2)?,
                revision: row.int(3)?,
                asked: of.text(0)?,
                author: of.text(1)?,
            }))
        })
    }

    /// Ends a task of a worker; whether it was still the worker's.
    pub(crate) fn end_task(
        &self,
        worker: &str,
        task: &Task,
        end: End,
        result: &str,
    ) -> Result<bool, StoreError> {
        self.database.write(|to| {
            let ended = to.change(
                "UPDATE task SET state = $4, result = $5 WHERE job = $1 AND number = $2 AND worker = $3 AND state = 'running'",
                values![&task.job, task.number, worker, end.name(), result],
            )?;
            end_job(to, &task.job)?;
            Ok(ended == 1)
        })
    }

    /// Gives a task back that a worker has not ended.
    pub(crate) fn give_back(&self, worker: &str, task: &Task) -> Result<(), StoreError> {
        self.database.write(|to| {
            to.change(
                "UPDATE task SET state = 'waiting' WHERE job = $1 AND number = $2 AND worker = $3 AND state = 'running'",
                values![&task.job, task.number, worker],
            )?;
            Ok(())
        })
    }

    /// Cancels a job: no further task of it begins.
    pub(crate) fn cancel(&self, id: &str) -> Result<(), StoreError> {
        self.database.write(|to| {
            self.may_with_job(to, id, Act::Change)?;
            self.note(to, "job.cancel", id, "")?;
            to.change("UPDATE job SET is_cancelled = TRUE WHERE id = $1 AND ended IS NULL", values![id])?;
            to.change(
                "UPDATE task SET state = 'cancelled' WHERE job = $1 AND state = 'waiting'
                 AND job IN (SELECT id FROM job WHERE is_cancelled)",
                values![id],
            )?;
            end_job(to, id)
        })
    }

    /// A job.
    pub(crate) fn job(&self, id: &str) -> Result<Job, StoreError> {
        self.database.read(|from| {
            self.may_with_job(from, id, Act::Read)?;
            let sql = "SELECT id, asked, author, made, ended, is_cancelled FROM job WHERE id = $1";
            let mut job = read(from.row(sql, values![id])?)?;
            count(from, &mut job)?;
            Ok(job)
        })
    }

    /// Jobs, the newest first, so many at most; those before one.
    pub(crate) fn jobs(&self, before: Option<&str>, most: u32) -> Result<Vec<Job>, StoreError> {
        self.database.read(|from| {
            // Of a job without programs, its author alone may know.
            let sql = format!(
                "SELECT id, asked, author, made, ended, is_cancelled FROM job
                 WHERE (CAST($1 AS TEXT) IS NULL OR (made, id) < (SELECT made, id FROM job WHERE id = $1))
                   AND (CAST($3 AS TEXT) IS NULL
                        OR (author = $3 OR EXISTS (SELECT 1 FROM task t WHERE t.job = job.id))
                           AND NOT EXISTS (SELECT 1 FROM task t JOIN program p ON p.id = t.program
                                           WHERE t.job = job.id AND NOT {}))
                 ORDER BY made DESC, id DESC LIMIT $2",
                holds_in("p.folder", "$3", "$4")
            );
            let rank = Role::of(Act::Read).rank();
            let mut jobs = from.read(&sql, values![before, most, self.reader(), rank], read)?;
            jobs.iter_mut().try_for_each(|job| count(from, job))?;
            Ok(jobs)
        })
    }

    /// Tasks of a job with their results, after a number, `most` at most.
    pub(crate) fn results(&self, id: &str, after: i64, most: u32) -> Result<Vec<TaskResult>, StoreError> {
        self.database.read(|from| {
            self.may_with_job(from, id, Act::Read)?;
            let result = |mut row: Row| {
                Ok(TaskResult {
                    number: row.int(0)?,
                    program: row.text(1)?,
                    place: [row.text(2)?, row.text(3)?],
                    revision: row.int(4)?,
                    state: row.text(5)?,
                    result: row.text(6)?,
                })
            };
            from.read(
                "SELECT t.number, t.program, r.folder, r.name, t.revision, t.state, t.result FROM task t
                 JOIN revision r ON r.program = t.program AND r.number = t.revision
                 WHERE t.job = $1 AND t.number > $2 ORDER BY t.number LIMIT $3",
                values![id, after, most],
                result,
            )
        })
    }
}

impl Store {
    /// The user may do something with all programs of a job.
    fn may_with_job(&self, from: &dyn Session, id: &str, act: Act) -> Result<(), StoreError> {
        let author = from.row("SELECT author FROM job WHERE id = $1", values![id])?.text(0)?;
        let folders = from.read(
            "SELECT DISTINCT p.folder FROM task t JOIN program p ON p.id = t.program WHERE t.job = $1",
            values![id],
            |mut row| row.text(0),
        )?;
        if folders.is_empty() && author != self.who.name {
            return self.may(act, "");
        }
        // One that may not be read is worse than one that may not be changed.
        folders.iter().try_for_each(|folder| self.may(Act::Read, folder))?;
        folders.iter().try_for_each(|folder| self.may(act, folder))
    }
}

fn read(mut row: Row) -> Result<Job, StoreError> {
    Ok(Job {
        id: row.text(0)?,
        asked: row.text(1)?,
        author: row.text(2)?,
        made: row.int(3)?,
        ended: row.maybe_int(4)?,
        is_cancelled: row.is(5)?,
        counts: BTreeMap::new(),
    })
}

fn count(from: &dyn Session, job: &mut Job) -> Result<(), StoreError> {
    let counts = from.read(
        "SELECT state, count(*) FROM task WHERE job = $1 GROUP BY state",
        values![&job.id],
        |mut row| Ok((row.text(0)?, row.int(1)?)),
    )?;
    job.counts = counts.into_iter().collect();
    Ok(())
}

/// Marks a job as ended where no task of it is left. Only the first one who does so changes a row, so hooks are told once.
fn end_job(to: &dyn Session, id: &str) -> Result<(), StoreError> {
    let ended = to.change(
        "UPDATE job SET ended = $2 WHERE id = $1 AND ended IS NULL
         AND NOT EXISTS (SELECT 1 FROM task WHERE job = $1 AND state IN ('waiting', 'running'))",
        values![id, now()],
    )?;
    if ended == 1 { job_ended(to, id) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::super::contents::Receiving;
    use super::super::programs::{Details, Said};
    use super::*;

    fn store(programs: usize) -> (tempfile::TempDir, Store) {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store::open(&super::super::Place::File(folder.path().join("a.sqlite"))).expect("a store");
        let all: Vec<(String, i64)> = (0..programs).map(|n| (format!("p{n}"), 1)).collect();
        for (id, _) in &all {
            let details = Details { name: id.clone(), ..Details::default() };
            store
                .create_program(id, &details, Receiving::default(), &Said::default(), None)
                .expect("a program");
        }
        store.create_job("j", "{}", "ana", &all).expect("a job");
        (folder, store)
    }

    fn counts(store: &Store) -> Vec<(String, i64)> {
        store.job("j").expect("a job").counts.into_iter().collect()
    }

    #[test]
    fn a_task_of_a_worker_that_has_died_is_done_by_another_once() {
        let (_folder, store) = store(1);
        // Its time is over before it begins.
        let first = store.claim("dead", -1).expect("a store").expect("a task");
        let second = store.claim("alive", 60).expect("a store").expect("the task again");
        assert_eq!(first, second);
        assert_eq!(store.claim("third", 60).expect("a store"), None);
        assert!(!store.end_task("dead", &first, End::Done, "late").expect("a store"));
        assert!(store.end_task("alive", &second, End::Done, "first").expect("a store"));
        assert!(!store.end_task("alive", &second, End::Done, "again").expect("a store"));
        let results = store.results("j", 0, 10).expect("results");
        assert_eq!((results[0].state.as_str(), results[0].result.as_str()), ("done", "first"));
        assert!(store.job("j").expect("a job").ended.is_some());
    }

    #[test]
    fn a_cancelled_job_begins_no_task() {
        let (_folder, store) = store(3);
        let running = store.claim("a", 60).expect("a store").expect("a task");
        let left = store.claim("dead", -1).expect("a store").expect("a task");
        assert_ne!(running.number, left.number);
        store.cancel("j").expect("a store");
        assert_eq!(counts(&store), [("cancelled".to_owned(), 1), ("running".to_owned(), 2)]);
        // The one of a dead worker is swept away when another one looks for work.
        assert_eq!(store.claim("b", 60).expect("a store"), None);
        assert_eq!(counts(&store), [("cancelled".to_owned(), 2), ("running".to_owned(), 1)]);
        assert!(store.job("j").expect("a job").ended.is_none());
        assert!(store.end_task("a", &running, End::Done, "").expect("a store"));
        assert!(store.job("j").expect("a job").ended.is_some());
    }

    #[test]
    fn a_task_that_is_given_back_waits() {
        let (_folder, store) = store(1);
        let task = store.claim("a", 60).expect("a store").expect("a task");
        store.give_back("b", &task).expect("a store");
        assert_eq!(counts(&store), [("running".to_owned(), 1)]);
        store.give_back("a", &task).expect("a store");
        assert_eq!(counts(&store), [("waiting".to_owned(), 1)]);
    }

    #[test]
    fn a_job_without_programs_is_over() {
        let (_folder, store) = store(0);
        assert!(store.job("j").expect("a job").ended.is_some());
    }
}
