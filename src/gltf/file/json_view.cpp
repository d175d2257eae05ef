// Look-ups in nlohmann's JSON.
#include "gltf/file/json_view.h"

namespace lavalight {

JsonView JsonView::operator[](std::string_view member) const {
    if (!isObject())
        return {};
    const auto found = json_->find(member);
    return found == json_->end() ? JsonView() : JsonView(*found);
}

JsonView JsonView::operator[](size_t element) const {
    const auto all = elements();
    return element < all.size() ? JsonView(all[element]) : JsonView();
}

std::span<const nlohmann::json> JsonView::elements() const {
    if (json_ == nullptr || !json_->is_array())
        return {};
    return json_->get_ref<const nlohmann::json::array_t&>();
}

const nlohmann::json::object_t& JsonView::members() const {
    static const nlohmann::json::object_t kNone;
    return isObject() ? json_->get_ref<const nlohmann::json::object_t&>() : kNone;
}

double JsonView::number(std::string_view member, double otherwise) const {
    return (*this)[member].asNumber(otherwise);
}

uint64_t JsonView::count(std::string_view member, uint64_t otherwise) const {
    return (*this)[member].asCount(otherwise);
}

bool JsonView::flag(std::string_view member, bool otherwise) const {
    const JsonView value = (*this)[member];
    return value && value.json_->is_boolean() ? value.json_->get<bool>() : otherwise;
}

const std::string& JsonView::text(std::string_view member) const {
    static const std::string kNone;
    const JsonView value = (*this)[member];
    return value && value.json_->is_string() ? value.json_->get_ref<const std::string&>() : kNone;
}

std::optional<size_t> JsonView::index(std::string_view member) const {
    const JsonView value = (*this)[member];
    return value && value.json_->is_number_integer() ? std::optional(value.json_->get<size_t>())
                                                     : std::nullopt;
}

double JsonView::asNumber(double otherwise) const {
    return json_ != nullptr && json_->is_number() ? json_->get<double>() : otherwise;
}

uint64_t JsonView::asCount(uint64_t otherwise) const {
    return json_ != nullptr && json_->is_number_integer() ? json_->get<uint64_t>() : otherwise;
}

} // namespace lavalight
