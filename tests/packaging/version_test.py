#!/usr/bin/env python3
"""cmake/version.cmake tells the commit of a checkout, whether it was changed, and nothing where git is not about it."""
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent.parent.parent / "cmake/version.cmake"


@unittest.skipUnless(shutil.which("git"), "git is not installed")
class Version(unittest.TestCase):
    def setUp(self):
        work = tempfile.TemporaryDirectory()
        self.addCleanup(work.cleanup)
        self.source = Path(work.name).resolve() / "source"
        self.out = self.source.parent / "values.cpp"
        (self.source / "below").mkdir(parents=True)
        (self.source / "file").write_text("first", encoding="utf-8")
        self.git("init", "--quiet")
        self.git("add", ".")
        self.git("commit", "--quiet", "--message", "first")

    def git(self, *words):
        who = ("-c", "user.name=Someone", "-c", "user.email=someone@example.org")
        return subprocess.run(["git", *who, *words], cwd=self.source, check=True, capture_output=True, text=True).stdout.strip()

    def commit_of(self, folder, commit=""):
        subprocess.run(["cmake", f"-DOUT={self.out}", f"-DSOURCE={folder}", "-DVERSION=1.2.3", f"-DCOMMIT={commit}", "-P", SCRIPT],
                       check=True)
        text = self.out.read_text(encoding="utf-8")
        self.assertIn('kVersion = "1.2.3"', text)
        return re.search(r'kCommit = "(.*)"', text)[1]

    def test_commit_is_heads_and_a_change_makes_it_dirty(self):
        head = self.git("rev-parse", "--short=12", "HEAD")
        self.git("tag", "--annotate", "--message", "tag", "v1")
        self.assertEqual(self.commit_of(self.source), head)
        (self.source / "file").write_text("changed", encoding="utf-8")
        self.assertEqual(self.commit_of(self.source), f"{head}-dirty")

    def test_repository_around_an_archive_is_not_asked(self):
        self.assertEqual(self.commit_of(self.source / "below"), "")

    def test_archive_says_the_commit_that_its_file_has(self):
        (self.source / "below/COMMIT").write_text("0123456789ab\n", encoding="utf-8")
        self.assertEqual(self.commit_of(self.source / "below"), "0123456789ab")

    def test_checkout_is_asked_whatever_a_file_says(self):
        (self.source / "COMMIT").write_text("0123456789ab\n", encoding="utf-8")
        self.assertEqual(self.commit_of(self.source), self.git("rev-parse", "--short=12", "HEAD"))

    def test_commit_that_is_given_stands(self):
        self.assertEqual(self.commit_of(self.source, "abc"), "abc")

    def test_values_that_are_the_same_are_not_written_again(self):
        self.commit_of(self.source)
        before = self.out.stat().st_mtime_ns
        self.commit_of(self.source)
        self.assertEqual(self.out.stat().st_mtime_ns, before)


if __name__ == "__main__":
    unittest.main()
