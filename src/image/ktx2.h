// Pictures in KTX 2.0 files: texels of 8 or 16 bits, and those of Basis Universal where its transcoder is
// built in.
#pragma once

#include <string_view>

#include "image/picture.h"

namespace lavalight {

// measurePicture and decodePicture for a KTX 2.0 file, of which the largest level is read.
[[nodiscard]] PictureSize measureKtx2(std::string_view bytes);
[[nodiscard]] Picture decodeKtx2(std::string_view bytes);

} // namespace lavalight
