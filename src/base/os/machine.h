// Which machine this is, and which kind of processor it has.
#pragma once

#include <string>

namespace lavalight {

// What may decide the last bits of compiled kernels: maker, family, model and vector extensions, as in
// "GenuineIntel family 6 model 85, sse4_1 avx avx2 fma avx512f". Clock, number of cores and stepping are left
// out. Where the system says none of this, it is the architecture's name.
[[nodiscard]] std::string processorKind();

// The kind by the text of /proc/cpuinfo; empty where the text lacks maker, family or model.
[[nodiscard]] std::string processorKindIn(const std::string& cpuinfo);

// The machine's name in its network, as far as it may stand in a file's name.
[[nodiscard]] std::string hostName();

} // namespace lavalight
