// What the host packs into 32 bits, the device unpacks to nearly the same unit vector.
#include <cmath>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "device_scene/octahedral.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

class OctahedralTest : public DeviceTest {};

TEST_F(OctahedralTest, VectorsComeBackWithinTheAnglePromised) {
    std::vector<glm::vec3> vectors = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const float x : {-1.0f, 0.0f, 1.0f}) // folds and corners of the map
        for (const float y : {-1.0f, 0.0f, 1.0f})
            for (const float z : {-1.0f, -1e-4f, -0.0f, 1e-4f, 1.0f})
                if (x != 0.0f || y != 0.0f)
                    vectors.push_back(glm::normalize(glm::vec3(x, y, z)));
    Random random(1);
    while (vectors.size() < 100000)
        vectors.push_back(random.direction());
    std::vector<uint32_t> words;
    words.reserve(vectors.size());
    for (const glm::vec3& v : vectors)
        words.push_back(encodeOctahedral(v));
    KernelRunner runner(device(), test_kernels::find("octahedral_test"));
    const auto decoded = runner.map<glm::vec4>(words);
    for (size_t i = 0; i < vectors.size(); ++i) {
        const glm::vec3 v(decoded[i]);
        ASSERT_NEAR(glm::length(v), 1.0f, 1e-6f);
        ASSERT_LT(glm::length(glm::cross(glm::dvec3(v), glm::dvec3(vectors[i]))), 1e-4)
            << vectors[i].x << ", " << vectors[i].y << ", " << vectors[i].z;
        ASSERT_GT(glm::dot(v, vectors[i]), 0.0f);
    }
}

} // namespace
} // namespace lavalight::test
