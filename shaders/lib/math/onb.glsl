// Orthonormal bases around a unit vector.
// Based on: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017, listing 3.

struct Basis {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

Basis makeBasis(vec3 n) {
    const float s = n.z >= 0.0 ? 1.0 : -1.0;
    const float a = -1.0 / (s + n.z);
    const float b = n.x * n.y * a;
    return Basis(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

vec3 toLocal(Basis basis, vec3 v) {
    return vec3(dot(v, basis.tangent), dot(v, basis.bitangent), dot(v, basis.normal));
}

vec3 toWorld(Basis basis, vec3 v) {
    return v.x * basis.tangent + v.y * basis.bitangent + v.z * basis.normal;
}
