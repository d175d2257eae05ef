// Libraries that are looked for when the program runs.
#pragma once

#include <filesystem>

namespace lavalight {

// A library that stays loaded as long as the program runs.
class SharedLibrary {
  public:
    // A file, or a name that the system's paths are searched for. Throws Error with the loader's message.
    explicit SharedLibrary(const std::filesystem::path& file);

    // The function of that name and type. Throws Error where there is none.
    template <typename Function>
    [[nodiscard]] Function* function(const char* name) const {
        return reinterpret_cast<Function*>(address(name));
    }

  private:
    [[nodiscard]] void* address(const char* name) const;

    void* handle_;
};

} // namespace lavalight
