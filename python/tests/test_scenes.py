"""Scenes: from files, from arrays, changed in place."""
import logging
import os
import pickle
import shutil

import lavalight
import numpy as np
import pytest

from conftest import REPOSITORY, SMALL

SQUARE = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
CORNERS = [[0, 1, 2], [0, 2, 3]]
CAMERA = lavalight.Camera((0, 0, 3), (0, 0, 0), fov=30)


def glowing(emission, **mesh):
    """A square that fills the view and glows."""
    return lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS, material=0, **mesh)],
                           [lavalight.Material(base_color=(0, 0, 0), emission=emission)], CAMERA)


def test_builtin_scenes_and_files_are_loaded():
    assert "cornell-box" in lavalight.builtin_scenes()
    scene = lavalight.load(REPOSITORY / "assets/cornell-box.gltf")
    assert scene.triangles == lavalight.load("cornell-box").triangles
    assert (scene.render(**SMALL).rgb == lavalight.load("cornell-box").render(**SMALL).rgb).all()


def test_what_is_no_scene_is_an_error(tmp_path):
    with pytest.raises(lavalight.Error, match="no such file"):
        lavalight.load("no such scene")
    (tmp_path / "broken.glb").write_bytes(b"glTF\2\0\0\0")
    with pytest.raises(lavalight.Error, match="cannot read"):
        lavalight.load(tmp_path / "broken.glb")


def test_names_of_files_need_not_be_utf_8(tmp_path, caplog):
    folder = tmp_path / os.fsdecode(b"caf\xe9")
    folder.mkdir()
    model = folder / os.fsdecode(b"bo\xeete.gltf")
    shutil.copy(REPOSITORY / "assets/cornell-box.gltf", model)
    scene = lavalight.load(model)
    assert scene.name == str(model) and "\\udcee" in ascii(scene)
    image = scene.render(**SMALL)
    assert (image.rgb == lavalight.load("cornell-box").render(**SMALL).rgb).all()
    for name in (b"im\xe9.exr", b"im\xe9.png", b"im\xe9.json"):
        image.save(folder / os.fsdecode(name))
        assert (folder / os.fsdecode(name)).stat().st_size > 0
    assert image.compare(folder / os.fsdecode(b"im\xe9.exr")).equal
    assert (pickle.loads(pickle.dumps(scene)).render(**SMALL).rgb == image.rgb).all()
    scene.render(samples=(0, 2), size=(16, 16)).save(folder / os.fsdecode(b"film\xe9.exr"))
    assert lavalight.merge([folder / os.fsdecode(b"film\xe9.exr")]).width == 16
    lavalight.load("cornell-box", env=folder / os.fsdecode(b"im\xe9.exr")).render(**SMALL)
    with pytest.raises(lavalight.Error, match=r"caf\\xe9"):
        lavalight.load(folder / "none.glb")
    assert all(record.getMessage().encode() for record in caplog.records)  # UTF-8, whatever they quote


def test_half_of_a_surrogate_pair_is_no_name():
    with pytest.raises(UnicodeEncodeError):
        lavalight.load("\ud800")


def test_a_scene_says_what_it_has(box):
    assert box.cameras and box.triangles > 10 and box.warnings == []
    low, high = box.bounds
    assert all(a < b for a, b in zip(low, high))
    assert box.animations == {} and box.variants == []
    assert "cornell-box" in repr(box)


def test_emission_is_radiance():
    image = glowing((2.0, 0.5, 7.0)).render(**SMALL)
    assert np.allclose(image.rgb[8, 8], [2.0, 0.5, 7.0], rtol=1e-5)


def test_light_is_irradiance_over_pi():
    scene = lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS, material=0)],
                            [lavalight.Material(base_color=(0.5, 0.5, 0.5), roughness=1.0, ior=1.5,
                                                extensions={"KHR_materials_specular": {"specularFactor": 0.0}})],
                            CAMERA, [lavalight.Light("directional", direction=(0, 0, -1), intensity=3.0)])
    image = scene.render(size=(16, 16), spp=4)
    assert np.allclose(image.rgb[8, 8], 0.5 * 3.0 / np.pi, rtol=1e-3)


