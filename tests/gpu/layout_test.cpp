// Records that kernels fetch through texel buffers arrive member by member as the host wrote them.
#include <cstring>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/commands.h"
#include "shared/bvh.h"
#include "shared/scene.h"
#include "shared/texture.h"
#include "shared/triangle.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

// The members count upwards in the order of their declaration; what no kernel loads is 0.
const BvhNode kBvhNode{
    {1, 2, 3}, 4, {5, 6, {7, 8}}, {{9, 10}, {11, 12}, {13, 14}}, {{15, 16}, {17, 18}, {19, 20}}};
const TriangleRecord kTriangleRecord{{1, 2, 3}, {4}, {5, 6, 7}, 8, {9, 10, 11}, 12};
const MaterialRecord kMaterialRecord{
    {1, 2, 3}, 4,  {5, 6, 7}, 8,  {9, 10, 11},  12, 13, 14, 15, 16, 17, 18, 19, 20, {21, 22, 23}, 24,
    25,        26, 27,        28, {29, 30, 31}, 32, 33, 34, 35, 36, 37, 38, 39, 40, {41, 42, 43}, 44};
const SolidRecord kSolidRecord{{1, 2, 3}, 4, 5, {}};
const LightRecord kLightRecord{1, 2, 3, 4};
const PunctualRecord kPunctualRecord{{1, 2, 3}, 4, {5, 6, 7}, 8, {9, 10, 11}, 12, 13, {}};
const LightTreeRecord kLightTreeRecord{{1, 2, 3}, 4, 5, 6, 7, 8, 9, {}};
const TextureRecord kTextureRecord{{1, 2, 3}, 4, {5, 6, 7}, 8, 9, 10, 11, 12};
const TriangleUvs kTriangleUvs{{1, 2}, {3, 4}, {5, 6}, {7, 8}};
const TriangleColors kTriangleColors{{1, 2}, {3, 4}, {5, 6}, {7, 8}};
const TriangleTangents kTriangleTangents{1, 2, 3, 4};

class FetchedRecords : public DeviceTest {
  protected:
    // Two elements for the kernel to write the second one.
    template <typename T>
    const gpu::Buffer& output(const std::string& name) {
        buffers_.emplace_back(device(), name, 2 * sizeof(T), gpu::BufferUse::storage);
        resources_.set(name, buffers_.back());
        return buffers_.back();
    }
    template <typename T>
    void input(const std::string& name, const T& value) {
        const T elements[2] = {T{}, value};
        buffers_.emplace_back(device(), name, sizeof elements, gpu::BufferUse::texels);
        buffers_.back().upload(std::span<const T>(elements));
        resources_.set(name, buffers_.back());
    }
    void runKernel() {
        const gpu::Kernel kernel(device(), test_kernels::find("layout_test"));
        const gpu::BoundKernel bound(device(), kernel, resources_);
        gpu::Commands commands(device());
        commands.begin();
        for (const gpu::Buffer& buffer : buffers_)
            if (buffer.use() == gpu::BufferUse::storage)
                commands.fill(buffer, 0);
        commands.dispatch(bound, 1);
        commands.submitAndWait();
    }

  private:
    std::deque<gpu::Buffer> buffers_; // at fixed addresses
    gpu::ResourceTable resources_;
};

template <typename T>
void expectSecond(const gpu::Buffer& buffer, const T& expected) {
    const T elements[2] = {T{}, expected};
    const auto words = buffer.downloadAll<uint32_t>();
    std::vector<uint32_t> wanted(sizeof elements / 4);
    std::memcpy(wanted.data(), elements, sizeof elements);
    for (size_t i = 0; i < wanted.size(); ++i)
        EXPECT_EQ(words[i], wanted[i])
            << buffer.name() << ": word " << i << " of two elements of " << sizeof(T) << " bytes";
}

TEST_F(FetchedRecords, ArriveMemberByMember) {
    input("bvhNodes", kBvhNode);
    input("triangles", kTriangleRecord);
    input("materials", kMaterialRecord);
    input("solids", kSolidRecord);
    input("lights", kLightRecord);
    input("punctuals", kPunctualRecord);
    input("lightTree", kLightTreeRecord);
    input("textures", kTextureRecord);
    input("triangleUvs", kTriangleUvs);
    input("triangleColors", kTriangleColors);
    input("triangleTangents", kTriangleTangents);
    const gpu::Buffer& node = output<BvhNode>("BvhNodeOut");
    const gpu::Buffer& triangle = output<TriangleRecord>("TriangleRecordOut");
    const gpu::Buffer& material = output<MaterialRecord>("MaterialRecordOut");
    const gpu::Buffer& solid = output<SolidRecord>("SolidRecordOut");
    const gpu::Buffer& light = output<LightRecord>("LightRecordOut");
    const gpu::Buffer& punctual = output<PunctualRecord>("PunctualRecordOut");
    const gpu::Buffer& lightTreeNode = output<LightTreeRecord>("LightTreeRecordOut");
    const gpu::Buffer& texture = output<TextureRecord>("TextureRecordOut");
    const gpu::Buffer& uvs = output<TriangleUvs>("TriangleUvsOut");
    const gpu::Buffer& colors = output<TriangleColors>("TriangleColorsOut");
    const gpu::Buffer& tangents = output<TriangleTangents>("TriangleTangentsOut");
    runKernel();
    expectSecond(node, kBvhNode);
    expectSecond(triangle, kTriangleRecord);
    expectSecond(material, kMaterialRecord);
    expectSecond(solid, kSolidRecord);
    expectSecond(light, kLightRecord);
    expectSecond(punctual, kPunctualRecord);
    expectSecond(lightTreeNode, kLightTreeRecord);
    expectSecond(texture, kTextureRecord);
    expectSecond(uvs, kTriangleUvs);
    expectSecond(colors, kTriangleColors);
    expectSecond(tangents, kTriangleTangents);
}

} // namespace
} // namespace lavalight::test
