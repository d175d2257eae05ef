// What is read of a processor's description.
#include <gtest/gtest.h>

#include "base/os/machine.h"

namespace lavalight {
namespace {

TEST(Processor, MakerFamilyModelAndVectorsAreItsKind) {
    const std::string cpuinfo =
        "processor\t: 0\nvendor_id\t: GenuineIntel\ncpu family\t: 6\nmodel\t\t: 85\n"
        "model name\t: Some CPU @ 2.5 GHz\nstepping\t: 7\nflags\t\t: fpu sse4_1 avx avx2 fma avx512f\n"
        "\nprocessor\t: 1\nvendor_id\t: Other\n";
    EXPECT_EQ(processorKindIn(cpuinfo), "GenuineIntel family 6 model 85, sse4_1 avx avx2 fma avx512f");
}

TEST(Processor, DescriptionsWithoutAFamilyHaveNoKind) {
    EXPECT_EQ(processorKindIn("processor\t: 0\nBogoMIPS\t: 50\n"), "");
    EXPECT_EQ(processorKindIn(""), "");
}

TEST(Processor, ThisMachineHasAKind) {
    EXPECT_FALSE(processorKind().empty());
    EXPECT_EQ(processorKind(), processorKind());
}

} // namespace
} // namespace lavalight
