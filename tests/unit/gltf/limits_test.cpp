// Tests of small files that ask for much: they are refused by their figures, before memory or time is spent.
#include <chrono>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "support/memory_limit.h"
#include "support/sound_scene.h"
#include "unit/gltf/errors.h"

namespace lavalight::test {
namespace {

// What the file was refused with, in far less time than the work that it asks for would take.
std::string quickError(const std::string& bytes) {
    const auto start = std::chrono::steady_clock::now();
    std::string error = importError(bytes);
    EXPECT_LT(std::chrono::steady_clock::now() - start,
              std::chrono::seconds(20)); // sanitizers, loaded machines
    return error;
}

void expectQuickError(const GltfBuilder& builder, const std::string& text) {
    expectError(quickError(builder.glb()), "test.glb", text);
}

// An accessor of zeros, which takes no bytes of the file.
int addZeros(GltfBuilder& builder, size_t count, const char* type) {
    return builder.addAccessor({{"componentType", kFloat}, {"count", count}, {"type", type}});
}

TEST(GltfLimits, ZerosOfAllAccessorsAreBoundedTogether) {
    GltfBuilder builder = goodFile();
    for (int i = 0; i < 16; ++i)
        addZeros(builder, 1u << 24, "VEC3");
    EXPECT_EQ(quickError(builder.glb()), "");
    addZeros(builder, 1, "VEC3");
    expectQuickError(builder, "its accessors ask for 268435457 elements without data, at most 268435456");
}

// A copy of each accessor for each use would be 200 MB two thousand times.
TEST(GltfLimits, SparseElementsOfALargeAccessorCostWhatIsUsed) {
    GltfBuilder builder = goodFile();
    const int positions = addZeros(builder, 1u << 24, "VEC3");
    builder.json["accessors"][static_cast<size_t>(positions)]["sparse"] = {
        {"count", 2},
        {"indices",
         {{"bufferView", builder.addView<uint32_t>({1, (1u << 24) - 1})}, {"componentType", 5125}}},
        {"values", {{"bufferView", builder.addView<glm::vec3>({{1, 0, 0}, {0, 1, 0}})}}}};
    const int indices = builder.addIndices<uint32_t>({0, 1, (1u << 24) - 1}, kUnsignedInt);
    Json& primitives = builder.json["meshes"][0]["primitives"];
    const Json primitive = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
    primitives = std::vector<Json>(2000, primitive);
    const auto start = std::chrono::steady_clock::now();
    const Scene scene = builder.import();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
    EXPECT_EQ(scene.triangleCount(), 2000u);
    EXPECT_EQ(scene.bounds.upper, glm::vec3(1, 1, 0));
}

TEST(GltfLimits, SparseElementsOutOfOrderAreAnError) {
    GltfBuilder builder = goodFile();
    const auto replace = [&](const std::vector<uint8_t>& numbers) {
        builder.json["accessors"][0]["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", builder.addView(numbers)}, {"componentType", 5121}}},
            {"values", {{"bufferView", builder.addView<glm::vec3>({{1, 1, 1}, {2, 2, 2}})}}}};
    };
    replace({2, 1});
    expectError(builder, "accessor 0 replaces element 1 after element 2, but they must ascend");
    replace({1, 1});
    expectError(builder, "accessor 0 replaces element 1 after element 1");
}

TEST(GltfLimits, InstancesBeyondCountingAreRefused) {
    GltfBuilder builder = goodFile();
    const int translations = addZeros(builder, 1u << 24, "VEC3");
    const auto instances = [&](const char* attribute) {
        return Json{{"EXT_mesh_gpu_instancing", {{"attributes", {{attribute, translations}}}}}};
    };
    builder.json["nodes"][0]["extensions"] = instances("TRANSLATION");
    builder.addNode({{"mesh", 0}, {"extensions", instances("SCALE")}});
    builder.addNode({{"mesh", 0}, {"extensions", instances("TRANSLATION")}});
    expectQuickError(builder, "it draws 50331648 triangles, at most 44739242");
    builder.json["accessors"][static_cast<size_t>(translations)]["count"] = uint64_t{1} << 31;
    expectQuickError(builder, "asks for 2147483648 elements without data");
}

