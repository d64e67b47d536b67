#!/usr/bin/env python3
"""Kills `ncc serve` at random moments while documents and programs are written, and looks for each acknowledged write afterwards.

    python3 service/tests/kill.py BINARY ROUNDS [--full-disk FOLDER]

The database is a file that is made for this, or the empty one that NCC_DATABASE_URL names.

Each round starts the server on the database of the round before. Writers POST, PUT and DELETE documents of their own, a few
names each; others make programs and revisions of them; then the process is sent SIGKILL. After the next start each document
must be the last one that was acknowledged, or the one that was being written when the process ended; its parts must all be of
one document, and its tag theirs. Each program must have all revisions that were acknowledged, in order, and at most the one
more that was being written; each text must have the digest of its revision. Every tenth round begins a job, and at the end
each job must have ended, each of its programs once. Each round begins a job without programs too: a hook must have been told
of the end of each job, by one name each, and of nothing else.

With `--full-disk` a folder on a small file system is filled instead: writes must end with 507, and none that was
acknowledged may be lost, also after a SIGKILL and a start on the full disk.

The exit code is 0 if nothing was lost.
"""

import hashlib
import http.client
import http.server
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time

WRITERS = 6
NAMES = 4
WHOLE = "application/vnd.ncc.document+json"


class Server:
    def __init__(self, binary, database, target=None):
        place = ["--database", database] if database else []
        place += ["--hook-target", target] if target else []
        self.process = subprocess.Popen(
            [binary, "serve", "--listen", "127.0.0.1:0", *place],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        line = self.process.stdout.readline().strip()
        if not line.startswith("http://"):
            sys.exit("the server did not start: " + line + self.process.stderr.read())
        self.port = int(line.rsplit(":", 1)[1])

    def connect(self):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()


class Receiver(http.server.ThreadingHTTPServer):
    """A receiver of hooks; `told` has the names of the messages about each job."""

    def __init__(self):
        super().__init__(("127.0.0.1", 0), Message)
        self.told = {}
        self.target = f"http://127.0.0.1:{self.server_port}/"
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def handle_error(self, request, client_address):
        """A sender that is killed breaks off."""


class Message(http.server.BaseHTTPRequestHandler):
    def do_POST(self):
        body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.server.told.setdefault(body["data"]["job"], set()).add(self.headers["webhook-id"])
        # So that the process is killed while some are being sent.
        time.sleep(random.uniform(0.0, 0.05))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_):
        """Nothing is written."""


def payload(name, mark, blocks):
    """A payload whose blocks all have the mark as their tool."""
    block = {
        "gcode": f"T{mark}", "function_name": "SELECT_TOOL",
        "x0": 0.0, "y0": 0.0, "z0": 0.0, "x1": 0.0, "y1": 0.0, "z1": 0.0,
        "cut_offset": 0, "feed": 0.0, "speed": 0.0, "tool": mark,
        "dx": 0.0, "dy": 0.0, "dz": 0.0, "distance": 0.0, "time": 0.0, "timestamp": 0.0,
        "parameters": {},
    }
    return json.dumps({"prog_name": name, "machine_name": "", "dialect": "mach9", "blocks": [block] * blocks})


def document(name, mark, blocks):
    """A document whose parts all have the mark, and its tag: SHA-256 of its names and parts, each after its length."""
    parts = {
        "after": payload(name, mark, blocks),
        "before": payload(name, mark, 1),
        "cmf": f"SELECT_TOOL({mark})\n" * blocks,
    }
    digest = hashlib.sha256()
    for piece in ["", "mach9"] + [piece for part in sorted(parts) for piece in (part, parts[part])]:
        digest.update(len(piece.encode()).to_bytes(8, "little") + piece.encode())
    return {"machine": "", "dialect": "mach9", "parts": parts}, digest.hexdigest()


