// Images to write, and what is expected of files that are refused, for the tests of EXR files.
#pragma once

#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "image/exr.h"

namespace lavalight::test {

// Every exponent of float occurs, and zero, the smallest subnormal and the largest value.
inline Rendering sampleRendering(uint32_t width, uint32_t height) {
    std::mt19937 generator(7);
    Rendering rendering{Image(width, height), Image(width, height), {}};
    for (size_t i = 0; i < rendering.radiance().pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            rendering.radiance().pixels[i][c] =
                std::bit_cast<float>(static_cast<uint32_t>(generator() % 0x7f800000u));
            rendering.variance().pixels[i][c] = std::ldexp(1.0f, static_cast<int>(generator() % 60) - 30);
        }
        rendering.sampleCounts.push_back(static_cast<uint32_t>(generator()));
    }
    rendering.radiance().pixels.front() = {0.0f, std::numeric_limits<float>::denorm_min(),
                                           std::numeric_limits<float>::max()};
    return rendering;
}

// The message with which readExr refuses a file; empty if it does not.
inline std::string readError(const std::filesystem::path& path) {
    try {
        (void)readExr(path);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

inline void expectOneLineNaming(const std::string& message, const std::filesystem::path& path) {
    EXPECT_TRUE(message.starts_with("cannot read " + path.string() + ": ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

// The folder of real assets; tests that need it are skipped without.
inline std::filesystem::path assetFolder() {
    const char* folder = std::getenv("LAVALIGHT_ASSETS");
    return folder == nullptr ? std::filesystem::path() : std::filesystem::path(folder);
}

} // namespace lavalight::test
