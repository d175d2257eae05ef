// Tests of textures: from a file's images, samplers and transforms to pictures and rows.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "image/basis_universal.h"
#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

// 2 x 1 texels: red, and (0, 128, 255).
constexpr const char* kPng =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR4nGP4z8DA0PAfAAgA"
    "An+cRUBOAAAAAElFTkSuQmCC";
constexpr const char* kWebp =
    "data:image/webp;base64,UklGRiAAAABXRUJQVlA4TBMAAAAvAQAAAA8wgPs///MfWqhARP8DAA==";
// 1 x 1 texel of 16 bits a channel: (0x1234, 0x8000, 0xffff).
constexpr const char* kPng16 =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAIAAADA54+dAAAAD0lEQVR42mMQMmlg+P8fAAZ0AsXcUeSkAAAAAElFTkSu"
    "QmCC";
// A file whose header claims 16384 x 16384 texels.
constexpr const char* kBomb =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAQAAAAEAACAYAAACpyBCEAAAAC0lEQVR4nGNgQAUAABAAATm9j2UAAAAASUVORK5CYII=";

// 8 x 8 texels of a grey of 200, without the last two bytes, which mark the end.
constexpr const char* kJpegWithoutEnd =
    "data:image/jpeg;base64,"
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMU"
    "FRUVDA8XGBYUGBIUFRT/wAALCAAIAAgBAREA/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8QAtRAAAgEDAwIEAwUF"
    "BAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVFVW"
    "V1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi"
    "4+Tl5ufo6erx8vP09fb3+Pn6/9oACAEBAAA/APsCvw==";

// A triangle whose base colour is `textureInfo`; texture i shows image i.
GltfBuilder textured(Json textureInfo, const std::vector<std::string>& images) {
    GltfBuilder builder;
    const int mesh = builder.addTriangle();
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", std::move(textureInfo)}}}}};
    for (size_t i = 0; i < images.size(); ++i) {
        builder.json["images"].push_back({{"uri", images[i]}});
        builder.json["textures"].push_back({{"source", i}});
    }
    builder.addNode({{"mesh", mesh}});
    return builder;
}

const Texture& baseColorOf(const Scene& scene) {
    return scene.materials.at(0).texture(TextureSlot::baseColor).value();
}

TEST(GltfTexture, PngBecomesRgbaFromTheTopLeft) {
    const Scene scene = textured({{"index", 0}}, {kPng}).import();
    ASSERT_EQ(scene.pictures.size(), 1u);
    const Picture& picture = scene.pictures[0];
    EXPECT_EQ(picture.width, 2u);
    EXPECT_EQ(picture.height, 1u);
    EXPECT_FALSE(picture.is16Bit);
    EXPECT_EQ(picture.bytes, (std::vector<uint8_t>{255, 0, 0, 255, 0, 128, 255, 255}));
    EXPECT_TRUE(baseColorOf(scene).isSrgb);
}

TEST(GltfTexture, SixteenBitsAChannelAreKept) {
    const Scene scene = textured({{"index", 0}}, {kPng16}).import();
    const Picture& picture = scene.pictures.at(0);
    ASSERT_TRUE(picture.is16Bit);
    ASSERT_EQ(picture.bytes.size(), 8u);
    uint16_t texel[4];
    std::memcpy(texel, picture.bytes.data(), sizeof texel);
    EXPECT_EQ(texel[0], 0x1234);
    EXPECT_EQ(texel[1], 0x8000);
    EXPECT_EQ(texel[2], 0xffff);
    EXPECT_EQ(texel[3], 0xffff);
}

TEST(GltfTexture, WebpGoesBeforeThePlainSource) {
    GltfBuilder builder = textured({{"index", 0}}, {kPng16, kWebp});
    builder.json["textures"][0]["extensions"] = {{"EXT_texture_webp", {{"source", 1}}}};
    const Scene scene = builder.import();
    ASSERT_EQ(scene.pictures.size(), 1u);
    EXPECT_EQ(scene.pictures[0].bytes, (std::vector<uint8_t>{255, 0, 0, 255, 0, 128, 255, 255}));
    EXPECT_EQ(warningsWith(scene, "EXT_texture_webp"), 0);
}

TEST(GltfTexture, SamplersAreRead) {
    GltfBuilder builder = textured({{"index", 0}}, {kPng});
    EXPECT_EQ(baseColorOf(builder.import()).wrapU, Wrap::repeat);
    EXPECT_FALSE(baseColorOf(builder.import()).isNearest);
    builder.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    builder.json["textures"][0]["sampler"] = 0;
    const Scene scene = builder.import();
    EXPECT_EQ(baseColorOf(scene).wrapU, Wrap::clamp);
    EXPECT_EQ(baseColorOf(scene).wrapV, Wrap::mirror);
    EXPECT_TRUE(baseColorOf(scene).isNearest);
}