@pytest.mark.parametrize("light", [lavalight.Light("point", (0, 0, 2), intensity=4.0),
                                   lavalight.Light("spot", (0, 0, 2), (0, 0, -1), intensity=4.0)])
def test_candela_fall_with_the_square(light):
    scene = lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS, material=0)],
                            [lavalight.Material(roughness=1.0, extensions={"KHR_materials_specular": {"specularFactor": 0.0}})],
                            CAMERA, [light])
    image = scene.render(size=(17, 17), spp=4)
    assert np.allclose(image.rgb[8, 8], 4.0 / 4.0 / np.pi, rtol=2e-2)


def test_transforms_move_meshes():
    moved = np.eye(4)
    moved[0, 3] = 50.0
    assert glowing((1, 1, 1)).render(**SMALL).rgb.max() > 0
    low, _ = glowing((1, 1, 1), transform=moved).bounds
    assert low[0] == pytest.approx(49.0)


def test_colors_of_vertices_multiply():
    colors = np.tile([0.0, 1.0, 0.0], (4, 1))
    scene = lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS, colors=colors, material=0)],
                            [lavalight.Material(extensions={"KHR_materials_unlit": {}})], CAMERA)
    assert np.allclose(scene.render(**SMALL).rgb[8, 8], [0, 1, 0], atol=1e-5)


def test_textures_are_pictures_or_their_bytes(box, tmp_path):
    png = box.render(size=(4, 4), spp=1, exposure=-20.0)  # black
    png.save(tmp_path / "black.png")
    for texture in (str(tmp_path / "black.png"), png.png()):
        scene = lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS, uvs=[[0, 0], [1, 0], [1, 1], [0, 1]], material=0)],
                                [lavalight.Material(texture=texture, extensions={"KHR_materials_unlit": {}})], CAMERA)
        assert scene.render(**SMALL).rgb[8, 8].max() < 0.05


@pytest.mark.parametrize("mesh, message", [
    ({"positions": [[0, 0]]}, r"\(n, 3\) is wanted"),
    ({"positions": SQUARE, "triangles": [[0, 1]]}, r"\(m, 3\) is wanted"),
    ({"positions": SQUARE, "triangles": [[0, 1, 9]]}, "is not one of 4 positions"),
    ({"positions": SQUARE, "triangles": [[0, 1, -1]]}, "is not one of 4 positions"),
    ({"positions": SQUARE, "normals": [[0, 0, 1]]}, "1 for 4 positions"),
    ({"positions": SQUARE, "uvs": np.zeros((4, 3))}, r"\(n, 2\) is wanted"),
    ({"positions": SQUARE, "colors": np.zeros((4, 2))}, r"\(n, 3\) or \(n, 4\) is wanted"),
    ({"positions": SQUARE, "material": 3}, "has material 3"),
    ({"positions": SQUARE, "triangles": [[0.9, 1.2, 2.7]]}, "whole numbers"),
    ({"positions": SQUARE, "transform": np.full((4, 4), np.nan)}, "mesh 0, transform: nan is not finite"),
    ({"positions": SQUARE, "transform": np.eye(3)}, r"\(4, 4\) is wanted"),
])
def test_arrays_of_wrong_shapes_are_refused(mesh, message):
    with pytest.raises(ValueError, match=message):
        lavalight.Scene([lavalight.Mesh(**mesh)])


@pytest.mark.parametrize("material, message", [({"metallic": float("nan")}, "material 0, metallic"),
                                               ({"emission": (float("inf"), 0, 0)}, "material 0, emission"),
                                               ({"base_color": (0, float("nan"), 0)}, "material 0, base_color")])
def test_factors_that_are_not_finite_are_refused_by_name(material, message):
    with pytest.raises(ValueError, match=message):
        lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS, material=0)], [lavalight.Material(**material)])


