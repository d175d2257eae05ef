"""Parts of images in memory, and images and scenes on their way to other processes."""
import pickle
import struct

import lavalight
import numpy as np
import pytest

EVERYTHING = {"size": (40, 30), "layers": ["normal", "depth", "object-id", "cryptomatte"], "background": "transparent", "filter": "mitchell",
              "crop": (4, 2, 24, 16)}


def header(path):
    """The attributes of an EXR file by name, and the bytes after them."""
    data, at, found = path.read_bytes(), 8, {}
    while data[at]:
        end = data.index(b"\0", at)
        name, at = data[at:end].decode(), data.index(b"\0", end + 1) + 1
        size, = struct.unpack_from("<I", data, at)
        found[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return found, data[at:]


TIMES = ("lavalight:render-seconds", "lavalight:film:hash")  # the hash is of the seconds, too


def assert_same_bits(image, other, tmp_path):
    """Arrays, picture and EXR file, but for the seconds that it took."""
    assert (image.rgb == other.rgb).all() and (image.variance == other.variance).all() and (image.samples == other.samples).all()
    assert list(image.layers) == list(other.layers)
    for name, layer in other.layers.items():
        assert (image.layers[name] == layer).all(), name
        assert name in ("object-id", "material-id") or image.layer_variance(name) is None or \
            (image.layer_variance(name) == other.layer_variance(name)).all(), name
    assert image.ledger == other.ledger and image.complete == other.complete
    assert (image.pixels == other.pixels).all() and image.png() == other.png()
    image.save(tmp_path / "image.exr")
    other.save(tmp_path / "other.exr")
    (found, content), (expected, wanted) = header(tmp_path / "image.exr"), header(tmp_path / "other.exr")
    assert {name for name in found.keys() | expected.keys() if found.get(name) != expected.get(name)} <= set(TIMES)
    offsets = 8 * image.height  # where each line begins, which moves with the length of the seconds
    assert content[offsets:] == wanted[offsets:]


def test_parts_merge_to_the_bits_of_one_render(box, tmp_path):
    parts = [box.render(samples=samples, **EVERYTHING) for samples in ((5, 8), (0, 5))]
    parts[1].save(tmp_path / "part.exr")
    whole = box.render(samples=(0, 8), **EVERYTHING)
    assert_same_bits(lavalight.merge(parts), whole, tmp_path)
    assert_same_bits(lavalight.merge([parts[0].film_bytes(), tmp_path / "part.exr"]), whole, tmp_path)


def test_a_merged_image_says_what_it_is(box):
    merged = lavalight.merge(box.render(size=(16, 16), samples=samples, max_bounces=2) for samples in ((0, 2), (4, 6)))
    assert merged.report["ranges"] == "0:2,4:6" and merged.report["settings"]["spp"] == "4"
    assert merged.report["samples"]["total"] == 4 * 256 and merged.report["rays"]["camera"] == 4 * 256
    assert "cut-paths" in merged.ledger and merged.report["device"]["name"]
    again = lavalight.merge([merged, box.render(size=(16, 16), samples=(2, 4), max_bounces=2)])
    assert (again.rgb == box.render(size=(16, 16), samples=(0, 6), max_bounces=2).rgb).all()


def test_tone_and_exposure_are_those_of_the_merge(box):
    part = box.render(size=(16, 16), samples=(0, 4))
    for how in ({"tonemap": "agx", "exposure": 1.0}, {"exposure": "auto"}):
        assert (lavalight.merge([part], **how).pixels == box.render(size=(16, 16), samples=(0, 4), **how).pixels).all()


def test_what_does_not_belong_together_is_refused(box):
    part = box.render(size=(16, 16), samples=(0, 2))
    with pytest.raises(lavalight.Error, match="cannot merge part 2 with part 1: both hold the samples 0:2"):
        lavalight.merge([part, part])
    with pytest.raises(lavalight.Error, match="they differ in --seed"):
        lavalight.merge([part, box.render(size=(16, 16), samples=(2, 4), seed=7)])
    with pytest.raises(lavalight.Error, match="did not keep it; try samples"):
        lavalight.merge([box.render(size=(16, 16), spp=2)])
    with pytest.raises(lavalight.Error, match="cannot denoise part 1|denois"):
        lavalight.merge([part], denoise=True)
    with pytest.raises(TypeError, match="unexpected keyword argument 'spp'"):
        lavalight.merge([part], spp=2)
    with pytest.raises(ValueError, match="needs parts"):
        lavalight.merge([])


@pytest.mark.parametrize("damage", [lambda data: b"", lambda data: b"nonsense", lambda data: data[:-1], lambda data: data + b"\0",
                                    lambda data: data[:-40] + b"\1" + data[-39:], lambda data: data.replace(b"cornell-box", b"cornell-fox")])
def test_damaged_films_are_refused(box, damage):
    data = box.render(size=(16, 16), samples=(0, 2)).film_bytes()
    with pytest.raises(lavalight.Error, match="cannot read part 1: "):
        lavalight.merge([damage(data)])


def test_images_pickle(box, tmp_path):
    image = box.render(samples=(0, 2), tonemap="agx", exposure=0.5, **EVERYTHING)
    copy = pickle.loads(pickle.dumps(image))
    assert_same_bits(copy, image, tmp_path)
    assert copy.report == image.report and copy.film_bytes() == image.film_bytes()
    assert copy.compare(image, flip=0.0).equal
    merged = pickle.loads(pickle.dumps(lavalight.merge([image], tonemap="agx", exposure=0.5)))
    assert (merged.pixels == image.pixels).all()


def test_damaged_pickles_are_refused(box):
    data = box.render(size=(8, 8), spp=1)._image.pack()
    for damaged in (b"", data[:-1], data[:200], data + b"\0", b"x" + data[1:]):
        with pytest.raises(lavalight.Error, match="cannot read the image"):
            lavalight._lavalight.Image.unpack(damaged)


def test_scenes_pickle(tmp_path):
    square = lavalight.Mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]], material=0)
    lavalight.load("cornell-box").render(size=(16, 8), spp=1).save(tmp_path / "map.exr")
    scene = lavalight.Scene([square], [lavalight.Material((0.8, 0.2, 0.1), name="paint")], lavalight.Camera((0, 0, 4)),
                            env=tmp_path / "map.exr")
    scene.materials["paint"].base_color = (0.1, 0.3, 0.7)
    scene.materials["paint"].roughness = 0.123456789
    expected = scene.render(size=(16, 16), spp=2)
    data = pickle.dumps(scene)
    (tmp_path / "map.exr").unlink()
    copy = pickle.loads(data)
    assert_same_bits(copy.render(size=(16, 16), spp=2), expected, tmp_path)
    assert_same_bits(pickle.loads(pickle.dumps(copy)).render(size=(16, 16), spp=2), expected, tmp_path)


def test_files_pickle_with_all_they_refer_to(tmp_path, monkeypatch):
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32).tobytes()
    (tmp_path / "corners.bin").write_bytes(corners)
    (tmp_path / "scene.gltf").write_text("""{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [{"uri": "corners.bin", "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]}""")
    monkeypatch.chdir(tmp_path)
    scene = lavalight.load("scene.gltf")
    expected = scene.render(size=(16, 16), spp=2)
    data = pickle.dumps(scene)
    assert lavalight.pack("scene.gltf")[:4] == b"glTF"
    (tmp_path / "corners.bin").unlink()
    assert_same_bits(pickle.loads(data).render(size=(16, 16), spp=2), expected, tmp_path)
    (tmp_path / "scene.gltf").write_text("{}")
    with pytest.raises(lavalight.Error, match="has changed since it was loaded; try to load it again"):
        pickle.dumps(scene)
