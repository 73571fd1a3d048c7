"""The commands of examples/github-actions/thumbnails.yml do what the file says, in a repository with a remote."""

import hashlib
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import tarfile
import unittest

from program import MODELS, PROGRAM, ProgramTest
from program import contract_quickly as setUpModule

WORKFLOW = MODELS.parent / "examples/github-actions/thumbnails.yml"
NO_COMMIT = "0" * 40


@unittest.skipIf(importlib.util.find_spec("yaml") is None, "NOTHING WAS TESTED: python3-yaml is not installed")
@unittest.skipIf(shutil.which("git") is None or shutil.which("curl") is None, "NOTHING WAS TESTED: git or curl is not installed")
class Thumbnails(ProgramTest):

    def setUp(self):
        super().setUp()
        import yaml
        self.workflow = yaml.safe_load(WORKFLOW.read_text(encoding="utf-8"))
        self.steps = self.workflow["jobs"]["thumbnails"]["steps"]
        self.env = {**os.environ, "HOME": str(self.dir), "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1",
                    "RUNNER_TEMP": str(self.dir / "temp"), "GITHUB_PATH": str(self.dir / "paths")}
        (self.dir / "temp").mkdir()
        with tarfile.open(self.dir / "release.tar.gz", "w:gz") as release:
            release.add(PROGRAM, "vantage-0.1.0-linux-x86_64/bin/vantage")
        self.env["VANTAGE_URL"] = (self.dir / "release.tar.gz").as_uri()
        self.env["VANTAGE_SHA256"] = hashlib.sha256((self.dir / "release.tar.gz").read_bytes()).hexdigest()
        self.repository = self.dir / "repository"
        subprocess.run(["git", "init", "-q", "--bare", "-b", "main", self.dir / "remote"], check=True, env=self.env)
        subprocess.run(["git", "clone", "-q", self.dir / "remote", self.repository], check=True, env=self.env,
                       stderr=subprocess.DEVNULL)
        self.git("checkout", "-q", "-b", "main")

    def git(self, *arguments):
        return subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@localhost", *arguments], check=True,
                              cwd=self.repository, env=self.env, capture_output=True, text=True).stdout.strip()

    def push(self, message):
        self.git("add", "--all")
        self.git("commit", "-q", "-m", message)
        self.git("push", "-q", "origin", "main")
        return self.git("rev-parse", "HEAD")

    def run_steps(self, before):
        """Runs every command as the runner does: bash, ended by the first failure, paths of a step in the next."""
        said = ""
        for step in self.steps:
            if "run" not in step:
                continue
            added = pathlib.Path(self.env["GITHUB_PATH"])
            paths = added.read_text(encoding="utf-8").split() if added.exists() else []
            done = subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]],
                                  cwd=self.repository, env={**self.env, "BEFORE": before,
                                                            "PATH": ":".join([*paths, self.env["PATH"]])},
                                  capture_output=True, text=True, timeout=300, check=False)
            said += done.stdout
            self.assertEqual(done.returncode, 0, f"{step['name']}: {done.stderr}")
        return said

    def thumbnails(self):
        return self.git("ls-tree", "-r", "-z", "--name-only", "origin/main", "thumbnails").strip("\0").split("\0")

    def test_a_push_makes_changes_and_removes_thumbnails(self):
        folder = self.repository / "parts of a fan"
        folder.mkdir()
        shutil.copy(MODELS / "fan.ply", folder / "fan.PLY")
        shutil.copy(MODELS / "cat_lowpoly.ply", self.repository / "-cat.ply")
        (self.repository / "broken.stl").write_text("solid nothing\n")
        (self.repository / "notes.txt").write_text("no model\n")
        first = self.push("first")
        said = self.run_steps(NO_COMMIT)
        self.assertIn("::warning::no thumbnail of broken.stl", said)
        self.assertIn("1 models have no thumbnail", said)
        self.assertEqual(self.thumbnails(), ["thumbnails/-cat.ply.png", "thumbnails/parts of a fan/fan.PLY.png"])

        # Only what the push changed is rendered again.
        cat = self.repository / "thumbnails/-cat.ply.png"
        before = self.git("rev-parse", "HEAD")
        self.assertNotEqual(before, first)
        self.git("rm", "-q", "parts of a fan/fan.PLY")
        shutil.copy(MODELS / "deer.ply", self.repository / "deer.ply")
        cat.write_bytes(b"left alone")
        self.push("second")
        self.run_steps(before)
        self.assertEqual(self.thumbnails(), ["thumbnails/-cat.ply.png", "thumbnails/deer.ply.png"])
        self.assertEqual(cat.read_bytes(), b"left alone")
        self.assertTrue((self.repository / "thumbnails/deer.ply.png").read_bytes().startswith(b"\x89PNG"))

        # A push without models leaves no commit.
        (self.repository / "notes.txt").write_text("other words\n")
        before, after = self.git("rev-parse", "HEAD"), self.push("third")
        self.run_steps(before)
        self.assertEqual(self.git("rev-parse", "origin/main"), after)

    def test_another_release_than_the_one_trusted_is_not_unpacked(self):
        self.env["VANTAGE_SHA256"] = "0" * 64
        (self.repository / "a").write_text("a")
        self.push("first")
        with self.assertRaisesRegex(AssertionError, "Install Vantage"):
            self.run_steps(NO_COMMIT)
        self.assertFalse((self.dir / "temp/vantage").exists())

    def test_actions_are_githubs_own_and_named_by_their_commit(self):
        used = [step["uses"] for step in self.steps if "uses" in step]
        for action in used:
            self.assertTrue(re.fullmatch(r"actions/[a-z-]+@[0-9a-f]{40}", action), action)
        self.assertEqual(len(used), 1)

    def test_nothing_that_others_write_is_pasted_into_a_command(self):
        for step in self.steps:
            self.assertNotIn("${{", step.get("run", ""))


if __name__ == "__main__":
    unittest.main()
