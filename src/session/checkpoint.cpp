#include "session/checkpoint.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"

namespace lavalight {

Checkpoint::Checkpoint(std::string file, std::chrono::duration<double> interval)
    : file_(std::move(file)), interval_(interval) {
    if (!isWanted())
        return;
    requireWritable(file_);
    lock_ = std::make_unique<FileLock>(file_);
    removeUnfinished(file_);
}

std::optional<FilmFile> Checkpoint::read() {
    std::error_code unknown;
    if (!std::filesystem::exists(file_, unknown)) {
        spdlog::info("there is no {} yet: the render starts from its first sample", file_);
        return std::nullopt;
    }
    FilmFile film = readFilmFile(file_);
    last_ = std::chrono::steady_clock::now();
    read_ = film.progress;
    return film;
}

bool Checkpoint::isDue() const {
    return isWanted() && std::chrono::steady_clock::now() - last_ >= interval_;
}

void Checkpoint::write(const std::function<FilmFile()>& record) {
    failure_.clear();
    try {
        const FilmFile film = record();
        if (read_ != film.progress)
            writeFilmFile(file_, film);
    } catch (const Error& error) {
        failure_ = error.what();
        spdlog::warn("no checkpoint: {}; the render goes on without it", failure_);
    }
    last_ = std::chrono::steady_clock::now();
}

void Checkpoint::requireWritten() const {
    if (!failure_.empty())
        throw Error(fmt::format("the images are written, the last checkpoint is not: {}", failure_));
}

} // namespace lavalight
