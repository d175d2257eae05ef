"""A program of a user who wants types: mypy --strict must accept it."""
from pathlib import Path

import lavalight
import lavalight.distributed
import numpy as np


def main() -> None:
    scene = lavalight.load("cornell-box", env="studio")
    scene.materials["white"].roughness = 0.5
    image: lavalight.Image = scene.render(size=(64, 64), spp=4, layers=["normal"])
    mean: float = float(np.mean(image.rgb))
    normal = image.layers["normal"]
    print(mean, normal.shape, image.alpha is None)
    image.save(Path("out.png"))
    for better in scene.progressive(spp=16, every=0.1):
        print(better.complete)
    comparison: lavalight.Comparison = image.compare("golden.exr", flip=0.05)
    print(comparison.equal, comparison["rmse"])
    for table in lavalight.lab("dice", samples=1024):
        print(table.title, table.column("estimate"))
    built = lavalight.Scene([lavalight.Mesh(np.zeros((3, 3)))], [lavalight.Material()], lavalight.Camera(), [lavalight.Light()])
    print(built.bounds)
    merged: lavalight.Image = lavalight.merge([image.film_bytes(), "part.exr"], tonemap="agx")
    print(merged.report["ranges"], len(lavalight.pack("model.gltf")))
    for better in lavalight.distributed.progressive(scene, parts=8, every=1.0, spp=64):
        print(better.complete)
    for number, frame in lavalight.distributed.frames(scene, range(2), fps=12, in_order=True):
        frame.save(f"out_{number:04}.png")
    print(lavalight.distributed.render(scene, progress="bar", spp=64).samples)


if __name__ == "__main__":
    main()