class Writer(threading.Thread):
    """Writes documents of its own. `states[name]` are those that may be there: tags, or None for no document."""

    def __init__(self, server, number, states, seed, largest):
        super().__init__()
        self.server, self.number, self.states, self.largest = server, number, states, largest
        self.random = random.Random(seed)
        self.acknowledged = 0
        self.full = 0
        self.wrong = []
        self.stop = False

    def run(self):
        try:
            connection = self.server.connect()
            while not self.stop:
                self.write(connection)
        except (OSError, http.client.HTTPException):
            pass

    def write(self, connection):
        name = f"w{self.number}-{self.random.randrange(NAMES)}"
        there = self.states.get(name, [None])
        blocks = self.random.choice([1, 10, self.largest])
        body, tag = document(name, self.random.randrange(1, 10**6), blocks)
        # Which of two documents is there is not known before it has been asked for: PUT and DELETE need none to be known.
        known = there[0] if len(there) == 1 else "?"
        if known is None:
            method, after, status = "POST", tag, 201
        elif known == "?":
            return self.look(connection, name)
        elif self.random.random() < 0.3:
            method, after, status = "DELETE", None, 204
        else:
            method, after, status = "PUT", tag, 204
        # From here on both may be there, until it is acknowledged.
        self.states[name] = [known, after]
        headers = {} if known is None else {"If-Match": f'"{known}"'}
        if method == "DELETE":
            connection.request(method, f"/persistence/{name}", headers=headers)
        else:
            headers["Content-Type"] = WHOLE
            connection.request(method, f"/persistence/{name}", body=json.dumps(body), headers=headers)
        answer = connection.getresponse()
        text = answer.read()
        if answer.status == status:
            self.states[name] = [after]
            self.acknowledged += 1
        elif answer.status == 507:
            self.states[name] = [known]
            self.full += 1
            time.sleep(0.01)
        else:
            self.wrong.append(f"{method} {name}: {answer.status} {text[:300]}")
            self.states[name] = [known, after]
            self.stop = True

    def look(self, connection, name):
        self.states[name] = [whole(connection, name, self.wrong)]


def whole(connection, name, wrong):
    """The tag of the document under a name, after its parts have been compared with it and each other."""
    connection.request("GET", f"/persistence/{name}?form=whole")
    answer = connection.getresponse()
    text = answer.read()
    if answer.status == 404:
        return None
    if answer.status != 200:
        wrong.append(f"GET {name}: {answer.status} {text[:300]}")
        return "?"
    tag = answer.headers["ETag"].strip('"').split("-")[0]
    parts = json.loads(text)["parts"]
    after = json.loads(parts["after"])
    mark, blocks = after["blocks"][0]["tool"], len(after["blocks"])
    made, expected = document(name, mark, blocks)
    if made["parts"] != parts or expected != tag:
        wrong.append(f"{name} is not whole: mark {mark}, {blocks} blocks, tag {tag}")
    return tag


class Reviser(threading.Thread):
    """Makes programs of its own, and revisions of them.

    `programs[name]` has the `id` of the program, the digests of its `revisions`, and the text that is being `sent`: as a
    revision that may be there.
    """

    def __init__(self, server, number, programs, seed):
        super().__init__()
        self.server, self.number, self.programs = server, number, programs
        self.random = random.Random(seed)
        self.acknowledged = 0
        self.wrong = []

    def run(self):
        try:
            connection = self.server.connect()
            while not self.wrong:
                self.write(connection, f"r{self.number}-{self.random.randrange(NAMES)}.nc")
        except (OSError, http.client.HTTPException):
            pass

    def write(self, connection, name):
        own = self.programs.setdefault(name, {"id": None, "revisions": [], "sent": None})
        if own["sent"] is None:
            blocks = self.random.choice([1, 100, 20_000])
            own["sent"] = f"T1 M6\nG0 X{self.random.randrange(10**6)}\n" + "G1 X1. F100.\n" * blocks
        headers = {"Content-Type": "text/plain"}
        if own["id"] is None:
            # Sent again with its key after a round that broke off, it is done once.
            headers["Idempotency-Key"] = name
            method, path, status = "POST", f"/api/v1/programs?name={name}&folder=kill&dialect=fanuc", 201
        else:
            headers["If-Match"] = f'"{len(own["revisions"])}"'
            method, path, status = "PUT", f"/api/v1/programs/{own['id']}/text", 200
        connection.request(method, path, body=own["sent"], headers=headers)
        answer = connection.getresponse()
        text = answer.read()
        if answer.status != status:
            self.wrong.append(f"{method} {name}: {answer.status} {text[:300]}")
            return
        own["id"] = json.loads(text)["id"]
        own["revisions"].append(digest(own["sent"]))
        own["sent"] = None
        self.acknowledged += 1


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()


