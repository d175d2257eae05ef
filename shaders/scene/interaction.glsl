// From a hit to the geometry of the surface there.
#include "lib/bsdf/normal_map.glsl"
#include "lib/estimator.glsl"
#include "lib/features.glsl"
#include "lib/math/octahedral.glsl"
#include "lib/math/ray_offset.glsl"
#include "lib/math/smooth_surface.glsl"
#include "scene/tangent_basis.glsl"
#include "scene/triangle_record.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"
#include "shared/wavefront.h"

struct Interaction {
    vec3 p;
    vec3 pError;   // bound on the error of p per component
    vec3 ng;       // geometric normal, unit length, on the side of wo
    vec3 n;        // shading normal, unit length, flipped with ng
    bool isFront;  // wo is on the triangle's front
    float area;
    SurfaceId id;
    uint emitter;  // or kNoEmitter
    uint material;
    uint solid;    // solid whose boundary this is, or 0; needs kFeatureSolids
    vec3 b;        // barycentrics
    bool isLifted; // rays to the side of wo start at `lifted`, on the smooth surface that the mesh stands for
    vec3 lifted;
    // With kFeatureTangents, all flipped with ng:
    vec3 tangent;     // unit length, towards growing u
    vec3 bitangent;
    vec3 meshNormal;  // n before normal maps
    vec3 coatNormal;  // n of the clear coat
    vec2 anisotropyDirection; // in units of tangent and bitangent
};

bool isSmoothShaded(TriangleRecord triangle) {
    return sceneHas(kFeatureShadingNormals) && (triangle.material & kFlatBit) == 0u;
}

mat3 cornerNormals(SurfaceId surface) {
    const uvec4 n = texelFetch(triangleNormals, int(attributeIndex(surface)));
    return mat3(decodeOctahedral(n.x), decodeOctahedral(n.y), decodeOctahedral(n.z));
}

vec3 shadingNormal(TriangleRecord triangle, vec3 b, vec3 ng) {
    if (!isSmoothShaded(triangle))
        return ng;
    const mat3 normals = cornerNormals(triangle.surface);
    const vec3 n = b.x * normals[0] + b.y * normals[1] + b.z * normals[2];
    const float length2 = dot(n, n);
    return length2 > 1e-12 ? n * inversesqrt(length2) : ng; // opposite corner normals cancel: keep the plane's
}

// Lets the surface follow the normals that the mesh gives it: rays start where the smooth surface lies, and the normal is bent
// as those of normal maps are. On the inner side of a curve the smooth surface lies below, and rays start on the mesh.
void followNormals(TriangleRecord triangle, vec3 wo, float longestEdge, inout Interaction i) {
    const float side = i.isFront ? 1.0 : -1.0;
    const vec3 lift = liftToSmoothSurface(i.p, i.b, mat3(triangle.v0, triangle.v1, triangle.v2),
                                          side * cornerNormals(triangle.surface), i.ng);
    i.isLifted = (triangle.material & kOwnPlaneBit) == 0u &&
                 dot(lift, i.ng) > max(kLeastLift * longestEdge, 8.0 * dot(abs(i.ng), i.pError));
    i.lifted = i.p + lift;
    i.n = bentNormal(i.n, i.ng, wo);
    i.coatNormal = i.n;
}

// The basis that vectors of a texture are given in, on the side of wo. first: of the tangents that go by its coordinates.
Basis textureBasis(Interaction i, uint first) {
    const float side = i.isFront ? 1.0 : -1.0;
    const Basis basis = tangentBasis(i.id, first, i.b, side * i.meshNormal);
    return Basis(side * basis.tangent, side * basis.bitangent, i.meshNormal);
}

void setTangents(uint first, inout Interaction i) {
    const Basis basis = textureBasis(i, first);
    i.tangent = basis.tangent;
    i.bitangent = basis.bitangent;
}

// The basis of the BSDF: z is the shading normal, x the direction of anisotropy, turned counter-clockwise by `rotation`.
Basis shadingBasis(Interaction i, float anisotropy, float rotation) {
    const Basis any = makeBasis(i.n);
    if (!sceneHas(kFeatureAnisotropy) || anisotropy == 0.0)
        return any;
    const mat2 turn = mat2(cos(rotation), sin(rotation), -sin(rotation), cos(rotation));
    const vec2 direction = turn * i.anisotropyDirection;
    const vec3 along = direction.x * i.tangent + direction.y * i.bitangent;
    const vec3 x = along - dot(along, i.n) * i.n;
    const float length2 = dot(x, x);
    if (length2 < 1e-8)
        return any;
    return Basis(x * inversesqrt(length2), cross(i.n, x * inversesqrt(length2)), i.n);
}

// wo: unit vector from the hit back along the ray.
Interaction makeInteraction(Hit hit, vec3 wo) {
    const TriangleRecord triangle = loadTriangle(hit.record);
    const vec3 e1 = triangle.v1 - triangle.v0;
    const vec3 e2 = triangle.v2 - triangle.v0;
    const vec3 normal = cross(e1, e2);
    const float twiceArea = length(normal);
    const float longestEdge = sqrt(max(dot(e1, e1), max(dot(e2, e2), dot(e2 - e1, e2 - e1))));
    vec3 b = vec3(1.0 - hit.barycentrics.x - hit.barycentrics.y, hit.barycentrics);
    Interaction i;
    i.pError = hitPointError(b, triangle.v0, triangle.v1, triangle.v2);
    b = keepOffEdges(b, i.pError, longestEdge, twiceArea);
    i.p = b.x * triangle.v0 + b.y * triangle.v1 + b.z * triangle.v2;
    i.ng = normal / twiceArea;
    i.area = 0.5 * twiceArea;
    i.isFront = dot(i.ng, wo) > 0.0;
    i.n = shadingNormal(triangle, b, i.ng);
    if (!i.isFront) {
        i.ng = -i.ng;
        i.n = -i.n;
    }
    i.id = triangle.surface;
    i.emitter = emitterOf(triangle);
    i.material = triangle.material & kMaterialMask;
    i.solid = sceneHas(kFeatureSolids) ? solidOf(triangle.surface) : 0u;
    i.b = b;
    i.isLifted = false;
    i.lifted = i.p;
    i.tangent = i.bitangent = vec3(0.0);
    i.meshNormal = i.coatNormal = i.n;
    i.anisotropyDirection = vec2(1.0, 0.0);
    if (sceneHas(kFeatureTangents))
        setTangents(0u, i);
    if (kSmoothTerminator != 0u && isSmoothShaded(triangle))
        followNormals(triangle, wo, longestEdge, i);
    return i;
}
