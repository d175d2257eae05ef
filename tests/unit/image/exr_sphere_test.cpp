// Environment maps in OpenEXR: windows that differ, cubes, and compressions that came later.
#include "image/exr_sphere.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "image/environment_file.h"
#include "image/exr.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

using Imath::Box2i;
using ColorAt = std::function<glm::vec3(int x, int y)>; // by coordinates of the file

const std::string kField = std::string(LAVALIGHT_SOURCE_DIR) + "/tests/field/";

// A colour that tells its pixel.
glm::vec3 ownColor(int x, int y) {
    return {static_cast<float>(x + 100), static_cast<float>(y + 100), 0.5f};
}

class ExrSphere : public testing::Test {
  protected:
    void write(const Box2i& display, const Box2i& data, std::optional<Imf::Envmap> kind,
               const ColorAt& colorAt = ownColor) const {
        Imf::Header header(display, data);
        if (kind)
            Imf::addEnvmap(header, *kind);
        const int width = data.max.x - data.min.x + 1;
        std::vector<glm::vec3> pixels;
        for (int y = data.min.y; y <= data.max.y; ++y)
            for (int x = data.min.x; x <= data.max.x; ++x)
                pixels.push_back(colorAt(x, y));
        Imf::FrameBuffer buffer;
        for (int c = 0; c < 3; ++c) {
            const std::string name(1, "RGB"[c]);
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, &pixels.front()[c], data, sizeof(glm::vec3),
                                                 sizeof(glm::vec3) * static_cast<size_t>(width)));
        }
        Imf::OutputFile file((folder_ / "map.exr").c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(data.max.y - data.min.y + 1);
    }

    [[nodiscard]] Image read() const { return readEnvironmentFile(folder_ / "map.exr").image; }

    void expectRefusal(const std::string& text) const {
        try {
            (void)read();
            ADD_FAILURE() << "was read, instead of: " << text;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("map.exr"), std::string::npos) << error.what();
        }
    }

    const TemporaryFolder folder_;
};

TEST_F(ExrSphere, PixelsOutsideOfTheDataWindowAreBlack) {
    struct Windows {
        Box2i display;
        Box2i data;
    };
    const std::vector<Windows> all = {{{{0, 0}, {15, 7}}, {{4, 2}, {11, 5}}},    // inside
                                      {{{0, 0}, {15, 7}}, {{0, 2}, {15, 7}}},    // a border at the top
                                      {{{0, 0}, {15, 7}}, {{-3, -2}, {6, 3}}},   // partly outside
                                      {{{0, 0}, {15, 7}}, {{-3, -2}, {20, 12}}}, // all around
                                      {{{-8, -4}, {7, 3}}, {{-8, -1}, {2, 3}}},  // negative minima
                                      {{{100, 200}, {115, 207}}, {{115, 207}, {118, 211}}}}; // a corner
    for (const auto& [display, data] : all) {
        write(display, data, std::nullopt);
        const Image map = read();
        ASSERT_EQ(map.width, 16u);
        ASSERT_EQ(map.height, 8u);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 16; ++x) {
                const Imath::V2i place = display.min + Imath::V2i(x, y);
                const glm::vec3 right = data.intersects(place) ? ownColor(place.x, place.y) : glm::vec3(0.0f);
                EXPECT_EQ(map.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y)),
                          glm::max(right, glm::vec3(0.0f)))
                    << x << " " << y;
            }
    }
}

TEST_F(ExrSphere, CroppedFileOfTheFieldKeepsItsPlace) {
    const Image map = readEnvironmentFile(kField + "crop.exr").image;
    ASSERT_EQ(map.width, 32u);
    ASSERT_EQ(map.height, 16u);
    const Image data = readExr(kField + "crop.exr").radiance(); // 24 x 12 from (8, 4)
    for (uint32_t y = 0; y < 16; ++y)
        for (uint32_t x = 0; x < 32; ++x)
            EXPECT_EQ(map.at(x, y), x < 8 || y < 4 ? glm::vec3(0.0f) : data.at(x - 8, y - 4));
}

// OpenEXR's "Environment Maps": where the attribute is, the data window is the map.
TEST_F(ExrSphere, DataWindowIsTheMapWhereTheAttributeSaysThatThereIsOne) {
    write({{0, 0}, {15, 7}}, {{4, 2}, {11, 5}}, Imf::ENVMAP_LATLONG);
    const Image map = read();
    EXPECT_EQ(map.width, 8u);
    EXPECT_EQ(map.height, 4u);
    EXPECT_EQ(map.at(0, 0), ownColor(4, 2));
}

