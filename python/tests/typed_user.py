"""A program of a user who wants types: mypy --strict must accept it."""
from pathlib import Path

import lavalight
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


if __name__ == "__main__":
    main()
