#include "support/spawn.h"

#include <stdexcept>

#include <unistd.h>

namespace lavalight::test {

std::vector<char*> argvOf(std::vector<std::string>& words) {
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    return argv;
}

void Spawn::open(int stream, const std::string& file, int flags) {
    ::posix_spawn_file_actions_addopen(&actions_, stream, file.c_str(), flags, 0600);
}

void Spawn::pass(int stream, int descriptor) {
    ::posix_spawn_file_actions_adddup2(&actions_, descriptor, stream);
}

void Spawn::workIn(const std::string& folder) {
    ::posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
}

pid_t Spawn::start(std::vector<std::string> words) const {
    const std::vector<char*> argv = argvOf(words);
    pid_t process = 0;
    if (::posix_spawnp(&process, argv.front(), &actions_, nullptr, argv.data(), ::environ) != 0)
        throw std::runtime_error("cannot run " + words.front());
    return process;
}

} // namespace lavalight::test
