// A library that, preloaded, makes one allocation of a program fail: LAVALIGHT_FAILING_NEW=N names the N-th
// operator new of at least 4096 bytes that the program's own code calls. Allocations of shared libraries are
// let through, since a driver's are not ours, and so are allocations before main, which nobody can catch, and
// smaller ones: some are made by header libraries, which do not survive a failure. LAVALIGHT_NEW_LOG=FILE
// gets the number of allocations at the program's end.
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>

#include <dlfcn.h>
#include <link.h>

namespace {

struct Range {
    uintptr_t begin = 0;
    uintptr_t end = 0;
};

// The program is the first object in the list.
Range codeOfProgram() {
    Range range;
    dl_iterate_phdr(
        [](dl_phdr_info* info, size_t, void* result) {
            auto& found = *static_cast<Range*>(result);
            for (int i = 0; i < info->dlpi_phnum; ++i)
                if (info->dlpi_phdr[i].p_type == PT_LOAD && (info->dlpi_phdr[i].p_flags & PF_X) != 0)
                    found = {info->dlpi_addr + info->dlpi_phdr[i].p_vaddr,
                             info->dlpi_addr + info->dlpi_phdr[i].p_vaddr + info->dlpi_phdr[i].p_memsz};
            return 1;
        },
        &range);
    return range;
}

constexpr std::size_t kSmallest = 4096; // bytes
std::atomic<long> allocations = 0;
std::atomic<bool> hasBegun = false;

bool fails(std::size_t bytes, const void* caller) {
    if (bytes < kSmallest || !hasBegun)
        return false;
    static const Range program = codeOfProgram();
    static const char* const wanted = std::getenv("LAVALIGHT_FAILING_NEW");
    static const long failing = wanted == nullptr ? 0 : std::atol(wanted);
    const auto address = reinterpret_cast<uintptr_t>(caller);
    return address >= program.begin && address < program.end && ++allocations == failing;
}

void* allocate(std::size_t bytes, const void* caller) {
    void* memory = fails(bytes, caller) ? nullptr : std::malloc(bytes == 0 ? 1 : bytes);
    if (memory == nullptr)
        throw std::bad_alloc();
    return memory;
}

struct Log {
    ~Log() {
        if (const char* file = std::getenv("LAVALIGHT_NEW_LOG"))
            if (std::FILE* out = std::fopen(file, "w")) {
                std::fprintf(out, "%ld\n", allocations.load());
                std::fclose(out);
            }
    }
};
const Log log;

using Main = int (*)(int, char**, char**);
Main mainOfProgram = nullptr;

int beginMain(int argc, char** argv, char** environment) {
    hasBegun = true;
    return mainOfProgram(argc, argv, environment);
}

} // namespace

// NOLINTNEXTLINE(bugprone-reserved-identifier): the loader calls it by this name
extern "C" int __libc_start_main(Main main, int argc, char** argv, Main init, void (*fini)(),
                                 void (*unload)(), void* stackEnd) {
    mainOfProgram = main;
    const auto next = reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
    return next(&beginMain, argc, argv, init, fini, unload, stackEnd);
}

void* operator new(std::size_t bytes) {
    return allocate(bytes, __builtin_return_address(0));
}
void* operator new[](std::size_t bytes) {
    return allocate(bytes, __builtin_return_address(0));
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}