def read(connection, path):
    connection.request("GET", path)
    answer = connection.getresponse()
    return answer.status, answer.read()


def compare_programs(server, programs):
    """What is wrong with the programs and their revisions."""
    wrong = []
    connection = server.connect()
    for name, own in sorted(programs.items()):
        if own["id"] is None:
            continue
        path = f"/api/v1/programs/{own['id']}"
        status, text = read(connection, path + "/revisions?limit=1000")
        if status != 200:
            wrong.append(f"{name}: {status} {text[:300]}")
            continue
        rows = list(reversed(json.loads(text)["revisions"]))
        there = [row["sha256"] for row in rows]
        kept = own["revisions"][-len(there):] if len(own["revisions"]) > 1000 else own["revisions"]
        more = [digest(own["sent"])] if own["sent"] is not None else []
        if there != kept and there != (kept + more)[-len(there):]:
            wrong.append(f"{name}: there are {len(there)} revisions, and {len(kept)} were acknowledged")
        elif there != kept:
            own["revisions"] += more
        if [row["revision"] for row in rows] != list(range(rows[0]["revision"], rows[0]["revision"] + len(rows))):
            wrong.append(f"{name}: the revisions do not follow each other")
        last = rows[-1]
        status, text = read(connection, f"{path}/revisions/{last['revision']}/text")
        if status != 200 or hashlib.sha256(text).hexdigest() != last["sha256"]:
            wrong.append(f"{name}: the text of revision {last['revision']} is another one")
        own["sent"] = None
    connection.close()
    return wrong


def begin_job(server, programs):
    """A job over the programs that are there."""
    connection = server.connect()
    ids = [own["id"] for own in programs.values() if own["id"] is not None]
    if not ids:
        return None
    body = json.dumps({"programs": ids, "to": "haas", "assume": True})
    connection.request("POST", "/api/v1/jobs", body=body, headers={"Content-Type": "application/json"})
    answer = connection.getresponse()
    job = json.loads(answer.read())
    connection.close()
    return (job["id"], ids) if answer.status == 202 else None


def compare_jobs(server, jobs):
    """What is wrong with the jobs, after all of them have had time to end."""
    wrong = []
    connection = server.connect()
    until = time.monotonic() + 180
    for job, ids in jobs:
        while True:
            state = json.loads(read(connection, f"/api/v1/jobs/{job}")[1])
            if state["ended"] is not None:
                break
            if time.monotonic() > until:
                wrong.append(f"job {job} has not ended: {state['tasks']}")
                break
            time.sleep(0.2)
        results = json.loads(read(connection, f"/api/v1/jobs/{job}/results?limit=1000")[1])["results"]
        if [row["program"] for row in results] != ids:
            wrong.append(f"job {job} has other programs than it was given")
        if any(row["state"] not in ("done", "refused") for row in results):
            wrong.append(f"job {job}: {state['tasks']}")
    connection.close()
    return wrong


def compare(server, states):
    """What is wrong with what is there."""
    wrong = []
    connection = server.connect()
    for name, may in sorted(states.items()):
        tag = whole(connection, name, wrong)
        if tag not in may:
            wrong.append(f"{name}: there is {tag}, and there may be {may}")
        states[name] = [tag]
    connection.request("GET", "/persistence?limit=1000")
    listed = {row["prog_name"]: row["tag"] for row in json.loads(connection.getresponse().read())["documents"]}
    there = {name: tag for name, [tag] in states.items() if tag is not None}
    if listed != there:
        wrong.append(f"the list has {sorted(listed)}, and there are {sorted(there)}")
    connection.close()
    return wrong


def ask(server, path, asked):
    """The name of the thing that a request makes; none if it is not acknowledged."""
    connection = server.connect()
    connection.request("POST", path, body=json.dumps(asked), headers={"Content-Type": "application/json"})
    answer = connection.getresponse()
    made = json.loads(answer.read())
    connection.close()
    return made["id"] if answer.status in (201, 202) else None


