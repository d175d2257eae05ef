"""`lavalight serve`: who may ask, for how much, and what comes back."""
import argparse
import asyncio
import base64
import hashlib
import http.client
import io
import json
import os
import re
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
from pathlib import Path

import lavalight
import numpy as np
import pytest
from lavalight._build import build_glb

from conftest import REPOSITORY

NEEDED = ("starlette", "uvicorn", "python_multipart", "PIL")
for needed in NEEDED:
    pytest.importorskip(needed, reason=f"the extra lavalight[serve] is not installed: {needed}")

from lavalight.serve import _command, _drake, _preview  # noqa: E402
from lavalight.serve._connection import Connection  # noqa: E402
from lavalight.serve._guard import Guard  # noqa: E402
from lavalight.serve._refusal import ClientGone, Refusal  # noqa: E402
from lavalight.serve._renders import Renders  # noqa: E402
from lavalight.serve._scenes import KeptScene, Scenes  # noqa: E402
from lavalight.serve._settings import Limits, Settings  # noqa: E402
from PIL import Image as Pillow  # noqa: E402
from starlette.responses import PlainTextResponse  # noqa: E402
import uvicorn  # noqa: E402

TOKEN = "a-token-of-24-characters"


# A server of its own for these tests, with limits that tests can reach.

