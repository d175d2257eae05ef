// Points of triangles are lifted to the smooth surface that the normals at their corners stand for.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Question { // as in the kernel
    std::array<glm::vec4, 3> corners;
    std::array<glm::vec4, 3> normals;
    glm::vec4 b;
};

// A triangle with corners on the unit sphere, and the sphere's normals there, or those of its inside.
Question onSphere(const std::array<glm::vec3, 3>& corners, const glm::vec3& b, float side = 1.0f) {
    Question question{};
    for (size_t i = 0; i < 3; ++i) {
        question.corners[i] = glm::vec4(corners[i], 0.0f);
        question.normals[i] = glm::vec4(side * corners[i], 0.0f);
    }
    question.b = glm::vec4(b, 0.0f);
    return question;
}

glm::vec3 pointOf(const Question& q) {
    return glm::vec3(q.b.x * q.corners[0] + q.b.y * q.corners[1] + q.b.z * q.corners[2]);
}

// Corners `reach` radians from a random axis, counter-clockwise from outside.
std::array<glm::vec3, 3> randomTriangle(Random& random, float reach) {
    const glm::vec3 axis = random.direction();
    const glm::vec3 x =
        glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
    const glm::vec3 y = glm::cross(axis, x);
    std::array<glm::vec3, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
        const float phi = 2.0943951f * (static_cast<float>(i) + 0.4f * random.unit());
        corners[i] = std::cos(reach) * axis + std::sin(reach) * (std::cos(phi) * x + std::sin(phi) * y);
    }
    return corners;
}

glm::vec3 randomPlace(Random& random) {
    const glm::vec3 b(random.unit() + 1e-3f, random.unit() + 1e-3f, random.unit() + 1e-3f);
    return b / (b.x + b.y + b.z);
}

class SmoothSurfaceTest : public DeviceTest {
  protected:
    [[nodiscard]] std::vector<glm::vec4> lift(const std::vector<Question>& questions) {
        KernelRunner runner(device(), test_kernels::find("smooth_surface_test"));
        return runner.map<glm::vec4>(questions);
    }
};

// Hanika's surface of a sphere lies outside it, no further than the mesh lies inside.
TEST_F(SmoothSurfaceTest, SphereIsLiftedJustBeyondItself) {
    Random random(1);
    for (const float reach : {0.05f, 0.2f, 0.5f, 0.7f}) {
        constexpr size_t kCount = 1000;
        std::vector<Question> questions;
        questions.reserve(kCount);
        for (size_t i = 0; i < kCount; ++i)
            questions.push_back(onSphere(randomTriangle(random, reach), randomPlace(random)));
        const std::vector<glm::vec4> lifts = lift(questions);
        for (size_t i = 0; i < lifts.size(); ++i) {
            const float below = 1.0f - glm::length(pointOf(questions[i]));
            const float radius = glm::length(pointOf(questions[i]) + glm::vec3(lifts[i]));
            ASSERT_GT(radius, 1.0f - 1e-6f) << reach;
            ASSERT_LT(radius, 1.0f + 1.5f * below + 1e-6f) << reach;
        }
    }
}

TEST_F(SmoothSurfaceTest, NeighboursAgreeAboutTheirEdge) {
    const std::array<glm::vec3, 4> corners = {glm::vec3(1, 0, 0), glm::normalize(glm::vec3(1, 0.4f, 0.1f)),
                                              glm::normalize(glm::vec3(1, 0.1f, 0.5f)),
                                              glm::normalize(glm::vec3(1, 0.5f, 0.6f))};
    std::vector<Question> left;
    std::vector<Question> right;
    for (int i = 1; i < 10; ++i) {
        const float u = 0.1f * static_cast<float>(i);
        left.push_back(onSphere({corners[0], corners[1], corners[2]}, {0.0f, u, 1.0f - u}));
        right.push_back(onSphere({corners[3], corners[2], corners[1]}, {0.0f, 1.0f - u, u}));
    }
    const std::vector<glm::vec4> a = lift(left);
    const std::vector<glm::vec4> b = lift(right);
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_LT(glm::distance(a[i], b[i]), 1e-6f);
        EXPECT_GT(glm::length(a[i]), 1e-3f);
    }
}

TEST_F(SmoothSurfaceTest, NothingIsLiftedInsideOfACurveOnFlatTrianglesAndAtSharpCorners) {
    Random random(2);
    std::vector<Question> questions;
    for (int i = 0; i < 100; ++i) {
        std::array<glm::vec3, 3> corners = randomTriangle(random, 0.3f);
        const glm::vec3 b = randomPlace(random);
        questions.push_back(onSphere({corners[0], corners[2], corners[1]}, b, -1.0f));
        questions.push_back(onSphere(corners, b));
        const glm::vec3 ng = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        questions.back().normals.fill(glm::vec4(ng, 0.0f));
        questions.push_back(
            onSphere(randomTriangle(random, 0.95f), b)); // 54 degrees, as the corners of a cube
    }
    for (const glm::vec4& l : lift(questions))
        EXPECT_LT(glm::length(l), 1e-6f);
}

} // namespace
} // namespace lavalight::test