TEST_F(ExrSphere, WindowsThatDoNotMeetAndDisplayWindowsWithoutEndAreRefused) {
    write({{0, 0}, {15, 7}}, {{16, 0}, {20, 7}}, std::nullopt);
    expectRefusal("lie outside of its display window");
    write({{0, 0}, {16384, 7}}, {{0, 0}, {3, 3}}, std::nullopt);
    expectRefusal("16384");
}

// A direction in OpenEXR's axes, by the convention of its latitude-longitude maps.
glm::vec3 directionOf(double u, double v) {
    const double longitude = -2.0 * std::numbers::pi * (u - 0.5);
    const double latitude = std::numbers::pi * (0.5 - v);
    return {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
            std::cos(longitude) * std::cos(latitude)};
}

// The faces one below another are +X, -X, +Y, -Y, +Z, -Z.
TEST_F(ExrSphere, FacesOfACubeLieWhereOpenExrHasThem) {
    constexpr int kSide = 8;
    const Box2i window({0, 0}, {kSide - 1, 6 * kSide - 1});
    write(window, window, Imf::ENVMAP_CUBE, [](int, int y) {
        const int face = y / kSide;
        return glm::vec3(static_cast<float>(face));
    });
    const Image map = read();
    ASSERT_EQ(map.width, 32u);
    ASSERT_EQ(map.height, 16u);
    EXPECT_EQ(map.at(8, 8).x, 0.0f);  // +X, a quarter turn to the left of the middle
    EXPECT_EQ(map.at(24, 8).x, 1.0f); // -X
    EXPECT_EQ(map.at(3, 0).x, 2.0f);  // +Y, the top
    EXPECT_EQ(map.at(3, 15).x, 3.0f); // -Y
    EXPECT_EQ(map.at(16, 8).x, 4.0f); // +Z, the middle
    EXPECT_EQ(map.at(0, 8).x, 5.0f);  // -Z
    EXPECT_EQ(map.at(31, 8).x, 5.0f);
}

TEST_F(ExrSphere, CubeShowsInEveryDirectionWhatItHoldsThere) {
    constexpr int kSide = 64;
    const Box2i window({0, 0}, {kSide - 1, 6 * kSide - 1});
    // Faces are stored turned or mirrored: a pixel of a face lies where the library says.
    Image faces(kSide, 6 * kSide);
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < kSide * kSide; ++i) {
            const int row = i / kSide;
            const Imath::V2f inFace(static_cast<float>(i % kSide), static_cast<float>(row));
            const Imath::V3f d = Imf::CubeMap::direction(Imf::CubeMapFace(face), window, inFace).normalized();
            const Imath::V2f at = Imf::CubeMap::pixelPosition(Imf::CubeMapFace(face), window, inFace);
            faces.pixels[static_cast<size_t>(std::lround(at.y * kSide + at.x))] =
                glm::vec3(d.x, d.y, d.z) * 0.5f + 0.5f;
        }
    write(window, window, Imf::ENVMAP_CUBE,
          [&](int x, int y) { return faces.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y)); });
    const Image map = read();
    float largest = 0.0f;
    for (uint32_t y = 0; y < map.height; ++y)
        for (uint32_t x = 0; x < map.width; ++x) {
            const glm::vec3 right = directionOf((x + 0.5) / map.width, (y + 0.5) / map.height);
            largest = std::max(largest, glm::length(map.at(x, y) - (right * 0.5f + 0.5f)));
        }
    EXPECT_LT(largest, 2e-3f); // a pixel spans 0.025
}

TEST_F(ExrSphere, CubeOfOnePixelAFaceIsRead) {
    const Box2i window({0, 0}, {0, 5});
    write(window, window, Imf::ENVMAP_CUBE, [](int, int y) { return glm::vec3(static_cast<float>(y)); });
    EXPECT_EQ(read().width, 4u);
}

TEST_F(ExrSphere, CubesWithoutSquareFacesAreRefusedByName) {
    try {
        (void)readEnvironmentFile(kField + "cube.exr");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("cube map, and its 32 x 16 pixels are not six squares"),
                  std::string::npos)
            << error.what();
    }
}

TEST_F(ExrSphere, CompressionsThatCameLaterAreNamed) {
    for (const int method : {10, 11, 12, 255}) {
        write({{0, 0}, {3, 3}}, {{0, 0}, {3, 3}}, std::nullopt);
        std::string bytes = readFile(folder_ / "map.exr");
        const std::string attribute("compression\0compression\0\1\0\0\0", 28);
        bytes.at(bytes.find(attribute) + attribute.size()) = static_cast<char>(method);
        writeFileAtomically(folder_ / "map.exr", bytes);
        expectRefusal("its compression, number " + std::to_string(method) +
                      (method < 12 ? " (HTJ2K), is not supported" : ", is not supported"));
    }
}

} // namespace
} // namespace lavalight::test
