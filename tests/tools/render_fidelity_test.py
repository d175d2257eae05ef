#!/usr/bin/env python3
"""Tests tools/render_fidelity: where the camera stands, what the picture and its metadata are, how it fails."""
import json
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
LAVALIGHT = Path(sys.argv.pop(1)).resolve()
TONE = ["--tonemap", "aces", "--exposure", "0.7369655941662062"]


def tool(*words, folder=None):
    return subprocess.run([str(word) for word in (REPOSITORY / "tools/render_fidelity", *words, "--lavalight", LAVALIGHT,
                                                  "--spp", 1)], capture_output=True, text=True, check=False, cwd=folder)


def scenario(**changes):
    return {"name": "box", "model": "../Models/Box/glTF/box.gltf", "lighting": "../environments/sky.hdr",
            "dimensions": {"width": 24, "height": 16}, "orbit": {"theta": 90, "phi": 60, "radius": 2},
            "target": {"x": 0, "y": 1, "z": 0}, "verticalFoV": 40, "renderSkybox": True, **changes}


class RenderFidelity(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.model = self.folder / "Models/Box/glTF/box.gltf"
        self.light = self.folder / "environments/sky.hdr"
        for file, source in ((self.model, "assets/cornell-box.gltf"), (self.light, "tests/field/colorcorr.hdr")):
            file.parent.mkdir(parents=True)
            file.write_bytes((REPOSITORY / source).read_bytes())

    def tearDown(self):
        self.temporary.cleanup()

    def job(self, **changes):
        png = self.folder / "test/out.png"
        return png, tool(json.dumps({"scenario": scenario(**changes), "outputFile": str(png)}), folder=self.folder)

    def test_the_orbit_turns_from_z_and_falls_from_y(self):
        png, done = self.job()
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = self.folder / "expected.png"
        # 2 sin 60 along +X, 2 cos 60 above the target.
        subprocess.run([LAVALIGHT, "render", self.model, "--env", self.light, "--look-from=1.7320508075688772,2,0",
                        "--look-at=0,1,0", "--fov", "40", "--size", "48x32", "--spp", "1", *TONE, "--png", expected, "--quiet"],
                       check=True)
        compared = subprocess.run([LAVALIGHT, "compare", "--flip-threshold", "0.001", png, expected], capture_output=True,
                                  text=True, check=False)
        self.assertEqual(compared.returncode, 0, compared.stdout + compared.stderr)

    def test_a_picture_has_four_pixels_for_each_of_the_scenario(self):
        png, _ = self.job()
        self.assertEqual(struct.unpack(">II", png.read_bytes()[16:24]), (48, 32))

    def test_without_a_skybox_the_background_is_transparent(self):
        png, _ = self.job(renderSkybox=False, orbit={"theta": 0, "phi": 90, "radius": 9})
        self.assertEqual(png.read_bytes()[25], 6, "a PNG of RGBA")
        png, _ = self.job(orbit={"theta": 0, "phi": 90, "radius": 9})
        self.assertEqual(png.read_bytes()[25], 2, "a PNG of RGB")

    def test_metadata_say_how_it_was_made_and_name_no_folder(self):
        png, _ = self.job()
        text = png.with_suffix(".json").read_text()
        metadata = json.loads(text)
        self.assertIn("lavalight", metadata["version"])
        self.assertEqual(metadata["model"]["name"], "box.gltf")
        self.assertEqual(len(metadata["picture"]["sha256"]), 64)
        self.assertIn("--fov", metadata["options"])
        self.assertIn("ledger", json.dumps(metadata["report"]))
        self.assertNotIn(str(self.folder), json.dumps(metadata["options"]))

    def test_a_configuration_becomes_a_page_that_names_what_is_missing(self):
        config = self.folder / "test/config.json"
        config.parent.mkdir()
        config.write_text(json.dumps({"scenarios": [scenario(), scenario(name="gone", model="../Models/Gone/glTF/gone.gltf")]}))
        done = tool("--config", config, "--out", self.folder / "page")
        self.assertEqual(done.returncode, 1, "one scenario failed")
        page = (self.folder / "page/index.html").read_text()
        self.assertIn('src="box.png"', page)
        self.assertIn("cannot find ../Models/Gone/glTF/gone.gltf", page)
        self.assertTrue((self.folder / "page/box.png").is_file())

    def test_a_view_from_right_above_has_an_up(self):
        _, done = self.job(orbit={"theta": 0, "phi": 0, "radius": 4})
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_scenario_that_cannot_be_understood_does_not_end_the_others(self):
        config = self.folder / "test/config.json"
        config.parent.mkdir()
        dark = {key: value for key, value in scenario(name="dark").items() if key != "lighting"}
        config.write_text(json.dumps({"scenarios": [dark, scenario(name="odd", orbit=None), scenario()]}))
        done = tool("--config", config, "--out", self.folder / "page")
        self.assertEqual(done.returncode, 1)
        page = (self.folder / "page/index.html").read_text()
        self.assertIn("has no &#x27;lighting&#x27;", page)
        self.assertTrue((self.folder / "page/box.png").is_file())

    def test_models_are_found_below_a_folder_of_models(self):
        away = self.folder / "elsewhere"
        (away / "Box/glTF-Binary").mkdir(parents=True)
        self.model.rename(away / "Box/glTF-Binary/box.gltf")
        png = self.folder / "out.png"
        done = tool(json.dumps({"scenario": scenario(), "outputFile": str(png)}), "--models", away, folder=self.folder / "environments")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_cannot_be_rendered_is_said(self):
        _, done = self.job(model="../Models/Gone/glTF/gone.gltf")
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot find ../Models/Gone/glTF/gone.gltf", done.stderr)
        self.model.write_text("{}")
        _, done = self.job()
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot read", done.stderr)
        self.assertEqual(tool("{").returncode, 1)
        self.assertEqual(tool("{}").returncode, 1)
        self.assertEqual(tool().returncode, 2)


if __name__ == "__main__":
    unittest.main()
