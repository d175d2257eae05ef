// What must hold of an EXR's header before the C++ reader of OpenEXR 3.1 may see it. Its C reader, which
// needs no such shield, is no substitute: as of 3.1.5 it decompresses neither DWAA nor DWAB ("DWA/A
// decompression not yet implemented in C"), and two readers would be more code than this walk.
#pragma once

#include <filesystem>

namespace lavalight {

// The C++ reader allocates what an attribute claims, and for most types goes on where the value ends by its
// type, not by the size that is stated: hidden from the C reader, which goes by the size, a claim of 2 GB may
// follow. Throws Error, which does not name the file, unless sizes and types agree and all lies within the
// file, and for compressions that came after OpenEXR 3.1, by name.
void requireSaneAttributes(const std::filesystem::path& path);

} // namespace lavalight
