"""Every public header compiles alone: the first include of its own source file is the header, or it is compiled here."""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def first_include(source):
    found = re.search(r'^#include ["<]([^">]+)[">]', source.read_text(encoding="utf-8"), re.MULTILINE)
    return found.group(1) if found else None


def compile_alone(header):
    return subprocess.run(
        [os.environ.get("CXX", "c++"), "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-x", "c++",
         "-I", ROOT / "include", "-isystem", "/usr/include/eigen3", "-"],
        input=f'#include "{header}"\n#include "{header}"\n', capture_output=True, text=True, check=False)


class Headers(unittest.TestCase):

    def test_every_public_header_compiles_alone(self):
        headers = {str(path.relative_to(ROOT / "include")) for path in (ROOT / "include").rglob("*.h")}
        self.assertGreater(len(headers), 50)
        proven = {first_include(source) for source in (ROOT / "src").rglob("*.cpp")}
        left = sorted(headers - proven)
        self.assertGreater(len(left), 0)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for header, done in zip(left, pool.map(compile_alone, left)):
                self.assertEqual(done.returncode, 0, f"{header}\n{done.stderr}")

    def test_a_header_that_lacks_an_include_would_be_caught(self):
        self.assertNotEqual(compile_alone("nowhere.h").returncode, 0)


if __name__ == "__main__":
    unittest.main()