TEST(GltfTexture, TransformScalesThenTurnsThenMoves) {
    const double angle = 0.3;
    const Json transform = {
        {"offset", {0.5, -2.0}}, {"rotation", angle}, {"scale", {3.0, 0.25}}, {"texCoord", 1}};
    const Scene scene =
        textured({{"index", 0}, {"texCoord", 0}, {"extensions", {{"KHR_texture_transform", transform}}}},
                 {kPng})
            .import();
    const Texture& texture = baseColorOf(scene);
    EXPECT_EQ(texture.uvSet, 1u);
    const glm::dvec2 uv(0.7, 0.2);
    const glm::dvec2 scaled = uv * glm::dvec2(3.0, 0.25);
    const glm::vec3 corner(uv, 1.0);
    EXPECT_NEAR(glm::dot(texture.uRow, corner), std::cos(angle) * scaled.x + std::sin(angle) * scaled.y + 0.5,
                1e-6);
    EXPECT_NEAR(glm::dot(texture.vRow, corner), std::cos(angle) * scaled.y - std::sin(angle) * scaled.x - 2.0,
                1e-6);
}

TEST(GltfTexture, PictureOfManyMaterialsIsDecodedOnce) {
    GltfBuilder builder = textured({{"index", 0}}, {kPng16, kPng});
    builder.json["materials"][0]["normalTexture"] = {{"index", 1}, {"scale", 0.5}};
    builder.json["materials"].push_back({{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 1}}}});
    const Scene scene = builder.import();
    EXPECT_EQ(scene.pictures.size(), 2u);
    const Material& first = scene.materials.at(0);
    EXPECT_FALSE(first.texture(TextureSlot::normal)->isSrgb);
    EXPECT_FLOAT_EQ(first.normalScale, 0.5f);
    EXPECT_EQ(first.texture(TextureSlot::normal)->picture,
              scene.materials.at(1).texture(TextureSlot::emission)->picture);
    EXPECT_TRUE(scene.materials.at(1).texture(TextureSlot::emission)->isSrgb);
}

// kBomb also shows that the size is checked before memory is taken.
TEST(GltfTexture, UnreadablePicturesLeaveThePlainFactorsAndAWarning) {
    const std::vector<std::pair<std::string, const char*>> bad = {
        {"missing.png", "an embedded scene cannot refer to files"},
        {"data:image/png;base64,AAAA", "it is not a PNG, JPEG, WebP or KTX2 file"},
        {kBomb, "it has 16384 x 16384 texels, at most 134217728 are supported"},
        {std::string(kPng).substr(0, 80), "it is damaged"}};
    for (const auto& [uri, message] : bad) {
        const Scene scene = textured({{"index", 0}}, {uri}).import();
        EXPECT_FALSE(scene.materials.at(0).texture(TextureSlot::baseColor).has_value());
        EXPECT_TRUE(scene.pictures.empty());
        EXPECT_EQ(warningsWith(scene, "image 0"), 1) << message;
        EXPECT_EQ(warningsWith(scene, message), 1) << message;
    }
}

TEST(GltfTexture, JpegWithoutItsEndIsShownWithAWarning) {
    const Scene scene = textured({{"index", 0}}, {kJpegWithoutEnd}).import();
    ASSERT_EQ(scene.pictures.size(), 1u);
    EXPECT_EQ(scene.pictures[0].width, 8u);
    EXPECT_NEAR(scene.pictures[0].bytes.at(0), 200, 1);
    EXPECT_EQ(
        warningsWith(scene, "image 0 is damaged and shown as far as it could be decoded: Premature end"), 1);
}

TEST(GltfTexture, TextureWithoutASourceLeavesThePlainFactors) {
    GltfBuilder builder = textured({{"index", 0}}, {kPng});
    builder.json["textures"][0] = {{"extensions", {{"EXT_texture_avif", {{"source", 0}}}}}};
    const Scene scene = builder.import();
    EXPECT_FALSE(scene.materials.at(0).texture(TextureSlot::baseColor).has_value());
    EXPECT_EQ(warningsWith(scene, "EXT_texture_avif"), 1);
    builder.json["extensionsRequired"] = {"EXT_texture_avif"};
    EXPECT_NE(importError(builder).find("EXT_texture_avif"), std::string::npos);
}

