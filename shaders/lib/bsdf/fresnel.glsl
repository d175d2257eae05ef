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

// Squared cosine beyond an interface, by Snell's law; below 0 under total internal reflection. Of indices that nearly match
// the usual form, a difference of two numbers near 1, would lose small cosines: at grazing angles all was reflected.
float cos2Beyond(float cosTheta, float eta) {
    if (abs(eta - 1.0) < 0.0625)
        return (cosTheta * cosTheta + (eta - 1.0) * (eta + 1.0)) / (eta * eta);
    return 1.0 - (1.0 - cosTheta * cosTheta) / (eta * eta);
}

// Unpolarised reflectance of a smooth interface between dielectrics; eta = index beyond the interface / index on this
// side, cosTheta >= 0 on this side. 1 under total internal reflection. Born, Wolf, "Principles of Optics", section 1.5.2.
float fresnelDielectric(float cosTheta, float eta) {
    const float cos2T = cos2Beyond(cosTheta, eta);
    if (cos2T <= 0.0)
        return 1.0;
    const float cosT = sqrt(cos2T);
    const float parallel = (eta * cosTheta - cosT) / (eta * cosTheta + cosT);
    const float perpendicular = (cosTheta - eta * cosT) / (cosTheta + eta * cosT);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// The lecture's margin code: Schlick's curve in place of the exact one, by the cosine on the thinner side, so that it
// meets total internal reflection continuously.
float schlickDielectric(float cosTheta, float eta) {
    const float r = (eta - 1.0) / (eta + 1.0);
    const float cos2T = cos2Beyond(cosTheta, eta);
    if (cos2T <= 0.0)
        return 1.0;
    return mix(r * r, 1.0, schlickWeight(eta < 1.0 ? sqrt(cos2T) : cosTheta));
}
