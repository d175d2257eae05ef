// What the tests of refused files share.
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "unit/gltf/builder.h"

namespace lavalight::test {

// The error must be one line that names the file and contains `text`.
inline void expectError(const std::string& error, const std::string& file, const std::string& text) {
    EXPECT_NE(error.find(text), std::string::npos) << "got: \"" << error << "\", wanted: " << text;
    EXPECT_NE(error.find(file), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

inline void expectError(const GltfBuilder& builder, const std::string& text) {
    expectError(importError(builder), "test.glb", text);
}

// What importing a file on disk says when it fails; empty if it succeeds.
inline std::string fileError(const std::filesystem::path& path, const ImportOptions& options = {}) {
    try {
        static_cast<void>(importGltf(path, options));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

// One triangle of indexed vertices.
inline GltfBuilder goodFile() {
    GltfBuilder builder;
    const int positions = builder.addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int indices = builder.addIndices<uint16_t>({0, 1, 2}, kUnsignedShort);
    builder.addNode(
        {{"mesh", builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
    return builder;
}

} // namespace lavalight::test
