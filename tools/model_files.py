"""The glTF files of a folder."""

MODELS = (".gltf", ".glb")
SKIPPED_FOLDERS = ("invalid",)  # malformed on purpose: they belong to the tests


def models_of(folder):
    """Paths below `folder`, whatever the letters' case, without what is malformed on purpose."""
    found = (path.relative_to(folder) for path in folder.rglob("*") if path.suffix.lower() in MODELS and path.is_file())
    return sorted((path for path in found if not set(path.parts[:-1]) & set(SKIPPED_FOLDERS)),
                  key=lambda path: [part.casefold() for part in path.parts])
