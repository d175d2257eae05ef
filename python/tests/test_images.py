"""What an image holds: the command's bits, views without copies, files."""
import gc
import json
import struct
import weakref

import lavalight
import numpy as np
import pytest

from conftest import SMALL


@pytest.fixture(scope="module")
def image(box):
    return box.render(size=(24, 16), spp=4, layers=["normal", "depth", "object-id"], background="transparent")


def test_arrays_have_rows_columns_and_channels(image):
    assert image.shape == (16, 24)
    assert image.rgb.shape == image.variance.shape == (16, 24, 3)
    assert image.alpha.shape == image.samples.shape == (16, 24)
    assert image.pixels.shape == (16, 24, 4)
    assert image.layers["normal"].shape == (16, 24, 3)
    assert image.layers["depth"].shape == (16, 24)
    assert (image.rgb.dtype, image.samples.dtype, image.pixels.dtype) == (np.float32, np.uint32, np.uint8)


def test_layers_are_a_mapping(image):
    assert {"color", "normal", "depth", "coverage"} <= set(image.layers)
    assert len(image.layers) == len(list(image.layers))
    assert "normal" in image.layers and "nothing" not in image.layers
    with pytest.raises(KeyError):
        image.layers["nothing"]
    with pytest.raises(KeyError):
        image.layer_variance("nothing")


def test_ids_are_whole_numbers(image):
    names = [name for name in image.layers if "object" in name]
    assert names and image.layers[names[0]].dtype == np.uint32
    assert image.layers[names[0]].max() > 0


def test_arrays_are_views_that_nobody_writes_to(image):
    assert np.shares_memory(image.rgb, image.rgb)
    assert np.shares_memory(image.rgb, image.layers["color"])
    for array in (image.rgb, image.variance, image.samples, image.pixels, image.alpha):
        assert not array.flags.owndata
        with pytest.raises(ValueError):
            array[...] = 0


def test_arrays_outlive_the_image(box):
    image = box.render(**SMALL)
    array, expected = image.rgb, image.rgb.copy()
    del image
    gc.collect()
    box.render(**SMALL, seed=3)
    assert (array == expected).all()


def test_an_image_goes_with_its_last_array(box):
    image = box.render(**SMALL)
    gone = weakref.ref(image)
    del image
    gc.collect()
    assert gone() is None


def test_samples_and_variance_are_of_the_samples_taken(box):
    image = box.render(**SMALL)
    assert (image.samples == 2).all()
    assert (image.variance >= 0).all() and image.variance.max() > 0
    one = box.render(size=(8, 8), spp=1)
    assert one.variance is None or (one.variance == 0).all()


def test_bits_are_the_commands(box, command, tmp_path):
    ours, theirs = tmp_path / "ours.exr", tmp_path / "theirs.exr"
    box.render(size=(48, 32), spp=8, mis="balance", seed=5).save(ours)
    command("render", "cornell-box", "--size", "48x32", "--spp", "8", "--mis", "balance", "--seed", "5", "-o", theirs, "--quiet")
    result = json.loads(command("compare", "--threshold", "0", "--json", ours, theirs).stdout)
    assert result["equal"] and result["rmse"] == 0.0


def test_png_has_the_bytes_of_the_commands(box, command, tmp_path):
    ours, theirs = tmp_path / "ours.png", tmp_path / "theirs.png"
    image = box.render(size=(48, 32), spp=4, tonemap="agx", exposure=0.5)
    image.save(ours)
    command("render", "cornell-box", "--size", "48x32", "--spp", "4", "--tonemap", "agx", "--exposure", "0.5", "--png", theirs, "--quiet")
    assert ours.read_bytes() == theirs.read_bytes() == image.png()


def test_notebooks_get_a_png(image):
    png = image._repr_png_()
    assert png.startswith(b"\x89PNG") and struct.unpack(">II", png[16:24]) == (24, 16)


def test_files_by_their_ending(image, tmp_path):
    image.save(tmp_path / "a.exr")
    image.save(str(tmp_path / "a.png"))
    image.save(tmp_path / "a.json")
    assert json.loads((tmp_path / "a.json").read_text())["samples"]["total"] == 24 * 16 * 4
    with pytest.raises(lavalight.UsageError, match="ending"):
        image.save(tmp_path / "a.tiff")
    with pytest.raises(lavalight.Error, match="cannot"):
        image.save(tmp_path / "no folder" / "a.exr")


def test_parts_of_samples_are_saved_as_films_that_merge(box, command, tmp_path):
    for number, samples in enumerate([(0, 2), (2, 4)]):
        box.render(size=(16, 16), samples=samples).save(tmp_path / f"{number}.exr")
    command("merge", tmp_path / "0.exr", tmp_path / "1.exr", "-o", tmp_path / "merged.exr")
    whole = box.render(size=(16, 16), spp=4)
    assert whole.compare(tmp_path / "merged.exr", relmse=0.0)


def test_the_report_says_what_was_done(image):
    report = image.report
    assert report["settings"]["spp"] == "4" or report["samples"]["total"] == 24 * 16 * 4
    assert "render" in report["seconds"]
    assert image.complete and report["complete"]


def test_the_ledger_names_what_is_biased(box):
    assert box.render(**SMALL).ledger == {}
    assert "clamp-indirect" in box.render(**SMALL, clamp_indirect=1.0).ledger


def test_images_are_compared(box):
    image, same, other = box.render(**SMALL), box.render(**SMALL), box.render(**SMALL, seed=1)
    assert image.compare(same, relmse=0.0)
    result = image.compare(other, relmse=0.0)
    assert not result and not result.equal and result["relMse"] > 0
    assert {"rmse", "flip"} <= set(result) and len(result) > 4
    assert "relMSE" in repr(result)


def test_noise_is_told_from_difference(box):
    image = box.render(size=(32, 32), spp=32, sampler="independent")
    assert image.compare(box.render(size=(32, 32), spp=32, sampler="independent", seed=1), significance=1e-4)
    assert not image.compare(box.render(size=(32, 32), spp=32, sampler="independent", max_bounces=1), significance=1e-4)


def test_images_of_one_sample_have_no_noise_to_tell_from(box):
    one = box.render(size=(16, 16), spp=1)
    with pytest.raises(lavalight.Error, match="no Z-test"):
        one.compare(box.render(size=(16, 16), spp=1, max_bounces=1), significance=1e-4)
    assert not one.compare(box.render(size=(16, 16), spp=1, max_bounces=1))  # by relMSE


def test_images_of_other_sizes_are_not_compared(box):
    with pytest.raises(lavalight.Error, match="size"):
        box.render(**SMALL).compare(box.render(size=(8, 8), spp=1), relmse=1.0)
    with pytest.raises(lavalight.Error, match="cannot"):
        box.render(**SMALL).compare("no such.exr")


def test_an_image_is_an_array(image):
    assert np.asarray(image).shape == (16, 24, 3)


def test_images_say_what_they_are(image):
    assert "24 x 16" in repr(image) and "normal" in repr(image)


def test_denoising_keeps_the_raw_colour(box):
    try:
        image = box.render(size=(32, 32), spp=4, denoise="fast")
    except lavalight.Error as error:
        pytest.skip(str(error).splitlines()[0])
    assert image.denoised.shape == (32, 32, 3)
    assert (image.rgb == box.render(size=(32, 32), spp=4).rgb).all()
    assert "denoised" in image.ledger


def test_without_denoising_there_is_no_denoised_layer(image):
    assert image.denoised is None
    assert lavalight.load("cornell-box").render(**SMALL).alpha is None
