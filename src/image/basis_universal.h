// Texels of Basis Universal (ETC1S and UASTC), by its own transcoder, which is an option of the build.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "image/ktx2_container.h"

namespace lavalight {

// Whether the transcoder is built in.
[[nodiscard]] bool hasBasisUniversal();

// Throws Error where it is not.
void requireBasisUniversal();

// Decodes the largest level of `file` into RGBA of 8 bits, rows from the top; `rgba` has four bytes a texel.
// `level` is the level without Zstandard. Both throw Error for damaged data.
void transcodeEtc1s(const Ktx2File& file, std::vector<uint8_t>& rgba);
void transcodeUastc(const Ktx2File& file, std::string_view level, std::vector<uint8_t>& rgba);

} // namespace lavalight
