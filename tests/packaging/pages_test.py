#!/usr/bin/env python3
"""Man pages and completions of a build know every subcommand, every option and every choice that --help tells.

Reads --help by rules of its own, and asks bash itself what it would complete; zsh and fish too, where they are installed.
"""
import argparse
import re
import shutil
import subprocess
import unittest
from pathlib import Path

arguments = None


def help_of(*command):
    return subprocess.run([arguments.lavalight, *command, "--help"], check=True, capture_output=True, text=True).stdout


def subcommands(*command):
    _, _, below = help_of(*command).partition("Subcommands:\n")
    return re.findall(r"^  ([a-z-]+) ", below, re.MULTILINE)


def options(*command):
    found = re.findall(r"^  ((?:-\w,)?--[a-z-]+|-\w)(?= |$)", help_of(*command), re.MULTILINE)
    return {name for names in found for name in names.split(",")}


def all_commands():
    top = subcommands()
    return [()] + [(name,) for name in top] + [(name, below) for name in top for below in subcommands(name)]


def bash_offers(*words):
    """What bash completes of these words, the last of which is being typed."""
    script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _lavalight; printf "%s\\n" "${COMPREPLY[@]}"'
    page = arguments.pages / "lavalight"
    return set(subprocess.run(["bash", "-c", script, "bash", page, "lavalight", *words], check=True, capture_output=True,
                              text=True).stdout.split())


class Pages(unittest.TestCase):
    def test_there_are_many_commands_and_options(self):
        self.assertGreater(len(all_commands()), 10)
        self.assertGreater(len(options("render")), 50)

    def test_each_command_has_a_man_page_with_its_options(self):
        for command in all_commands():
            page = (arguments.pages / f"{'-'.join(['lavalight', *command])}.1").read_text(encoding="utf-8").replace("\\-", "-")
            for option in options(*command):
                self.assertIn(f"\\fB{option}\\fR", page, command)

    def test_man_pages_are_of_no_command_that_is_gone(self):
        expected = {"-".join(["lavalight", *command]) for command in all_commands()}
        self.assertEqual({page.stem for page in arguments.pages.glob("*.1")}, expected)

    def test_man_finds_no_fault_in_them(self):
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        for page in arguments.pages.glob("*.1"):
            said = subprocess.run(["groff", "-man", "-ww", "-z", "-Tutf8", page], capture_output=True, text=True, check=True).stderr
            self.assertEqual(said, "", page.name)

    def test_bash_completes_every_option(self):
        for command in all_commands():
            self.assertEqual(bash_offers(*command, "-"), options(*command), command)

    def test_bash_completes_subcommands(self):
        self.assertEqual(bash_offers(""), set(subcommands()))
        self.assertEqual(bash_offers("bench", ""), set(subcommands("bench")))

    def test_bash_completes_choices(self):
        self.assertEqual(bash_offers("render", "box.gltf", "--mis", ""), {"power", "balance", "off"})
        self.assertEqual(bash_offers("render", "--tonemap", "a"), {"agx", "aces"})

    def test_zsh_knows_every_option(self):
        page = (arguments.pages / "_lavalight").read_text(encoding="utf-8")
        bodies = dict(re.findall(r"^(_lavalight\w*)\(\) \{\n(.*?)^\}", page, re.MULTILINE | re.DOTALL))
        for command in all_commands():
            body = bodies["_".join(["_lavalight", *command]).replace("-", "_")]
            for option in options(*command):
                self.assertRegex(body, rf"[')]{re.escape(option)}\[", command)
        if shutil.which("zsh"):
            subprocess.run(["zsh", "-n", arguments.pages / "_lavalight"], check=True)

    def test_fish_knows_every_option(self):
        lines = (arguments.pages / "lavalight.fish").read_text(encoding="utf-8").splitlines()
        for command in all_commands():
            wanted = "; and ".join(f"__fish_seen_subcommand_from {word}" for word in command)
            mine = [line for line in lines if f'-n "{wanted}" ' in line or (not command and "__fish_use_subcommand " in line)]
            for option in options(*command):
                short = f" -l {option[2:]} " if option.startswith("--") else f" -s {option[1:]} "
                self.assertTrue(any(short in line for line in mine), (command, option))
        if shutil.which("fish"):
            subprocess.run(["fish", "--no-execute", arguments.pages / "lavalight.fish"], check=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lavalight", type=Path, required=True)
    parser.add_argument("--pages", type=Path, required=True)
    arguments = parser.parse_args()
    unittest.main(argv=["pages_test"])
