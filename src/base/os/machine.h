// Which machine this is, and which kind of processor it has.
#pragma once

#include <string>

namespace lavalight {

// What may decide the last bits of compiled kernels: maker, family and model, and the widest vectors, as in
// "GenuineIntel family 6 model 85, avx2 fma avx512f". Clock, cores and stepping are left out. The
// architecture's name where the system says no more.
[[nodiscard]] std::string processorKind();

// The same from the text of /proc/cpuinfo; empty where it does not say them.
[[nodiscard]] std::string processorKindIn(const std::string& cpuinfo);

// The machine's name in its network, as far as it may stand in a file's name.
[[nodiscard]] std::string hostName();

} // namespace lavalight
