// Drivers and memory that fail: a line says what could not be done, nothing is left behind, and what was
// there stays.
#include <array>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "support/faults/faults.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

class Fault : public testing::Test {
  protected:
    void SetUp() override { makeCheckpoint("auto"); }
    void makeCheckpoint(const std::string& schedule) {
        std::filesystem::remove(folder_ / "c.exr");
        ASSERT_EQ(render({"--samples", "0:1", "--schedule", schedule, "--checkpoint", "c.exr", "-o", "a.exr"})
                      .exitCode,
                  0);
        checkpoint_ = readFile(folder_ / "c.exr");
        std::filesystem::remove(folder_ / "a.exr");
    }
    [[nodiscard]] ProgramResult render(const std::vector<std::string>& more) const {
        std::vector<std::string> words{"render", "--size", "24x16"};
        words.insert(words.end(), more.begin(), more.end());
        return runLavalight(words, folder_.path());
    }
    // Goes on from the checkpoint.
    [[nodiscard]] ProgramResult goOn(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words{"--samples", "0:2", "--checkpoint", "c.exr",
                                       "--resume",  "-o",  "a.exr"};
        words.insert(words.end(), more.begin(), more.end());
        return render(words);
    }
    void expectMessageAndNothingElse(const ProgramResult& result, const std::string& what) const {
        SCOPED_TRACE(what + ": " + result.err);
        EXPECT_EQ(result.exitCode, 1);
        EXPECT_TRUE(result.err.starts_with("lavalight: error: "));
        EXPECT_EQ(result.err.find("unexpected"), std::string::npos);
        EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << "one line";
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(folder_.count(), 1) << "the checkpoint alone";
        EXPECT_EQ(readFile(folder_ / "c.exr"), checkpoint_);
    }
    // The names of all calls of goOn(), in order.
    [[nodiscard]] std::vector<std::string> callsOf(const std::vector<std::string>& more = {}) const {
        const TemporaryFolder log;
        const std::string file = (log / "calls.txt").string();
        {
            const VulkanFault none("", file);
            EXPECT_EQ(goOn(more).exitCode, 0);
        }
        std::filesystem::remove(folder_ / "a.exr");
        writeFileAtomically(folder_ / "c.exr", checkpoint_);
        std::istringstream lines(readFile(file));
        std::vector<std::string> names;
        for (std::string name; std::getline(lines, name);)
            names.push_back(name);
        return names;
    }

    TemporaryFolder folder_;
    std::string checkpoint_;
};

constexpr std::array<int, 3> kFailures{-1, -2, -4}; // out of host memory, of device memory, device lost

// A third of the calls each, so that they run side by side.
class VulkanFaults : public Fault, public testing::WithParamInterface<size_t> {};

TEST_P(VulkanFaults, EveryCallMayFail) {
    const std::vector<std::string> calls = callsOf();
    ASSERT_GT(calls.size(), 100u);
    for (size_t i = GetParam(); i < calls.size(); i += kFailures.size()) {
        const int failure = kFailures[i % kFailures.size()];
        const VulkanFault fault(std::to_string(i + 1) + " " + std::to_string(failure));
        expectMessageAndNothingElse(goOn(), calls[i] + " " + std::to_string(failure));
        if (HasFailure())
            break;
    }
}

INSTANTIATE_TEST_SUITE_P(Thirds, VulkanFaults, testing::Range<size_t>(0, kFailures.size()));

TEST_F(Fault, CallsOfTheWavefrontMayFailToo) {
    makeCheckpoint("wavefront");
    const std::vector<std::string> calls = callsOf({"--schedule", "wavefront"});
    for (size_t i = 0; i < calls.size(); i += 17) {
        const int failure = kFailures[i % kFailures.size()];
        const VulkanFault fault(std::to_string(i + 1) + " " + std::to_string(failure));
        expectMessageAndNothingElse(goOn({"--schedule", "wavefront"}), calls[i]);
    }
}

TEST_F(Fault, AnyAllocationMayFail) {
    const TemporaryFolder log;
    const std::string file = (log / "allocations.txt").string();
    {
        const FailingNew none(0, file);
        ASSERT_EQ(render({"--samples", "0:2", "-o", "b.exr"}).exitCode, 0);
    }
    std::filesystem::remove(folder_ / "b.exr");
    const long allocations = std::stol(readFile(file));
    ASSERT_GT(allocations, 10);
    for (long i = 1; i < allocations; i += 1 + allocations / 40) {
        const FailingNew fault(i);
        const ProgramResult result = goOn();
        // The picture may fail after the checkpoint of all samples.
        if (readFile(folder_ / "c.exr") != checkpoint_) {
            EXPECT_GT(i, allocations / 2);
            writeFileAtomically(folder_ / "c.exr", checkpoint_);
        }
        if (result.exitCode == 0) // one that only a message or a header needed
            std::filesystem::remove(folder_ / "a.exr");
        else
            expectMessageAndNothingElse(result, "allocation " + std::to_string(i));
    }
}

// lavapipe ends loops after 65,535 turns: long ones are as good as endless.
TEST_F(Fault, AKernelThatDoesNotComeBackIsNamed) {
    ASSERT_EQ(runLavalight({"new-experiment", "mine", "kernels/accumulate.comp"}, folder_.path()).exitCode,
              0);
    const std::filesystem::path kernel = folder_ / "mine/kernels/accumulate.comp";
    std::string text = readFile(kernel);
    const size_t body = text.find("void main() {");
    ASSERT_NE(body, std::string::npos);
    text.insert(
        body + std::string("void main() {").size(),
        "\n    float x = 1.0;\n    for (uint i = 0u; i < 65000u; ++i)\n"
        "        x = sin(cos(sin(cos(sin(cos(x + float(i)))))));\n    film[0] = floatBitsToUint(x);\n");
    writeFileAtomically(kernel, text);
    const ProgramResult result = runLavalight({"render", "--size", "256x256", "--spp", "1", "--shaders",
                                               "mine", "--kernel-timeout", "3", "-o", "a.exr"},
                                              folder_.path());
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find("kernel accumulate has not come back within 3 s"), std::string::npos)
        << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.exr"));
}

} // namespace
} // namespace lavalight::test
