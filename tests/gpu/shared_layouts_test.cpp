// Both languages lay out every shared struct alike: the offsets and strides that the compiled kernel declares
// are C++'s.
#include "shared_layouts.h"

#include <cstdint>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "test_kernels.h"

namespace lavalight::test {
namespace {

// What a module says of its types and variables, by their ids. Khronos, SPIR-V Specification 1.6,
// sections 2.3 (an instruction's first word holds its length and its kind), 3.20 and 3.52.
struct Declarations {
    std::map<uint32_t, uint32_t> bindings;                    // variable -> binding
    std::map<uint32_t, uint32_t> types;                       // variable -> its pointer
    std::map<uint32_t, uint32_t> pointees;                    // pointer -> what it points to
    std::map<uint32_t, uint32_t> firstMembers;                // struct -> the type of its first member
    std::map<uint32_t, uint32_t> elements;                    // runtime array -> its element
    std::map<uint32_t, uint32_t> strides;                     // array -> bytes
    std::map<uint32_t, std::map<uint32_t, uint32_t>> offsets; // struct -> member -> bytes
};

void read(Declarations& found, uint32_t kind, const uint32_t* word) {
    constexpr uint32_t kBinding = 33, kArrayStride = 6, kOffset = 35;
    switch (kind) {
    case 29: // OpTypeRuntimeArray
        found.elements[word[1]] = word[2];
        break;
    case 30: // OpTypeStruct
        found.firstMembers[word[1]] = word[2];
        break;
    case 32: // OpTypePointer
        found.pointees[word[1]] = word[3];
        break;
    case 59: // OpVariable
        found.types[word[2]] = word[1];
        break;
    case 71: // OpDecorate
        if (word[2] == kBinding)
            found.bindings[word[1]] = word[3];
        else if (word[2] == kArrayStride)
            found.strides[word[1]] = word[3];
        break;
    case 72: // OpMemberDecorate
        if (word[3] == kOffset)
            found.offsets[word[1]][word[2]] = word[4];
        break;
    }
}

Declarations declarationsOf(const std::vector<uint32_t>& spirv) {
    Declarations found;
    constexpr size_t kHeaderWords = 5;
    for (size_t at = kHeaderWords; at < spirv.size(); at += spirv[at] >> 16)
        read(found, spirv[at] & 0xffffu, &spirv[at]);
    return found;
}

TEST(SharedLayouts, GlslAndCppLayOutEverySharedStructAlike) {
    const Declarations glsl = declarationsOf(test_kernels::find("shared_layouts").spirv);
    ASSERT_EQ(glsl.bindings.size(), kSharedStructs.size());
    for (const auto& [variable, binding] : glsl.bindings) {
        const SharedStruct& cpp = kSharedStructs.at(binding);
        const uint32_t array = glsl.firstMembers.at(glsl.pointees.at(glsl.types.at(variable)));
        EXPECT_EQ(glsl.strides.at(array), cpp.bytes) << cpp.name << ": its size";
        const auto& offsets = glsl.offsets.at(glsl.elements.at(array));
        ASSERT_EQ(offsets.size(), cpp.members.size()) << cpp.name;
        for (uint32_t i = 0; i < cpp.members.size(); ++i)
            EXPECT_EQ(offsets.at(i), cpp.members[i].offset) << cpp.name << "::" << cpp.members[i].name;
    }
}

} // namespace
} // namespace lavalight::test
