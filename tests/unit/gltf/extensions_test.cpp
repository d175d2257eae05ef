// Tests of the table of extensions and of the page that lists them.
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "base/file.h"
#include "gltf/check/extensions.h"
#include "image/basis_universal.h"
#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

// The extensions in the tables of docs/gltf.md. A name that begins with "_" follows the prefix of materials.
std::set<std::string> extensionsOnThePage() {
    std::set<std::string> names;
    std::istringstream page(readFile(LAVALIGHT_SOURCE_DIR "/docs/gltf.md"));
    for (std::string line; std::getline(page, line);) {
        if (!line.starts_with("| "))
            continue;
        for (size_t first = line.find('`'); first != std::string::npos; first = line.find('`', first)) {
            const size_t last = line.find('`', first + 1);
            const std::string word = line.substr(first + 1, last - first - 1);
            if (word.starts_with("KHR_") || word.starts_with("EXT_"))
                names.insert(word);
            else if (word.starts_with("_"))
                names.insert("KHR_materials" + word);
            first = last + 1;
        }
    }
    return names;
}

TEST(GltfExtensions, ThePageListsThoseThatAreReadAndNoOthers) {
    std::set<std::string> read;
    for (const Extension& extension : kExtensions)
        read.emplace(extension.name);
    EXPECT_EQ(extensionsOnThePage(), read);
}

TEST(GltfExtensions, NamesAreFoundAsTheyAreSpelled) {
    ASSERT_NE(extensionNamed("KHR_materials_sheen"), nullptr);
    EXPECT_TRUE(extensionNamed("KHR_materials_sheen")->hasRules());
    EXPECT_FALSE(extensionNamed("KHR_xmp")->hasRules());
    EXPECT_EQ(extensionNamed("khr_materials_sheen"), nullptr);
    EXPECT_EQ(extensionNamed(""), nullptr);
}

TEST(GltfExtensions, BasisUniversalIsReadWhereItsTranscoderIsBuiltIn) {
    EXPECT_EQ(isExtensionRead("KHR_texture_basisu"), hasBasisUniversal());
    EXPECT_TRUE(isExtensionRead("KHR_xmp"));
    EXPECT_FALSE(isExtensionRead("EXT_nobody_knows"));
}

TEST(GltfExtensions, GaussianSplatsAreRefusedByWhatTheyAre) {
    GltfBuilder builder;
    builder.addNode({{"mesh", builder.addTriangle()}});
    builder.json["extensionsRequired"] = {"KHR_gaussian_splatting"};
    const std::string error = importError(builder);
    EXPECT_NE(error.find("KHR_gaussian_splatting"), std::string::npos) << error;
    EXPECT_NE(error.find("Gaussian splats"), std::string::npos) << error;
}

TEST(GltfExtensions, WhatNoStillShowsIsTakenInSilence) {
    for (const char* name : {"KHR_interactivity", "KHR_node_hoverability", "KHR_node_selectability",
                             "KHR_xmp_json_ld", "EXT_mesh_opacity_micromap"}) {
        GltfBuilder builder;
        builder.addNode({{"mesh", builder.addTriangle()}, {"extensions", {{name, Json::object()}}}});
        builder.json["extensionsRequired"] = {name};
        const Scene scene = builder.import();
        EXPECT_TRUE(scene.ignoredExtensions.empty()) << name;
        EXPECT_EQ(warningsWith(scene, name), 0) << name;
    }
}

} // namespace
} // namespace lavalight::test