def test_scalars_of_numpy_are_numbers():
    material = lavalight.Material(metallic=np.float32(0.5), alpha=np.float32(0.5), double_sided=np.bool_(True), roughness=np.float64(1))
    scene = lavalight.Scene([lavalight.Mesh(np.array(SQUARE, dtype=np.int64), np.array(CORNERS, dtype=np.uint8), material=np.int64(0))],
                            [material])
    assert scene.materials[0].metallic == 0.5


def test_meshes_of_nothing_show_nothing():
    for mesh in (lavalight.Mesh(np.zeros((0, 3))), lavalight.Mesh(SQUARE, np.zeros((0, 3), dtype=int))):
        scene = lavalight.Scene([mesh, lavalight.Mesh(SQUARE, CORNERS)])
        assert scene.triangles == 2
        assert np.isfinite(scene.render(**SMALL).rgb).all()


def test_cameras_and_lights_without_direction_are_refused():
    with pytest.raises(ValueError, match="is not a direction"):
        lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS)], camera=lavalight.Camera((1, 1, 1), (1, 1, 1)))
    with pytest.raises(ValueError, match="kind"):
        lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS)], lights=[lavalight.Light("laser")])


def test_a_camera_may_look_along_its_up():
    scene = lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS)], camera=lavalight.Camera((0, 5, 0), (0, 0, 0)))
    assert np.isfinite(scene.render(**SMALL).rgb).all()


def test_materials_change_without_a_reload():
    scene = glowing((1, 1, 1))
    before = scene.render(**SMALL)
    scene.materials[0].emission = (0.0, 3.0, 0.0)
    assert np.allclose(scene.render(**SMALL).rgb[8, 8], [0, 3, 0], rtol=1e-5)
    assert np.allclose(before.rgb[8, 8], 1.0, rtol=1e-5)
    assert list(scene.materials[0].emission) == [0.0, 3.0, 0.0]


def test_materials_are_found_by_name():
    scene = lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS, material=1)],
                            [lavalight.Material(name="a"), lavalight.Material(name="b", roughness=0.25)])
    assert scene.materials["b"].roughness == pytest.approx(0.25)
    assert len(scene.materials) == 2
    with pytest.raises(KeyError, match="cannot find material 'c'"):
        scene.materials["c"]
    with pytest.raises(IndexError):
        scene.materials[7]


@pytest.mark.parametrize("name, value", [("metallic", 1.5), ("roughness", -0.1), ("base_color", (2, 0, 0)), ("ior", 0.5),
                                         ("roughness", float("nan"))])
def test_factors_out_of_range_are_refused(name, value):
    material = glowing((1, 1, 1)).materials[0]
    with pytest.raises(ValueError, match=name):
        setattr(material, name, value)


@pytest.mark.parametrize("name", ["metallic", "roughness", "specular", "transmission", "clearcoat", "clearcoat_roughness",
                                  "sheen_roughness"])
def test_factors_are_read_as_they_were_set(name):
    material = glowing((1, 1, 1)).materials[0]
    setattr(material, name, 0.25)
    assert getattr(material, name) == pytest.approx(0.25)


def test_cameras_move_without_a_reload(box):
    a = box.render(**SMALL)
    b = box.render(**SMALL, look_from=(0, 1, 2), look_at=(0, 1, 0))
    assert not (a.rgb == b.rgb).all()
    assert (box.render(**SMALL).rgb == a.rgb).all()


def test_scenes_without_light_get_the_studio_and_say_so(triangle, caplog):
    assert not triangle.has_own_light
    assert any("studio" in warning for warning in triangle.warnings)
    with caplog.at_level(logging.WARNING, logger="lavalight"):
        image = triangle.render(**SMALL)
    assert "stand-in-light" in image.ledger
    assert any("studio" in record.message for record in caplog.records)


def test_light_is_chosen_when_loading():
    dark = lavalight.Scene([lavalight.Mesh(SQUARE, CORNERS)], camera=lavalight.Camera((0, 0, 30)), env=(0.25, 0.5, 1.0))
    assert np.allclose(dark.render(**SMALL, max_bounces=0).rgb[0, 0], [0.25, 0.5, 1.0], rtol=1e-5)
