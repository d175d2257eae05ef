// Thin films reflect what interference leaves of each wavelength.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Question { // as in the kernel, padded to std430
    glm::vec3 f0;
    float cosTheta;
    float ior;
    float thickness;
    float unused[2];
};

Question question(const glm::vec3& f0, float cosTheta, float ior, float thickness) {
    return {f0, cosTheta, ior, thickness, {}};
}

class ThinFilmTest : public DeviceTest {
  protected:
    std::vector<glm::vec4> ask(const std::vector<Question>& questions) {
        KernelRunner runner(device(), test_kernels::find("thin_film_test"));
        return runner.map<glm::vec4>(questions);
    }
};

double squared(double x) {
    return x * x;
}

double schlick(double f0, double cosTheta) {
    return f0 + (1.0 - f0) * std::pow(1.0 - cosTheta, 5.0);
}

// The two interfaces of a film, as reflectances.
struct Interfaces {
    double top;
    double base;
    double path;  // difference of optical paths, nm
    double shift; // shift of the phase
};

Interfaces interfacesOf(const Question& q, glm::length_t channel) {
    const double ior = q.ior;
    const double root = std::sqrt(double{q.f0[channel]});
    const double baseIor = (1.0 + root) / (1.0 - root);
    const double cosInside = std::sqrt(1.0 - (1.0 - squared(q.cosTheta)) / squared(ior));
    return {schlick(squared((ior - 1.0) / (ior + 1.0)), q.cosTheta),
            schlick(squared((baseIor - ior) / (baseIor + ior)), cosInside),
            2.0 * ior * q.thickness * cosInside, std::numbers::pi * (baseIor < ior ? 2.0 : 1.0)};
}

// Reflectance with all orders of reflections: Airy's formula, with the phase turned at both ends of the way
// within the film.
double airy(const Interfaces& i, double wavelength) {
    const double r12 = std::sqrt(i.top);
    const double r23 = std::sqrt(i.base);
    const double c = -2.0 * r12 * r23 * std::cos(2.0 * std::numbers::pi * i.path / wavelength + i.shift);
    return (i.top + i.base + c) / (1.0 + i.top * i.base + c);
}

// A lobe with different widths to either side.
double lobe(double wavelength, double mean, double below, double above) {
    return std::exp(-0.5 * squared((wavelength - mean) * (wavelength < mean ? below : above)));
}

// The functions of CIE 1931, by the multi-lobe fit of Wyman, Sloan, Shirley, "Simple Analytic Approximations
// to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013.
glm::dvec3 colorMatching(double w) {
    return {1.056 * lobe(w, 599.8, 0.0264, 0.0323) + 0.362 * lobe(w, 442.0, 0.0624, 0.0374) -
                0.065 * lobe(w, 501.1, 0.0490, 0.0382),
            0.821 * lobe(w, 568.8, 0.0213, 0.0247) + 0.286 * lobe(w, 530.9, 0.0613, 0.0322),
            1.217 * lobe(w, 437.0, 0.0845, 0.0278) + 0.681 * lobe(w, 459.0, 0.0385, 0.0725)};
}

glm::dvec3 toRec709(const glm::dvec3& xyz) {
    return glm::dmat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314,
                      0.0415560, 1.0572252) *
           xyz;
}

// A channel of the reflectance in linear RGB; a spectrum of all ones is 1 in each channel.
double integratedOverWavelengths(const Question& q, glm::length_t channel) {
    const Interfaces interfaces = interfacesOf(q, channel);
    glm::dvec3 sum(0.0);
    glm::dvec3 white(0.0);
    for (double wavelength = 380.0; wavelength <= 780.0; wavelength += 1.0) {
        sum += airy(interfaces, wavelength) * colorMatching(wavelength);
        white += colorMatching(wavelength);
    }
    return toRec709(sum)[channel] / toRec709(white)[channel];
}

// The kernel keeps two orders and takes Gaussians for the colour matching functions; no channel exceeds what
// single wavelengths may reflect, which colours outside Rec. 709 would.
TEST_F(ThinFilmTest, ChannelsAreTheSpectrumOfInterference) {
    std::vector<Question> questions;
    for (const glm::vec3& f0 : {glm::vec3(0.04f), glm::vec3(0.1f, 0.3f, 0.5f)})
        for (const float ior : {1.3f, 1.5f, 1.8f})
            for (const float thickness : {0.0f, 100.0f, 250.0f, 400.0f, 700.0f, 1200.0f})
                for (const float cosTheta : {1.0f, 0.6f, 0.3f})
                    questions.push_back(question(f0, cosTheta, ior, thickness));
    const std::vector<glm::vec4> answers = ask(questions);
    double sumOfErrors = 0.0;
    for (size_t i = 0; i < questions.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c) {
            const Question& q = questions[i];
            const double exact = std::max(0.0, integratedOverWavelengths(q, c));
            sumOfErrors += std::abs(answers[i][c] - exact);
        }
    EXPECT_LT(sumOfErrors / static_cast<double>(3 * questions.size()), 0.01);
}

TEST_F(ThinFilmTest, FilmWithoutThicknessIsNotSeen) {
    std::vector<Question> questions;
    for (const float ior : {1.1f, 1.3f, 1.45f})
        questions.push_back(question({0.04f, 0.1f, 0.2f}, 1.0f, ior, 0.0f));
    for (const glm::vec4& answer : ask(questions)) {
        EXPECT_NEAR(answer.x, 0.04f, 1e-3f);
        EXPECT_NEAR(answer.y, 0.1f, 1e-3f);
        EXPECT_NEAR(answer.z, 0.2f, 2e-3f);
    }
}

TEST_F(ThinFilmTest, ThickFilmHasNoColour) {
    const std::vector<Question> questions = {question(glm::vec3(0.04f), 0.7f, 1.8f, 50000.0f),
                                             question(glm::vec3(0.6f), 0.7f, 1.3f, 50000.0f)};
    const std::vector<glm::vec4> answers = ask(questions);
    for (size_t i = 0; i < questions.size(); ++i) {
        const Interfaces f = interfacesOf(questions[i], 0);
        const double incoherent = f.top + squared(1.0 - f.top) * f.base / (1.0 - f.top * f.base);
        for (glm::length_t c = 0; c < 3; ++c)
            EXPECT_NEAR(answers[i][c], incoherent, 1e-4);
    }
}

} // namespace
} // namespace lavalight::test
