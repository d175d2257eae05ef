// One stream of Draco's, decoded into no more memory than it can be worth.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include <draco/mesh/mesh.h>

namespace lavalight {

// The number of triangles that the head of a stream states. Throws Error, which names no object, where it is
// no mesh of bitstream 2.2, the one that the extension is written for, or states more than its bytes can
// hold.
[[nodiscard]] uint64_t statedTriangles(std::string_view stream);

// Throws Error for a stream that is damaged, and before it allocates the values of attributes that would take
// more memory than there is, or than a stream of this size can fill.
[[nodiscard]] std::unique_ptr<draco::Mesh> decodeDracoStream(std::string_view stream);

} // namespace lavalight