// Sixteen sets of coordinates multiply by 40 million triangles: 70 GB.
TEST(GltfLimits, TrianglesWhoseVerticesDoNotFitIntoMemoryAreRefused) {
    GltfBuilder builder = goodFile();
    const int positions = addZeros(builder, 3 * 2'500'000, "VEC3");
    const int uvs = addZeros(builder, 3 * 2'500'000, "VEC2");
    Json attributes = {{"POSITION", positions}};
    for (int set = 0; set < 16; ++set)
        attributes["TEXCOORD_" + std::to_string(set)] = uvs;
    builder.json["meshes"][0]["primitives"] = {{{"attributes", attributes}}};
    for (int i = 0; i < 15; ++i)
        builder.addNode({{"mesh", 0}});
    if (!MemoryLimit::isPossible())
        GTEST_SKIP() << "memory cannot be limited here";
    const MemoryLimit limit(uint64_t{1} << 30);
    expectQuickError(builder, "the 40000000 triangles that it draws take 1");
    expectQuickError(builder, " are available: simplify the scene");
}

// 16384 x 8192 texels of one bit each, or the beginning of them: what may be in so many bytes.
std::vector<char> largePng() {
    const std::string head("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\0\x40\0\0\0\x20\0\1\0\0\0\0\0\0\0\0"
                           "\0\0\x42\x37IDAT", // stb 2.30 reads this far for the size
                           41);
    std::vector<char> bytes(head.begin(), head.end());
    bytes.resize(17'000, '\0');
    return bytes;
}

// 66,666 vertices, 1,000 targets that share one accessor, and nodes that share the mesh: 16,000 bytes.
GltfBuilder manyMorphs(size_t nodes) {
    constexpr size_t kVertices = 66'666;
    GltfBuilder builder = goodFile();
    Json& mesh = builder.json["meshes"][0];
    const int positions = addZeros(builder, kVertices, "VEC3");
    mesh["primitives"][0] = {{"attributes", {{"POSITION", positions}}}};
    mesh["primitives"][0]["targets"] = std::vector<Json>(1000, {{"POSITION", positions}});
    mesh["weights"] = std::vector<int>(1000, 1);
    for (size_t i = 1; i < nodes; ++i) // the file has one
        builder.addNode({{"mesh", 0}});
    return builder;
}

TEST(GltfLimits, MorphTargetsThatWouldTakeMinutesAreRefused) {
    expectQuickError(manyMorphs(200),
                     "its morph targets move vertices more than 1e+10 times: simplify the scene");
    EXPECT_EQ(quickError(manyMorphs(1).glb()), "");
    GltfBuilder still = manyMorphs(200);
    still.json["meshes"][0]["weights"] = std::vector<int>(1000, 0);
    EXPECT_EQ(quickError(still.glb()), ""); // targets without a weight move nothing
}

TEST(GltfLimits, PicturesBeyondATexelBufferAreRefusedBeforeTheyAreDecoded) {
    GltfBuilder builder = goodFile();
    const int view = builder.addView(largePng());
    for (int i = 0; i < 5; ++i) {
        builder.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
        builder.json["textures"].push_back({{"source", i}});
    }
    builder.json["materials"] = {
        {{"emissiveTexture", {{"index", 0}}},
         {"emissiveFactor", {1, 1, 1}},
         {"normalTexture", {{"index", 1}}},
         {"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 2}}}, {"metallicRoughnessTexture", {{"index", 3}}}}}},
        {{"normalTexture", {{"index", 4}}}}};
    expectQuickError(builder, "its pictures take 2560 MiB, at most 2048 are supported: scale them down");
    if (!MemoryLimit::isPossible())
        return;
    builder.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    const MemoryLimit limit(uint64_t{1} << 30);
    expectQuickError(builder, "its pictures take 2.0 GiB of memory, ");
}

std::string chainOf(size_t nodes) {
    std::ostringstream json;
    json << R"({"asset":{"version":"2.0"},"nodes":[)";
    for (size_t i = 0; i + 1 < nodes; ++i)
        json << R"({"scale":[1,1,1],"children":[)" << i + 1 << "]},";
    json << "{}]}";
    return json.str();
}

TEST(GltfLimits, ChainOfAHundredThousandNodesIsNoStackOverflow) {
    EXPECT_EQ(quickError(chainOf(100'000)), "");
    std::string ring = chainOf(100'000);
    ring.replace(ring.rfind("{}"), 2, R"({"children":[0]})");
    expectError(quickError(ring), "test.glb", "is among its own descendants");
}

// Nothing that is not finite gets into the scene, wherever it comes from.
TEST(GltfLimits, HugeAndUndefinedTransformsLeaveASoundScene) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const Json huge(std::vector<double>(16, 1e308));
    const std::vector<std::vector<glm::vec3>> badVectors = {
        {{kNan, 0, 0}}, {{0, -kInfinity, 0}}, {{1e38f, 1e38f, 0}}};
    std::vector<Json> nodes = {{{"matrix", huge}},
                               {{"scale", {1e308, 1e308, 1e308}}},
                               {{"scale", {0, 0, 0}}},
                               {{"scale", {1e-300, 1, 1}}},
                               {{"translation", {1e300, 0, -1e300}}},
                               {{"rotation", {1e300, 0, 0, 1e300}}},
                               {{"rotation", {0, 0, 0, 0}}}};
    for (const Json& node : nodes) {
        GltfBuilder builder = goodFile();
        builder.json["cameras"] = {
            {{"type", "perspective"}, {"perspective", {{"yfov", 1e300}, {"znear", 0.1}}}},
            {{"type", "orthographic"},
             {"orthographic", {{"xmag", 1e300}, {"ymag", 1e-300}, {"zfar", 1}, {"znear", 0}}}}};
        builder.json["nodes"][0].update(node);
        builder.json["nodes"][0]["camera"] = 0;
        builder.json["nodes"][0]["children"] = {1};
        builder.addNode({{"mesh", 0}, {"camera", 1}, {"scale", {1e200, 1e200, 1e200}}});
        EXPECT_EQ(unsoundPart(builder.import()), "") << node;
    }
    for (const auto& bad : badVectors) {
        GltfBuilder instances = goodFile();
        const int accessor = instances.addVec3(bad);
        instances.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
            {"TRANSLATION", accessor}, {"SCALE", accessor}};
        EXPECT_EQ(unsoundPart(instances.import()), "");
        GltfBuilder keys = goodFile();
        const int values = keys.addVec3(bad);
        keys.json["animations"] = {
            {{"samplers", {{{"input", addZeros(keys, 1, "SCALAR")}, {"output", values}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}}};
        EXPECT_EQ(unsoundPart(importGltf("test.glb", keys.glb(), {.seconds = 0.0})), "");
    }
}

// A double of a file may be zero or infinite as the float of a scene.
TEST(GltfLimits, CameraNumbersBeyondFloatsLeaveASoundScene) {
    const auto scene = [](const Json& camera) {
        GltfBuilder builder = goodFile();
        builder.json["cameras"] = Json::array({camera});
        builder.json["nodes"][0]["camera"] = 0;
        return builder.import();
    };
    const std::vector<double> numbers = {1e-310, 1e-46, 1e-40, 1.0, 3.1415926535, 1e39, 1e308};
    for (const double first : numbers) {
        for (const double second : numbers) {
            const Json perspective = {{"yfov", first}, {"aspectRatio", second}, {"znear", 0.1}};
            EXPECT_EQ(unsoundPart(scene({{"type", "perspective"}, {"perspective", perspective}})), "")
                << perspective;
            const Json orthographic = {{"xmag", first}, {"ymag", second}, {"zfar", 1}, {"znear", 0}};
            EXPECT_EQ(unsoundPart(scene({{"type", "orthographic"}, {"orthographic", orthographic}})), "")
                << orthographic;
        }
    }
}

// Read for each channel anew, they would be 10^11 keys.
TEST(GltfLimits, TimesThatThousandsOfChannelsShareAreReadOnce) {
    GltfBuilder builder = goodFile();
    const int times = addZeros(builder, 1u << 20, "SCALAR");
    const int values = addZeros(builder, 1u << 20, "VEC3");
    const Json channel = {{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}};
    builder.json["animations"] = {{{"samplers", {{{"input", times}, {"output", values}}}},
                                   {"channels", std::vector<Json>(100'000, channel)}}};
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(importGltf("test.glb", builder.glb(), {.seconds = 0.5}).triangleCount(), 1u);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

// Two bytes of the file are a thousand in memory.
TEST(GltfLimits, ObjectsThatDoNotFitIntoMemoryAreRefused) {
    if (!MemoryLimit::isPossible())
        GTEST_SKIP() << "memory cannot be limited here";
    const MemoryLimit limit(uint64_t{1} << 29);
    std::string json = R"({"asset":{"version":"2.0"},"materials":[{})";
    for (size_t i = 1; i < 300'000; ++i)
        json += ",{}";
    expectError(quickError(json + "]}"), "test.glb", "its nodes, materials and other objects take");
}

TEST(GltfLimits, ValuesThatDoNotFitIntoMemoryAreRefusedBeforeTheyAreParsed) {
    if (!MemoryLimit::isPossible())
        GTEST_SKIP() << "memory cannot be limited here";
    std::string json = R"({"asset":{"version":"2.0"},"extras":[[])";
    for (size_t i = 1; i < 4'000'000; ++i)
        json += ",[]";
    json += "]}";
    const MemoryLimit limit(uint64_t{1} << 29);
    expectError(quickError(json), "test.glb", "8000004 values of its JSON take 1011 MiB of memory");
}

TEST(GltfLimits, DuplicateKeysBrokenTextAndHugeNumbersAreOneLineOrLoad) {
    const std::string head = R"({"asset":{"version":"2.0"},)";
    EXPECT_EQ(quickError(head + R"("nodes":[{}],"nodes":[{},{}]})"), "");
    EXPECT_EQ(quickError(head + R"("nodes":[{"name":"a","name":"b"}]})"), "");
    expectError(quickError(head + "\"nodes\":[{\"name\":\"\xC3\x28\"}]}"), "test.glb", "JSON is damaged");
    expectError(quickError(head + "\"nodes\":[{\"name\":\"\xED\xA0\x80\"}]}"), "test.glb", "JSON is damaged");
    expectError(quickError(head + R"("nodes":[{"name":"\uD800"}]})"), "test.glb", "JSON is damaged");
    expectError(quickError(head + R"("nodes":[{"scale":[1e999,1,1]}]})"), "test.glb", "JSON is damaged");
    expectError(quickError(head + R"("nodes":[{"mesh":99999999999999999999}]})"), "test.glb",
                "nodes[0].mesh");
    expectError(
        quickError(head + R"("buffers":[{"byteLength":9223372036854775808,"uri":"data:;base64,AAAA"}]})"),
        "test.glb", "holds 3 bytes, its byteLength is 9223372036854775808");
    EXPECT_EQ(quickError(head + R"("buffers":[{"byteLength":9223372036854775808}]})"), "");
}

// tinygltf decodes what it can; what is missing is missed.
TEST(GltfLimits, Base64OfAWrongLengthOrAlphabetIsAnError) {
    for (const char* data : {"A", "AA", "AAA", "AAAAA", "====", "!!!!", "AA\xC3\xA4", ""}) {
        GltfBuilder builder = goodFile();
        builder.json["buffers"] = {{{"byteLength", 44}, {"uri", std::string("data:;base64,") + data}}};
        const std::string error = importError(builder);
        EXPECT_NE(error.find("buffer 0"), std::string::npos) << data << ": " << error;
    }
}

} // namespace
} // namespace lavalight::test
