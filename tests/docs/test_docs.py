"""The pages and help texts hold: commands run, code compiles, links lead somewhere."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("VANTAGE", "")
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
LAB_PAGES = sorted((ROOT / "docs/lab").glob("*.md"))
OTHER_PAGES = [ROOT / name for name in ("SECURITY.md", "CONTRIBUTING.md", "THIRD_PARTY.md", "CHANGELOG.md",
                                        "models/SOURCES.md", "examples/engines/README.md", "viewer/README.md")]
# What a reader puts in for the words in capitals.
STANDS_FOR = {"MODEL": "horse.ply", "MODEL...": "horse.ply", "FILE": "out.png", "DIR1": "results",
              "DIR2": "results2", "DIR…": "results",
              "DIR": "results", "MODELS": "models", "INPUT…": "models", "SAMPLE": "models", "ALL": "all",
              "PART1": "results", "PART2": "results2", "A": "results", "B": "results2", "SIZE": "64"}
# What changes the machine (completion), does not end (serve), or needs a data set of people (eval) or a cluster is not run
# here; each has a test of its own elsewhere.
ELSEWHERE = re.compile(r"/etc/|fpath|~/|vantage serve|vantage eval|slurm|--shard|--manifest (FILE|-)"
                       r"|view horse.ply --preset paper")
COMMANDS_ELSEWHERE = {"completion", "eval", "serve"}


def commands_of_pages():
    for page in PAGES:
        for line in re.findall(r"^ {4}((?:vantage|jq) .*)$", page.read_text(encoding="utf-8"), re.MULTILINE):
            yield page.name, re.split(r"  +|  #", line)[0]


def help_of(*command):
    return subprocess.run([PROGRAM, *command, "--help"], capture_output=True, check=True, text=True).stdout


def commands_of_program(*above):
    """Every command, as the program lists them: view, results query, …"""
    listed = re.findall(r"^ {2}(\w\S*) ", help_of(*above).partition("\nSubcommands:\n")[2].partition("\n\n")[0], re.MULTILINE)
    if not listed:
        yield " ".join(above)
    for name in listed:
        yield from commands_of_program(*above, name)


def commands_of_help():
    for command in commands_of_program():
        for line in re.findall(r"^ {2}(.*vantage .*)$", help_of(*command.split()).partition("Examples:")[2], re.MULTILINE):
            yield f"{command} --help", line


def filled_in(command):
    if command.startswith("jq "):
        return command if shutil.which("jq") else "true"
    command = re.sub(r" \[[^]]*\]", "", command)
    return " ".join(STANDS_FOR.get(word, word) for word in command.split(" "))


class Commands(unittest.TestCase):
    """Runs them in one folder that holds what they name, a small model under each name."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.dir = pathlib.Path(scratch.name)
        small = ROOT / "models/cat_lowpoly.ply"
        for name in ("horse.ply", "model.ply", "scan.ply", "a.ply", "models/cat.ply", "b/cat.ply"):
            (cls.dir / name).parent.mkdir(exist_ok=True)
            shutil.copy(small, cls.dir / name)
        shutil.copy(ROOT / "models/fan.ply", cls.dir / "models")
        corners = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
        faces = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
        facets = "".join("facet normal 0 0 0\nouter loop\n" +
                         "".join("vertex %g %g %g\n" % corners[i] for i in face) + "endloop\nendfacet\n"
                         for face in faces)
        (cls.dir / "part.stl").write_text(f"solid part\n{facets}endsolid part\n")
        scene = "".join(f"o {name}\n" + "".join("v %g %g %g\n" % (x + shift, y, z) for x, y, z in corners) +
                        "".join("f %d %d %d\n" % tuple(i + 1 + first for i in face) for face in faces)
                        for name, shift, first in (("lamp", 0, 0), ("table", 3, 4)))
        (cls.dir / "scene.obj").write_text(scene)
        (cls.dir / "room.obj").write_text(scene)
        (cls.dir / "views.csv").write_text("dx,dy,dz\n1,0,0\n0,1,1\n")
        (cls.dir / "cameras.csv").write_text("x,y,z\n5,5,5\n")
        (cls.dir / "people/views").mkdir(parents=True)
        for other in ("results2", "all"):
            subprocess.run([PROGRAM, "batch", "models", "-o", other, "--write", "json", "-q"], cwd=cls.dir, check=True)

    def run_all(self, commands):
        folder = self.dir / "bin"
        folder.mkdir(exist_ok=True)
        if not (folder / "vantage").exists():
            (folder / "vantage").symlink_to(PROGRAM)
        env = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}",
               # small pictures: what counts here is that the words are right
               "VANTAGE_SIZE": "48", "VANTAGE_TOUR_SIZE": "48", "VANTAGE_FPS": "2"}
        count = 0
        for where, command in commands:
            if ELSEWHERE.search(command):
                continue
            count += 1
            # Two examples write it, and the program replaces no model that bears no mark of it.
            (self.dir / "upright.obj").unlink(missing_ok=True)
            with self.subTest(where=where, command=command):
                done = subprocess.run(["bash", "-o", "pipefail", "-c", filled_in(command)], cwd=self.dir, env=env,
                                      capture_output=True, check=False, text=True, timeout=300)
                self.assertEqual(done.returncode, 0, done.stderr)
        return count

    def test_commands_of_pages_and_help_run(self):
        # collections first: later commands ask them
        first = [("README.md", "vantage batch models/ -o results"), ("docs", "vantage batch models -o sample --jobs 1")]
        every = dict.fromkeys(command for _, command in [*commands_of_pages(), *commands_of_help()])
        self.assertGreater(self.run_all(first + [("", command) for command in every]), 30)

    def test_help_shows_an_example_for_every_command(self):
        every = set(commands_of_program())
        self.assertLessEqual({"view", "orient", "serve", "results verify"}, every)  # the list was read
        shown = [(where.removesuffix(" --help"), line) for where, line in commands_of_help()]
        self.assertEqual({command for command, _ in shown}, every)
        run = {command for command, line in shown if not ELSEWHERE.search(line)}
        self.assertEqual(every - run, COMMANDS_ELSEWHERE)


