#include "lab/theory.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "shared/lab.h"

namespace lavalight {
namespace {

using std::numbers::pi;

constexpr double kFaces = 6.0;
constexpr double kSixfold = 6.0;

// Mean of D^k for one die.
double dieMoment(int k) {
    double sum = 0.0;
    for (int face = 1; face <= 6; ++face)
        sum += std::pow(face, k);
    return sum / kFaces;
}

// Integral of exp(rate x) from a to b.
double integralOfExp(double rate, double a, double b) {
    return (std::exp(rate * b) - std::exp(rate * a)) / rate;
}

// The integrand and its square over stratum i of n.
struct Stratum {
    Stratum(size_t i, size_t n)
        : width(1.0 / static_cast<double>(n)),
          first(
              integralOfExp(kStrataRate, static_cast<double>(i) * width, static_cast<double>(i + 1) * width)),
          second(integralOfExp(2.0 * kStrataRate, static_cast<double>(i) * width,
                               static_cast<double>(i + 1) * width)) {}
    double width;
    double first;
    double second;
};

// Integral of (a + b c)^2 c^k over c in [0, 1].
double squareMoment(double a, double b, int k) {
    return a * a / (k + 1) + 2.0 * a * b / (k + 2) + b * b / (k + 3);
}

} // namespace

Theory diceTogether() {
    const double one = dieMoment(2) - dieMoment(1) * dieMoment(1);
    return {(kSixfold + 1.0) * dieMoment(1), (kSixfold * kSixfold + 1.0) * one};
}

Theory dieAtATime(double p) {
    assert(p > 0.0 && p < 1.0);
    const double mean = diceTogether().mean;
    const double second = kSixfold * kSixfold * dieMoment(2) / p + dieMoment(2) / (1.0 - p);
    return {mean, second - mean * mean};
}

// a / p + b / (1 - p) is least where p : 1 - p = sqrt(a) : sqrt(b).
double bestDieProbability() {
    return kSixfold / (kSixfold + 1.0);
}

Theory strataPicked(std::span<const float> pmf) {
    Theory theory;
    double second = 0.0;
    for (size_t i = 0; i < pmf.size(); ++i) {
        assert(pmf[i] > 0.0f);
        const Stratum stratum(i, pmf.size());
        theory.mean += stratum.first;
        second += stratum.width * stratum.second / pmf[i];
    }
    theory.variance = second - theory.mean * theory.mean;
    return theory;
}

Theory strataEach(uint32_t count) {
    Theory theory;
    for (size_t i = 0; i < count; ++i) {
        const Stratum stratum(i, count);
        theory.mean += stratum.first;
        theory.variance += stratum.width * stratum.second - stratum.first * stratum.first;
    }
    return theory;
}

// With the cosine c: E = 2 pi * integral of L c. Samples are 2 pi L c with c uniform, or pi L with density 2
// c.
Theory skyIrradiance(Hemisphere directions, bool isOvercast) {
    const double a = isOvercast ? 1.0 / 3.0 : 1.0;
    const double b = isOvercast ? 2.0 / 3.0 : 0.0;
    const double mean = 2.0 * pi * (a / 2.0 + b / 3.0);
    const double second = directions == Hemisphere::uniform ? 4.0 * pi * pi * squareMoment(a, b, 2)
                                                            : 2.0 * pi * pi * squareMoment(a, b, 1);
    return {mean, second - mean * mean};
}

double SphereLight::oneMinusCosRim() const {
    const double sin2 = radius * radius / (distance * distance);
    return sin2 / (1.0 + std::sqrt(1.0 - sin2));
}

double SphereLight::power() const {
    return 4.0 * pi * radius * radius * pi * radiance;
}

// With t the cosine to the cone's axis, mean(t) = (1 + t0) / 2 and mean(t^2) = (1 + t0 + t0^2) / 3 over the
// cone. The cosine to the normal is t cos(center) + sqrt(1 - t^2) sin(center) cos(phi).
Theory SphereLight::irradiance() const {
    const double rim = 1.0 - oneMinusCosRim();
    const double scale = 2.0 * pi * oneMinusCosRim() * radiance;
    const double t2 = (1.0 + rim + rim * rim) / 3.0;
    const double cos2 = cosCenter * cosCenter;
    const double mean = scale * cosCenter * 0.5 * (1.0 + rim);
    const double second = scale * scale * (t2 * cos2 + 0.5 * (1.0 - t2) * (1.0 - cos2));
    return {mean, second - mean * mean};
}

Theory twoLights(const SphereLight& first, const SphereLight& second, double p) {
    assert(p > 0.0 && p < 1.0);
    const Theory a = first.irradiance();
    const Theory b = second.irradiance();
    const double mean = a.mean + b.mean;
    const double square = (a.variance + a.mean * a.mean) / p + (b.variance + b.mean * b.mean) / (1.0 - p);
    return {mean, square - mean * mean};
}

double bestLightProbability(const SphereLight& first, const SphereLight& second) {
    const auto rms = [](const Theory& t) { return std::sqrt(t.variance + t.mean * t.mean); };
    const double a = rms(first.irradiance());
    return a / (a + rms(second.irradiance()));
}

Theory rouletteRays(uint32_t count, double power, double p) {
    assert(p > 0.0 && p <= 1.0);
    return {count * power, count * power * power * (1.0 / p - 1.0)};
}

// The exact mean is after Duntley, "The Optical Properties of Diffusing Materials", 1942, for the denser
// medium beyond. From within, all beyond the critical angle is reflected and the rest is the same light
// backwards: 1 - (1 - F) eta^2, for both curves (the lecture's goes by the outer cosine).
double diffuseReflectance(Fresnel fresnel, double eta) {
    if (eta < 1.0)
        return 1.0 - (1.0 - diffuseReflectance(fresnel, 1.0 / eta)) * eta * eta;
    const double n = eta;
    if (fresnel == Fresnel::schlick) { // integral of 2 c (1 - c)^5 is 1 / 21
        const double f0 = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
        return f0 + (1.0 - f0) / 21.0;
    }
    const double n2 = n * n;
    const double n4 = n2 * n2;
    return 0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0)) +
           n2 * (n2 - 1.0) * (n2 - 1.0) / std::pow(n2 + 1.0, 3.0) * std::log((n - 1.0) / (n + 1.0)) -
           2.0 * n * n2 * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0)) +
           8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * (n4 - 1.0) * (n4 - 1.0)) * std::log(n);
}

double logLogSlope(std::span<const double> samples, std::span<const double> errors) {
    assert(samples.size() == errors.size() && samples.size() > 1);
    const auto count = static_cast<double>(samples.size());
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (size_t i = 0; i < samples.size(); ++i) {
        const double logSamples = std::log(samples[i]);
        const double logError = std::log(errors[i]);
        x += logSamples;
        y += logError;
        xx += logSamples * logSamples;
        xy += logSamples * logError;
    }
    return (count * xy - x * y) / (count * xx - x * x);
}

} // namespace lavalight
