// Writes docs/estimators.md from the table of settings, or checks that it is what the table gives.
//
//     describe_settings FILE            writes it
//     describe_settings --check FILE    exits with 1 where it differs
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "render/presets.h"
#include "render/setting_text.h"

namespace {

using namespace lavalight;

constexpr std::string_view kHead = R"(# The estimators and their settings

What each setting of the estimator takes, what it does, and whether it may change the mean of the image. Try one:

    lavalight render cornell-box --mis off --png box.png

This page is generated from the table of settings (src/render/setting_table.cpp); `lavalight render --help` prints the same.
A setting that decides the bits of the image stands in the image's header as `option:NAME`, and films that differ in one are not
merged.

| option | values (default in bold) | what it does | may change the mean | decides bits |
| --- | --- | --- | --- | --- |
)";

constexpr std::string_view kPresets = R"(
## Presets

`--preset NAME` sets several at once, one step of the lecture after the other; other options then change them. A click on
`preset` in the window does the same.

| preset | meaning | settings |
| --- | --- | --- |
)";

constexpr std::string_view kTests = R"(
## How they are tested

Tests check that a setting which may not change the mean does not change it. tests/image/estimator_test.cpp renders built-in
scenes at each of its named values. A Z-test compares their means with the default's, each tile against the variance that the
films measured. The values come from the table, so that a new setting is tested as soon as it has a row. `full_product_test`
does the same for every combination, at night. Both use `--sampler independent`, since the variance of Sobol's correlated samples
is not known from one image.

A setting that may change the mean is left out there; what it computes is tested by itself, as `--texture-filter` in
tests/image/surface_detail_test.cpp and `--multiple-scattering` in tests/gpu/bsdf_test.cpp. The bias ledger of an image names
what biased it: indirect light that was clamped, paths that were cut, lights that `--nee off` cannot reach.
)";

std::string bold(const std::string& text) {
    return "**" + text + "**";
}

// In a cell of a table.
std::string cellOf(const SettingRow& row) {
    const std::string chosen = textOf(row, EstimatorSettings{});
    const auto* values = std::get_if<NamedValues>(&row.values);
    if (values == nullptr)
        return fmt::format("{}, {}", rangeOf(row), bold(chosen));
    std::string text;
    for (const auto& name : values->names)
        text += fmt::format("{}{}", text.empty() ? "" : ", ",
                            name.name == chosen ? bold(chosen) : std::string(name.name));
    return text;
}

std::string page() {
    std::string text(kHead);
    for (const SettingRow& row : settingRows())
        text += fmt::format("| `--{}` | {} | {} | {} | {} |\n", row.name, cellOf(row), row.help,
                            row.mayChangeMean ? "yes" : "no", row.decidesBits ? "yes" : "no");
    text += kPresets;
    for (const Preset& preset : presets())
        text += fmt::format("| `{}` | {} | {} |\n", preset.name, preset.meaning, optionsOf(preset));
    return text.append(kTests);
}

} // namespace

int main(int argc, char** argv) {
    try {
        const bool isCheck = argc == 3 && std::string_view(argv[1]) == "--check";
        if (argc != 2 && !isCheck)
            throw Error("usage: describe_settings [--check] FILE");
        const std::filesystem::path file = argv[argc - 1];
        if (!isCheck)
            writeFileAtomically(file, page());
        else if (readFile(file) != page())
            throw Error(
                fmt::format("{0} is not what the table of settings gives; write it anew with: {1} {0}",
                            file.string(), argv[0]));
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
