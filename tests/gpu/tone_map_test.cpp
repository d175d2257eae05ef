// Tone curves are the published ones, and do what is said of them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "render/setting_names.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "support/tone_reference.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Question { // as in the kernel
    glm::vec3 color;
    ToneCurve curve;
};

struct Answer { // as in the kernel
    glm::vec3 display;
    float unused0;
    glm::vec3 signal;
    float unused1;
};

// Tolerance of display values and of signals: a fortieth of an 8-bit code. Drivers may err by some 1e-5 in a
// power.
constexpr double kTolerance = 1e-4;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class ToneMap : public DeviceTest {
  protected:
    std::vector<Answer> map(ToneCurve curve, const std::vector<glm::vec3>& colors) {
        std::vector<Question> questions;
        for (const glm::vec3& color : colors)
            questions.push_back({color, curve});
        return runner_.map<Answer>(questions);
    }
    glm::vec3 display(ToneCurve curve, const glm::vec3& color) { return map(curve, {color}).front().display; }

    // Calls check() for each curve, with its name on record.
    template <typename Check>
    void forEachCurve(const Check& check) {
        for (const SettingName<ToneCurve>& curve : settingNames<ToneCurve>()) {
            SCOPED_TRACE(std::string(curve.name));
            check(curve.value);
        }
    }

  private:
    KernelRunner runner_{device(), test_kernels::find("tone_map_test")};
};

std::string text(const glm::vec3& v) {
    return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z);
}

// Greys from 1e-6 to 1e6 in 3,001 steps of 0.9 %, after black.
std::vector<glm::vec3> greyRamp() {
    std::vector<glm::vec3> colors{glm::vec3(0.0f)};
    for (int i = 0; i <= 3000; ++i)
        colors.emplace_back(std::pow(10.0f, -6.0f + 12.0f * static_cast<float>(i) / 3000.0f));
    return colors;
}

// Every mixture of some values, pure colours among them; then random ones over twelve decades.
std::vector<glm::vec3> manyColors() {
    const std::vector<float> values{0.0f, 1e-5f, 0.01f, 0.08f, 0.18f, 0.5f, 0.8f, 1.0f, 4.0f, 50.0f, 1e6f};
    std::vector<glm::vec3> colors;
    for (const float red : values)
        for (const float green : values)
            for (const float blue : values)
                colors.emplace_back(red, green, blue);
    Random random(1);
    const auto any = [&] { return std::pow(10.0f, random.between(-6.0f, 6.0f)); };
    for (int i = 0; i < 10000; ++i)
        colors.emplace_back(any(), any(), any());
    return colors;
}

TEST_F(ToneMap, EveryCurveIsThePublishedOne) {
    std::vector<glm::vec3> colors = greyRamp();
    for (const glm::vec3& color : manyColors())
        colors.push_back(color);
    forEachCurve([&](ToneCurve curve) {
        const std::vector<Answer> answers = map(curve, colors);
        for (size_t i = 0; i < colors.size(); ++i) {
            const glm::dvec3 expected = toneReference(curve, glm::dvec3(colors[i]));
            const glm::dvec3 signal = srgbSignal(expected);
            for (glm::length_t c = 0; c < 3; ++c) {
                ASSERT_NEAR(answers[i].display[c], expected[c], kTolerance) << text(colors[i]);
                ASSERT_NEAR(answers[i].signal[c], signal[c], kTolerance) << text(colors[i]);
            }
        }
    });
}

TEST_F(ToneMap, AlongGreyEveryCurveRisesFromBlackToWhiteAndStaysGrey) {
    forEachCurve([&](ToneCurve curve) {
        const std::vector<Answer> answers = map(curve, greyRamp());
        EXPECT_EQ(answers.front().display, glm::vec3(0.0f));
        EXPECT_GT(answers.back().display.g, 0.99f);
        glm::vec3 before(0.0f);
        for (const Answer& answer : answers) {
            const glm::vec3 now = answer.display;
            for (glm::length_t c = 0; c < 3; ++c) {
                ASSERT_GE(now[c], before[c] - 1e-6f) << text(before); // rounding where the curve is level
                ASSERT_GE(now[c], 0.0f);
                ASSERT_LE(now[c], 1.0f);
                ASSERT_NEAR(now[c], now.g, 2e-5f); // ACES: its matrices have five digits
            }
            before = now;
        }
    });
}

