// What must hold of a JPEG before stb_image may see it.
#pragma once

#include <string_view>

namespace lavalight {

// Throws Error for a file whose Huffman tables state more codes than the 256 that stb_image 2.27 has room
// for: it would write past the end of its own.
void requireSoundJpeg(std::string_view bytes);

} // namespace lavalight
