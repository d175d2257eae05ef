// How --help shows what an option takes: `--name VALUE=default`, whichever release of CLI11 prints it. Manual
// pages, completions and docs/manual.md are made from that.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace lavalight {

class HelpFormatter : public CLI::Formatter {
  public:
    [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
};

} // namespace lavalight
