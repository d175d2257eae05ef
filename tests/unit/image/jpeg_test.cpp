// Tests of JPEGs: what they look like, what is damaged but can be shown, what is refused by its header.
#include "image/jpeg.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <stb_image.h>
#include <turbojpeg.h>

#include "base/error.h"

namespace lavalight::test {
namespace {

constexpr int kWidth = 83; // no multiple of a block
constexpr int kHeight = 61;

// Smooth colours and a few edges, RGBA, or inverted inks.
std::vector<uint8_t> texelsOfOurs() {
    std::vector<uint8_t> texels;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const bool isInside = std::hypot(x - 40.0, y - 30.0) < 20.0;
            texels.push_back(static_cast<uint8_t>(isInside ? 230 : 3 * x));
            texels.push_back(static_cast<uint8_t>(4 * y));
            texels.push_back(static_cast<uint8_t>(isInside ? 20 : 128 + 60 * std::sin(0.1 * (x + y))));
            texels.push_back(255);
        }
    }
    return texels;
}

std::string encode(const std::vector<uint8_t>& texels, int format, int subsampling, int flags) {
    const std::unique_ptr<void, int (*)(tjhandle)> encoder(tjInitCompress(), tjDestroy);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    EXPECT_EQ(tjCompress2(encoder.get(), texels.data(), kWidth, 0, kHeight, format, &bytes, &size,
                          subsampling, 95, flags),
              0);
    std::string jpeg(reinterpret_cast<const char*>(bytes), size);
    tjFree(bytes);
    return jpeg;
}

std::string jpegOfOurs(int flags = 0) {
    return encode(texelsOfOurs(), TJPF_RGBX, TJSAMP_444, flags);
}

std::vector<uint8_t> decodedByStb(const std::string& jpeg) {
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(jpeg.data()), static_cast<int>(jpeg.size()),
                              &width, &height, &channels, 4),
        stbi_image_free);
    return texels ? std::vector<uint8_t>(texels.get(), texels.get() + width * height * 4)
                  : std::vector<uint8_t>();
}

int largestDifference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
    int largest = a.size() == b.size() ? 0 : 1000;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

double meanDifference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
    double sum = 0.0;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        sum += std::abs(a[i] - b[i]);
    return sum / static_cast<double>(a.size());
}

