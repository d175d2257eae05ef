"""Views of files of the assets that benches render beside Cycles: what lights them, and what is seen from where."""
import os
from dataclasses import dataclass
from pathlib import Path


@dataclass
class View:
    """A file of the assets, the map that lights it (none: its own lights do), and the camera."""
    file: str
    environment: str | None
    look_from: str
    look_at: str
    fov: float  # vertical, degrees

    def options(self, size):
        """Camera and size as options of Lavalight, and of benches' ends in Blender."""
        return [f"--look-from={self.look_from}", f"--look-at={self.look_at}", f"--fov={self.fov}", f"--size={size}"]

    def files(self, assets):
        """The scene's file, and the map's if there is one."""
        return [assets / name for name in (self.file, self.environment) if name]

    def description(self, assets, size):
        """What cycles_scene.load() takes, as JSON can carry it."""
        return {"scene": str(assets / self.file), "environment": self.environment and str(assets / self.environment),
                "look_from": self.look_from, "look_at": self.look_at, "fov": self.fov, "size": size}


VENICE, SKY = "_env/venice_sunset_1k.hdr", "_env/qwantani_afternoon_puresky_1k.hdr"
VIEWS = {
    "WaterBottle": View("WaterBottle/glTF/WaterBottle.gltf", VENICE, "0.19,0.1,0.36", "0,0,0", 40),
    "FlightHelmet": View("FlightHelmet/glTF/FlightHelmet.gltf", VENICE, "0,0.36,1.2", "0,0.36,0", 38),
    "ToyCar": View("ToyCar/glTF/ToyCar.gltf", VENICE, "-0.0433,0.0236,0.0761", "0.0065,-0.0014,-0.0069", 23.5),
    "SheenChair": View("SheenChair/glTF/SheenChair.gltf", VENICE, "0.74,0.8,1.25", "0,0.34,0", 42),
    # The file's own camera; it has no light of its own: the sky comes in through the windows.
    "LivingRoom": View("LivingRoom-Bitterli/LivingRoom-Bitterli.glb", SKY, "5.1052,0.7311,-2.3179", "4.1434,0.8055,-2.0544", 58.7),
    # The file's own camera and sun.
    "Classroom": View("Classroom-Bitterli/Classroom-Bitterli.glb", None, "-1.6905,1.2716,5.8865", "-1.5392,1.2999,4.8985", 35.98),
}


def assets_folder():
    """The folder that LAVALIGHT_ASSETS names; None: it names none."""
    return Path(os.environ["LAVALIGHT_ASSETS"]).resolve() if os.environ.get("LAVALIGHT_ASSETS") else None
