// Interpolation of keys (glTF 2.0 specification, section 3.11 and appendix C).
#include "gltf/read/keyframes.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

namespace lavalight {
namespace {

glm::dquat toQuaternion(const glm::dvec4& v) {
    return {v.w, v.x, v.y, v.z};
}

glm::dvec4 unit(const glm::dvec4& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec4(0.0, 0.0, 0.0, 1.0);
}

// The shorter way round: a quaternion and its negative are the same rotation, and glm picks.
glm::dvec4 slerp(const glm::dvec4& a, const glm::dvec4& b, double t) {
    const glm::dquat q = glm::slerp(toQuaternion(unit(a)), toQuaternion(unit(b)), t);
    return {q.x, q.y, q.z, q.w};
}

} // namespace

const std::vector<float>& KeyTimes::of(size_t accessor) {
    const auto known = times_.find(accessor);
    if (known != times_.end())
        return known->second;
    const AccessorView input(document_, accessor);
    if (!input.isScalar())
        throw document_.error(input.name() + " is used as times of keys and must be a SCALAR");
    std::vector<float> times;
    for (size_t i = 0; i < input.count(); ++i) {
        times.push_back(input.scalarAt(i));
        if (i > 0 && !(times[i - 1] <= times[i]))
            throw document_.error(
                fmt::format("{} is used as times of keys, which must ascend, but {} follows {}", input.name(),
                            times[i], times[i - 1]));
    }
    return times_.emplace(accessor, std::move(times)).first->second;
}

Keyframes::Keyframes(const GltfDocument& document, JsonView sampler, KeyType type, KeyTimes& times)
    : output_(document, sampler.count("output", 0)), type_(std::move(type)) {
    const std::string& interpolation = sampler.text("interpolation");
    if (interpolation == "STEP")
        interpolation_ = Interpolation::step;
    else if (interpolation == "CUBICSPLINE")
        interpolation_ = Interpolation::cubic;
    else if (!interpolation.empty() && interpolation != "LINEAR")
        throw document.error(
            fmt::format("an animation's interpolation is \"{}\", which glTF does not know", interpolation));
    times_ = times.of(sampler.count("input", 0));
    checkValues(document);
}

void Keyframes::checkValues(const GltfDocument& document) {
    const bool isRight = type_.components == 1   ? output_.isScalar()
                         : type_.components == 2 ? output_.isVec2()
                         : type_.components == 3 ? output_.isVec3()
                                                 : output_.isVec4();
    if (!isRight)
        throw document.error(fmt::format("{} is used as keys of {} and is of another type", output_.name(),
                                         printable(type_.name)));
    const size_t perKey = interpolation_ == Interpolation::cubic ? 3 : 1;
    const size_t values = perKey * times_.size();
    lanes_ = type_.isArray ? output_.count() / values : 1;
    if (lanes_ == 0 || output_.count() != lanes_ * values)
        throw document.error(fmt::format("{} is used as keys of {} and has {} elements for {} times",
                                         output_.name(), printable(type_.name), output_.count(),
                                         times_.size()));
}

glm::dvec4 Keyframes::stored(size_t key, size_t lane, Part part) const {
    size_t element = key;
    if (interpolation_ == Interpolation::cubic)
        element = 3 * key + static_cast<size_t>(part);
    element = element * lanes_ + lane;
    if (output_.isScalar())
        return {output_.scalarAt(element), 0.0, 0.0, 0.0};
    if (output_.isVec2())
        return {glm::dvec2(output_.vec2At(element)), 0.0, 0.0};
    if (output_.isVec3())
        return {glm::dvec3(output_.vec3At(element)), 0.0};
    return glm::dvec4(output_.vec4At(element));
}

glm::dvec4 Keyframes::between(size_t key, double seconds, size_t lane) const {
    const double span = static_cast<double>(times_[key + 1]) - times_[key];
    const double t = (seconds - times_[key]) / span;
    const glm::dvec4 a = stored(key, lane);
    const glm::dvec4 b = stored(key + 1, lane);
    if (interpolation_ == Interpolation::linear)
        return type_.isRotation ? slerp(a, b, t) : glm::mix(a, b, t);
    // Hermite's polynomials; the tangents are per second.
    const glm::dvec4 out = span * stored(key, lane, Part::outTangent);
    const glm::dvec4 in = span * stored(key + 1, lane, Part::inTangent);
    const double t2 = t * t;
    const double t3 = t2 * t;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * a + (t3 - 2.0 * t2 + t) * out + (3.0 * t2 - 2.0 * t3) * b +
           (t3 - t2) * in;
}

glm::dvec4 Keyframes::at(double seconds, size_t lane) const {
    // The last key that is not after the time; keys of equal times leave no span to divide by.
    const auto next = std::upper_bound(times_.begin(), times_.end(), seconds, [](double time, float key) {
        return time < static_cast<double>(key);
    });
    const auto after = static_cast<size_t>(next - times_.begin());
    const size_t key = after > 0 ? after - 1 : 0;
    const bool holds = after == 0 || after == times_.size() || interpolation_ == Interpolation::step;
    const glm::dvec4 value = holds ? stored(key, lane) : between(key, seconds, lane);
    return type_.isRotation ? unit(value) : value;
}

} // namespace lavalight
