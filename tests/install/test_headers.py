"""Every public header compiles alone, twice in a row, and is installed for somebody: an example includes its folder."""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def compile_alone(header):
    return subprocess.run(
        [os.environ.get("CXX", "c++"), "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-x", "c++",
         "-I", ROOT / "include", "-isystem", "/usr/include/eigen3", "-"],
        input=f'#include "{header}"\n#include "{header}"\n', capture_output=True, text=True, check=False)


class Headers(unittest.TestCase):

    def test_every_public_header_compiles_alone(self):
        headers = sorted(str(path.relative_to(ROOT / "include")) for path in (ROOT / "include").rglob("*.h"))
        self.assertGreater(len(headers), 30)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for header, done in zip(headers, pool.map(compile_alone, headers)):
                self.assertEqual(done.returncode, 0, f"{header}\n{done.stderr}")

    def test_every_module_has_an_example(self):
        modules = {path.name for path in (ROOT / "include/vantage").iterdir() if path.is_dir()}
        text = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "examples").glob("*.cpp"))
        self.assertEqual(modules - set(re.findall(r'#include "vantage/(\w+)/', text)), set())

    def test_a_header_that_lacks_an_include_would_be_caught(self):
        self.assertNotEqual(compile_alone("nowhere.h").returncode, 0)


if __name__ == "__main__":
    unittest.main()
