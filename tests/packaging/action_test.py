#!/usr/bin/env python3
"""The steps of action/action.yml do what they say, run as they stand in the file.

A stand-in for GitHub: inputs and contexts are filled in, files take what steps put out, `curl` and `gh` are scripts that write
down how they were called. The Dockerfile is held to a few rules as well, since nothing here can build it.
"""
import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import tarfile
import tempfile
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent.parent
FAKE_GH = """#!/bin/bash
printf '%s\\n' "$*" >>"$LOG"
case "$*" in
*git/ref/heads*) [ -n "${BRANCH_EXISTS:-}" ] ;;
*"pr comment"*) cp "${@: -1}" "$LOG.comment" ;;
*--jq*) echo 0123abcd ;;
esac
"""
FAKE_CURL = """#!/bin/bash
printf '%s\\n' "$*" >>"$LOG"
cp "$RELEASE/$(basename "${@: -1}")" .
"""
lavalight = None


def indent_of(line):
    return len(line) - len(line.lstrip())


def parse(text):
    """Nested mappings and lists of this file's kind of YAML; `|` texts as they are, all else as words."""
    lines = text.splitlines()

    def block(start, indent):
        """(value, next line) of what begins there at that depth."""
        result, at = None, start
        while at < len(lines):
            line = lines[at]
            if not line.strip() or line.lstrip().startswith("#"):
                at += 1
                continue
            if indent_of(line) < indent:
                break
            if line.lstrip().startswith("- "):
                result = [] if result is None else result
                lines[at] = line.replace("- ", "  ", 1)
                item, at = block(at, indent + 2)
                result.append(item)
                continue
            result = {} if result is None else result
            key, _, value = line.strip().partition(":")
            value = value.strip()
            at += 1
            if value == "|":
                end = at
                while end < len(lines) and (not lines[end].strip() or indent_of(lines[end]) > indent):
                    end += 1
                depth = indent_of(lines[at])
                result[key], at = "\n".join(line[depth:] for line in lines[at:end]).rstrip() + "\n", end
            elif value:
                result[key] = value.strip('"')
            else:
                result[key], at = block(at, indent + 1 if at >= len(lines) else max(indent + 1, indent_of(lines[at])))
        return result, at

    return block(0, 0)[0]


ACTION = parse((REPOSITORY / "action/action.yml").read_text(encoding="utf-8"))


def step_named(name):
    return next(step for step in ACTION["runs"]["steps"] if step["name"] == name)


