// Layers of a path from the vertices that it meets.
#include "scene/path_layers.glsl"
#include "scene/path_vertex.glsl"

// Light that reaches the camera without being scattered, after `bounce` vertices.
void recordEmission(uint slot, uint bounce, vec3 radiance) {
    if (recordsLayers() && bounce == 0u)
        layers[slot].emission = radiance;
}

// All that a path has found once it can find no more direct light: its second vertex is the last that it sees by light that
// was scattered once. The host does the same where it sums what paths find.
void recordDirect(uint slot, uint bounce, vec3 radiance) {
    if (!recordsLayers() || bounce != 1u)
        return;
    layers[slot].direct = radiance;
    layers[slot].isPastDirect = 1u;
}

// Where the surface is, as the camera sees it.
void recordPlace(uint slot, uint bounce, Interaction surface, float t) {
    if (!recordsLayers() || bounce > 0u)
        return;
    layers[slot].normal = surface.n;
    layers[slot].guideNormal = surface.n;
    layers[slot].position = surface.p;
    layers[slot].surface = surface.id;
    layers[slot].b1 = surface.b.y;
    layers[slot].b2 = surface.b.z;
    layers[slot].depth =
        sceneHas(kFeaturePanorama) ? t : dot(surface.p - frame.cameraPosition, frame.cameraForward);
}

// What the surface looks like. Guides follow the path through smooth mirrors and glass.
void recordAlbedo(uint slot, uint bounce, Vertex v) {
    if (!recordsLayers() || (bounce > 0u && layers[slot].isFollowed == 0u))
        return;
    const vec3 albedo = min(directionalAlbedo(v.bsdf, v.wo), vec3(1.0));
    const bool isSmoothOnly = !hasNonDelta(v.bsdf);
    if (bounce == 0u) {
        layers[slot].albedo = albedo;
        layers[slot].isFollowed = isSmoothOnly ? 1u : 0u;
        layers[slot].guideAlbedo = isSmoothOnly ? vec3(1.0) : albedo;
        return;
    }
    if (isSmoothOnly)
        return;
    layers[slot].isFollowed = 0u;
    layers[slot].guideAlbedo = albedo;
    layers[slot].guideNormal = v.surface.n;
}
