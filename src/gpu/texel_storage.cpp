#include "gpu/texel_storage.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>
#include <span>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight::gpu {
namespace {

// A module is a header of five words and instructions, each of which starts with a word of its length (upper
// half) and its operation. Types come before functions, and what decorates them before types.
constexpr size_t kHeaderWords = 5;
constexpr size_t kBoundWord = 3; // above all ids

// What is used of the SPIR-V specification, version 1.5, sections 3.7 to 3.32.
namespace spv {
enum Op : uint32_t {
    OpTypeVoid = 19,
    OpTypeInt = 21,
    OpTypeVector = 23,
    OpTypeImage = 25,
    OpTypeSampledImage = 27,
    OpTypeRuntimeArray = 29,
    OpTypeStruct = 30,
    OpTypePointer = 32,
    OpTypeForwardPointer = 39,
    OpConstant = 43,
    OpFunction = 54,
    OpVariable = 59,
    OpLoad = 61,
    OpAccessChain = 65,
    OpDecorate = 71,
    OpMemberDecorate = 72,
    OpImageFetch = 95,
    OpImageQuerySize = 104,
};
constexpr uint32_t DimBuffer = 5;
constexpr uint32_t OperandZeroExtend = 0x2000;
constexpr uint32_t StorageClassStorageBuffer = 12;
constexpr uint32_t DecorationBlock = 2;
constexpr uint32_t DecorationArrayStride = 6;
constexpr uint32_t DecorationNonWritable = 24;
constexpr uint32_t DecorationOffset = 35;
} // namespace spv

using Words = std::vector<uint32_t>;
using Instruction = std::span<const uint32_t>;

spv::Op operation(Instruction instruction) {
    return static_cast<spv::Op>(instruction[0] & 0xffffu);
}

void append(Words& words, spv::Op op, std::initializer_list<uint32_t> operands) {
    words.push_back(static_cast<uint32_t>(operands.size() + 1) << 16 | op);
    words.insert(words.end(), operands);
}

bool isType(spv::Op op) {
    return op >= spv::OpTypeVoid && op <= spv::OpTypeForwardPointer;
}

class Rewriter {
  public:
    explicit Rewriter(const KernelCode& code) : code_(&code), next_(code.spirv[kBoundWord]) {}

    [[nodiscard]] Words run() {
        forEach([&](Instruction i) { survey(i); });
        Words words(code_->spirv.begin(), code_->spirv.begin() + kHeaderWords);
        bool hasDecorations = false;
        bool hasTypes = false;
        forEach([&](Instruction i) {
            if (!hasDecorations && isType(operation(i))) {
                decorate(words);
                hasDecorations = true;
            }
            if (!hasTypes && operation(i) == spv::OpFunction) {
                declare(words);
                hasTypes = true;
            }
            rewrite(i, words);
        });
        words[kBoundWord] = next_;
        return words;
    }

  private:
    template <typename Visit>
    void forEach(const Visit& visit) const {
        const Instruction all(code_->spirv);
        for (size_t at = kHeaderWords; at < all.size(); at += all[at] >> 16)
            visit(all.subspan(at, all[at] >> 16));
    }

    // Finds the types there are, the texel buffers, and the values loaded from their variables.
    void survey(Instruction i) {
        switch (operation(i)) {
        case spv::OpTypeInt:
            if (i[2] == 32 && i[3] == 0)
                unsigned_ = i[1];
            break;
        case spv::OpTypeVector:
            if (i[2] == unsigned_ && i[3] == 4)
                texel_ = i[1];
            break;
        case spv::OpTypeImage:
            if (i[3] == spv::DimBuffer)
                images_.insert(i[1]);
            break;
        case spv::OpTypePointer:
            if (images_.contains(i[3]))
                pointers_.insert(i[1]);
            break;
        case spv::OpVariable:
            if (pointers_.contains(i[1]))
                variables_.push_back(i[2]);
            break;
        case spv::OpLoad:
            if (images_.contains(i[1]))
                loaded_.emplace(i[2], i[3]);
            break;
        default:
            break;
        }
    }

    // struct { uvec4 texels[]; } without padding, read only.
    void decorate(Words& words) const {
        append(words, spv::OpDecorate, {array_, spv::DecorationArrayStride, 16});
        append(words, spv::OpDecorate, {block_, spv::DecorationBlock});
        append(words, spv::OpMemberDecorate, {block_, 0, spv::DecorationOffset, 0});
        append(words, spv::OpMemberDecorate, {block_, 0, spv::DecorationNonWritable});
    }

    void declare(Words& words) const {
        append(words, spv::OpTypeRuntimeArray, {array_, texel_});
        append(words, spv::OpTypeStruct, {block_, array_});
        append(words, spv::OpTypePointer, {blockPointer_, spv::StorageClassStorageBuffer, block_});
        append(words, spv::OpTypePointer, {texelPointer_, spv::StorageClassStorageBuffer, texel_});
        append(words, spv::OpConstant, {unsigned_, zero_, 0});
        for (const uint32_t variable : variables_)
            append(words, spv::OpVariable, {blockPointer_, variable, spv::StorageClassStorageBuffer});
    }

    void rewrite(Instruction i, Words& words) {
        switch (operation(i)) {
        case spv::OpVariable:
            if (pointers_.contains(i[1]))
                return;
            break;
        case spv::OpLoad:
            if (images_.contains(i[1]))
                return;
            break;
        case spv::OpImageFetch: {
            const auto variable = loaded_.find(i[3]);
            // Texels are unsigned, and glslang says so at each fetch.
            const bool isPlain = i.size() == 5 || (i.size() == 6 && i[5] == spv::OperandZeroExtend);
            if (variable == loaded_.end() || !isPlain)
                refuse("fetches from what is no texel buffer");
            const uint32_t element = next_++;
            append(words, spv::OpAccessChain, {texelPointer_, element, variable->second, zero_, i[4]});
            append(words, spv::OpLoad, {i[1], i[2], element});
            return;
        }
        case spv::OpTypeSampledImage:
        case spv::OpImageQuerySize:
            refuse("does more with a texel buffer than texelFetch");
        default:
            break;
        }
        words.insert(words.end(), i.begin(), i.end());
    }

    [[noreturn]] void refuse(const char* what) const {
        throw Error(
            fmt::format("cannot read texels of kernel {} from storage buffers: it {}; declare them as "
                        "utextureBuffer",
                        code_->name, what));
    }

    const KernelCode* code_;
    uint32_t next_; // the next free id
    uint32_t unsigned_ = 0, texel_ = 0;
    uint32_t array_ = next_++, block_ = next_++, blockPointer_ = next_++, texelPointer_ = next_++,
             zero_ = next_++;
    std::set<uint32_t> images_, pointers_;
    std::vector<uint32_t> variables_;
    std::map<uint32_t, uint32_t> loaded_; // value of an image: its variable
};

} // namespace

KernelCode withTexelsInStorage(KernelCode code) {
    const auto isTexels = [](const KernelBinding& binding) {
        return binding.kind == BindingKind::uniformTexelBuffer;
    };
    if (std::ranges::none_of(code.bindings, isTexels))
        return code;
    code.spirv = Rewriter(code).run();
    for (KernelBinding& binding : code.bindings)
        if (isTexels(binding))
            binding.kind = BindingKind::storageBuffer;
    return code;
}

} // namespace lavalight::gpu