def compare_hooks(server, hook, receiver, jobs):
    """Faults of the messages to a hook, after all of them have had time to be sent."""
    connection = server.connect()
    until = time.monotonic() + 180
    while True:
        page = json.loads(read(connection, f"/api/v1/hooks/{hook}/deliveries?limit=1000")[1])["deliveries"]
        waiting = [row for row in page if row["ended"] is None]
        if not waiting:
            break
        if time.monotonic() > until:
            return [f"the hook waits for {waiting}"]
        time.sleep(0.2)
    wrong = [f"the hook was not told of the job {job}" for job in jobs if job not in receiver.told]
    for job, names in receiver.told.items():
        if len(names) != 1:
            wrong.append(f"the hook was told of the job {job} by {names}")
        if read(connection, f"/api/v1/jobs/{job}")[0] != 200:
            wrong.append(f"the hook was told of the job {job}, which is not there")
    connection.close()
    return wrong


def write_for(server, states, seconds, seed, largest):
    writers = [Writer(server, k, states, seed + k, largest) for k in range(WRITERS)]
    for writer in writers:
        writer.start()
    time.sleep(seconds)
    return writers


def killed(binary, rounds):
    folder = tempfile.TemporaryDirectory()
    database = None if os.environ.get("NCC_DATABASE_URL") else os.path.join(folder.name, "ncc.sqlite")
    states, programs, jobs, acknowledged, revisions, open_writes, wrong = {}, {}, [], 0, 0, 0, []
    chance = random.Random(20230711)
    receiver, hook, ended = Receiver(), None, []
    for k in range(rounds):
        server = Server(binary, database, receiver.target)
        hook = hook or ask(server, "/api/v1/hooks", {"target": receiver.target, "events": ["job"]})
        wrong += [f"round {k}: {words}" for words in compare(server, states) + compare_programs(server, programs)]
        if k % 10 == 9:
            jobs += [job for job in [begin_job(server, programs)] if job]
        revisers = [Reviser(server, n, programs, 1000 + k * 2 + n) for n in range(2)]
        for reviser in revisers:
            reviser.start()
        ended += [job for job in [ask(server, "/api/v1/jobs", {"under": "nothing", "to": "haas"})] if job]
        # Some documents are larger than a piece of the database (1 MiB).
        writers = write_for(server, states, chance.uniform(0.0, 0.4), k * WRITERS, 4000 if k % 10 == 0 else 200)
        server.kill()
        for reviser in revisers:
            reviser.join()
            revisions += reviser.acknowledged
            wrong += [f"round {k}: {words}" for words in reviser.wrong]
        for writer in writers:
            writer.join()
            acknowledged += writer.acknowledged
            wrong += [f"round {k}: {words}" for words in writer.wrong]
        open_writes += sum(len(may) > 1 for may in states.values())
        if wrong:
            break
    server = Server(binary, database, receiver.target)
    wrong += compare(server, states) + compare_programs(server, programs) + compare_jobs(server, jobs)
    wrong += compare_hooks(server, hook, receiver, ended + [job for job, _ in jobs])
    server.kill()
    print(
        f"{k + 1} rounds, {acknowledged} documents and {revisions} revisions acknowledged, {open_writes} documents broken "
        f"off, {len(jobs)} jobs, {len(receiver.told)} ends of jobs told, {len(wrong)} faults"
    )
    return wrong


def full(binary, folder):
    database = os.path.join(folder, "ncc.sqlite")
    states, acknowledged, refused, wrong = {}, 0, 0, []
    for k in range(5):
        server = Server(binary, database)
        wrong += [f"start {k}: {words}" for words in compare(server, states)]
        writers = write_for(server, states, 3, k * WRITERS, 4000)
        for writer in writers:
            writer.stop = True
        for writer in writers:
            writer.join()
            acknowledged += writer.acknowledged
            refused += writer.full
            wrong += [f"start {k}: {words}" for words in writer.wrong]
        wrong += [f"running {k}: {words}" for words in compare(server, states)]
        server.kill()
    print(f"{acknowledged} writes acknowledged, {refused} refused with 507, {len(wrong)} faults")
    if refused == 0:
        wrong.append("the disk was never full: take a smaller one")
    return wrong


def main():
    if len(sys.argv) == 5 and sys.argv[3] == "--full-disk":
        wrong = full(sys.argv[1], sys.argv[4])
    elif len(sys.argv) == 3:
        wrong = killed(sys.argv[1], int(sys.argv[2]))
    else:
        sys.exit(__doc__)
    for words in wrong:
        print(words)
    sys.exit(1 if wrong else 0)


main()
