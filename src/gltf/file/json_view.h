// Typed access to checked JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace lavalight {

// A value in a document that has passed the schema check, or nothing. Members of what is not an object and
// elements of what is not an array are nothing, so that optional parts of a file need no questions. The
// document must outlive the view.
class JsonView {
  public:
    JsonView() = default;
    JsonView(const nlohmann::json& json) : json_(&json) {}
    JsonView(nlohmann::json&&) = delete;

    // Whether there is a value.
    [[nodiscard]] explicit operator bool() const { return json_ != nullptr; }
    [[nodiscard]] bool isObject() const { return json_ != nullptr && json_->is_object(); }
    [[nodiscard]] bool has(std::string_view member) const { return static_cast<bool>((*this)[member]); }

    [[nodiscard]] JsonView operator[](std::string_view member) const;
    [[nodiscard]] JsonView operator[](size_t element) const;

    [[nodiscard]] size_t size() const { return elements().size(); } // length of an array
    [[nodiscard]] std::span<const nlohmann::json> elements() const;
    [[nodiscard]] const nlohmann::json::object_t& members() const;

    // The value of a member; `otherwise` where there is none of that type.
    [[nodiscard]] double number(std::string_view member, double otherwise) const;
    [[nodiscard]] uint64_t count(std::string_view member, uint64_t otherwise) const;
    [[nodiscard]] bool flag(std::string_view member, bool otherwise) const;
    [[nodiscard]] const std::string& text(std::string_view member) const; // empty where there is none
    [[nodiscard]] std::optional<size_t> index(std::string_view member) const;

    // The first elements of a member; those that are missing are as in `otherwise`.
    template <glm::length_t Size>
    [[nodiscard]] glm::vec<Size, double> vector(std::string_view member,
                                                glm::vec<Size, double> otherwise) const {
        const JsonView array = (*this)[member];
        for (glm::length_t i = 0; i < Size; ++i)
            otherwise[i] = array[static_cast<size_t>(i)].asNumber(otherwise[i]);
        return otherwise;
    }

    // The value itself.
    [[nodiscard]] double asNumber(double otherwise) const;
    [[nodiscard]] uint64_t asCount(uint64_t otherwise) const;

  private:
    const nlohmann::json* json_ = nullptr;
};

} // namespace lavalight
