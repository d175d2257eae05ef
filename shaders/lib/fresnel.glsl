// Fresnel reflectance.

// The weight of F90 in Schlick's approximation: F = F0 + (F90 - F0) * schlickWeight. Schlick 1994, eq. 15.
float schlickWeight(float cosTheta) {
    const float m = clamp(1.0 - cosTheta, 0.0, 1.0);
    const float m2 = m * m;
    return m2 * m2 * m;
}

vec3 schlick(vec3 f0, float f90, float cosTheta) {
    return mix(f0, vec3(f90), schlickWeight(cosTheta));
}
