// The tabulated albedo of the GGX lobe is what integrating the lobe gives.
#include <cmath>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "render/albedo_table.h"
#include "shared/scene.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

constexpr size_t kStrata = 512; // as in the kernel

struct Question { // as in the kernel
    float cosTheta;
    float alpha;
};

struct Answer { // as in the kernel
    glm::vec2 table;
    glm::vec2 rowMean;
};

class AlbedoTableTest : public DeviceTest {
  protected:
    // The largest difference at places (column + shift, row + shift) of the grid.
    float largestError(float shift) {
        std::vector<Question> questions;
        for (uint32_t row = 2; row + 1 < kAlbedoRoughnesses; row += 4)
            for (uint32_t column = 1; column + 1 < kAlbedoCosines; column += 5) {
                const float roughness = (static_cast<float>(row) + shift) / (kAlbedoRoughnesses - 1);
                const float root = (static_cast<float>(column) + shift) / (kAlbedoCosines - 1);
                questions.push_back({root * root, roughness * roughness});
            }
        const gpu::Buffer table = makeAlbedoTable(device());
        gpu::ResourceTable resources;
        resources.set("albedoTable", table);
        KernelRunner runner(device(), test_kernels::find("albedo_table_test"), resources);
        const auto answers =
            runner.run<Answer>(std::span<const Question>(questions), questions.size() * kStrata);
        float largest = 0.0f;
        for (size_t i = 0; i < answers.size(); i += kStrata) {
            glm::vec2 integral(0.0f);
            for (size_t row = i; row < i + kStrata; ++row)
                integral += answers[row].rowMean / static_cast<float>(kStrata);
            for (glm::length_t term = 0; term < 2; ++term)
                largest = std::fmax(largest, std::abs(answers[i].table[term] - integral[term]));
        }
        return largest;
    }
};

TEST_F(AlbedoTableTest, EntriesAreTheIntegralOfTheLobe) {
    EXPECT_LT(largestError(0.0f), 8e-4f); // the lattice of 1597 points that fills the table
}

TEST_F(AlbedoTableTest, InterpolationBetweenEntriesIsClose) {
    EXPECT_LT(largestError(0.5f), 7e-3f); // worst at grazing angles over nearly smooth surfaces
}

} // namespace
} // namespace lavalight::test
