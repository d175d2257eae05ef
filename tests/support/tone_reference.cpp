#include "support/tone_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lavalight::test {
namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;

double least(const dvec3& v) {
    return std::min({v.x, v.y, v.z});
}

double largest(const dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

// The equations of KhronosGroup/ToneMapping, PBR_Neutral/README.md, with its names.
dvec3 neutral(const dvec3& in) {
    constexpr double f90 = 0.04;
    constexpr double ks = 0.8 - f90;
    constexpr double kd = 0.15;
    const double x = least(in);
    const double f = x <= 2.0 * f90 ? x - x * x / (4.0 * f90) : f90;
    const double p = largest(in - f);
    if (p <= ks)
        return in - f;
    const double pn = 1.0 - (1.0 - ks) * (1.0 - ks) / (p + 1.0 - 2.0 * ks);
    const double g = 1.0 / (kd * (p - pn) + 1.0);
    return (in - f) * (pn / p * g) + dvec3(pn * (1.0 - g));
}

// Linear RGB to XYZ: the primaries' sum is white, D65, of luminance 1 (SMPTE RP 177-1993).
dmat3 toXyz(const std::array<dvec2, 3>& primaries) {
    const auto xyz = [](const dvec2& xy) { return dvec3(xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y); };
    const dmat3 columns(xyz(primaries[0]), xyz(primaries[1]), xyz(primaries[2]));
    const dvec3 shares = glm::inverse(columns) * xyz(dvec2(0.3127, 0.3290));
    return {columns[0] * shares.x, columns[1] * shares.y, columns[2] * shares.z};
}

dmat3 rec709ToRec2020() {
    const dmat3 rec709 = toXyz({dvec2(0.64, 0.33), dvec2(0.30, 0.60), dvec2(0.15, 0.06)});
    const dmat3 rec2020 = toXyz({dvec2(0.708, 0.292), dvec2(0.170, 0.797), dvec2(0.131, 0.046)});
    return glm::inverse(rec2020) * rec709;
}

// AgX with Blender's matrices (column by column) and Wrensch's polynomial, as three.js and Filament have it.
dvec3 agx(const dvec3& in) {
    const dmat3 inset(0.856627153315983, 0.137318972929847, 0.11189821299995, 0.0951212405381588,
                      0.761241990602591, 0.0767994186031903, 0.0482516061458583, 0.101439036467562,
                      0.811302368396859);
    const dmat3 outsetInverse(0.899796955911611, 0.11142098895748, 0.11142098895748, 0.0871996192028351,
                              0.875575586156966, 0.0871996192028349, 0.013003424885555, 0.0130034248855548,
                              0.801379391839686);
    const double darkest = std::log2(0.18) - 10.0;
    const double brightest = std::log2(0.18) + 6.5;
    const dmat3 toRec2020 = rec709ToRec2020();
    const dvec3 v = inset * (toRec2020 * in);
    dvec3 signal(0.0);
    for (glm::length_t c = 0; c < 3; ++c) {
        const double stops = std::log2(std::max(v[c], 1e-10));
        const double x = std::clamp((stops - darkest) / (brightest - darkest), 0.0, 1.0);
        signal[c] = 15.5 * std::pow(x, 6) - 40.14 * std::pow(x, 5) + 31.96 * std::pow(x, 4) -
                    6.868 * std::pow(x, 3) + 0.4298 * x * x + 0.1191 * x - 0.00232;
    }
    const dvec3 out = glm::max(glm::inverse(outsetInverse) * signal, dvec3(0.0));
    return glm::inverse(toRec2020) * glm::pow(out, dvec3(2.2));
}

// Hill's ACES.hlsl, its matrices written row by row.
dvec3 aces(const dvec3& in) {
    const dmat3 input = glm::transpose(
        dmat3(0.59719, 0.35458, 0.04823, 0.07600, 0.90834, 0.01566, 0.02840, 0.13383, 0.83777));
    const dmat3 output = glm::transpose(
        dmat3(1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605, -0.00327, -0.07276, 1.07602));
    const dvec3 v = input * in;
    const dvec3 a = v * (v + 0.0245786) - 0.000090537;
    const dvec3 b = v * (0.983729 * v + 0.4329510) + 0.238081;
    return output * (a / b);
}

dvec3 mapped(ToneCurve curve, const dvec3& color) {
    switch (curve) {
    case ToneCurve::neutral:
        return neutral(color);
    case ToneCurve::agx:
        return agx(color);
    case ToneCurve::aces:
        return aces(color);
    case ToneCurve::linear:
        break;
    }
    return color;
}

} // namespace

dvec3 toneReference(ToneCurve curve, const dvec3& color) {
    return glm::clamp(mapped(curve, color), 0.0, 1.0);
}

double srgbSignal(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double linearOfSrgb(double signal) {
    return signal <= 0.04045 ? signal / 12.92 : std::pow((signal + 0.055) / 1.055, 2.4);
}

dvec3 srgbSignal(const dvec3& linear) {
    return {srgbSignal(linear.x), srgbSignal(linear.y), srgbSignal(linear.z)};
}

} // namespace lavalight::test
