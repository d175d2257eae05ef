"""The pixels of EXR files as Lavalight writes them, as bytes: whether two films are equal, whatever their headers say."""
import struct
from pathlib import Path


def pixel_bytes(path):
    """The compressed chunks of a scan-line file. Equal channels give equal bytes."""
    data = Path(path).read_bytes()
    magic, version = struct.unpack_from("<II", data)
    if magic != 20000630 or version >> 8 & ~0x4:  # single part, scan lines; 0x4 is long names
        raise ValueError(f"{path} is not a scan-line EXR file")
    at = 8
    while data[at]:  # attributes: name, type, size, value; an empty name ends them
        for _ in range(2):
            at = data.index(b"\0", at) + 1
        at += 4 + struct.unpack_from("<I", data, at)[0]
    first = struct.unpack_from("<Q", data, at + 1)[0]  # of the table of offsets
    return data[first:]
