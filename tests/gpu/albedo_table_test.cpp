// The tabulated albedos of the GGX lobe and of sheen are what integrating the lobes gives.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "render/albedo_table.h"
#include "render/kernel_source.h"
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

struct Answer {      // as in the kernel
    glm::vec4 table; // F0, F90, sheen
    glm::vec4 rowMean;
};

class AlbedoTableTest : public DeviceTest {
  protected:
    // The largest difference of each of them at places (column + shift, row + shift) of the grid.
    glm::vec3 largestErrors(float shift) {
        std::vector<Question> questions;
        for (uint32_t row = 3; row + 1 < kAlbedoRoughnesses; row += 4)
            for (uint32_t column = 1; column + 1 < kAlbedoCosines; column += 5) {
                const float roughness = (static_cast<float>(row) + shift) / (kAlbedoRoughnesses - 1);
                const float root = (static_cast<float>(column) + shift) / (kAlbedoCosines - 1);
                questions.push_back({root * root, roughness * roughness});
            }
        const gpu::Buffer table = makeAlbedoTable(device(), embeddedKernel("albedo")).buffer;
        gpu::ResourceTable resources;
        resources.set("albedoTable", table);
        KernelRunner runner(device(), test_kernels::find("albedo_table_test"), resources);
        const auto answers =
            runner.run<Answer>(std::span<const Question>(questions), questions.size() * kStrata);
        glm::vec3 largest(0.0f);
        for (size_t i = 0; i < answers.size(); i += kStrata) {
            glm::vec4 integral(0.0f);
            for (size_t row = i; row < i + kStrata; ++row)
                integral += answers[row].rowMean / static_cast<float>(kStrata);
            const glm::vec3 scale(1.0f, 1.0f, std::max(1.0f, integral.z)); // sheen is divided by more than 1
            largest = glm::max(largest, glm::abs(glm::vec3(answers[i].table - integral)) / scale);
        }
        return largest;
    }
};

TEST_F(AlbedoTableTest, EntriesAreTheIntegralOfTheLobe) {
    const glm::vec3 error = largestErrors(0.0f);
    EXPECT_LT(std::max(error.x, error.y), 8e-4f); // the lattice of 1597 points that fills the table
    EXPECT_LT(error.z, 2e-3f);                    // of up to twice the values
}

TEST_F(AlbedoTableTest, InterpolationBetweenEntriesIsClose) {
    const glm::vec3 error = largestErrors(0.5f);
    EXPECT_LT(std::max(error.x, error.y), 7e-3f); // worst at grazing angles over nearly smooth surfaces
    EXPECT_LT(error.z, 1.5e-2f);                  // and of sheen between its lowest roughnesses
}

} // namespace
} // namespace lavalight::test
