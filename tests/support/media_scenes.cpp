#include "support/media_scenes.h"

namespace lavalight::test {

Material glassOf(float ior, const glm::vec3& metreColor) {
    Material glass = lambert(glm::vec3(1.0f));
    glass.transmission = 1.0f;
    glass.isSolid = true;
    glass.roughness = 0.0f;
    glass.ior = ior;
    if (metreColor != glm::vec3(1.0f)) {
        glass.attenuationColor = metreColor;
        glass.attenuationDistance = 1.0f;
    }
    return glass;
}

Material unlit(const glm::vec3& color) {
    Material material = lambert(color);
    material.isUnlit = true;
    return material;
}

Shape box(const glm::vec3& lower, const glm::vec3& upper) {
    Shape shape = cube({0, 0, 0}, 0.5f);
    for (glm::vec3& p : shape.positions)
        p = lower + (p + 0.5f) * (upper - lower);
    return shape;
}

glm::vec3 turned(const glm::vec3& p) {
    const glm::vec3 q(0.8f * p.x + 0.6f * p.z, p.y, 0.8f * p.z - 0.6f * p.x);
    return {q.x, 0.96f * q.y - 0.28f * q.z, 0.28f * q.y + 0.96f * q.z};
}

Shape turned(Shape shape) {
    for (glm::vec3& p : shape.positions)
        p = turned(p);
    return shape;
}

Shape moved(Shape shape, const glm::vec3& offset) {
    for (glm::vec3& p : shape.positions)
        p += offset;
    return shape;
}

Camera down(float height) {
    Camera camera;
    camera.name = "down";
    camera.projection = Projection::orthographic;
    camera.position = {0.013f, 0.021f, height};
    camera.halfHeight = 0.1f;
    camera.aspect = 1.0f;
    return camera;
}

Shape squareAt(float z, float half) {
    return rectangle({0, 0, z}, {half, 0, 0}, {0, half, 0});
}

glm::dvec3 over(double metres, const glm::vec3& metreColor) {
    return glm::pow(glm::dvec3(metreColor), glm::dvec3(metres));
}

double passing(double from, double to) {
    const double r = (from - to) / (from + to);
    return 1.0 - r * r;
}

RenderResult MediaTest::render(const Scene& scene, uint32_t samples, uint32_t size, Schedule schedule) {
    RenderSettings settings = imageSettings(size, size, samples);
    settings.estimator.maxBounces = 24;
    settings.estimator.roulette = Roulette::off;
    settings.work.schedule = schedule;
    return renderScene(device(), scene, settings);
}

void MediaTest::expectEverywhere(const Scene& scene, const glm::dvec3& expected) {
    for (const Schedule schedule : schedulesOf(device()))
        expectEveryPixel(render(scene, 4, 16, schedule), expected);
}

} // namespace lavalight::test
