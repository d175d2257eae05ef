// Drops a file on a window, for tools/ci/soak. Arguments: the file and the window's number; DISPLAY says
// where.
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "support/desktop/drag_source.h"

int main(int count, char** words) {
    try {
        if (count != 3)
            throw std::invalid_argument("usage: drop FILE WINDOW");
        lavalight::test::dragAndDrop(words[1], std::stoul(words[2]));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "drop: %s\n", error.what());
        return 1;
    }
}
