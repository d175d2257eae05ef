// What must hold of a JPEG before stb_image may see it.
#pragma once

#include <string_view>

namespace lavalight {

// Throws Error for files with which stb_image 2.27 would write past the end of its tables, or decode with
// tables and hand out pixels that it never set, which makes a picture of what was in memory before:
// - Huffman tables of more codes than the 256 that there is room for,
// - scans that use Huffman or quantisation tables which the file has not defined by then,
// - components without a scan, or whose first scan refines what is not there,
// - scans that end before all their restart intervals.
void requireSoundJpeg(std::string_view bytes);

} // namespace lavalight