class Action(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="action-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.outputs, self.path = {}, []
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        for tool, text in {"gh": FAKE_GH, "curl": FAKE_CURL}.items():
            (self.bin / tool).write_text(text, encoding="utf-8")
            (self.bin / tool).chmod(0o755)
        (self.bin / "lavalight").symlink_to(lavalight)
        (self.folder / "temp").mkdir()
        shutil.copy(REPOSITORY / "assets/cornell-box.gltf", self.folder / "a model.gltf")
        self.inputs = {name: fields.get("default", "") for name, fields in ACTION["inputs"].items()}
        self.inputs |= {"model": "a model.gltf", "size": "32x32", "spp": "32", "token": "secret", "repository": "owner/lavalight"}
        self.environment = {"LOG": str(self.folder / "log")}

    def filled(self, text):
        contexts = {"github.event.number": "7", "github.run_id": "55", "github.run_attempt": "1",
                    "steps.compare.outputs.equal": self.outputs.get("equal", "")}
        contexts |= {f"inputs.{name}": value for name, value in self.inputs.items()}
        return re.sub(r"\$\{\{ (\S+) \}\}", lambda match: contexts[match[1]], text)

    def run_step(self, name):
        step = step_named(name)
        self.assertEqual(step["shell"], "bash", name)
        self.assertNotIn("${{", step["run"], "inputs come by the environment: their text is never part of the script")
        output, path = self.folder / "output", self.folder / "path"
        for file in (output, path):
            file.write_text("", encoding="utf-8")
        environment = {key: value for key, value in os.environ.items() if key != "GH_TOKEN"} | self.environment
        environment |= {key: self.filled(value) for key, value in step.get("env", {}).items()}
        environment |= {"GITHUB_OUTPUT": str(output), "GITHUB_PATH": str(path), "RUNNER_TEMP": str(self.folder / "temp"),
                        "GITHUB_REPOSITORY": "owner/models", "GITHUB_SERVER_URL": "https://github.com",
                        "PATH": ":".join([*self.path, str(self.bin), os.environ["PATH"]])}
        script = self.folder / "step.sh"
        script.write_text(step["run"], encoding="utf-8")
        # The command that GitHub documents for `shell: bash`.
        done = subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", script], cwd=self.folder, env=environment,
                              capture_output=True, text=True, check=False)
        self.outputs |= dict(line.split("=", 1) for line in output.read_text(encoding="utf-8").splitlines())
        self.path += path.read_text(encoding="utf-8").split()
        return done

    def succeed(self, name):
        done = self.run_step(name)
        self.assertEqual(done.returncode, 0, f"{name}: {done.stdout}{done.stderr}")
        return done

    def make_golden(self, scene):
        self.inputs["golden"] = "golden.exr"
        subprocess.run([lavalight, "render", scene, "--size", "32x32", "--spp", "64", "--seed", "1", "--quiet", "-o",
                        self.folder / "golden.exr"], check=True)

    def log(self):
        return (self.folder / "log").read_text(encoding="utf-8")

    def test_installed_program_is_taken_as_it_is(self):
        self.assertIn("lavalight ", self.succeed("Install Lavalight").stdout)
        self.assertFalse((self.folder / "log").exists())

    def release(self):
        """A release with a program that only says hello; none is installed."""
        (self.bin / "lavalight").unlink()
        release = self.folder / "release"
        name = f"lavalight-{self.inputs['version']}-linux-x86_64"
        program = release / name / "bin/lavalight"
        program.parent.mkdir(parents=True)
        program.write_text("#!/bin/sh\necho hello\n", encoding="utf-8")
        program.chmod(0o755)
        tarball = release / f"{name}.tar.gz"
        with tarfile.open(tarball, "w:gz") as archive:
            archive.add(release / name, name)
        digest = hashlib.sha256(tarball.read_bytes()).hexdigest()
        (release / "SHA256SUMS").write_text(f"{digest}  {tarball.name}\n", encoding="utf-8")
        self.environment["RELEASE"] = str(release)
        return tarball, digest

    def test_release_is_fetched_checked_and_put_into_the_path(self):
        tarball, _ = self.release()
        self.succeed("Install Lavalight")
        self.assertIn(f"https://github.com/owner/lavalight/releases/download/v{self.inputs['version']}/{tarball.name}", self.log())
        self.assertEqual(subprocess.run([f"{self.path[0]}/lavalight"], check=True, capture_output=True, text=True).stdout, "hello\n")

    def test_release_with_other_bits_is_refused(self):
        tarball, digest = self.release()
        (tarball.parent / "SHA256SUMS").write_text(f"{'0' * 64}  {tarball.name}\n", encoding="utf-8")
        self.assertNotEqual(self.run_step("Install Lavalight").returncode, 0)
        self.inputs["sha256"] = digest[::-1]
        self.assertNotEqual(self.run_step("Install Lavalight").returncode, 0)
        self.assertEqual(self.path, [])

    def test_equal_picture_passes(self):
        self.make_golden("cornell-box")
        self.inputs["arguments"] = "--max-bounces 64 --mis power"
        self.succeed("Render")
        self.succeed("Compare")
        self.assertEqual(self.outputs["equal"], "true")
        for name in ("render.exr", "render.png", "render.json", "report.html", "heatmap.png", "verdict.txt"):
            self.assertTrue((self.folder / "lavalight-out" / name).stat().st_size > 0, name)
        report = json.loads((self.folder / "lavalight-out/render.json").read_text(encoding="utf-8"))
        self.assertEqual((report["settings"]["seed"], report["settings"]["spp"]), ("2", "32"))

    def test_another_picture_is_told_after_the_report_is_kept(self):
        self.make_golden("cornell-glass")
        self.succeed("Render")
        self.succeed("Compare")
        self.assertEqual(self.outputs["equal"], "false")
        self.assertNotEqual(self.run_step("Fail where the picture differs").returncode, 0)
        names = [step["name"] for step in ACTION["runs"]["steps"]]
        self.assertLess(names.index("Keep pictures and report"), names.index("Fail where the picture differs"))

    def test_missing_golden_image_or_model_fails(self):
        self.succeed("Render")
        self.inputs["golden"] = "missing.exr"
        self.assertEqual(self.run_step("Compare").returncode, 3)
        self.inputs["model"] = "missing.gltf"
        self.assertNotEqual(self.run_step("Render").returncode, 0)

    def test_input_is_never_a_command(self):
        self.inputs["model"] = "$(touch made).gltf; touch made"
        self.assertNotEqual(self.run_step("Render").returncode, 0)
        self.assertFalse((self.folder / "made").exists())

    def test_comment_shows_picture_verdict_and_where_it_differs(self):
        self.make_golden("cornell-glass")
        self.succeed("Render")
        self.succeed("Compare")
        self.succeed("Comment")
        comment = (self.folder / "log.comment").read_text(encoding="utf-8")
        address = "https://github.com/owner/models/raw/lavalight-pictures/7/55-1-lavalight"
        self.assertIn(f"![The render]({address}-render.png)", comment)
        self.assertIn(f"![Where it differs]({address}-heatmap.png)", comment)
        self.assertIn("**differs from its golden image**", comment)
        self.assertIn((self.folder / "lavalight-out/verdict.txt").read_text(encoding="utf-8").strip(), comment)
        self.assertEqual(self.log().count("refs/heads/lavalight-pictures"), 1)
        self.assertIn("contents/7/55-1-lavalight-render.png", self.log())

    def test_comment_without_golden_image_makes_the_branch_once(self):
        self.environment["BRANCH_EXISTS"] = "yes"
        self.succeed("Render")
        self.succeed("Comment")
        self.assertNotIn("git/refs", self.log())
        comment = (self.folder / "log.comment").read_text(encoding="utf-8")
        self.assertNotIn("heatmap", comment)

    def test_version_is_that_of_the_program(self):
        said = subprocess.run([lavalight, "--version"], check=True, capture_output=True, text=True).stdout
        self.assertEqual(said.split()[1], ACTION["inputs"]["version"]["default"])

    def test_yaml_is_read_as_others_read_it(self):
        try:
            import yaml
        except ImportError:
            self.skipTest("PyYAML is not installed")
        theirs = yaml.safe_load((REPOSITORY / "action/action.yml").read_text(encoding="utf-8"))
        self.assertEqual(theirs["runs"]["steps"], ACTION["runs"]["steps"])
        for name, fields in theirs["inputs"].items():
            self.assertEqual(fields.get("default"), ACTION["inputs"][name].get("default"), name)


