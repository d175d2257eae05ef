// Tests of what users name: by name before number, and a message that lists what there is.
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/named.h"

namespace lavalight::test {
namespace {

size_t find(const std::string& text) {
    return findNamed({"front", "2", "top"}, {text, "--camera", "camera", "box.glb"});
}

std::string refusal(const std::string& text) {
    try {
        static_cast<void>(find(text));
    } catch (const UsageError& error) {
        return error.what();
    }
    return {};
}

TEST(FindNamed, NamesGoBeforeNumbers) {
    EXPECT_EQ(find("top"), 2u);
    EXPECT_EQ(find("0"), 0u);
    EXPECT_EQ(find("2"), 1u);
}

TEST(FindNamed, UnknownOnesAreRefusedWithWhatThereIs) {
    for (const char* text : {"3", "-1", "Top", "1x", ""})
        EXPECT_EQ(refusal(text), "--camera: box.glb has no camera \"" + std::string(text) +
                                     "\"; it has 0 \"front\", 1 \"2\", 2 \"top\"");
}

TEST(TextFor, FindsEachOfNamesThatAreEmptyOrComeTwice) {
    const std::vector<std::string> names{"", "beach", "street", "beach"};
    EXPECT_EQ(textFor(names, 0), "0") << "no text is for no choice";
    EXPECT_EQ(textFor(names, 2), "street");
    for (size_t i = 0; i < names.size(); ++i)
        EXPECT_EQ(findNamed(names, {textFor(names, i), "--variant", "variant", "a.glb"}), i);
}

} // namespace
} // namespace lavalight::test
