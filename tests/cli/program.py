"""Runs the vantage program named by the environment variable VANTAGE, in a folder of its own."""

import os
import pathlib
import subprocess
import tempfile
import unittest
import unittest.mock

PROGRAM = os.environ["VANTAGE"]
MODELS = pathlib.Path(__file__).resolve().parents[2] / "models"


def contract_quickly():
    """The setUpModule of suites that are about files and pictures: models of a few large faces are contracted as they
    are, where refining them first would take longer than all else."""
    quick = unittest.mock.patch.dict(os.environ, VANTAGE_CONTRACTION="exact")
    quick.start()
    unittest.addModuleCleanup(quick.stop)


class ProgramTest(unittest.TestCase):
    """A test with a scratch folder, self.dir, removed at the end."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.dir = pathlib.Path(scratch.name)

    def vantage(self, *arguments, exit_code=0, stdin=None):
        """Runs the program in self.dir and checks its exit code; None: any will do."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.dir, input=stdin,
                              capture_output=True, timeout=300, check=False)
        if exit_code is not None:
            self.assertEqual(done.returncode, exit_code,
                             f"{arguments}: stderr: {done.stderr.decode(errors='replace')}")
        done.out = done.stdout.decode()
        done.err = done.stderr.decode(errors="replace")
        return done

    def write(self, name, content):
        """Writes a file into the scratch folder and returns its path."""
        path = self.dir / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path


def read_ply(path):
    """Header properties and vertices of a binary little-endian PLY of ours; faces as triples."""
    import struct
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    codes = {"float": "f", "double": "d", "uchar": "B"}
    properties, vertices, faces, element = [], 0, 0, ""
    for line in head.decode().splitlines():
        word = line.split()
        if word[0] == "element":
            element = word[1]
            vertices, faces = (int(word[2]), faces) if element == "vertex" else (vertices, int(word[2]))
        elif word[0] == "property" and element == "vertex":
            properties.append((word[2], codes[word[1]]))
    row = struct.Struct("<" + "".join(code for _, code in properties))
    names = [name for name, _ in properties]
    table = [dict(zip(names, row.unpack_from(body, i * row.size))) for i in range(vertices)]
    rest = body[vertices * row.size:]
    triangles = []
    for i in range(faces):
        count, a, b, c = struct.unpack_from("<B3i", rest, i * 13)
        assert count == 3
        triangles.append((a, b, c))
    return names, table, triangles
