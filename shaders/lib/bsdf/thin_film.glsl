// A film some hundred nanometres thick on a surface, whose two reflections interfere: its reflectance in place of Fresnel's.
// Based on: Belcour, Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", SIGGRAPH
// 2017, as simplified by KHR_materials_iridescence (Schlick's reflectance at both interfaces, no polarisation), with two
// changes: a spectrum without interference is white, where the extension's tint it by its XYZ of equal energy; and no
// channel exceeds what a single wavelength may reflect, so that energy is never gained.
#include "lib/math/constants.glsl"
#include "lib/bsdf/fresnel.glsl"

struct Film {
    float weight; // 0: no film
    float ior;
    float thickness; // nm
};

// A spectrum cos(2 pi opd / lambda + shift) in linear Rec. 709: Belcour, Barla 2017, section 4. Their fit of the colour
// matching functions, two Gaussians for X, one each for Y and Z, has these Fourier transforms; per channel the integral is 1
// at opd 0. opd: difference of optical paths, nm; one shift a channel (it depends on the base).
vec3 interferenceColor(float opd, vec3 shift) {
    const float phase = 2.0 * kPi * opd;
    const vec4 envelope = vec4(0.84659, 1.00022, 1.00112, 0.153868) *
                          exp(-phase * phase * vec4(4.3278e-9, 9.3046e-9, 6.6121e-9, 4.5282e-9));
    const vec4 wave = envelope * cos(phase * vec4(1.6810e-3, 1.7953e-3, 2.2084e-3, 2.2399e-3) + shift.xyzx);
    const mat3 xyzToRgb = mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314,
                               0.0415560, 1.0572252);
    const vec3 equalEnergy = vec3(1.2053, 0.9484, 0.9092); // what matrix and fit make of equal energy
    return xyzToRgb * vec3(wave.x + wave.w, wave.yz) / equalEnergy;
}

vec3 squared(vec3 v) {
    return v * v;
}

// Reflectance along the normal of the interface from the film to a base that reflects f0 in air, by its real index.
vec3 filmBaseF0(float filmIor, vec3 f0, out vec3 baseIor) {
    const vec3 root = sqrt(clamp(f0, 0.0, 0.9999)); // 1 has no index
    baseIor = (1.0 + root) / (1.0 - root);
    return squared((baseIor - filmIor) / (baseIor + filmIor));
}

float filmTopF0(float filmIor) {
    const float r = (filmIor - 1.0) / (filmIor + 1.0);
    return r * r;
}

// What a wavelength reflects whose reflections are all in phase: the most that any does.
vec3 reflectanceInPhase(vec3 top, vec3 base) {
    return squared((sqrt(top) + sqrt(base)) / (1.0 + sqrt(top * base)));
}

// The two reflectances of the film, on top and below, under this angle within it.
struct FilmInterfaces {
    vec3 top;
    vec3 base;
    vec3 baseIor;
};

FilmInterfaces filmInterfaces(Film film, vec3 f0, float cosTheta, float cosInside) {
    FilmInterfaces i;
    i.base = schlick(filmBaseF0(film.ior, f0, i.baseIor), 1.0, cosInside);
    i.top = schlick(vec3(filmTopF0(film.ior)), 1.0, cosTheta);
    return i;
}

// Like Schlick's f0 and f90, a curve that no channel exceeds: through what is reflected in phase along the normal and, unless
// that is too steep, at 60 degrees. What lies below the film gets the rest.
struct FilmBound {
    vec3 f0;
    vec3 f90;
};

FilmBound filmBound(Film film, vec3 f0) {
    const float weight = 0.03125; // Schlick's at 60 degrees
    const FilmInterfaces normal = filmInterfaces(film, f0, 1.0, 1.0);
    const FilmInterfaces slanted =
        filmInterfaces(film, f0, 0.5, sqrt(max(0.0, 1.0 - 0.75 / (film.ior * film.ior))));
    FilmBound bound;
    bound.f0 = reflectanceInPhase(normal.top, normal.base);
    const vec3 there = reflectanceInPhase(slanted.top, slanted.base);
    bound.f90 = clamp((there - (1.0 - weight) * bound.f0) / weight, 1.0, 2.0);
    return bound;
}

// Airy's sum over the reflections within the film, to the second order. f0: of the base in air, along the normal.
vec3 filmReflectance(Film film, vec3 f0, float cosTheta) {
    const float cos2Inside = 1.0 - (1.0 - cosTheta * cosTheta) / (film.ior * film.ior);
    if (cos2Inside <= 0.0)
        return vec3(1.0);
    const float cosInside = sqrt(cos2Inside);
    const FilmInterfaces i = filmInterfaces(film, f0, cosTheta, cosInside);
    // A reflection turns the phase where it meets a denser medium; the film is denser than air.
    const vec3 shift = kPi * (vec3(1.0) + vec3(lessThan(i.baseIor, vec3(film.ior))));
    const vec3 amplitude = sqrt(clamp(i.top * i.base, 1e-5, 0.9999));
    const vec3 returned = squared(1.0 - i.top) * i.base / (1.0 - amplitude * amplitude);
    const float opd = 2.0 * film.ior * film.thickness * cosInside;
    const vec3 first = 2.0 * (returned - (1.0 - i.top)) * amplitude;
    const vec3 sum = i.top + returned + first * interferenceColor(opd, shift) +
                     first * amplitude * interferenceColor(2.0 * opd, 2.0 * shift);
    const FilmBound bound = filmBound(film, f0);
    const vec3 curve = mix(bound.f0, bound.f90, schlickWeight(cosTheta));
    return clamp(sum, vec3(0.0), min(min(curve, reflectanceInPhase(i.top, i.base)), 1.0));
}
