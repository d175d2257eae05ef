#!/usr/bin/env python3
"""What `cmake --install` puts where: by DESTDIR and prefix, whole, movable, and with a thumbnailer that makes thumbnails."""
import argparse
import configparser
import os
import re
import shlex
import shutil
import struct
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent.parent
FILES = ("bin/lavalight", "share/man/man1/lavalight.1", "share/man/man1/lavalight-render.1",
         "share/bash-completion/completions/lavalight", "share/zsh/vendor-completions/_lavalight",
         "share/fish/vendor_completions.d/lavalight.fish", "share/thumbnailers/lavalight.thumbnailer",
         "share/applications/lavalight.desktop", "share/icons/hicolor/scalable/apps/lavalight.svg",
         "share/doc/lavalight/copyright")
build = None


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="install-"))
        subprocess.run(["cmake", "--install", build, "--prefix", "/opt/light"], check=True, capture_output=True,
                       env={**os.environ, "DESTDIR": str(cls.folder)})
        cls.prefix = cls.folder / "moved"
        (cls.folder / "opt/light").rename(cls.prefix)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def fields(self, file, section):
        parser = configparser.ConfigParser(interpolation=None)
        parser.optionxform = str
        parser.read(self.prefix / file, encoding="utf-8")
        return parser[section]

    def test_all_files_are_below_the_prefix(self):
        for file in FILES:
            self.assertTrue((self.prefix / file).is_file(), file)
        self.assertEqual([entry.name for entry in (self.folder / "opt").iterdir()], [])
        self.assertEqual({entry.name for entry in self.folder.iterdir()}, {"opt", "moved"})

    def test_nothing_names_the_folders_of_the_build(self):
        for path in self.prefix.rglob("*"):
            if path.is_file() and path.name != "lavalight":
                self.assertNotIn(str(REPOSITORY), path.read_text(encoding="utf-8"), path)

    def test_moved_program_renders(self):
        subprocess.run([self.prefix / "bin/lavalight", "render", "cornell-box", "--size", "16x16", "--spp", "1", "--quiet",
                        "--png", self.folder / "opt/box.png"], check=True, cwd=self.folder)
        (self.folder / "opt/box.png").unlink()

    def test_thumbnailer_makes_a_square_of_the_size_asked_for(self):
        entry = self.fields("share/thumbnailers/lavalight.thumbnailer", "Thumbnailer Entry")
        self.assertEqual(entry["MimeType"], "model/gltf-binary;model/gltf+json;")
        with tempfile.TemporaryDirectory() as work:
            model = Path(work, "a model.gltf")
            shutil.copy(REPOSITORY / "assets/cornell-box.gltf", model)
            words = [word.replace("%s", "64").replace("%i", str(model)).replace("%o", f"{work}/thumbnail.png")
                     for word in shlex.split(entry["Exec"])]
            self.assertFalse([word for word in words if "%" in word])
            path = f"{self.prefix / 'bin'}:{os.environ['PATH']}"
            subprocess.run(words, check=True, env={**os.environ, "PATH": path})
            picture = Path(work, "thumbnail.png").read_bytes()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", picture[16:24]), (64, 64))

    def test_desktop_entry_opens_the_models_that_the_thumbnailer_shows(self):
        entry = self.fields("share/applications/lavalight.desktop", "Desktop Entry")
        self.assertEqual(entry["MimeType"], "model/gltf-binary;model/gltf+json;")
        self.assertEqual(entry["Exec"], "lavalight view %f")
        self.assertTrue((self.prefix / f"share/icons/hicolor/scalable/apps/{entry['Icon']}.svg").exists())
        if shutil.which("desktop-file-validate"):
            subprocess.run(["desktop-file-validate", self.prefix / "share/applications/lavalight.desktop"], check=True)

    def test_icon_is_a_picture(self):
        icon = xml.etree.ElementTree.parse(self.prefix / "share/icons/hicolor/scalable/apps/lavalight.svg").getroot()
        self.assertEqual(icon.tag, "{http://www.w3.org/2000/svg}svg")

    def test_licences_are_of_every_library_that_becomes_part_of_the_program(self):
        text = (self.prefix / "share/doc/lavalight/copyright").read_text(encoding="utf-8")
        for part in ("assets/sky/*", "basis-universal", "meshoptimizer", "glslang", "spirv-tools", "vulkan-hpp", "imgui",
                     "cli11", "glm", "spdlog", "nlohmann-json", "boost-math"):
            self.assertRegex(text, rf"(?m)^Files: .*{re.escape(part)}", part)
        used = set(re.findall(r"(?m)^License: (.+)$", text.partition("\nLicense: Expat\n ")[0]))
        given = set(re.findall(r"(?m)^License: (.+)\n ", text))
        self.assertEqual(used, given)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True)
    build = parser.parse_args().build.resolve()
    unittest.main(argv=["install_test"])
