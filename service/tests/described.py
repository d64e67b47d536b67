#!/usr/bin/env python3
"""Requests made of the server's own description of its addresses (OpenAPI), by schemathesis.

    described.py NCC SCHEMATHESIS [EXAMPLES]

Starts NCC with a database of its own, puts a program, a translation and a job into it, and has SCHEMATHESIS make EXAMPLES
(5) requests and more for each address: none may end in a fault, each answer has the form that is described, and what the
description forbids is refused. Exit status: that of SCHEMATHESIS.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import urllib.request

# The target of hooks: nobody listens there.
TARGET = "http://127.0.0.1:9/"

PROGRAM = b"T1M6\nS1000M3\nG0X1.Y2.Z3.\nG1X10.F100\nM5\n"

# A description cannot state that a text is a program (422), that a tag is the one that was read (412), that a name has at
# most 255 bytes, that a moment or a position can be read (400).
CONFIG = """
[checks.positive_data_acceptance]
expected-statuses = ["2xx", "3xx", "400", "401", "403", "404", "409", "412", "422"]

[[operations]]
include-path-regex = "^/api/v1/programs/"
parameters = { "path.id" = "PROGRAM", "path.number" = 1 }

[[operations]]
include-path-regex = "^/api/v1/translations/"
parameters = { "path.id" = "TRANSLATION" }

[[operations]]
include-path-regex = "^/api/v1/jobs/"
parameters = { "path.id" = "JOB" }

[[operations]]
include-path-regex = "^/api/v1/hooks/"
parameters = { "path.id" = "HOOK" }

[[operations]]
include-path-regex = "^/(transpiler|persistence|output)/"
include-method = "GET"
parameters = { "path.name" = "a.cn" }

[[operations]]
include-path = "/api/v1/machines/{name}"
include-method = "GET"
parameters = { "path.name" = "romi-discovery-4022" }

[[operations]]
include-path-regex = "^/api/v1/dialects/"
include-method = "GET"
parameters = { "path.name" = "shop", "path.number" = 1 }
"""

DICTIONARY = b'id = "shop"\ntitle = "A shop\'s"\nbase = "fanuc"\n'

# A dictionary is a text: schemathesis has no idea of TOML.
HOOKS = """import schemathesis

schemathesis.serializer.alias("application/toml", "text/plain")
"""


def send(method, address, body, media):
    request = urllib.request.Request(address, data=body, headers={"Content-Type": media}, method=method)
    with urllib.request.urlopen(request, timeout=30) as answer:
        return answer.read()


def post(address, body, media):
    return json.loads(send("POST", address, body, media))


def things(address):
    """The configuration, with the names of things that are there."""
    program = post(f"{address}/api/v1/programs?name=a.cn&folder=plates&dialect=mach9", PROGRAM, "text/plain")["id"]
    asked = {"program": program, "to": "fanuc"}
    translation = post(f"{address}/api/v1/translations", json.dumps(asked).encode(), "application/json")["id"]
    asked = {"programs": [program], "to": "haas"}
    job = post(f"{address}/api/v1/jobs", json.dumps(asked).encode(), "application/json")["id"]
    post(f"{address}/transpiler/a.cn?dialect=mach9", PROGRAM, "text/plain")
    send("PUT", f"{address}/api/v1/dialects/shop", DICTIONARY, "application/toml")
    asked = {"target": TARGET, "events": ["job"]}
    hook = post(f"{address}/api/v1/hooks", json.dumps(asked).encode(), "application/json")["id"]
    names = {"PROGRAM": program, "TRANSLATION": translation, "JOB": job, "HOOK": hook}
    config = CONFIG
    for word, name in names.items():
        config = config.replace(word, name)
    return config


def main():
    ncc, schemathesis, *examples = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        server = subprocess.Popen(
            [ncc, "serve", "--listen", "127.0.0.1:0", "--database", str(folder / "ncc.sqlite"), "--hook-target", TARGET],
            stdout=subprocess.PIPE, text=True)
        try:
            address = server.stdout.readline().strip()
            config = folder / "schemathesis.toml"
            (folder / "hooks.py").write_text(HOOKS)
            config.write_text('hooks = "hooks.py"\n' + things(address))
            begin = time.monotonic()
            done = subprocess.run(
                [schemathesis, "--config-file", str(config), "run", f"{address}/api/v1/openapi.json",
                 "--phases", "examples,coverage,fuzzing", "--max-examples", examples[0] if examples else "5",
                 "--seed", "1", "--no-color"],
                cwd=folder, capture_output=True, text=True)
            if done.returncode:
                print(done.stdout, done.stderr)
            cases = [line.strip() for line in done.stdout.splitlines() if re.match(r"\s*\d+ generated", line)]
            print(f"{' '.join(cases)}, in {time.monotonic() - begin:.0f} s")
            if server.poll() is not None:
                sys.exit("the server has ended")
            sys.exit(done.returncode)
        finally:
            server.kill()


main()