class Running:
    def __init__(self, *words, **environment):
        self.process = subprocess.Popen([sys.executable, "-m", "lavalight", "serve", "--bind", "127.0.0.1:0", *words], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, env={**os.environ, **environment})
        line = self.process.stdout.readline()
        self.port = int(re.search(r":(\d+)/", line)[1])
        self.log = []
        threading.Thread(target=lambda: self.log.extend(self.process.stderr), daemon=True).start()

    def ask(self, method, path, body=None, headers=None, timeout=60):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        try:
            connection.request(method, path, body, headers or {})
            answer = connection.getresponse()
            return answer.status, dict((key.lower(), value) for key, value in answer.getheaders()), answer.read()
        finally:
            connection.close()

    def about(self):
        return json.loads(self.ask("GET", "/about")[2])

    def json(self, path, value, **headers):
        return self.ask("POST", path, json.dumps(value), {"Content-Type": "application/json", **headers})

    def raw(self, data, timeout=30):
        """The head that comes back for bytes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=timeout) as connection:
            connection.sendall(data)
            answer = b""
            try:
                while b"\r\n\r\n" not in answer and (part := connection.recv(65536)):
                    answer += part
            except OSError:
                pass
            return answer

    def end(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(30)


@pytest.fixture(scope="module")
def server():
    running = Running("--max-bytes", "1M", "--max-pixels", "300000", "--max-samples", "1000000", "--max-seconds", "3", "--max-waiting", "1", "--spp", "2")
    while running.about()["requests"]:  # the first picture, which compiles kernels
        time.sleep(0.1)
    yield running
    assert running.end() == 0, running.log
    assert not any("Traceback" in line for line in running.log), running.log


@pytest.fixture(scope="module")
def guarded():
    running = Running(LAVALIGHT_TOKEN=TOKEN)
    yield running
    running.end()


# A wall at z = -4 and a smaller one before it, as Drake would send them.

FIELDS = {"image_type": "color", "width": "40", "height": "30", "near": "0.1", "far": "10", "focal_x": "50.0", "focal_y": "40.0", "fov_x": "0.76",
          "fov_y": "0.717", "center_x": "14.0", "center_y": "17.5", "submit": "Render"}
LABELS = {"far": (200, 1, 7), "near": (48, 117, 0)}


def wall(z, half, material, middle=(0.0, 0.0)):
    x, y = middle
    corners = [[x - half, y - half, z], [x + half, y - half, z], [x + half, y + half, z], [x - half, y + half, z]]
    return lavalight.Mesh(np.array(corners), np.array([[0, 1, 2], [0, 2, 3]]), material=material)


@pytest.fixture(scope="module")
def model():
    materials = [lavalight.Material(base_color=tuple(channel / 255 for channel in LABELS[name]), name=name) for name in LABELS]
    meshes = [wall(-4.0, 1.21, 0), wall(-3.0, 0.3, 1, (0.2, 0.4))]
    return build_glb(meshes, materials, lavalight.Camera((0, 0, 0), (0, 0, -1), fov=41), [])


def as_gltf(model):
    """The JSON of a .glb, with its bytes inside."""
    length = struct.unpack_from("<I", model, 12)[0]
    gltf = json.loads(model[20:20 + length])
    gltf["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(model[28 + length:]).decode()
    return gltf


def form(model, **changes):
    fields = {**FIELDS, "scene_sha256": hashlib.sha256(model).hexdigest(), **changes}
    boundary = "----boundary"
    parts = [f"--{boundary}\r\nContent-Disposition: form-data; name=\"{name}\"\r\n\r\n{value}\r\n".encode() for name, value in fields.items() if value is not None]
    parts.append(f"--{boundary}\r\nContent-Disposition: form-data; name=\"scene\"; filename=\"scene.gltf\"\r\n"
                 "Content-Type: model/gltf+json\r\n\r\n".encode() + model + b"\r\n")
    return b"".join(parts) + f"--{boundary}--\r\n".encode(), {"Content-Type": f"multipart/form-data; boundary={boundary}"}


def expected_hit(x, y):
    """Which wall the middle of a pixel of FIELDS sees, by similar triangles."""
    slope = ((x + 0.5 - 14.0) / 50.0, -(y + 0.5 - 17.5) / 40.0)
    if abs(3.0 * slope[0] - 0.2) < 0.3 and abs(3.0 * slope[1] - 0.4) < 0.3:
        return "near"
    return "far" if max(abs(4.0 * slope[0]), abs(4.0 * slope[1])) < 1.21 else None


HITS = [[expected_hit(x, y) for x in range(40)] for y in range(30)]


def test_drakes_depth_is_axial_in_metres_at_the_middle_of_each_pixel(server, model):
    body, headers = form(model, image_type="depth", min_depth="0.5", max_depth="8")
    status, answered, data = server.ask("POST", "/render", body, headers)
    assert status == 200 and answered["content-type"] == "image/tiff", data
    picture = Pillow.open(io.BytesIO(data))
    assert picture.mode == "F"
    depth = np.array(picture)
    expected = np.array([[{"near": 3.0, "far": 4.0, None: np.inf}[hit] for hit in row] for row in HITS])
    assert {3.0, 4.0, np.inf} == set(expected.ravel())
    assert (np.isinf(depth) == np.isinf(expected)).all()
    assert np.abs(depth[np.isfinite(expected)] - expected[np.isfinite(expected)]).max() < 1e-5


def test_drakes_depth_says_too_near_and_too_far_as_drake_does(server, model):
    body, headers = form(model, image_type="depth", min_depth="3.5", max_depth="3.9")
    depth = np.array(Pillow.open(io.BytesIO(server.ask("POST", "/render", body, headers)[2])))
    assert set(depth.ravel()) == {0.0, np.inf}
    assert all((depth[y, x] == 0.0) == (HITS[y][x] == "near") for y in range(30) for x in range(40))


def test_planes_of_the_form_clip(server, model):
    body, headers = form(model, image_type="depth", min_depth="0", max_depth="8", near="3.5", far="10")
    depth = np.array(Pillow.open(io.BytesIO(server.ask("POST", "/render", body, headers)[2])))
    assert set(np.round(depth[np.isfinite(depth)], 4)) == {4.0}


def test_drakes_labels_are_exact_and_white_where_nothing_is(server, model):
    body, headers = form(model, image_type="label")
    status, answered, data = server.ask("POST", "/render", body, headers)
    assert status == 200 and answered["content-type"] == "image/png", data
    labels = np.array(Pillow.open(io.BytesIO(data)))
    expected = np.array([[{**LABELS, None: (255, 255, 255)}[hit] for hit in row] for row in HITS])
    assert labels.shape == (30, 40, 3) and (labels == expected).all()


def test_drakes_colour_is_a_picture_of_the_size(server, model):
    body, headers = form(model)
    status, answered, data = server.ask("POST", "/render", body, headers)
    assert status == 200 and answered["content-type"] == "image/png", data
    picture = np.array(Pillow.open(io.BytesIO(data)).convert("RGB")).astype(int)
    assert picture.shape == (30, 40, 3)
    inside = [picture[y, x] for y in range(1, 29) for x in range(1, 39) if HITS[y][x] == "near" == HITS[y - 1][x] == HITS[y + 1][x]]
    assert np.mean(inside, axis=0).argmax() == 1  # its label's green


@pytest.mark.parametrize("name", ["image_type", "width", "height", "near", "far", "focal_x", "focal_y", "fov_x", "fov_y", "center_x", "center_y"])
def test_a_form_without_a_field_is_told_which(server, model, name):
    status, _, data = server.ask("POST", "/render", *form(model, **{name: None}))
    assert status == 400 and name in data.decode()


BAD_FIELDS = [{"image_type": "colour"}, {"width": "0"}, {"width": "-4"}, {"width": "4.5"}, {"width": "1_0"}, {"height": "x"}, {"near": "nan"}, {"near": "0"},
              {"far": "inf"}, {"near": "5", "far": "4"}, {"focal_x": "0"}, {"focal_y": "-3"}, {"center_x": "1e"}, {"fov_x": "no"}, {"width": "9" * 400},
              {"image_type": "depth"}, {"image_type": "depth", "min_depth": "2", "max_depth": "1"}, {"image_type": "depth", "min_depth": "-1", "max_depth": "1"},
              {"scene_sha256": "0" * 64}, {"focal_x": "1e-9"}, {"center_x": "1e9"}, {"near": "1e300", "far": "1e301"}]


@pytest.mark.parametrize("changes", BAD_FIELDS, ids=str)
def test_a_form_that_makes_no_sense_is_400(server, model, changes):
    status, answered, data = server.ask("POST", "/render", *form(model, **changes))
    assert status == 400 and answered["content-type"].startswith("text/plain"), (status, data)
    assert data.decode().startswith("cannot ") or "--" in data.decode()


def test_a_field_that_is_given_twice_is_400(server, model):
    body, headers = form(model, image_type="label")
    again = b"------boundary\r\nContent-Disposition: form-data; name=\"width\"\r\n\r\n41\r\n"
    status, _, data = server.ask("POST", "/render", again + body, headers)
    assert status == 400 and b"twice" in data


def test_a_form_that_is_no_form_is_400(server):
    headers = {"Content-Type": "multipart/form-data; boundary=x"}
    for body in (b"", b"\x00" * 100, b"--x", b"--x\r\n\r\n", b"--x\r\nContent-Disposition: form-data; name=\"scene\"; filename=\"a\"\r\n\r\nabc\r\n--x--\r\n"):
        assert server.ask("POST", "/render", body, headers)[0] == 400
    assert server.ask("POST", "/render", b"abc", {"Content-Type": "multipart/form-data"})[0] == 400
    assert server.ask("POST", "/render", b"abc", {"Content-Type": "text/plain"})[0] == 415
    assert server.ask("POST", "/render", b"abc")[0] == 415


def test_a_scene_that_is_none_is_400(server, model):
    for bad in (b"", b"glTF", b"{}", b"[" * 100000, model[:200], b"\xff" * 64, b'{"asset": {"version": "1.0"}}'):
        status, _, data = server.ask("POST", "/render", *form(bad))
        assert status == 400 and data, bad[:20]
    without = json.dumps({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}]}).encode()
    status, _, data = server.ask("POST", "/render", *form(without))
    assert status == 400 and b"camera" in data


def test_a_file_outside_of_the_upload_is_not_read(server, tmp_path):
    secret = tmp_path / "secret.bin"
    secret.write_bytes(np.array([[-1, -1, -2], [1, -1, -2], [0, 1, -2]], np.float32).tobytes())
    relative = os.path.relpath(secret, os.getcwd())
    for uri in (str(secret), secret.as_uri(), f"file:{secret}", relative, f"../../../../../..{secret}", f"%2e%2e/..{secret}", "http://127.0.0.1:1/a", "/proc/self/environ"):
        gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"camera": 0}],
                "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [{"uri": uri, "byteLength": 36}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, -2], "max": [1, 1, -2]}]}
        for body, headers in (form(json.dumps(gltf).encode()), form(json.dumps(gltf).encode(), image_type="label")):
            assert server.ask("POST", "/render", body, headers)[0] == 400, uri
        assert server.json("/render", {"model": gltf, "size": [8, 8], "spp": 1})[0] == 400, uri
        assert server.ask("POST", "/scenes", json.dumps(gltf))[0] == 400, uri
    for name in ("env", "shaders", "allow_external", "preset", "device"):
        assert server.json("/render", {"builtin": "cornell-box", "size": [8, 8], "spp": 1, name: str(secret)})[0] == 400, name
    for name in (str(secret), "../secret.bin", "/etc/passwd", "cornell-box\0", "dense-N", "dense-9"):
        assert server.json("/render", {"builtin": name})[0] == 404
        assert server.json("/scenes", {"builtin": name})[0] == 404


def test_paths_that_lead_nowhere_are_404(server):
    for path in ("/../_app.py", "/page/../_app.py", "/%2e%2e/_app.py", "/page.js/../../_app.py", "//etc/passwd", "/index.html", "/scenes/../about", "/_app.py",
                 "/scenes/x/picture.png", "/scenes/../picture.exr"):
        status, _, data = server.ask("GET", path)
        assert status == 404 and b"import" not in data, path
    assert server.ask("PUT", "/render")[0] == 405
    assert server.ask("GET", "/render")[0] == 405


# JSON.

def test_a_preview_has_the_bits_of_render(server):
    status, answered, data = server.json("/render", {"builtin": "cornell-box", "size": [24, 16], "spp": 3, "seed": 5, "exposure": 1})
    assert status == 200 and answered["content-type"] == "image/png"
    expected = lavalight.load("cornell-box").render(size=(24, 16), spp=3, seed=5, exposure=1)
    assert (np.array(Pillow.open(io.BytesIO(data)).convert("RGB")) == expected.pixels[:, :, :3]).all()


def test_models_come_as_base64_or_as_json(server, model):
    request = {"size": [16, 12], "spp": 1, "env": "white"}
    one = server.json("/render", {**request, "model": base64.b64encode(model).decode()})
    assert one[0] == 200, one
    other = server.json("/render", {**request, "model": as_gltf(model)})
    assert other[0] == 200 and other[2] == one[2]


def test_exr_and_jpeg_are_formats(server):
    request = {"builtin": "cornell-box", "size": [8, 8], "spp": 1}
    assert server.json("/render", {**request, "format": "exr"})[2][:4] == b"\x76\x2f\x31\x01"
    assert server.json("/render", {**request, "format": "jpeg"})[2][:2] == b"\xff\xd8"


BAD_REQUESTS = [{}, {"builtin": "cornell-box", "nothing": 1}, {"builtin": 3}, {"builtin": "cornell-box", "scene": "a"}, {"scene": 5}, {"model": "?"}, {"model": 7},
                {"builtin": "cornell-box", "size": 5}, {"builtin": "cornell-box", "size": [0, 4]}, {"builtin": "cornell-box", "size": [4, 4.5]},
                {"builtin": "cornell-box", "spp": 0}, {"builtin": "cornell-box", "spp": True}, {"builtin": "cornell-box", "every": 0}, {"builtin": "cornell-box", "every": "x"},
                {"builtin": "cornell-box", "format": "tga"}, {"builtin": "cornell-box", "env": "somewhere.hdr"}, {"builtin": "cornell-box", "env": [1, 2]},
                {"builtin": "cornell-box", "fov": 500, "size": [8, 8]}, {"builtin": "cornell-box", "layers": {}}, {"builtin": "cornell-box", "look_from": [0, "a", 0], "size": [8, 8]},
                {"builtin": "cornell-box", "no_clip": "yes"}, {"builtin": "cornell-box", "camera": "x" * 1000}, {"builtin": "cornell-box", "at": [[1]]}]


@pytest.mark.parametrize("request_", BAD_REQUESTS, ids=str)
def test_a_request_that_makes_no_sense_is_400(server, request_):
    status, answered, data = server.json("/render", request_)
    assert status == 400 and data.strip() and answered["content-type"].startswith("text/plain"), (status, data)


def test_json_that_is_none_is_400(server):
    for body in (b"", b"[]", b"7", b"{", b"[" * 50000, b'{"a": NaN}', b"\xff\xfe", b'{"size": 1e999}'):
        assert server.ask("POST", "/render", body, {"Content-Type": "application/json"})[0] == 400


def events_of(answer):
    for part in answer.decode().split("\n\n"):
        lines = dict(line.split(": ", 1) for line in part.splitlines() if not line.startswith(":"))
        if "event" in lines:
            yield lines["event"], json.loads(lines["data"])


def test_events_bring_a_picture_that_gets_better_and_ends_with_the_bits_of_render(server):
    status, answered, data = server.json("/render", {"builtin": "cornell-box", "size": [32, 32], "spp": 256, "every": 0.05}, Accept="text/event-stream")
    assert status == 200 and answered["content-type"].startswith("text/event-stream")
    events = list(events_of(data))
    pictures = [data for name, data in events if name == "picture"]
    counts = [picture["samples"] for picture in pictures]
    assert len(pictures) > 1 and counts == sorted(counts) and counts[-1] == 256
    assert events[-1][0] == "done" and events[-1][1]["ledger"] == {}
    last = np.array(Pillow.open(io.BytesIO(base64.b64decode(pictures[-1]["data"]))).convert("RGB"))
    assert (last == lavalight.load("cornell-box").render(size=(32, 32), spp=256).pixels[:, :, :3]).all()


def test_events_tell_of_failures(server):
    data = server.json("/render", {"builtin": "cornell-box", "size": [8, 8], "fov": 500}, Accept="text/event-stream")[2]
    name, error = list(events_of(data))[-1]
    assert name == "error" and error["status"] == 400 and "--fov" in error["message"]


def test_scenes_are_kept_rendered_and_forgotten(server, model):
    status, _, data = server.ask("POST", "/scenes", model, {"Content-Type": "model/gltf-binary"})
    scene = json.loads(data)
    assert status == 201 and scene["triangles"] == 4 and len(scene["cameras"]) == 1
    assert scene["cameras"][0]["forward"] == pytest.approx([0, 0, -1]) and scene["cameras"][0]["fov"] == pytest.approx(41)
    address = f"/scenes/{scene['scene']}/picture.png"
    assert server.ask("GET", address)[0] == 404  # no picture yet
    picture = server.json("/render", {"scene": scene["scene"], "size": [8, 8], "spp": 1})
    assert picture[0] == 200
    assert server.ask("GET", address)[2] == picture[2]
    assert server.ask("GET", address.replace("png", "exr"))[2][:4] == b"\x76\x2f\x31\x01"
    assert server.ask("GET", address.replace("png", "gif"))[0] == 404
    assert server.json("/render", {"scene": scene["scene"], "size": [8, 8], "spp": 1, "env": [2, 2, 2]})[2] != picture[2]
    assert server.ask("DELETE", f"/scenes/{scene['scene']}")[0] == 204
    assert server.json("/render", {"scene": scene["scene"], "size": [8, 8], "spp": 1})[0] == 404


# Limits.

LONG = {"builtin": "cornell-box", "size": [256, 256], "spp": 1000000}


def test_too_many_pixels_samples_or_bytes_are_413(server, model):
    assert server.json("/render", {"builtin": "cornell-box", "size": [1000, 1000]})[0] == 413
    assert server.json("/render", {"builtin": "cornell-box", "size": [10**30, 1]})[0] == 413
    assert server.json("/render", {"builtin": "cornell-box", "size": [8, 8], "spp": 2000000})[0] == 413
    assert server.ask("POST", "/render", *form(model, width="1000", height="1000"))[0] == 413
    assert server.ask("POST", "/render", *form(b"{" + b" " * 1200000 + b"}"))[0] == 413
    assert server.ask("POST", "/scenes", b" " * 1200000)[0] == 413
    head = b"POST /scenes HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
    assert server.raw(head + (b"10000\r\n" + b" " * 0x10000 + b"\r\n") * 20).startswith(b"HTTP/1.1 413")
    for length in (b"99999999999999999999", b"2000000"):
        assert server.raw(b"POST /scenes HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + length + b"\r\n\r\n").startswith(b"HTTP/1.1 413")


def test_a_render_that_takes_too_long_is_504(server):
    start = time.monotonic()
    assert server.json("/render", LONG)[0] == 504
    assert 2.5 < time.monotonic() - start < 7.0
    assert server.about()["requests"] == 0


def test_a_full_queue_is_503_and_says_when_to_come_again(server):
    answers = []
    threads = [threading.Thread(target=lambda: answers.append(server.json("/render", {**LONG, "seed": seed}))) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    statuses = sorted(status for status, _, _ in answers)
    assert statuses == [503, 503, 504, 504], statuses
    assert all(int(headers["retry-after"]) > 0 for status, headers, _ in answers if status == 503)


@pytest.mark.parametrize("accept", ["image/png", "text/event-stream"])
def test_a_client_that_goes_away_frees_its_render(guarded, accept):
    bearer = {"Authorization": f"Bearer {TOKEN}"}
    endless = {"builtin": "cornell-box", "size": [1024, 1024], "spp": 4096}  # until the limit of 120 seconds
    connection = http.client.HTTPConnection("127.0.0.1", guarded.port, timeout=30)
    connection.request("POST", "/render", json.dumps(endless), {"Content-Type": "application/json", "Accept": accept, **bearer})
    while not json.loads(guarded.ask("GET", "/about", headers=bearer)[2])["requests"]:
        time.sleep(0.02)
    time.sleep(0.5)
    connection.close()
    start = time.monotonic()
    assert guarded.json("/render", {"builtin": "cornell-box", "size": [8, 8], "spp": 1}, **bearer)[0] == 200
    assert time.monotonic() - start < 20.0
    assert json.loads(guarded.ask("GET", "/about", headers=bearer)[2])["requests"] == 0


# Who may ask.

def test_the_page_and_its_parts_are_there_and_ask_nobody_else(server):
    for path, kind in (("/", "text/html"), ("/page.js", "text/javascript"), ("/orbit.js", "text/javascript"), ("/page.css", "text/css"), ("/icon.svg", "image/svg+xml")):
        status, headers, data = server.ask("GET", path)
        assert status == 200 and headers["content-type"].startswith(kind)
        assert "default-src 'none'" in headers["content-security-policy"] and "unsafe" not in headers["content-security-policy"]
        assert headers["x-content-type-options"] == "nosniff" and headers["referrer-policy"] == "no-referrer"
        assert not re.search(rb"https?://(?!www\.w3\.org/2000/svg)", data), path
        assert b"style=" not in data and b" onclick" not in data


@pytest.mark.parametrize("host, status", [("127.0.0.1", 200), ("localhost:8000", 200), ("[::1]:80", 200), ("evil.example", 421), ("127.0.0.1.evil.example", 421),
                                          ("192.168.1.7", 421), ("", 400), ("a b", 400), ("user@localhost", 400), ("localhost/x", 400)])
def test_requests_for_another_host_are_refused(server, host, status):
    assert server.ask("GET", "/about", headers={"Host": host})[0] == status


def test_a_request_without_one_host_is_refused(server):
    assert server.raw(b"GET /about HTTP/1.1\r\nConnection: close\r\n\r\n").startswith(b"HTTP/1.1 400")
    assert server.raw(b"GET /about HTTP/1.0\r\n\r\n").startswith(b"HTTP/1.1 400")
    assert server.raw(b"GET /about HTTP/1.1\r\nHost: localhost\r\nHost: evil\r\nConnection: close\r\n\r\n").startswith(b"HTTP/1.1 400")


@pytest.mark.parametrize("origin, status", [("http://localhost", 200), ("http://evil.example", 403), ("null", 403), ("https://localhost", 200), ("http://localhost:81", 403),
                                            ("http://localhost.evil", 403), ("", 403)])
def test_requests_from_another_page_are_refused(server, origin, status):
    assert server.ask("GET", "/about", headers={"Host": "localhost", "Origin": origin})[0] == status
    assert server.ask("POST", "/render", "{}", {"Host": "localhost", "Origin": origin, "Content-Type": "application/json"})[0] == (400 if status == 200 else 403)


def test_a_token_is_asked_for_everywhere(guarded, model):
    for method, path in (("GET", "/"), ("GET", "/about"), ("POST", "/render"), ("POST", "/scenes"), ("GET", "/page.js"), ("GET", f"/{TOKEN[:-1]}/about"),
                         ("GET", f"/{TOKEN}x/about"), ("GET", f"/about/{TOKEN}"), ("GET", f"/about?token={TOKEN}")):
        status, headers, _ = guarded.ask(method, path)
        assert status == 401 and headers["www-authenticate"] == "Bearer", path
    assert guarded.ask("GET", "/about", headers={"Authorization": "Bearer " + TOKEN[::-1]})[0] == 401
    assert guarded.ask("GET", "/about", headers={"Authorization": f"Bearer {TOKEN}"})[0] == 200
    assert guarded.ask("GET", f"/{TOKEN}/about")[0] == 200
    assert guarded.ask("GET", f"/{TOKEN}/")[0] == 200
    status, headers, _ = guarded.ask("GET", f"/{TOKEN}")
    assert status == 307 and headers["location"] == f"/{TOKEN}/"
    status, _, data = guarded.ask("POST", f"/{TOKEN}/render", *form(model, image_type="label"))
    assert status == 200, data
    assert not any(TOKEN in line for line in guarded.log)


def parsed(*words, token=None, monkeypatch=None):
    return _command.settings_of(_command._parser().parse_args(words))


def test_an_address_that_others_reach_gets_a_token(monkeypatch):
    monkeypatch.delenv("LAVALIGHT_TOKEN", raising=False)
    assert parsed().token is None and parsed("--bind", "[::1]:80").token is None and parsed("--bind", "localhost:80").token is None
    made = {parsed("--bind", address).token for address in ("0.0.0.0:80", "[::]:80", "192.168.1.2:80", "robot:80")}
    assert len(made) == 4 and all(len(token) >= 32 for token in made)


def test_words_that_make_no_sense_are_refused(monkeypatch, tmp_path, capfd):
    monkeypatch.delenv("LAVALIGHT_TOKEN", raising=False)
    for words in (("--bind", "here"), ("--bind", "127.0.0.1:99999"), ("--max-pixels", "0"), ("--max-seconds", "nan"), ("--max-seconds", "inf"), ("--renders", "0"),
                  ("--max-waiting", "-1"), ("--spp", "0"), ("--token-file", str(tmp_path / "none"))):
        assert _command.main(words) == 2, words
    file = tmp_path / "token"
    for token in ("short", "with a blank in the middle", "slash/slash/slash/slash"):
        file.write_text(token)
        assert _command.main(("--token-file", str(file))) == 2
    file.write_text(TOKEN + "\n")
    assert parsed("--token-file", str(file)).token == TOKEN
    assert "lavalight: " in capfd.readouterr().err


def test_a_port_that_is_taken_is_told(capfd):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        assert _command.main(("--bind", f"127.0.0.1:{taken.getsockname()[1]}")) == 1
    assert "cannot listen at" in capfd.readouterr().err


def test_without_the_extra_the_command_says_what_to_install():
    code = "import sys\nsys.modules['uvicorn'] = None\nsys.argv = ['lavalight', 'serve']\nfrom lavalight.__main__ import main\nsys.exit(main())"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and "uvicorn is not installed" in done.stderr and "lavalight[serve]" in done.stderr


def test_the_program_says_where_the_server_is():
    program = Path(os.environ.get("LAVALIGHT_COMMAND", REPOSITORY / "build/release/lavalight"))
    if not program.is_file():
        pytest.skip("the command is not built")
    done = subprocess.run([program, "serve", "--bind", "127.0.0.1:8000"], capture_output=True, text=True)
    assert done.returncode == 1 and "cannot serve" in done.stderr and "python3 -m lavalight serve" in done.stderr


def test_ctrl_c_ends_a_server_that_renders():
    running = Running()
    thread = threading.Thread(target=lambda: running.json("/render", {**LONG, "spp": 4096, "size": [2048, 2048]}))
    thread.start()
    while not running.about()["requests"]:
        time.sleep(0.05)
    time.sleep(1.0)
    start = time.monotonic()
    assert running.end() == 0
    assert time.monotonic() - start < 6.0
    thread.join()


# The parts, without a server.

async def guard(settings, scope=None, messages=(), app=None):
    """The status of an answer behind the guard, and what the application read."""
    sent = []
    queue = list(messages) or [{"type": "http.request", "body": b""}]

    async def receive():
        message = queue.pop(0) if queue else None
        if message is None:
            await asyncio.sleep(3600)
        return message

    async def send(message):
        sent.append(message)

    async def answering(scope, receive, send):
        while (await receive()).get("more_body"):
            pass
        await send({"type": "http.response.start", "status": 200, "headers": []})

    whole = {"type": "http", "method": "POST", "path": "/render", "headers": [(b"host", b"localhost")], **(scope or {})}
    try:
        await Guard(app or answering, settings)(whole, receive, send)
    except Refusal as refusal:
        return refusal.status
    return sent[0]["status"] if sent else None


def test_names_of_the_machine_may_be_told():
    settings = Settings(host="0.0.0.0", names=("robot.example",))
    hosts = {"robot.example:8000": 200, "ROBOT.example": 200, "192.168.1.7": 200, "other.example": 421}
    for host, status in hosts.items():
        assert asyncio.run(guard(settings, {"headers": [(b"host", host.encode())]})) == status, host


def test_a_body_that_dribbles_is_408():
    limits = Limits(body=0.3, silence=0.1)

    async def dribble():
        sent = []

        async def receive():
            await asyncio.sleep(0.05)
            return {"type": "http.request", "body": b" ", "more_body": True}

        async def app(scope, receive, send):
            while True:
                await receive()

        try:
            await Guard(app, Settings(limits=limits))({"type": "http", "path": "/", "headers": [(b"host", b"localhost")]}, receive, sent.append)
        except Refusal as refusal:
            return refusal.status

    start = time.monotonic()
    assert asyncio.run(dribble()) == 408
    assert time.monotonic() - start < 1.0
    assert asyncio.run(guard(Settings(limits=limits), messages=[{"type": "http.request", "body": b" ", "more_body": True}])) == 408


def test_a_body_may_have_as_many_bytes_as_the_limit_and_no_more():
    settings = Settings(limits=Limits(bytes=10))
    for count, status in ((5, 200), (6, 413)):
        halves = [{"type": "http.request", "body": b"x" * 5, "more_body": True}, {"type": "http.request", "body": b"x" * count}]
        assert asyncio.run(guard(settings, messages=halves)) == status


def test_renders_come_in_the_order_they_were_asked_for():
    order = []

    async def ask():
        renders = Renders(Limits(renders=1, waiting=5))

        def work(number):
            return lambda job: (time.sleep(0.02), order.append(number))

        await asyncio.gather(*(renders.run(work(number)) for number in range(5)))
        assert renders.count == 0 and renders.ahead == 0

    asyncio.run(ask())
    assert order == [0, 1, 2, 3, 4]


def test_a_render_whose_client_has_gone_ends_before_the_next_begins():
    async def ask():
        renders = Renders(Limits(renders=1, waiting=5))
        running = threading.Event()
        ended = threading.Event()

        def endless(job):
            running.set()
            try:
                while True:
                    job.go_on()
                    time.sleep(0.005)
            finally:
                time.sleep(0.1)
                ended.set()

        first = asyncio.ensure_future(renders.run(endless))
        waiting = asyncio.ensure_future(renders.run(lambda job: pytest.fail("its client has gone")))
        await asyncio.to_thread(running.wait)
        waiting.cancel()
        first.cancel()
        assert await renders.run(lambda job: ended.is_set())
        assert renders.count == 0

    asyncio.run(ask())


def test_more_requests_than_may_wait_are_refused_and_places_come_back():
    async def ask():
        renders = Renders(Limits(renders=2, waiting=1))
        release = threading.Event()
        tasks = [asyncio.ensure_future(renders.run(lambda job: release.wait())) for _ in range(3)]
        await asyncio.sleep(0.05)
        with pytest.raises(Refusal) as refusal:
            await renders.run(lambda job: None)
        assert refusal.value.status == 503 and refusal.value.headers["Retry-After"]
        release.set()
        await asyncio.gather(*tasks)
        assert await renders.run(lambda job: 7) == 7

    asyncio.run(ask())


def test_work_that_cannot_be_stopped_is_answered_all_the_same_and_keeps_its_place():
    async def ask(monkey):
        renders = Renders(Limits(renders=1, waiting=5, seconds=0.1))
        renders.GRACE = 0.1
        release = threading.Event()
        with pytest.raises(Refusal) as refusal:
            await renders.run(lambda job: release.wait())
        assert refusal.value.status == 504 and renders.count == 1
        release.set()
        assert await renders.run(lambda job: 7) == 7

    asyncio.run(ask(None))


def test_a_server_that_stops_ends_its_renders_and_takes_no_more():
    async def ask():
        renders = Renders(Limits())
        running = threading.Event()

        def endless(job):
            running.set()
            while True:
                job.go_on()
                time.sleep(0.005)

        task = asyncio.ensure_future(renders.run(endless))
        await asyncio.to_thread(running.wait)
        renders.close()
        for work in (task, renders.run(lambda job: None)):
            with pytest.raises(Refusal) as refusal:
                await work
            assert refusal.value.status == 503

    asyncio.run(ask())


def test_scenes_that_nobody_asks_for_make_room():
    scenes = Scenes(Limits(scenes=2, idle=3600))
    kept = [KeptScene("model", b"", Limits()) for _ in range(3)]
    scenes.keep(kept[0])
    scenes.keep(kept[1])
    assert scenes.find(kept[0].key) is kept[0]
    scenes.keep(kept[2])
    with pytest.raises(Refusal):
        scenes.find(kept[1].key)
    assert scenes.find(kept[0].key) and scenes.find(kept[2].key)
    kept[0].used -= 4000
    with pytest.raises(Refusal) as refusal:
        scenes.find(kept[0].key)
    assert refusal.value.status == 404 and len(scenes) == 1


def test_too_many_triangles_are_413(model):
    with pytest.raises(Refusal) as refusal:
        KeptScene("model", model, Limits(triangles=3)).scene({})
    assert refusal.value.status == 413
    assert KeptScene("model", model, Limits(triangles=4)).scene({}).triangles == 4


def test_a_slow_client_gets_the_latest_picture_alone():
    latest = _preview.Latest(lambda: None)
    for number in range(3):
        latest.send("picture", {"samples": number})
    latest.send("done", {})
    assert latest.take() == [("picture", {"samples": 2}), ("done", {})]
    assert latest.take() == []


def test_drakes_world_is_turned_with_its_cameras():
    gltf = {"asset": {"version": "2.0"}, "scene": 1, "scenes": [{"nodes": [0]}, {"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"camera": 0}]}
    turned = json.loads(_drake.with_y_up(json.dumps(gltf).encode()))
    assert turned["scenes"][1]["nodes"] == [2] and turned["scenes"][0]["nodes"] == [0]
    matrix = np.array(turned["nodes"][2]["matrix"]).reshape(4, 4).T
    assert turned["nodes"][2]["children"] == [0, 1]
    assert (matrix @ [0, 0, 1, 1] == [0, 1, 0, 1]).all() and np.linalg.det(matrix) == 1.0
    for left_alone in (b"", b"{}", b"[1]", b"glTF", b"[" * 100000, b'{"nodes": 3, "scenes": [{}]}', b'{"scene": 9, "nodes": [], "scenes": []}'):
        assert _drake.with_y_up(left_alone) == left_alone


def test_members_that_drake_leaves_null_are_dropped(server, model):
    with_null = json.dumps({**as_gltf(model), "images": None}).encode()
    for changes in ({}, {"image_type": "label"}):
        assert server.ask("POST", "/render", *form(with_null, **changes))[0] == 200
    gltf = {"asset": {"version": "2.0"}, "images": None, "nodes": [{"name": None}]}
    assert json.loads(_drake.without_nulls(json.dumps(gltf).encode())) == {"asset": {"version": "2.0"}, "nodes": [{"name": None}]}
    for left_alone in (model, b"null", b"[null]", b"glTFnull"):
        assert _drake.without_nulls(left_alone) == left_alone


def test_a_glb_is_turned_too(model):
    turned = _drake.with_y_up(model)
    assert turned != model and struct.unpack_from("<I", turned, 8)[0] == len(turned)
    scene = KeptScene("model", turned, Limits()).scene({})
    low, high = scene.bounds
    assert low[1] == pytest.approx(-4.0) and high[1] == pytest.approx(-3.0)


def test_types_of_the_package_are_strict():
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "lavalight"], capture_output=True, text=True, cwd=REPOSITORY / "python")
    if "No module named mypy" in done.stderr:
        pytest.skip("mypy is not installed")
    assert done.returncode == 0, done.stdout + done.stderr


def test_what_is_not_http_is_400_though_more_comes(server):
    for data in (b"\x16\x03\x01" * 100000, b"GET / HTTP/9\r\n\r\n" + b"x" * 300000, b"GET\r\n\r\n"):
        assert server.raw(data).startswith(b"HTTP/1.1 400"), data[:20]
    head = b"POST /scenes HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
    assert server.raw(head + b"zz\r\n" + b"x" * 300000).startswith(b"HTTP/1.1 400")


def test_a_head_that_does_not_end_is_408_and_silence_ends():
    assert Connection.HEAD_SECONDS <= 30.0

    class Hasty(Connection):
        HEAD_SECONDS = 0.2

    async def ask(data, step=100):
        with socket.socket() as listening:
            listening.bind(("127.0.0.1", 0))
            running = uvicorn.Server(uvicorn.Config(PlainTextResponse("well"), http=Hasty, log_config=None, lifespan="off"))
            serving = asyncio.ensure_future(running.serve([listening]))
            while not running.started:
                await asyncio.sleep(0.01)
            reader, writer = await asyncio.open_connection(*listening.getsockname())
            answer = asyncio.ensure_future(reader.readline())
            for i in range(0, len(data), step):
                writer.write(data[i:i + step])
                await asyncio.wait({answer}, timeout=0.02)
            try:
                return await asyncio.wait_for(answer, 5.0)
            except ConnectionError:
                return b""
            finally:
                writer.close()
                running.should_exit = True
                await serving

    assert asyncio.run(ask(b"GET / HTTP/1.1\r\nHost: x", 1)).startswith(b"HTTP/1.1 408")
    assert asyncio.run(ask(b"")) == b""
    assert asyncio.run(ask(b"GET / HTTP/1.1\r\n\r\n")).startswith(b"HTTP/1.1 400")  # h11 wants a Host
    assert asyncio.run(ask(b"GET / HTTP/1.0\r\n\r\n")).startswith(b"HTTP/1.1 200")
