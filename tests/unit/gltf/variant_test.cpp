// Tests of KHR_materials_variants.
#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

// A triangle of material 0 that shows material 1 as "night" and material 2 as "gala".
GltfBuilder variants() {
    GltfBuilder builder;
    const int mesh = builder.addTriangle();
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}},
                                                                     {{"material", 2}, {"variants", {1}}}};
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {
        {{"name", "night"}}, {{"name", "gala"}}, {{"name", "plain"}}};
    builder.json["materials"] = {{{"name", "day"}}, {{"name", "dark"}}, {{"name", "gold"}}};
    builder.addNode({{"mesh", mesh}});
    return builder;
}

std::string materialAs(const std::string& variant) {
    ImportOptions options;
    options.variant = variant;
    const Scene scene = importGltf("test.glb", variants().glb(), options);
    return scene.materials.at(scene.meshes.at(0).material).name;
}

TEST(GltfVariant, ChosenByNameOrNumberShowsItsMaterial) {
    EXPECT_EQ(materialAs(""), "day");
    EXPECT_EQ(materialAs("night"), "dark");
    EXPECT_EQ(materialAs("gala"), "gold");
    EXPECT_EQ(materialAs("1"), "gold");
    EXPECT_EQ(materialAs("plain"), "day"); // without a mapping the default stays
    EXPECT_EQ(variants().import().variants, (std::vector<std::string>{"night", "gala", "plain"}));
}

TEST(GltfVariant, UnknownOneIsWrongUsageAndNamesTheOthers) {
    try {
        static_cast<void>(materialAs("dusk"));
        FAIL() << "accepted";
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what())
                      .find("has no variant \"dusk\"; it has 0 \"night\", 1 \"gala\", 2 \"plain\""),
                  std::string::npos)
            << error.what();
    }
}

TEST(GltfVariant, MappingsAreChecked) {
    GltfBuilder builder = variants();
    builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0]
                ["material"] = 9;
    EXPECT_NE(importError(builder).find("material is 9, but the file has 3 materials"), std::string::npos);
}

} // namespace
} // namespace lavalight::test
