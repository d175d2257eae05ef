"""Every option of a picture is a keyword, with the command's own checks and messages."""
import pathlib

import lavalight
import numpy as np
import pytest
from lavalight import _keywords

from conftest import SMALL

# A value that is not the default, for each keyword of render().
VALUES = {
    "size": (24, 12), "spp": 3, "samples": (2, 5), "time": 0.3, "target_error": 0.5, "preset": "mis", "sampler": "independent",
    "hemisphere": "uniform", "nee": False, "light_selection": "power", "mis": "balance", "roulette": "off", "roulette_start": 2,
    "roulette_probability": 0.7, "mis_survival": True, "fresnel": "schlick", "multiple_scattering": True,
    "texture_filter": "stochastic", "smooth_terminator": False, "max_bounces": 2, "clamp_indirect": 3.0, "filter": "tent",
    "filter_radius": 1.5, "seed": 7, "device": 0, "require_device": "cpu", "schedule": "fused", "accelerator": "bvh8", "wave_size": 5000, "band_rows": 4,
    "crop": (2, 2, 8, 8), "camera": 0, "look_from": (0.0, 1.0, 3.5), "look_at": (0, 1, 0), "up": (0, 1, 0), "fov": 40,
    "aperture": 0.1, "focus": 2.0, "view": "front", "panorama": True, "no_clip": True, "tonemap": "agx", "exposure": -1.5,
    "background": "transparent", "ground": "#808080", "intrinsics": (30.0, 25, 8, 6.5), "clip": (0.1, 10), "layers": ["normal", "depth"], "denoise": None, "kernel_timeout": 100,
}
NEEDS = {"look_at": {"look_from": (0, 1, 3)}, "up": {"look_from": (0, 1, 3), "look_at": (0, 1, 0)}, "focus": {"aperture": 0.1},
         "mis_survival": {"roulette": "constant"}, "roulette_probability": {"roulette": "constant"}, "filter_radius": {"filter": "tent"}, "look_from": {"look_at": (0, 1, 0)}}
ALONE = {"samples": "spp", "time": "spp", "target_error": "spp", "panorama": "size"}


@pytest.mark.parametrize("keyword", _keywords.names(of_scene=False))
def test_every_keyword_of_render_is_taken(box, keyword):
    assert keyword in VALUES, "a new option: give it a value here"
    small = {key: value for key, value in SMALL.items() if key != ALONE.get(keyword)}
    image = box.render(**{**small, **NEEDS.get(keyword, {}), keyword: VALUES[keyword]})
    assert np.isfinite(image.rgb).all()


SCENE_VALUES = {"env": "studio", "env_rotation": 30, "env_intensity": 2.0, "sun_elevation": 20, "sun_azimuth": 90, "turbidity": 4,
                "at": 0.0, "animation": "0", "scene": "0", "variant": "0", "allow_external": True}
SCENE_NEEDS = {"env_rotation": {"env": "studio"}, "sun_elevation": {"env": "sky"}, "sun_azimuth": {"env": "sky"},
               "turbidity": {"env": "sky"}, "env_intensity": {"env": "studio"}}
REFUSED = {"at": "has no animation", "animation": "needs a time", "variant": "has no", "scene": "has no"}  # by the Cornell box


@pytest.mark.parametrize("keyword", _keywords.names(of_scene=True))
def test_every_keyword_of_load_is_taken_or_refused_for_what_the_scene_lacks(keyword):
    keywords = {**SCENE_NEEDS.get(keyword, {}), keyword: SCENE_VALUES[keyword]}
    if keyword in REFUSED and keyword != "scene":
        with pytest.raises(lavalight.UsageError, match=REFUSED[keyword]):
            lavalight.load("cornell-box", **keywords)
    else:
        assert lavalight.load("cornell-box", **keywords).triangles > 0


