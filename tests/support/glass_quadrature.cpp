#include "support/glass_quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace lavalight::test {
namespace {

constexpr double kPi = std::numbers::pi;

// A facet of a grid over the GGX distribution of projected area, D cos: tan^2 = alpha^2 u / (1 - u), with 1 -
// u = s^2 even in s, since what is seen of facets grows with their slope.
struct Facet {
    glm::dvec3 m{0.0, 0.0, 1.0};
    double solidAngle = 0.0;
    double share = 0.0; // share of the projected area
};

template <typename Visit>
void forEachFacet(double alpha, int side, const Visit& visit) {
    for (int i = 0; i < side; ++i) {
        const double s = (i + 0.5) / side;
        const double tangent = alpha * std::sqrt(1.0 - s * s) / s;
        const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
        const double density = std::pow(s * s / (alpha * cosine * cosine), 2.0) / kPi; // D
        const double share = 2.0 * s / (static_cast<double>(side) * side);
        for (int j = 0; j < side; ++j) {
            const double phi = 2.0 * kPi * (j + 0.5) / side;
            const double sine = tangent * cosine;
            visit(Facet{
                {sine * std::cos(phi), sine * std::sin(phi), cosine}, share / (density * cosine), share});
        }
    }
}

// Walter 2007, eq. 22.
double fresnel(double cosine, double eta) {
    const double g2 = eta * eta - 1.0 + cosine * cosine;
    if (eta == 0.0 || g2 <= 0.0)
        return 1.0;
    const double g = std::sqrt(g2);
    const double a = (g - cosine) / (g + cosine);
    const double b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

glm::dvec3 reflected(const glm::dvec3& wo, const glm::dvec3& m) {
    return 2.0 * glm::dot(wo, m) * m - wo;
}

// Walter 2007, eq. 40; a thin wall's is the reflected direction on the other side.
std::optional<glm::dvec3> passed(const GlassCase& glass, const glm::dvec3& m) {
    if (glass.isThin)
        return reflected(glass.wo, m) * glm::dvec3(1.0, 1.0, -1.0);
    const double cosine = glm::dot(glass.wo, m);
    const double g2 = glass.eta * glass.eta - 1.0 + cosine * cosine;
    if (glass.eta == 0.0 || g2 <= 0.0)
        return std::nullopt;
    return ((cosine - std::sqrt(g2)) * m - glass.wo) / glass.eta;
}

double lambda(const glm::dvec3& w, double alpha) {
    const double tangent2 = std::max(0.0, 1.0 - w.z * w.z) / (w.z * w.z);
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

// Height-correlated masking and shadowing.
double g2Of(const GlassCase& glass, const glm::dvec3& wi) {
    return 1.0 / (1.0 + lambda(glass.wo, glass.alpha) + lambda(wi, glass.alpha));
}

// d(wi) / d(facet): the inverses of Walter 2007, eqs. 14 and 17.
double spread(const GlassCase& glass, const glm::dvec3& m, const glm::dvec3& wi) {
    if (wi.z > 0.0 || glass.isThin)
        return 4.0 * glm::dot(glass.wo, m);
    const double denominator = glm::dot(wi, m) + glm::dot(glass.wo, m) / glass.eta;
    return denominator * denominator / std::abs(glm::dot(wi, m));
}

} // namespace

std::vector<FacetDirection> facetDirections(const GlassCase& glass, int side) {
    std::vector<FacetDirection> directions;
    forEachFacet(glass.alpha, side, [&](const Facet& facet) {
        if (glm::dot(glass.wo, facet.m) <= 0.0)
            return;
        const glm::dvec3 up = reflected(glass.wo, facet.m);
        if (up.z > 0.0)
            directions.push_back({up, facet.solidAngle * spread(glass, facet.m, up)});
        const std::optional<glm::dvec3> down = passed(glass, facet.m);
        if (down && down->z < 0.0)
            directions.push_back({*down, facet.solidAngle * spread(glass, facet.m, *down)});
    });
    return directions;
}

GlassAlbedo glassAlbedo(const GlassCase& glass) {
    if (glass.alpha == 0.0) {
        const double f = fresnel(glass.wo.z, glass.eta);
        return {f, 1.0 - f};
    }
    GlassAlbedo albedo;
    forEachFacet(glass.alpha, 256, [&](const Facet& facet) {
        const double cosine = glm::dot(glass.wo, facet.m);
        if (cosine <= 0.0)
            return;
        const double weight = facet.share * cosine / (glass.wo.z * facet.m.z); // D (wo.m) / (wo.n)
        const double f = fresnel(cosine, glass.eta);
        const glm::dvec3 up = reflected(glass.wo, facet.m);
        if (up.z > 0.0)
            albedo.reflected += weight * f * g2Of(glass, up);
        const std::optional<glm::dvec3> down = passed(glass, facet.m);
        if (down && down->z < 0.0)
            albedo.passed += weight * (1.0 - f) * g2Of(glass, *down);
    });
    return albedo;
}

} // namespace lavalight::test
