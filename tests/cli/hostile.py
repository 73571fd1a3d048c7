"""What tests of hostile inputs of `vantage batch` share."""

import json
import sqlite3
import struct

from program import PROGRAM, ProgramTest
from shapes import box

FAST = ["--search", "rapid", "--write", "json", "--jobs", "2"]
TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def gltf(*uris):
    return json.dumps({
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": uri} for uri in uris]})


class HostileTest(ProgramTest):

    def setUp(self):
        super().setUp()
        self.victim = self.dir / "victim"
        self.victim.mkdir()
        (self.victim / "thesis.txt").write_text("mine")
        (self.victim / "local").mkdir()
        (self.victim / "local" / "notes.txt").write_text("mine")
        self.before = self.state_of(self.victim)

    @staticmethod
    def state_of(folder):
        return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None for p in folder.rglob("*")}

    def assert_untouched(self):
        self.assertEqual(self.state_of(self.victim), self.before)

    def batch(self, *arguments, exit_code=0, out="out", **more):
        return self.vantage("batch", *arguments, "-o", out, *FAST, exit_code=exit_code, **more)

    def rows(self, out="out"):
        text = self.vantage("results", "export", out, "--format", "jsonl").out
        return {row["key"]: row for row in map(json.loads, text.splitlines())}

    def change_store(self, sql, out="out"):
        with sqlite3.connect(self.dir / out / "results.sqlite") as store:
            store.executescript(sql)
        store.close()
