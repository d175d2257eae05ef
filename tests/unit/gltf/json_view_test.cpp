// Tests of typed access to JSON.
#include "gltf/file/json_view.h"

#include <optional>

#include <gtest/gtest.h>

namespace lavalight::test {
namespace {

using Json = nlohmann::json;

TEST(JsonView, MembersOfTheRightTypeAreRead) {
    const Json json = {{"number", 2.5}, {"count", 7}, {"flag", true}, {"text", "abc"}, {"list", {1, 2, 3}}};
    const JsonView view(json);
    EXPECT_EQ(view.number("number", 1.0), 2.5);
    EXPECT_EQ(view.number("count", 1.0), 7.0);
    EXPECT_EQ(view.count("count", 1), 7u);
    EXPECT_EQ(view.index("count"), std::optional<size_t>(7));
    EXPECT_TRUE(view.flag("flag", false));
    EXPECT_EQ(view.text("text"), "abc");
    EXPECT_EQ(view["list"].size(), 3u);
    EXPECT_EQ(view["list"][2].asCount(0), 3u);
    EXPECT_EQ(view.members().size(), 5u);
}

TEST(JsonView, WhatIsMissingOrOfAnotherTypeReadsAsTheDefault) {
    const Json json = {{"number", "2.5"}, {"text", 3}, {"object", {{"a", 1}}}};
    const JsonView view(json);
    for (const char* member : {"number", "object", "none"}) {
        EXPECT_EQ(view.number(member, 1.5), 1.5) << member;
        EXPECT_EQ(view.count(member, 4), 4u) << member;
        EXPECT_EQ(view.index(member), std::nullopt) << member;
        EXPECT_TRUE(view.flag(member, true)) << member;
        EXPECT_EQ(view[member].size(), 0u) << member;
    }
    EXPECT_EQ(view.text("text"), "");
    EXPECT_TRUE(view["number"].members().empty());
}

TEST(JsonView, PartsOfNothingAreNothing) {
    const Json json = {{"list", {1}}};
    const JsonView view(json);
    EXPECT_FALSE(view["a"]["b"]["c"]);
    EXPECT_FALSE(view["list"]["b"]);
    EXPECT_FALSE(view["list"][1]);
    EXPECT_FALSE(JsonView()["a"]);
    EXPECT_EQ(JsonView().size(), 0u);
    EXPECT_TRUE(view["list"]);
    EXPECT_FALSE(view.has("a"));
}

TEST(JsonView, VectorsTakeTheDefaultOfEachElementThatIsMissing) {
    const Json json = {{"v", {1, 2}}};
    EXPECT_EQ(JsonView(json).vector<3>("v", glm::dvec3(9.0)), glm::dvec3(1.0, 2.0, 9.0));
    EXPECT_EQ(JsonView(json).vector<2>("w", glm::dvec2(3.0, 4.0)), glm::dvec2(3.0, 4.0));
}

} // namespace
} // namespace lavalight::test
