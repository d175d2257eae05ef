"""What the person who starts the server decides."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Limits:
    """What one client may ask for, and how many may ask."""

    bytes: int = 64 << 20  # of a request
    pixels: int = 4 << 20  # of an image: 2048 x 2048
    samples: int = 4096  # of a pixel
    triangles: int = 10_000_000  # of a scene: building its tree cannot be interrupted
    seconds: float = 120.0  # of a render, loading included
    renders: int = 1  # at once
    waiting: int = 16  # requests behind those
    scenes: int = 4  # that are kept for the page
    idle: float = 900.0  # seconds that a scene is kept without being asked for
    body: float = 60.0  # seconds that a request may take to arrive
    silence: float = 10.0  # seconds without a byte, while a request arrives
    connections: int = 256


@dataclass(frozen=True)
class Settings:
    """Where the server listens, who may ask, and what Drake's images are rendered with."""

    host: str = "127.0.0.1"
    port: int = 8000
    token: str | None = None  # in the path or a header of every request
    names: tuple[str, ...] = ()  # further names that the machine is known by
    samples: int = 64  # of Drake's colour images
    environment: str | None = None  # of Drake's colour images; None: the studio, where the scene has no light
    denoise: bool = False  # Drake's colour images
    limits: Limits = field(default_factory=Limits)
