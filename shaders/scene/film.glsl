// The film of a band: a pixel's sums in registers, and values added to them.
#include "lib/film/fixed_point.glsl"
#include "scene/frame.glsl"
#include "shared/film.h"

layout(set = 0, binding = BINDING_FILM, std430) buffer Film { uint film[]; };
// The film's planes: bit i for row i of FILM_PLANES, and kNegativeWeights.
layout(constant_id = CONSTANT_FILM_PLANES) const uint kPlanesAsked = 1u;

// An expression, not a function: it is a constant once the kernel is specialised, and the branches of planes that nobody asked
// for go before functions are inlined for each plane.
#define FILM_HAS(plane) ((kPlanesAsked >> (plane) & 1u) != 0u)

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

uvec3 loadThree(uint first, uint pixel) {
    return uvec3(film[wordAt(first, pixel)], film[wordAt(first + 1u, pixel)], film[wordAt(first + 2u, pixel)]);
}

void storeThree(uint first, uint pixel, uvec3 words) {
    film[wordAt(first, pixel)] = words.x;
    film[wordAt(first + 1u, pixel)] = words.y;
    film[wordAt(first + 2u, pixel)] = words.z;
}

uvec4 loadFour(uint first, uint pixel) {
    return uvec4(loadThree(first, pixel), film[wordAt(first + 3u, pixel)]);
}

void storeFour(uint first, uint pixel, uvec4 words) {
    storeThree(first, pixel, words.xyz);
    film[wordAt(first + 3u, pixel)] = words.w;
}

ComponentSums loadComponent(FilmPlane shape, uint first, uint pixel) {
    const uint square = first + sumWordsOf(shape);
    return ComponentSums(shape.isSigned != 0u ? loadFour(first, pixel) : uvec4(loadThree(first, pixel), 0u),
                         shape.hasSquares != 0u ? loadFour(square, pixel) : uvec4(0u));
}

void storeComponent(FilmPlane shape, uint first, uint pixel, ComponentSums sums) {
    if (shape.isSigned != 0u)
        storeFour(first, pixel, sums.sum);
    else
        storeThree(first, pixel, sums.sum.xyz);
    if (shape.hasSquares != 0u)
        storeFour(first + sumWordsOf(shape), pixel, sums.square);
}

PlaneSums loadSums(uint plane, uint pixel) {
    const FilmPlane shape = shapeOf(plane, kPlanesAsked);
    const uint first = firstWordOf(plane, kPlanesAsked);
    PlaneSums sums;
    sums.x = loadComponent(shape, first, pixel);
    if (shape.components > 1u)
        sums.y = loadComponent(shape, first + componentWordsOf(shape), pixel);
    if (shape.components > 2u)
        sums.z = loadComponent(shape, first + 2u * componentWordsOf(shape), pixel);
    return sums;
}

void storeSums(uint plane, uint pixel, PlaneSums sums) {
    const FilmPlane shape = shapeOf(plane, kPlanesAsked);
    const uint first = firstWordOf(plane, kPlanesAsked);
    storeComponent(shape, first, pixel, sums.x);
    if (shape.components > 1u)
        storeComponent(shape, first + componentWordsOf(shape), pixel, sums.y);
    if (shape.components > 2u)
        storeComponent(shape, first + 2u * componentWordsOf(shape), pixel, sums.z);
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
    const FilmPlane shape = shapeOf(plane, kPlanesAsked);
    if (shape.isSigned == 0u && any(lessThan(value, vec3(0.0))))
        ++events.negative;
    addComponent(shape, sums.x, value.x, events);
    if (shape.components > 1u)
        addComponent(shape, sums.y, value.y, events);
    if (shape.components > 2u)
        addComponent(shape, sums.z, value.z, events);
}

ComponentSums withSum(ComponentSums sums, ComponentSums whole, ComponentSums part) {
    sums.sum = minus(whole.sum, part.sum);
    return sums;
}

// `sums` with the differences of two planes' sums in place of its own: exact, as the sums of rounded differences are not.
PlaneSums withSums(PlaneSums sums, PlaneSums whole, PlaneSums part) {
    return PlaneSums(withSum(sums.x, whole.x, part.x), withSum(sums.y, whole.y, part.y), withSum(sums.z, whole.z, part.z));
}

uint saturatedSums(FilmPlane shape, ComponentSums sums) {
    const bool sum = shape.isSigned == 0u && sums.sum.xyz == uvec3(0xffffffffu);
    const bool square = shape.hasSquares != 0u && sums.square == uvec4(0xffffffffu);
    return (sum ? 1u : 0u) + (square ? 1u : 0u);
}

// Sums that have left their range. They are counted when they do, not once a sample: so the count follows from the film.
uint saturatedSums(uint plane, PlaneSums sums) {
    const FilmPlane shape = shapeOf(plane, kPlanesAsked);
    return saturatedSums(shape, sums.x) + (shape.components > 1u ? saturatedSums(shape, sums.y) : 0u) +
           (shape.components > 2u ? saturatedSums(shape, sums.z) : 0u);
}