std::string errorOf(const std::string& bytes) {
    try {
        (void)decodeJpeg(bytes);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(Jpeg, EverySubsamplingShowsThePictureThatAnotherDecoderShows) {
    for (const int flags : {0, TJFLAG_PROGRESSIVE}) {
        for (const int subsampling : {TJSAMP_444, TJSAMP_422, TJSAMP_420, TJSAMP_GRAY, TJSAMP_440}) {
            const std::string jpeg = encode(texelsOfOurs(), TJPF_RGBX, subsampling, flags);
            const Picture picture = decodeJpeg(jpeg);
            EXPECT_EQ(picture.width, uint32_t{kWidth});
            EXPECT_EQ(picture.height, uint32_t{kHeight});
            EXPECT_EQ(picture.damage, "");
            // Colours halfway between those of 4:2:2 are rounded otherwise, by 1 in Cb and Cr each.
            const int rounding = subsampling == TJSAMP_422 ? 4 : 2;
            EXPECT_LE(largestDifference(picture.bytes, decodedByStb(jpeg)), rounding)
                << subsampling << " " << flags;
            EXPECT_LT(meanDifference(picture.bytes, decodedByStb(jpeg)), 0.5) << subsampling;
            const double error = meanDifference(picture.bytes, texelsOfOurs());
            EXPECT_TRUE(subsampling == TJSAMP_GRAY || error < 6.0) << subsampling << ": " << error;
        }
    }
}

TEST(Jpeg, InksOfAdobesProgramsAreLight) {
    std::vector<uint8_t> inks = texelsOfOurs(); // inverted: 255 is none
    for (size_t i = 3; i < inks.size(); i += 4)
        inks[i] = static_cast<uint8_t>(255 - i / 4 % 100);
    const std::string jpeg = encode(inks, TJPF_CMYK, TJSAMP_444, 0);
    const Picture picture = decodeJpeg(jpeg);
    EXPECT_LE(largestDifference(picture.bytes, decodedByStb(jpeg)), 2);
    std::vector<uint8_t> light = inks;
    for (size_t i = 0; i < light.size(); ++i)
        light[i] = i % 4 == 3 ? uint8_t{255} : static_cast<uint8_t>(inks[i] * inks[i | 3u] / 255);
    EXPECT_LT(meanDifference(picture.bytes, light), 6.0);
}

TEST(Jpeg, WithoutItsEndMarkerIsShownAndSaysSo) {
    const std::string jpeg = jpegOfOurs();
    ASSERT_EQ(jpeg.substr(jpeg.size() - 2), "\xFF\xD9");
    const Picture picture = decodeJpeg(jpeg.substr(0, jpeg.size() - 2));
    EXPECT_EQ(picture.damage, "Premature end of JPEG file");
    EXPECT_EQ(picture.bytes, decodeJpeg(jpeg).bytes);
}

TEST(Jpeg, CutInHalfShowsItsUpperPartAndSaysSo) {
    const std::string jpeg = jpegOfOurs();
    const Picture whole = decodeJpeg(jpeg);
    const Picture cut = decodeJpeg(jpeg.substr(0, jpeg.size() / 2));
    EXPECT_NE(cut.damage, "");
    constexpr size_t kRow = size_t{4} * kWidth;
    EXPECT_TRUE(std::equal(cut.bytes.begin(), cut.bytes.begin() + 16 * kRow, whole.bytes.begin()));
    EXPECT_NE(cut.bytes, whole.bytes);
}

TEST(Jpeg, EveryFlippedByteIsAnErrorOrTheSamePictureTwice) {
    for (const int flags : {0, TJFLAG_PROGRESSIVE}) {
        const std::string jpeg = jpegOfOurs(flags);
        for (size_t i = 2; i < jpeg.size(); i += i < 700 ? 1 : 37) {
            std::string damaged = jpeg;
            damaged[i] = static_cast<char>(damaged[i] ^ 0x15);
            const std::string error = errorOf(damaged);
            if (error.empty()) {
                EXPECT_EQ(decodeJpeg(damaged).bytes, decodeJpeg(damaged).bytes) << i;
            } else {
                EXPECT_TRUE(error.starts_with("it ")) << error;
            }
        }
    }
}

TEST(Jpeg, CutInItsHeaderIsRefused) {
    const std::string jpeg = jpegOfOurs();
    const size_t scan = jpeg.find("\xFF\xDA");
    for (const size_t length : {size_t{2}, size_t{10}, scan / 2, scan})
        EXPECT_TRUE(errorOf(jpeg.substr(0, length)).starts_with("it is damaged (")) << length;
}

// Where the frame states its height and width.
std::string withSize(std::string jpeg, uint32_t width, uint32_t height) {
    const size_t at = jpeg.find("\xFF\xC0") + 5;
    for (const uint32_t side : {height, width})
        for (const unsigned shift : {8u, 0u})
            jpeg[at + (side == height && shift == 8 ? 0
                       : side == height             ? 1
                       : shift == 8                 ? 2
                                                    : 3)] = static_cast<char>(side >> shift);
    return jpeg;
}

TEST(Jpeg, MoreTexelsThanItsBytesCanHoldAreRefusedByTheHeader) {
    const std::string jpeg = jpegOfOurs();
    EXPECT_EQ(errorOf(withSize(jpeg, 65000, 64000)),
              "it has 65000 x 64000 texels, at most 134217728 are supported: scale it down");
    EXPECT_EQ(errorOf(withSize(jpeg, 10000, 9000)),
              "it is damaged: 10000 x 9000 texels cannot be in " + std::to_string(jpeg.size()) + " bytes");
    EXPECT_NE(errorOf(withSize(jpeg, 0, 60)), "");
}

// Each scan passes over the whole picture, in a dozen bytes of the file.
TEST(Jpeg, HundredsOfScansAreRefused) {
    std::string jpeg = jpegOfOurs(TJFLAG_PROGRESSIVE);
    const std::string scan = jpeg.substr(jpeg.rfind("\xFF\xDA"), jpeg.size() - 2 - jpeg.rfind("\xFF\xDA"));
    jpeg.resize(jpeg.size() - 2);
    for (int i = 0; i < 510; ++i)
        jpeg += scan;
    const std::string error = errorOf(jpeg + "\xFF\xD9");
    EXPECT_NE(error.find("more than 500 scans"), std::string::npos) << error;
}

} // namespace
} // namespace lavalight::test
