#include "gltf/check/empty_accessors.h"

#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

namespace lavalight {
namespace {

using Json = nlohmann::json;

class EmptyAccessors {
  public:
    explicit EmptyAccessors(Json& json) : json_(json) {
        for (const Json& accessor : json_.value("accessors", Json::array()))
            isEmpty_.push_back(accessor.at("count").get<uint64_t>() == 0);
    }

    void drop() {
        for (Json& mesh : list(json_, "meshes"))
            for (Json& primitive : list(mesh, "primitives")) {
                if (primitive.contains("attributes") && primitive["attributes"].is_object())
                    dropMembers(primitive["attributes"]);
                for (Json& target : list(primitive, "targets"))
                    dropMembers(target);
            }
        for (Json& skin : list(json_, "skins"))
            if (skin.contains("inverseBindMatrices") && isEmpty(skin["inverseBindMatrices"]))
                skin.erase("inverseBindMatrices");
        for (Json& animation : list(json_, "animations"))
            dropChannels(animation);
    }

  private:
    [[nodiscard]] bool isEmpty(const Json& index) const { return isEmpty_[index.get<size_t>()]; }

    // The elements of an array that an object may lack.
    static Json::array_t& list(Json& object, const char* name) {
        static Json::array_t none;
        const auto member = object.find(name);
        return member != object.end() && member->is_array() ? member->get_ref<Json::array_t&>() : none;
    }

    void dropMembers(Json& attributes) const {
        std::erase_if(attributes.get_ref<Json::object_t&>(),
                      [&](const auto& attribute) { return isEmpty(attribute.second); });
    }

    void dropChannels(Json& animation) const {
        const Json::array_t& samplers = list(animation, "samplers");
        std::erase_if(list(animation, "channels"), [&](const Json& channel) {
            const auto sampler = channel.at("sampler").get<size_t>();
            return sampler < samplers.size() &&
                   (isEmpty(samplers[sampler].at("input")) || isEmpty(samplers[sampler].at("output")));
        });
    }

    Json& json_;
    std::vector<bool> isEmpty_; // by accessor
};

} // namespace

void dropEmptyAccessors(Json& json) {
    EmptyAccessors(json).drop();
}

} // namespace lavalight
