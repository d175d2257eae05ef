// Tests of the lab's formulas against enumeration and quadrature that know nothing of them.
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "lab/theory.h"
#include "shared/lab.h"

namespace lavalight::test {
namespace {

using std::numbers::pi;

// Integral over [a, b] by 20,000 midpoints: good to 1e-9 for the smooth functions here.
double integrate(double a, double b, const std::function<double(double)>& f) {
    constexpr int kPoints = 20000;
    const double width = (b - a) / kPoints;
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i)
        sum += f(a + (i + 0.5) * width);
    return sum * width;
}

// Mean and variance of value(outcome) over 36 rolls of two dice, each with both outcomes of the pick.
Theory enumerateOneDie(double p) {
    double mean = 0.0;
    double second = 0.0;
    for (int face = 1; face <= 6; ++face) {
        const double sixfold = 6.0 * face / p;
        const double plain = face / (1.0 - p);
        mean += (p * sixfold + (1.0 - p) * plain) / 6.0;
        second += (p * sixfold * sixfold + (1.0 - p) * plain * plain) / 6.0;
    }
    return {mean, second - mean * mean};
}

TEST(LabTheory, TwoDiceAreTheAverageOverAllThirtySixRolls) {
    double mean = 0.0;
    double second = 0.0;
    for (int first = 1; first <= 6; ++first)
        for (int other = 1; other <= 6; ++other) {
            mean += (6.0 * first + other) / 36.0;
            second += (6.0 * first + other) * (6.0 * first + other) / 36.0;
        }
    EXPECT_NEAR(diceTogether().mean, mean, 1e-12);
    EXPECT_DOUBLE_EQ(mean, 24.5);
    EXPECT_NEAR(diceTogether().variance, second - mean * mean, 1e-10);
}

TEST(LabTheory, OneDieAtATimeHasTheLecturesVariances) {
    constexpr std::array<std::array<double, 2>, 4> kLecture{
        {{0.5, 522.1}, {0.8, 158.1}, {0.2, 2148.7}, {6.0 / 7.0, 142.9}}};
    for (const auto& [p, variance] : kLecture) {
        EXPECT_NEAR(dieAtATime(p).variance, variance, 0.05) << p;
        EXPECT_NEAR(dieAtATime(p).variance, enumerateOneDie(p).variance, 1e-9) << p;
        EXPECT_NEAR(dieAtATime(p).mean, enumerateOneDie(p).mean, 1e-12) << p;
    }
}

TEST(LabTheory, NoDieProbabilityBeatsTheBestOne) {
    const double best = bestDieProbability();
    for (const double off : {-0.05, -0.001, 0.001, 0.05})
        EXPECT_GT(dieAtATime(best + off).variance, dieAtATime(best).variance) << off;
}

TEST(LabTheory, PickedStrataAgreeWithQuadrature) {
    const std::array<float, 4> pmf{0.1f, 0.2f, 0.3f, 0.4f};
    double mean = 0.0;
    double second = 0.0;
    for (int i = 0; i < 4; ++i) { // density of a point in stratum i: 4 p_i
        const double density = 4.0 * pmf[static_cast<size_t>(i)];
        mean += integrate(i / 4.0, (i + 1) / 4.0, [](double x) { return std::exp(kStrataRate * x); });
        second += integrate(i / 4.0, (i + 1) / 4.0,
                            [&](double x) { return std::exp(2.0 * kStrataRate * x) / density; });
    }
    EXPECT_NEAR(strataPicked(pmf).mean, mean, 1e-6);
    EXPECT_NEAR(strataPicked(pmf).variance, second - mean * mean, 1e-4);
}

TEST(LabTheory, OnePointInTheOnlyStratumIsTheNaiveEstimator) {
    const std::array<float, 1> one{1.0f};
    EXPECT_NEAR(strataEach(1).variance, strataPicked(one).variance, 1e-9);
    EXPECT_NEAR(strataEach(8).mean, strataEach(1).mean, 1e-9);
    // Halving the strata's width quarters the variance within a stratum, and twice as many points share it.
    EXPECT_NEAR(strataEach(128).variance / strataEach(64).variance, 1.0 / 8.0, 1e-3);
}

TEST(LabTheory, SkiesAgreeWithQuadratureOverTheHemisphere) {
    for (const bool isOvercast : {false, true}) {
        const auto radiance = [&](double c) { return isOvercast ? (1.0 + 2.0 * c) / 3.0 : 1.0; };
        const double mean = 2.0 * pi * integrate(0.0, 1.0, [&](double c) { return radiance(c) * c; });
        EXPECT_NEAR(mean, isOvercast ? 7.0 / 9.0 * pi : pi, 1e-8);
        for (const Hemisphere directions : {Hemisphere::uniform, Hemisphere::cosine}) {
            const auto pdf = [&](double c) { return directions == Hemisphere::uniform ? 0.5 / pi : c / pi; };
            const double second = 2.0 * pi * integrate(0.0, 1.0, [&](double c) {
                                      const double sample = radiance(c) * c / pdf(c);
                                      return sample * sample * pdf(c);
                                  });
            EXPECT_NEAR(skyIrradiance(directions, isOvercast).mean, mean, 1e-8);
            EXPECT_NEAR(skyIrradiance(directions, isOvercast).variance, second - mean * mean, 1e-7);
        }
    }
}

TEST(LabTheory, ASphereLightsTheFloorByItsClosedFormAndByQuadrature) {
    const SphereLight light{0.8, 1.0, 4.0, 3.0};
    const double rim = std::sqrt(1.0 - 1.0 / 16.0);
    EXPECT_NEAR(light.irradiance().mean, pi * 3.0 / 16.0 * 0.8, 1e-12); // pi L sin^2 cos
    EXPECT_NEAR(light.oneMinusCosRim(), 1.0 - rim, 1e-15);
    const double solidAngle = 2.0 * pi * (1.0 - rim);
    double second = 0.0;        // over the cone: t the cosine to its axis
    constexpr int kAngles = 64; // exact for a trigonometric polynomial
    for (int i = 0; i < kAngles; ++i)
        second += integrate(rim, 1.0,
                            [&](double t) {
                                const double c =
                                    t * 0.8 + std::sqrt(1.0 - t * t) * 0.6 * std::cos(2.0 * pi * i / kAngles);
                                return 3.0 * solidAngle * c * 3.0 * solidAngle * c / solidAngle;
                            }) *
                  (2.0 * pi / kAngles);
    const Theory theory = light.irradiance();
    EXPECT_NEAR(theory.variance, second - theory.mean * theory.mean, 1e-8);
}

TEST(LabTheory, NoLightProbabilityBeatsTheBestOne) {
    const SphereLight large{0.8, 1.0, 4.0, 4.0};
    const SphereLight small{0.6, 0.1, 4.0, 100.0};
    const double best = bestLightProbability(large, small);
    EXPECT_NEAR(twoLights(large, small, 0.3).mean, large.irradiance().mean + small.irradiance().mean, 1e-12);
    for (const double off : {-0.05, 0.05})
        EXPECT_GT(twoLights(large, small, best + off).variance, twoLights(large, small, best).variance)
            << off;
}

TEST(LabTheory, EightRaysKeepTheirPowerUnderRoulette) {
    // 0, 1, ..., 8 survivors of 32 W each, by the binomial distribution.
    constexpr std::array<double, 9> kWays{1, 8, 28, 56, 70, 56, 28, 8, 1};
    double mean = 0.0;
    double second = 0.0;
    for (size_t alive = 0; alive < kWays.size(); ++alive) {
        mean += kWays[alive] / 256.0 * 32.0 * static_cast<double>(alive);
        second += kWays[alive] / 256.0 * 32.0 * 32.0 * static_cast<double>(alive * alive);
    }
    EXPECT_DOUBLE_EQ(rouletteRays(8, 16.0, 0.5).mean, mean);
    EXPECT_DOUBLE_EQ(mean, 128.0);
    EXPECT_DOUBLE_EQ(rouletteRays(8, 16.0, 0.5).variance, second - mean * mean);
}

// Unpolarised reflectance by the angles of both sides: Fresnel's equations as sines and tangents.
double fresnelByAngles(double cosTheta, double eta) {
    const double incident = std::acos(cosTheta);
    if (std::sin(incident) >= eta)
        return 1.0;
    const double refracted = std::asin(std::sin(incident) / eta);
    const double s = std::sin(incident - refracted) / std::sin(incident + refracted);
    const double p = std::tan(incident - refracted) / std::tan(incident + refracted);
    return 0.5 * (s * s + p * p);
}

TEST(LabTheory, DiffuseReflectanceAgreesWithQuadrature) {
    for (const double eta : {1.5, 1.1, 2.4, 1.0 / 1.5}) {
        const double exact = integrate(0.0, 1.0, [&](double c) { return 2.0 * c * fresnelByAngles(c, eta); });
        EXPECT_NEAR(diffuseReflectance(Fresnel::exact, eta), exact, 1e-5) << eta;
    }
    const double schlick =
        integrate(0.0, 1.0, [](double c) { return 2.0 * c * (0.04 + 0.96 * std::pow(1.0 - c, 5.0)); });
    EXPECT_NEAR(diffuseReflectance(Fresnel::schlick, 1.5), schlick, 1e-8);
}

TEST(LabTheory, TheSlopeOfAPowerIsItsExponent) {
    const std::array<double, 4> samples{4.0, 16.0, 64.0, 256.0};
    std::array<double, 4> errors{};
    for (size_t i = 0; i < samples.size(); ++i)
        errors[i] = 3.0 * std::pow(samples[i], -1.25);
    EXPECT_NEAR(logLogSlope(samples, errors), -1.25, 1e-12);
}

} // namespace
} // namespace lavalight::test
