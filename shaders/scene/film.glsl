// The film of a band: a pixel's sums in registers, and values added to them.
#include "lib/film/fixed_point.glsl"
#include "scene/frame.glsl"
#include "shared/film.h"

layout(set = 0, binding = BINDING_FILM, std430) buffer Film { uint film[]; };
// The film's planes, bit i for row i of FILM_PLANES.
layout(constant_id = CONSTANT_FILM_PLANES) const uint kPlanesAsked = 1u;

bool filmHas(uint plane) {
    return (kPlanesAsked >> plane & 1u) != 0u;
}

struct ComponentSums {
    uvec4 sum; // three words without sign
    uvec4 square;
};

struct PlaneSums {
    ComponentSums x;
    ComponentSums y; // in planes of two components
    ComponentSums z; // in planes of three
};

// Events that the ledger reports.
struct FilmEvents {
    uint dropped;
    uint negative;
    uint limited;
    uint saturated;
};

uint wordAt(uint word, uint pixel) {
    return word * frame.bandPixels + pixel;
}

ComponentSums loadComponent(uint plane, uint component, uint pixel) {
    const FilmPlane shape = kFilmPlanes[plane];
    const uint first = firstWordOf(plane, kPlanesAsked) + component * componentWordsOf(shape);
    ComponentSums sums = ComponentSums(uvec4(0u), uvec4(0u));
    for (uint word = 0u; word < sumWordsOf(shape); ++word)
        sums.sum[word] = film[wordAt(first + word, pixel)];
    if (shape.hasSquares != 0u)
        for (uint word = 0u; word < kSquareWords; ++word)
            sums.square[word] = film[wordAt(first + sumWordsOf(shape) + word, pixel)];
    return sums;
}

void storeComponent(uint plane, uint component, uint pixel, ComponentSums sums) {
    const FilmPlane shape = kFilmPlanes[plane];
    const uint first = firstWordOf(plane, kPlanesAsked) + component * componentWordsOf(shape);
    for (uint word = 0u; word < sumWordsOf(shape); ++word)
        film[wordAt(first + word, pixel)] = sums.sum[word];
    if (shape.hasSquares != 0u)
        for (uint word = 0u; word < kSquareWords; ++word)
            film[wordAt(first + sumWordsOf(shape) + word, pixel)] = sums.square[word];
}

PlaneSums loadSums(uint plane, uint pixel) {
    PlaneSums sums;
    sums.x = loadComponent(plane, 0u, pixel);
    if (kFilmPlanes[plane].components > 1u)
        sums.y = loadComponent(plane, 1u, pixel);
    if (kFilmPlanes[plane].components > 2u)
        sums.z = loadComponent(plane, 2u, pixel);
    return sums;
}

void storeSums(uint plane, uint pixel, PlaneSums sums) {
    storeComponent(plane, 0u, pixel, sums.x);
    if (kFilmPlanes[plane].components > 1u)
        storeComponent(plane, 1u, pixel, sums.y);
    if (kFilmPlanes[plane].components > 2u)
        storeComponent(plane, 2u, pixel, sums.z);
}

void addComponent(FilmPlane shape, inout ComponentSums sums, float value, inout FilmEvents events) {
    const float kept = shape.isSigned != 0u ? value : max(value, 0.0);
    if (shape.isSigned != 0u)
        events.limited += addSigned(sums.sum, kept, kSumLowestExponent) ? 0u : 1u;
    else
        addExactly(sums.sum.xyz, kept, kSumLowestExponent);
    if (shape.hasSquares != 0u)
        addExactly(sums.square, kept * kept, kSquareLowestExponent);
}

// Components of `value` that the plane lacks must be 0.
void addValue(uint plane, inout PlaneSums sums, vec3 value, inout FilmEvents events) {
    const FilmPlane shape = kFilmPlanes[plane];
    if (shape.isSigned == 0u && any(lessThan(value, vec3(0.0))))
        ++events.negative;
    addComponent(shape, sums.x, value.x, events);
    if (shape.components > 1u)
        addComponent(shape, sums.y, value.y, events);
    if (shape.components > 2u)
        addComponent(shape, sums.z, value.z, events);
}

uint saturatedSums(FilmPlane shape, ComponentSums sums) {
    const bool sum = shape.isSigned == 0u && sums.sum.xyz == uvec3(0xffffffffu);
    const bool square = shape.hasSquares != 0u && sums.square == uvec4(0xffffffffu);
    return (sum ? 1u : 0u) + (square ? 1u : 0u);
}

// Sums that have left their range. They are counted when they do, not once a sample: so the count follows from the film.
uint saturatedSums(uint plane, PlaneSums sums) {
    const FilmPlane shape = kFilmPlanes[plane];
    return saturatedSums(shape, sums.x) + (shape.components > 1u ? saturatedSums(shape, sums.y) : 0u) +
           (shape.components > 2u ? saturatedSums(shape, sums.z) : 0u);
}
