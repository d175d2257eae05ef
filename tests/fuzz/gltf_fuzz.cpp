// Fuzzes the import of glTF: still, in motion and in another variant. A file is refused in one line, or its
// scene is sound.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.h"
#include "gltf/import.h"
#include "support/sound_scene.h"

namespace {

using lavalight::Scene;

void require(bool condition, const std::string& finding) {
    if (condition)
        return;
    std::fprintf(stderr, "%s\n", finding.c_str());
    std::abort();
}

Scene import(std::string_view bytes, const lavalight::ImportOptions& options) {
    Scene scene = lavalight::importGltf("fuzz", bytes, options);
    const std::string unsound = lavalight::test::unsoundPart(scene);
    require(unsound.empty(), unsound);
    return scene;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        const Scene still = import(bytes, {});
        if (!still.variants.empty())
            static_cast<void>(import(bytes, {.variant = "0"}));
        for (size_t i = 0; i < still.animations.size() && i < 4; ++i)
            static_cast<void>(
                import(bytes, {.seconds = 0.4 * static_cast<double>(still.animations[i].seconds),
                               .animation = std::to_string(i)}));
    } catch (const lavalight::Error& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos, error.what());
    }
    return 0;
}