@pytest.mark.parametrize("keywords, message", [
    ({"spp": 0}, "spp"), ({"spp": -1}, "spp"), ({"spp": "many"}, "spp"), ({"size": (0, 5)}, "size"), ({"size": (5,)}, "size"),
    ({"size": "big"}, "size"), ({"mis": "best"}, "mis"), ({"max_bounces": 100000}, "max-bounces"), ({"fov": 200}, "fov"),
    ({"crop": (0, 0, 99, 99)}, "crop"), ({"layers": ["nothing"]}, "aov"), ({"background": "no colour"}, "background"),
    ({"exposure": "bright"}, "exposure"), ({"camera": "no such"}, "camera"),
    ({"samples": (5, 2)}, "samples"), ({"nee": "perhaps"}, "nee"), ({"filter_radius": -1.0}, "filter-radius"),
    ({"preset": "none"}, "preset"), ({"ground": "grass"}, "ground"),
])
def test_wrong_values_are_usage_errors_that_name_the_option(box, keywords, message):
    with pytest.raises(lavalight.UsageError, match=message):
        box.render(**{**SMALL, **keywords})


def test_a_device_that_is_not_there_is_an_error(box):
    with pytest.raises(lavalight.Error, match="no such device"):
        box.render(**SMALL, device="no such device")


def test_usage_errors_are_value_errors_and_errors():
    assert issubclass(lavalight.UsageError, ValueError)
    assert issubclass(lavalight.UsageError, lavalight.Error)
    assert issubclass(lavalight.Error, RuntimeError)


def test_unknown_keywords_are_type_errors_with_a_guess(box):
    with pytest.raises(TypeError, match="Did you mean 'max_bounces'"):
        box.render(max_bounce=3)
    with pytest.raises(TypeError, match="unexpected keyword argument 'zzz'"):
        box.render(zzz=3)


def test_keywords_of_the_other_function_are_sent_there(box):
    with pytest.raises(TypeError, match=r"give it to load\(\)"):
        box.render(env="studio")
    with pytest.raises(TypeError, match=r"give it to render\(\)"):
        lavalight.load("cornell-box", spp=3)


def test_flags_are_true_or_false(box):
    with pytest.raises(TypeError, match="is True or False"):
        box.render(**SMALL, panorama="yes")
    box.render(**SMALL, no_clip=False)


def test_none_is_the_default(box):
    assert (box.render(**SMALL, mis=None).rgb == box.render(**SMALL).rgb).all()


@pytest.mark.parametrize("keywords", [{"filter_radius": 1e30, "filter": "tent"}, {"look_from": (1e19, 0, 0), "look_at": (0, 0, 0)},
                                      {"aperture": 1e19}, {"aperture": 0.1, "focus": 1e30}])
def test_rays_from_beyond_all_bounds_end_no_program(box, keywords):
    assert box.render(**SMALL, **keywords).complete


def test_values_of_numpy_are_pythons(box):
    image = box.render(size=np.array([16, 16]), spp=np.array(2), nee=np.False_, seed=np.uint8(3), clamp_indirect=np.float32(2))
    assert (image.rgb == box.render(size=(16, 16), spp=2, nee=False, seed=3, clamp_indirect=2.0).rgb).all()


def test_no_layers_are_no_layers(box):
    assert list(box.render(**SMALL, layers=[]).layers) == ["color"]


def test_numpy_numbers_and_paths_are_values(box, tmp_path):
    assert box.render(size=np.array([16, 12]), spp=np.int64(2)).shape == (12, 16)
    with pytest.raises(lavalight.Error, match="cannot"):
        lavalight.load("cornell-box", env=pathlib.Path(tmp_path / "no.hdr"))


def test_help_lists_every_keyword():
    for keyword in _keywords.names(of_scene=False):
        assert f"\n    {keyword}: " in lavalight.Scene.render.__doc__
    for keyword in _keywords.names(of_scene=True):
        assert f"\n    {keyword}: " in lavalight.load.__doc__