TEST_F(ToneMap, AnyColorHoweverBrightIsANumberBetweenBlackAndWhite) {
    std::vector<glm::vec3> colors = manyColors();
    for (const float huge : {1e10f, 1e20f, std::numeric_limits<float>::max(), kInfinity})
        for (const glm::vec3& hue : {glm::vec3(1.0f), glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)})
            colors.push_back(
                glm::mix(glm::vec3(0.0f), glm::vec3(huge), glm::greaterThan(hue, glm::vec3(0.5f))));
    forEachCurve([&](ToneCurve curve) {
        for (const Answer& answer : map(curve, colors))
            for (glm::length_t c = 0; c < 3; ++c)
                for (const float value : {answer.display[c], answer.signal[c]})
                    ASSERT_TRUE(value >= 0.0f && value <= 1.0f) << value; // false for NaN
        EXPECT_GT(display(curve, glm::vec3(kInfinity)).b, 0.99f);
    });
}

TEST_F(ToneMap, LinearLeavesColorsOfTheDisplayAsTheyAreAndClampsOthers) {
    for (const glm::vec3& color :
         {glm::vec3(0.0f), glm::vec3(0.25f, 0.5f, 1.0f), glm::vec3(1e-3f, 0.9f, 0.1f)})
        EXPECT_EQ(display(ToneCurve::linear, color), color);
    EXPECT_EQ(display(ToneCurve::linear, {0.5f, 7.0f, 1e6f}), glm::vec3(0.5f, 1.0f, 1.0f));
}

// The promise of the specification: base colours of dielectrics, to which reflection adds 0.04, come back.
TEST_F(ToneMap, NeutralTakesOnlyTheReflectanceOfDielectricsOffColorsBelowItsCompression) {
    Random random(2);
    std::vector<glm::vec3> colors;
    for (int i = 0; i < 1000; ++i)
        colors.emplace_back(random.between(0.08f, 0.8f), random.between(0.08f, 0.8f),
                            random.between(0.08f, 0.8f));
    const std::vector<Answer> answers = map(ToneCurve::neutral, colors);
    for (size_t i = 0; i < colors.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c)
            ASSERT_NEAR(answers[i].display[c], colors[i][c] - 0.04f, 1e-6f) << text(colors[i]);
    EXPECT_LT(display(ToneCurve::neutral, glm::vec3(0.9f)).r, 0.9f - 0.04f - 0.01f); // above, it compresses
}

TEST_F(ToneMap, ColorsFarTooBrightFadeToWhiteWhereLinearKeepsThemPure) {
    for (const glm::vec3& hue : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
        for (const ToneCurve curve : {ToneCurve::neutral, ToneCurve::agx, ToneCurve::aces}) {
            const glm::vec3 faded = display(curve, 1e5f * hue);
            EXPECT_GT(std::min({faded.r, faded.g, faded.b}), 0.95f) << nameOf(curve) << " " << text(hue);
            EXPECT_EQ(display(ToneCurve::linear, 1e5f * hue), hue);
        }
}

TEST_F(ToneMap, SignalsMatchTheStandardAtKnownPoints) {
    const auto signal = [&](float linear) {
        return map(ToneCurve::linear, {glm::vec3(linear)}).front().signal.r;
    };
    EXPECT_EQ(signal(0.0f), 0.0f);
    EXPECT_FLOAT_EQ(signal(0.001f), 0.01292f);      // the linear piece
    EXPECT_NEAR(signal(0.18f), 0.46135613f, 1e-5f); // 1.055 * 0.18^(1/2.4) - 0.055
    EXPECT_NEAR(signal(0.21404114f), 0.5f, 1e-5f);  // ((0.5 + 0.055) / 1.055)^2.4
    EXPECT_NEAR(signal(1.0f), 1.0f, 1e-6f);
    // The pieces meet, but for a step of 3e-8 that the standard's rounded constants leave.
    EXPECT_NEAR(signal(0.0031308f), signal(std::nextafter(0.0031308f, 1.0f)), 1e-5f);
}

TEST_F(ToneMap, EveryCodeSurvivesDecodingAndEncoding) {
    std::vector<glm::vec3> colors;
    for (int code = 0; code < 256; ++code)
        colors.emplace_back(static_cast<float>(linearOfSrgb(code / 255.0)));
    const std::vector<Answer> answers = map(ToneCurve::linear, colors);
    for (int code = 0; code < 256; ++code)
        EXPECT_EQ(std::lround(255.0f * answers[static_cast<size_t>(code)].signal.r), code);
}

} // namespace
} // namespace lavalight::test
