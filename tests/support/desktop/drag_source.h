// Drops a file on another program's window.
#pragma once

#include <string>

namespace lavalight::test {

// Drops the file by the protocol XDND, version 5 (freedesktop.org), its path as a URI. `window`: X's number.
// Throws std::runtime_error where the window does not take it within ten seconds.
void dragAndDrop(const std::string& path, unsigned long window);

} // namespace lavalight::test