def anchors_of(page):
    """As web pages of repositories name headings, and as Doxygen is told to."""
    text = page.read_text(encoding="utf-8")
    heads = re.findall(r"^#+ +(.*?)(?: *\{#([\w-]+)\})?$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head, _ in heads} | {name for _, name in heads}


class Pages(unittest.TestCase):

    def test_links_and_file_names_lead_somewhere(self):
        for page in PAGES + OTHER_PAGES + LAB_PAGES:
            text = page.read_text(encoding="utf-8")
            for target, anchor in re.findall(r"\]\(([^)#]*)#?([^)]*)\)", text):
                if re.match(r"[a-z]+:", target):
                    continue
                file = page.parent / target if target else page
                self.assertTrue(file.exists(), f"{page.name}: {target}")
                if anchor:
                    self.assertIn(anchor, anchors_of(file), f"{page.name}: {target}#{anchor}")
            if page in LAB_PAGES:
                continue  # they name files of their time
            for name in re.findall(r"`((?:docs|scripts|models|examples|bench|tests|src|include)/[a-z0-9_./-]+)`", text):
                self.assertTrue((ROOT / name).exists(), f"{page.name}: {name}")

    def test_programs_of_pages_can_be_run(self):
        found = set()
        for page in PAGES + OTHER_PAGES:
            found |= {(page.name, name) for name in re.findall(
                r"(?:^ {4}(?:[A-Z_]+=\S+ )*|`)((?:scripts|bench)/[a-z0-9_./-]+\.(?:sh|py))\b",
                page.read_text(encoding="utf-8"), re.MULTILINE)}
        self.assertGreater(len(found), 10)
        for page, name in sorted(found):
            self.assertTrue(os.access(ROOT / name, os.X_OK), f"{page}: {name} cannot be run")

    def test_promises_name_tests_that_are_there(self):
        sources = "".join(path.read_text(encoding="utf-8", errors="replace")
                          for path in (ROOT / "tests").rglob("*.*") if path.suffix in (".cpp", ".py"))
        named = 0
        for page in (ROOT / "SECURITY.md", ROOT / "docs/security.md"):
            for suite, test in re.findall(r"`(\w+)\.([A-Z]\w+)\*?`", page.read_text(encoding="utf-8")):
                named += 1
                self.assertRegex(sources, rf"TEST(_[FP])?\({suite}\w*,\s*{test}", page.name)
            for script in re.findall(r"`cli\.(test_\w+)", page.read_text(encoding="utf-8")):
                named += 1
                self.assertTrue((ROOT / f"tests/cli/{script}.py").exists(), script)
        self.assertGreater(named, 20)

    def test_code_compiles(self):
        blocks = 0
        for page in PAGES:
            for code in re.findall(r"^```cpp\n(.*?)^```", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
                if "#include" not in code:
                    continue
                blocks += 1
                done = subprocess.run(["c++", "-std=c++20", "-fsyntax-only", "-x", "c++", "-I", ROOT / "include",
                                       "-isystem", "/usr/include/eigen3", "-"],
                                      input=code, capture_output=True, check=False, text=True)
                self.assertEqual(done.returncode, 0, f"{page.name}:\n{code}\n{done.stderr}")
        self.assertGreater(blocks, 0)

    def test_every_page_is_reached_from_the_readme(self):
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        linked = set(re.findall(r"\]\(docs/([\w/-]+\.md)", readme))
        self.assertEqual({page.name for page in PAGES[1:]} - linked, set())
        self.assertIn("lab/README.md", linked)

    def test_the_manual_has_at_most_twenty_thousand_words(self):
        words = {page.name: len(page.read_text(encoding="utf-8").split()) for page in PAGES}
        self.assertLessEqual(sum(words.values()), 20000, words)

    def test_the_laboratory_lists_its_pages_each_with_date_and_commit(self):
        index = (ROOT / "docs/lab/README.md").read_text(encoding="utf-8")
        listed = re.findall(r"\]\((\d{4}-\d\d-[\w-]+\.md)\)", index)
        self.assertEqual(sorted(listed), [page.name for page in LAB_PAGES if page.name != "README.md"])
        for name in listed:
            head = (ROOT / "docs/lab" / name).read_text(encoding="utf-8").split("\n")[2]
            self.assertRegex(head, r"^Laboratory page of [A-Z]\w+ \d{4}, commit [0-9a-f]{7,}\. ", name)

    def test_the_page_of_what_people_take_names_what_its_table_holds(self):
        table = (ROOT / "src/choice/choice_table.txt").read_text(encoding="utf-8")
        page = (ROOT / "docs/people.md").read_text(encoding="utf-8")
        views = len(re.findall(r"^view ", table, re.MULTILINE))
        self.assertIn(f"{views} models ", page)
        for constant in ("habit", "significance", "bandwidth", "mirror"):
            value = re.search(rf"^{constant} (\S+)$", table, re.MULTILINE)[1]
            self.assertIn(f" = {value}", page, constant)


if __name__ == "__main__":
    unittest.main()
