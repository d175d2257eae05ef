// The tabulated albedos of the GGX lobe and of sheen are never below what integrating the lobes gives, and
// close to it.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "device_scene/albedo_table.h"
#include "kernels/kernel_source.h"
#include "shared/scene.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

constexpr size_t kStrata = 512; // as in the kernel
// Error of the integrals here, over 512 x 512 points: the integrand jumps where directions are lost below the
// horizon.
constexpr double kIntegralError = 2e-4;

struct Question { // as in the kernel
    float cosTheta;
    float alpha;
};

struct Answer {      // as in the kernel
    glm::vec4 table; // F0, F90, sheen
    glm::vec4 rowMean;
};

// What the table says more than the integral, of each: facets that reflect everything, F90 alone, sheen.
struct Excess {
    double least = 1.0;
    double most = -1.0;
    std::string where;
    void add(double value, const Question& at) {
        const bool isLargest = !(value <= most);
        least = std::min(least, value);
        most = isLargest ? value : most;
        if (isLargest)
            where = fmt::format("most at cosine {}, roughness {}", at.cosTheta, std::sqrt(at.alpha));
    }
};

// Places between the entries, and on some.
std::vector<Question> questions() {
    std::vector<Question> list;
    const int cosines = 21;
    for (const float roughness : {0.032f, 0.036f, 0.043f, 0.055f, 0.07f, 0.1f, 0.113f, 0.15f, 0.2f, 0.3f,
                                  0.45f, 0.6f, 0.8f, 0.97f, 1.0f})
        for (int i = 0; i < cosines; ++i) {
            const float s = 0.03f + 0.97f * static_cast<float>(i) / static_cast<float>(cosines - 1);
            list.push_back({std::min(s * s, 1.0f), roughness * roughness});
        }
    return list;
}

class AlbedoTableTest : public DeviceTest {
  protected:
    // The table's answers and the integrals, in the order of the questions.
    std::vector<Answer> answersTo(const std::vector<Question>& asked) {
        const gpu::Buffer table = makeAlbedoTable(device(), embeddedKernel("albedo")).buffer;
        gpu::ResourceTable resources;
        resources.set("albedoTable", table);
        KernelRunner runner(device(), test_kernels::find("albedo_table_test"), resources);
        const auto rows = runner.run<Answer>(std::span<const Question>(asked), asked.size() * kStrata);
        std::vector<Answer> answers;
        for (size_t i = 0; i < rows.size(); i += kStrata) {
            glm::dvec4 integral(0.0);
            for (size_t row = i; row < i + kStrata; ++row)
                integral += glm::dvec4(rows[row].rowMean) / static_cast<double>(kStrata);
            answers.push_back({rows[i].table, glm::vec4(integral)});
        }
        return answers;
    }
};

TEST_F(AlbedoTableTest, TheTableIsNeverBelowTheLobeAndCloseToIt) {
    const std::vector<Question> asked = questions();
    const std::vector<Answer> answers = answersTo(asked);
    Excess facets;
    Excess grazing;
    Excess sheen;
    for (size_t i = 0; i < answers.size(); ++i) {
        const glm::dvec4 table(answers[i].table);
        const glm::dvec4 integral(answers[i].rowMean);
        facets.add(table.x + table.y - integral.x - integral.y, asked[i]);
        grazing.add(table.y - integral.y, asked[i]);
        if (asked[i].alpha >= 0.01f) // the least alpha of sheen, which is divided by more than 1
            sheen.add((table.z - integral.z) / std::max(1.0, integral.z), asked[i]);
    }
    std::cout << "facets " << facets.least << " to " << facets.most << ", grazing " << grazing.least << " to "
              << grazing.most << ", sheen " << sheen.least << " to " << sheen.most << "\n";
    EXPECT_GE(facets.least, -kIntegralError);
    EXPECT_GE(grazing.least, -kIntegralError);
    EXPECT_GE(sheen.least, -kIntegralError);
    EXPECT_LE(facets.most, 3e-3) << facets.where;
    EXPECT_LE(grazing.most, 3e-3) << grazing.where;
    EXPECT_LE(sheen.most, 2.5e-2) << sheen.where;
}

} // namespace
} // namespace lavalight::test
