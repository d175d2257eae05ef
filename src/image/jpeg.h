// JPEG files, decoded by libjpeg-turbo.
#pragma once

#include <string_view>

#include "image/picture.h"

namespace lavalight {

// Whether bytes begin as a JPEG does.
[[nodiscard]] bool isJpeg(std::string_view bytes);

// measurePicture and decodePicture for a JPEG: baseline or progressive, of 8 bits a channel, grey, RGB,
// YCbCr, CMYK or YCCK. Inks are taken as Adobe's programs store them, inverted, which is what browsers do. A
// file that is damaged in a way that libjpeg passes over (cut short, or with bits that are no code) is
// decoded as far as it goes, and the picture's `damage` says so.
[[nodiscard]] PictureSize measureJpeg(std::string_view bytes);
[[nodiscard]] Picture decodeJpeg(std::string_view bytes);

} // namespace lavalight
