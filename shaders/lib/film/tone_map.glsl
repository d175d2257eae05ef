// Tone mapping: what a display of limited range shows of radiance. Curves take linear Rec. 709, at least 0, and give linear
// display values; toneMap() picks one and clamps, encodeSrgb() makes signals of the result. Constants are the publications'.
#include "shared/tone.h"

// Khronos PBR Neutral, specification of 2024 (KhronosGroup/ToneMapping, PBR_Neutral): what lies below kCompressionStart loses
// the reflectance kNeutralF90 that a dielectric adds to its base colour, and is left alone otherwise; hues stay.
const float kNeutralF90 = 0.04;
const float kCompressionStart = 0.8 - kNeutralF90;
const float kDesaturation = 0.15;

vec3 neutralCurve(vec3 color) {
    const float least = min(color.r, min(color.g, color.b));
    const float offset = least <= 2.0 * kNeutralF90 ? least - least * least / (4.0 * kNeutralF90) : kNeutralF90;
    const vec3 body = color - offset;
    const float peak = max(body.r, max(body.g, body.b));
    if (peak <= kCompressionStart)
        return body;
    const float room = 1.0 - kCompressionStart;
    const float newPeak = 1.0 - room * room / (peak - kCompressionStart + room);
    const float colorfulness = 1.0 / (kDesaturation * (peak - newPeak) + 1.0);
    return mix(vec3(newPeak), body * (newPeak / peak), colorfulness);
}

// Matrices are written row by row, as published, which GLSL reads as columns: `v * m` is then the matrix times v.

// Linear Rec. 709 and Rec. 2020: from the primaries and the white of ITU-R BT.709-6 and BT.2020-2, as in BT.2087 and BT.2407.
const mat3 kRec709ToRec2020 = mat3(0.6274039, 0.3292830, 0.0433131,
                                   0.0690973, 0.9195404, 0.0113623,
                                   0.0163914, 0.0880133, 0.8955953);
const mat3 kRec2020ToRec709 = mat3(1.6604910, -0.5876411, -0.0728499,
                                   -0.1245505, 1.1328999, -0.0083494,
                                   -0.0181508, -0.1005789, 1.1187297);

// AgX (Sobotka 2022) as Blender has it, with primaries for Rec. 2020 (Chow 2023, AgX_LUT_Gen/AgXBaseRec2020.py; the outset is
// the inverse of that file's). Dark colours go through a narrower gamut, where no channel is alone, and bright ones fade out.
const mat3 kAgxInset = mat3(0.856627153, 0.0951212405, 0.0482516061,
                            0.137318973, 0.761241991, 0.101439036,
                            0.111898213, 0.0767994186, 0.811302368);
const mat3 kAgxOutset = mat3(1.127100582, -0.110606643, -0.016493939,
                             -0.141329763, 1.157823702, -0.016493939,
                             -0.141329763, -0.110606643, 1.251936407);
// Stops from 10 below to 6.5 above middle grey, 0.18: log2 of the darkest and the brightest value told apart.
const float kAgxDarkest = -12.47393;
const float kAgxBrightest = 4.026069;

// The default contrast over the share of those stops: the fit of degree 6 by Wrensch 2023, "Minimal AgX Implementation", mean
// squared error 3.7e-6. The one of degree 7 is closer, but falls near 0.
vec3 agxContrast(vec3 x) {
    return ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
}

vec3 agxCurve(vec3 color) {
    const vec3 inset = color * kRec709ToRec2020 * kAgxInset;
    const vec3 stops = log2(max(inset, exp2(kAgxDarkest)));
    const vec3 share = min((stops - kAgxDarkest) / (kAgxBrightest - kAgxDarkest), 1.0);
    const vec3 signal = agxContrast(share) * kAgxOutset;
    return pow(max(signal, 0.0), vec3(2.2)) * kRec2020ToRec709;
}

// ACES: Hill 2017 (in Pettineo and Neubelt's BakingLab, ACES.hlsl), a fit of reference rendering and output transforms for
// Rec. 709 displays of 100 nits. As published: without the factors (1.8, 1 / 0.6) by which programs brighten it.
const mat3 kAcesInput = mat3(0.59719, 0.35458, 0.04823,
                             0.07600, 0.90834, 0.01566,
                             0.02840, 0.13383, 0.83777);
const mat3 kAcesOutput = mat3(1.60475, -0.53108, -0.07367,
                              -0.10208, 1.10813, -0.00605,
                              -0.00327, -0.07276, 1.07602);

vec3 acesCurve(vec3 color) {
    const vec3 v = color * kAcesInput;
    const vec3 fit = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return fit * kAcesOutput;
}

// Every curve has reached its end here; squares are still far from the largest float.
const float kBrightestMapped = 1e9;

// `curve`: kTone...; color at least 0, infinity included. Linear display values in [0, 1].
vec3 toneMap(uint curve, vec3 color) {
    vec3 mapped = min(color, kBrightestMapped);
    if (curve == kToneNeutral)
        mapped = neutralCurve(mapped);
    else if (curve == kToneAgx)
        mapped = agxCurve(mapped);
    else if (curve == kToneAces)
        mapped = acesCurve(mapped);
    return clamp(mapped, 0.0, 1.0);
}

// Signals of linear values in [0, 1] (IEC 61966-2-1:1999): linear near black, a power above.
vec3 encodeSrgb(vec3 linear) {
    return mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}
