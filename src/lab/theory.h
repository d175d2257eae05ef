// What theory says of the lab's estimators: means and variances of one sample, computed from first
// principles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/settings.h"

namespace lavalight {

struct Theory {
    double mean = 0.0;
    double variance = 0.0;
};

// 6 * D1 + D2 by rolling both dice.
[[nodiscard]] Theory diceTogether();
// 6 * D1 + D2 by rolling one die: the sixfold one with probability p in (0, 1), else the other; divided by
// the probability.
[[nodiscard]] Theory dieAtATime(double p);
// The p of least variance.
[[nodiscard]] double bestDieProbability();

// Integral of exp(kStrataRate x) over [0, 1]: one of pmf.size() equal strata picked, then a point in it.
[[nodiscard]] Theory strataPicked(std::span<const float> pmf);
// The mean of one point in each of `count` strata.
[[nodiscard]] Theory strataEach(uint32_t count);

// Irradiance under radiance 1 (constant) or under the CIE overcast sky of zenith radiance 1.
[[nodiscard]] Theory skyIrradiance(Hemisphere directions, bool isOvercast);

// A sphere of uniform radiance, all of it above the horizon.
struct SphereLight {
    double cosCenter = 1.0; // cosine of the angle between the normal and the direction of the centre
    double radius = 1.0;
    double distance = 2.0; // distance of the centre; more than the radius
    double radiance = 1.0;

    // 1 - cosine of the angle between the centre and the rim, by a formula that does not cancel.
    [[nodiscard]] double oneMinusCosRim() const;
    [[nodiscard]] double power() const; // in W
    // Irradiance by one direction, uniform in the cone, without picking a light.
    [[nodiscard]] Theory irradiance() const;
};

// Irradiance of both lights, picking the first with probability p.
[[nodiscard]] Theory twoLights(const SphereLight& first, const SphereLight& second, double p);
[[nodiscard]] double bestLightProbability(const SphereLight& first, const SphereLight& second);

// Power of `count` rays of `power` each, if each survives with probability p and then counts 1 / p.
[[nodiscard]] Theory rouletteRays(uint32_t count, double power, double p);

// Mean reflectance of a smooth dielectric under diffuse light; eta = index beyond / index on this side,
// not 1.
[[nodiscard]] double diffuseReflectance(Fresnel fresnel, double eta);

// Slope of the least-squares line through (log samples, log error).
[[nodiscard]] double logLogSlope(std::span<const double> samples, std::span<const double> errors);

} // namespace lavalight
