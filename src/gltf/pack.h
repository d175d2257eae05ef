// A glTF file and all that it refers to, as one .glb.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lavalight {

struct PackedScene {
    std::string glb;                   // the file's bytes
    std::vector<std::string> warnings; // pictures that cannot be had, one a line
};

// Moves buffers and pictures into the BIN chunk of a .glb, so that the file can travel alone. Nothing is
// decoded: importing the result gives the scene that importing `path` gives, to the bit. A .glb that refers
// to nothing comes back as it is. `allowsExternal`: files outside the scene's folder may be read. Throws
// Error as importGltf does, and for more than the 4 GiB that a .glb can hold.
[[nodiscard]] PackedScene packGltf(const std::filesystem::path& path, bool allowsExternal = false);

} // namespace lavalight