// 4 x 4 texels of (200, 100, 50, 25) as UASTC.
constexpr const char* kKtx2 =
    "data:image/ktx2;base64,q0tUWCAyMLsNChoKAAAAAAEAAAAEAAAABAAAAAAAAAAAAAAAAQAAAAEAAAAAAAAAaAAAACwAAAAAA"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAACUAAAAAAAAABAAAAAAAAAAEAAAAAAAAAAsAAAAAAAAAAIAKACmAAAAAAAAAAAAAAAAAAAAA"
    "AAAAwAAAAAAAAAAAAAAABeZTCYDAAAAAAAAAAAAAAA=";

TEST(GltfTexture, BasisUniversalGoesBeforeThePlainSource) {
    GltfBuilder builder = textured({{"index", 0}}, {kPng16, kKtx2});
    builder.json["textures"][0]["extensions"] = {{"KHR_texture_basisu", {{"source", 1}}}};
    const Scene scene = builder.import();
    ASSERT_EQ(scene.pictures.size(), 1u);
    if (!hasBasisUniversal()) {
        EXPECT_TRUE(scene.pictures[0].is16Bit);
        EXPECT_EQ(warningsWith(scene, "KHR_texture_basisu"), 1);
        return;
    }
    EXPECT_EQ(scene.pictures[0].width, 4u);
    EXPECT_EQ(scene.pictures[0].bytes[0], 200);
    EXPECT_EQ(scene.pictures[0].bytes[3], 25);
    EXPECT_EQ(warningsWith(scene, "KHR_texture_basisu"), 0);
}

TEST(GltfTexture, ReferencesAreChecked) {
    EXPECT_NE(importError(textured({{"index", 3}}, {kPng})).find("index is 3, but the file has 1 textures"),
              std::string::npos);
}

// Files in the wild have textures of images that are gone.
TEST(GltfTexture, SourceOutOfRangeIsNoSource) {
    GltfBuilder builder = textured({{"index", 0}}, {kPng});
    builder.json["textures"][0]["source"] = 7;
    const Scene scene = builder.import();
    EXPECT_FALSE(scene.materials.at(0).texture(TextureSlot::baseColor).has_value());
    EXPECT_EQ(warningsWith(scene, "texture 0 shows image 7, but the file has 1, its materials show"), 1);
    builder.json["textures"][0].erase("source");
    EXPECT_EQ(warningsWith(builder.import(), "texture 0 has no image that can be read"), 1);
}

TEST(GltfTexture, AnimatedWebpIsToldForWhatItIs) {
    const Scene scene = importGltf(std::string(LAVALIGHT_SOURCE_DIR) + "/tests/field/webp_anim.glb");
    EXPECT_EQ(warningsWith(scene, "image 0 cannot be read"), 1);
    EXPECT_EQ(warningsWith(scene, "it is an animated WebP file"), 1);
    EXPECT_EQ(warningsWith(scene, "damaged"), 0);
}

TEST(GltfTexture, JpegOfTheFieldWithoutItsEndIsShown) {
    const Scene scene = importGltf(std::string(LAVALIGHT_SOURCE_DIR) + "/tests/field/no_eoi.glb");
    EXPECT_EQ(scene.pictures.size(), 1u);
    EXPECT_EQ(warningsWith(scene, "cannot be read"), 0);
}

TEST(GltfTexture, MeshWithoutTheCoordinatesOfATextureIsNamedWithTheSetThatItLacks) {
    GltfBuilder builder = textured({{"index", 0}}, {kPng});
    EXPECT_EQ(warningsWith(builder.import(), "textures without their coordinates, TEXCOORD_0, show a single "
                                             "texel: mesh 0 \"part\""),
              1);
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    const int uvs = builder.addAccessor({{"bufferView", builder.addView<glm::vec2>({{0, 0}, {1, 0}, {0, 1}})},
                                         {"componentType", kFloat},
                                         {"count", 3},
                                         {"type", "VEC2"}});
    attributes["TEXCOORD_0"] = uvs;
    EXPECT_EQ(warningsWith(builder.import(), "coordinates"), 0);
    Json& info = builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["extensions"] = {{"KHR_texture_transform", {{"texCoord", 3}}}};
    EXPECT_EQ(warningsWith(builder.import(), "TEXCOORD_3, show a single texel"), 1);
    attributes["TEXCOORD_3"] = uvs;
    EXPECT_EQ(warningsWith(builder.import(), "coordinates"), 0);
}

} // namespace
} // namespace lavalight::test
