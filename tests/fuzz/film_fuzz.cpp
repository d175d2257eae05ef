// Fuzzes the reader of exact films: what merge and --resume are given. The hash of a film lets few changes
// through, so the image that the same file holds is read as well.
#include <cstdint>

#include "base/error.h"
#include "film/film_file.h"
#include "fuzz/memory_file.h"
#include "image/exr.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const lavalight::test::MemoryFile file(data, size);
    try {
        static_cast<void>(lavalight::readExr(file.path()));
        static_cast<void>(lavalight::readFilmFile(file.path()));
    } catch (const lavalight::Error&) {
        return 0;
    }
    return 0;
}
