// Rough glass by quadrature on the host, in double precision: what the device must come to.
// Based on: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace lavalight::test {

struct GlassCase {
    glm::dvec3 wo{0.0, 0.0, 1.0};
    double eta = 1.5; // index beyond / index on the side of wo; 0: a mirror
    double alpha = 0.25;
    bool isThin = false;
};

// A facet, the direction that it sends light to, and the solid angle of such directions that it stands for.
struct FacetDirection {
    glm::dvec3 wi{0.0};
    double solidAngle = 0.0;
};

// Facets of a grid of `side` squared, as many that reflect and, where there is no total reflection, that let
// pass.
[[nodiscard]] std::vector<FacetDirection> facetDirections(const GlassCase& glass, int side);

struct GlassAlbedo {
    double reflected = 0.0;
    double passed = 0.0; // as flux
};

[[nodiscard]] GlassAlbedo glassAlbedo(const GlassCase& glass);

} // namespace lavalight::test