class Dockerfile(unittest.TestCase):
    text = re.sub(r"\\\n\s*", "", (REPOSITORY / "Dockerfile").read_text(encoding="utf-8"))
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]

    def test_base_is_pinned(self):
        bases = {line.split()[1] for line in self.lines if line.startswith("FROM ")}
        bases = {line.partition("=")[2] for line in self.lines if line.startswith("ARG BASE=")} | (bases - {"${BASE}"})
        for base in bases:
            self.assertRegex(base, r"^debian:trixie-\d{8}-slim$|@sha256:[0-9a-f]{64}$")

    def test_apt_brings_nothing_that_is_only_recommended_and_leaves_no_lists(self):
        installs = [line for line in self.lines if re.search(r"apt-get install|RUN tools/setup", line)]
        self.assertEqual(len(installs), 2)
        for line in installs:
            self.assertTrue("--no-install-recommends" in line or "tools/setup" in line, line)
            self.assertIn("rm -rf /var/lib/apt/lists/*", line)
        self.assertIn("--no-install-recommends", (REPOSITORY / "tools/setup").read_text(encoding="utf-8"))

    def test_what_is_left_out_is_told_to_dpkg_before_it_installs(self):
        copied = next(index for index, line in enumerate(self.lines) if line.startswith("COPY packaging/container_excludes"))
        installed = next(index for index, line in enumerate(self.lines) if "apt-get install" in line)
        self.assertLess(copied, installed)
        self.assertTrue((REPOSITORY / "packaging/container_excludes").exists())

    def test_command_is_a_list_and_nothing_is_added_from_afar(self):
        self.assertIn('ENTRYPOINT ["lavalight"]', self.lines)
        for line in self.lines:
            self.assertNotRegex(line, r"^ADD |curl|wget|sudo|:latest")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lavalight", type=Path, required=True)
    arguments = parser.parse_args()
    lavalight = arguments.lavalight.resolve()
    unittest.main(argv=["action_test"])
