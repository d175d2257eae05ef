// Bases are orthonormal and right-handed around every unit vector, the poles included.
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Answer { // as in the kernel
    glm::vec4 tangent, bitangent, normal, thereAndBack;
};

class OnbTest : public DeviceTest {};

TEST_F(OnbTest, BasesAreOrthonormalAndRightHanded) {
    std::vector<glm::vec4> normals = {
        {0, 0, 1, 0}, {0, 0, -1, 0}, {0, 0, -0.0f, 0}, {1, 0, 0, 0}, {0, -1, 0, 0}};
    normals[2] = {0.6f, 0.8f, -0.0f, 0.0f};
    for (const float tiny : {1e-3f, 1e-5f, 1e-8f})
        normals.emplace_back(glm::normalize(glm::vec3(tiny, -tiny, -1.0f)), 0.0f);
    Random random(1);
    while (normals.size() < 20000)
        normals.emplace_back(random.direction(), 0.0f);
    KernelRunner runner(device(), test_kernels::find("onb_test"));
    const auto answers = runner.map<Answer>(normals);
    constexpr float tolerance = 2e-6f; // some roundings of numbers around 1
    for (size_t i = 0; i < normals.size(); ++i) {
        const glm::vec3 t(answers[i].tangent);
        const glm::vec3 b(answers[i].bitangent);
        const glm::vec3 n(answers[i].normal);
        ASSERT_EQ(n, glm::vec3(normals[i]));
        ASSERT_NEAR(glm::length(t), 1.0f, tolerance);
        ASSERT_NEAR(glm::length(b), 1.0f, tolerance);
        ASSERT_NEAR(glm::dot(t, b), 0.0f, tolerance);
        ASSERT_NEAR(glm::dot(t, n), 0.0f, tolerance);
        ASSERT_NEAR(glm::dot(b, n), 0.0f, tolerance);
        ASSERT_NEAR(glm::dot(glm::cross(t, b), n), 1.0f, tolerance);
        ASSERT_LT(glm::distance(glm::vec3(answers[i].thereAndBack), {0.48f, -0.6f, 0.64f}), 2.0f * tolerance);
    }
}

} // namespace
} // namespace lavalight::test
