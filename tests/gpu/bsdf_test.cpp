// The BSDF is reciprocal, zero where it has to be, and pure Lambert where glTF asks for it.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shared/frame.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "support/test_materials.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Question { // as in the kernel
    glm::vec3 wo;
    uint32_t material;
    glm::vec3 wi;
    float unused;
};

struct Answer { // as in the kernel
    glm::vec3 f;
    float pdf;
    glm::vec3 swapped;
    float unused;
};

class BsdfTest : public DeviceTest {
  protected:
    std::vector<Answer> ask(const std::vector<TestMaterial>& materials,
                            const std::vector<Question>& questions, bool multipleScattering = false) {
        const MaterialBuffers buffers(device(), materials);
        const std::array<gpu::SpecialisationConstant, 1> constants = {
            {{CONSTANT_MULTIPLE_SCATTERING, multipleScattering ? 1u : 0u}}};
        KernelRunner runner(device(), test_kernels::find("bsdf_test"), buffers.resources(), constants);
        return runner.map<Answer>(questions);
    }
    void expectReciprocity(const std::vector<TestMaterial>& materials, const std::vector<Question>& questions,
                           bool multipleScattering = false) {
        const std::vector<Answer> answers = ask(materials, questions, multipleScattering);
        for (size_t i = 0; i < questions.size(); ++i)
            for (glm::length_t c = 0; c < 3; ++c) {
                const float forwards = answers[i].f[c] / std::abs(questions[i].wi.z);
                const float backwards = answers[i].swapped[c] / questions[i].wo.z;
                ASSERT_NEAR(forwards, backwards, 2e-4f * std::max(forwards, backwards) + 1e-9f)
                    << materials[questions[i].material].name << ": cosines " << questions[i].wo.z << ", "
                    << questions[i].wi.z;
            }
    }
};

glm::vec3 upwards(glm::vec3 w) {
    w.z = std::abs(w.z);
    return w;
}

std::vector<Question> randomPairs(size_t materials, size_t perMaterial) {
    Random random(1);
    std::vector<Question> questions;
    for (uint32_t material = 0; material < materials; ++material)
        for (size_t i = 0; i < perMaterial; ++i)
            questions.push_back({upwards(random.direction()), material, upwards(random.direction()), 0.0f});
    return questions;
}

TEST_F(BsdfTest, SwappedDirectionsReflectAlike) {
    std::vector<TestMaterial> materials = roughMaterials();
    for (const auto& list : {layeredMaterials(), transmissiveMaterials()})
        materials.insert(materials.end(), list.begin(), list.end());
    const std::vector<Question> questions = randomPairs(materials.size(), 4096);
    expectReciprocity(materials, questions);
    expectReciprocity(materials, questions, true);
}

TEST_F(BsdfTest, SwappedDirectionsTransmitAlike) {
    const std::vector<TestMaterial> materials = transmissiveMaterials();
    std::vector<Question> questions = randomPairs(materials.size(), 4096);
    for (Question& question : questions)
        question.wi.z *= -1.0f;
    expectReciprocity(materials, questions);
}

TEST_F(BsdfTest, NothingIsTransmitted) {
    const std::vector<TestMaterial> materials = roughMaterials();
    std::vector<Question> questions = randomPairs(materials.size(), 256);
    for (size_t i = 0; i < questions.size(); ++i)
        (i % 2 == 0 ? questions[i].wi.z : questions[i].wo.z) *= -1.0f;
    for (const Answer& answer : ask(materials, questions)) {
        ASSERT_EQ(answer.f, glm::vec3(0.0f));
        ASSERT_EQ(answer.pdf, 0.0f);
    }
}

TEST_F(BsdfTest, WithoutSpecularItIsLambert) {
    std::vector<TestMaterial> materials = {roughMaterials().front()};
    materials[0].record.baseColor = {0.5f, 0.25f, 1.0f};
    const std::vector<Question> questions = randomPairs(1, 1024);
    const std::vector<Answer> answers = ask(materials, questions);
    for (size_t i = 0; i < questions.size(); ++i) {
        const float cosine = questions[i].wi.z / std::numbers::pi_v<float>;
        ASSERT_NEAR(answers[i].f.x, 0.5f * cosine, 1e-6f);
        ASSERT_NEAR(answers[i].f.y, 0.25f * cosine, 1e-6f);
        ASSERT_NEAR(answers[i].f.z, cosine, 1e-6f);
        ASSERT_NEAR(answers[i].pdf, cosine, 1e-6f);
    }
}

} // namespace
} // namespace lavalight::test
