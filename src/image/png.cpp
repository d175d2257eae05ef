// Files are written by libpng, to whose errors a C++ program cannot reply by exceptions: they jump.
#include "image/png.h"

#include <algorithm>
#include <cassert>
#include <csetjmp>
#include <new>

#include <fmt/format.h>
#include <png.h>

#include "base/error.h"
#include "base/file.h"
#include "image/image.h"

namespace lavalight {
namespace {

// A picture of 512x512 takes zlib, which libpng compresses with, 14 ms and 344 kB with level 4, 52 ms and 330
// kB with level 6, and 8 ms and 366 kB with level 1.
constexpr int kLevel = 4;

void appendTo(png_structp png, png_bytep data, size_t size) {
    bool fits = true;
    try {
        static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
    } catch (const std::bad_alloc&) {
        fits = false;
    }
    if (!fits)
        png_error(png, "out of memory");
}

// libpng's own handlers write to the standard error.
void jump(png_structp png, png_const_charp) {
    png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

class PngWriter {
  public:
    explicit PngWriter(std::string& file)
        : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, jump, ignoreWarning)),
          info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
        if (png_ != nullptr)
            png_set_write_fn(png_, &file, appendTo, nullptr);
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    // Calls steps(png, info); false: one of libpng's calls has failed, and those after it were left out. What
    // the steps have on the stack must need no destructor.
    template <class Steps>
    [[nodiscard]] bool run(const Steps& steps) {
        if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0)
            return false;
        steps(png_, info_);
        return true;
    }

  private:
    png_structp png_;
    png_infop info_;
};

std::vector<png_text> toPngTexts(const PngTexts& texts) {
    std::vector<png_text> list;
    for (const auto& [keyword, text] : texts) {
        png_text& one = list.emplace_back();
        one.compression = PNG_TEXT_COMPRESSION_NONE;
        one.key = const_cast<png_charp>(keyword.c_str()); // libpng copies both
        one.text = const_cast<png_charp>(text.c_str());
        one.text_length = text.size();
    }
    return list;
}

bool encode(uint32_t width, uint32_t height, std::span<const uint32_t> pixels, const PngTexts& texts,
            std::string& file) {
    const bool isOpaque = std::ranges::all_of(pixels, [](uint32_t pixel) { return pixel >> 24 == 0xffu; });
    const size_t channels = isOpaque ? 3 : 4;
    const std::vector<png_text> list = toPngTexts(texts);
    std::vector<uint8_t> row(width * channels);
    PngWriter writer(file);
    return writer.run([&](png_structp png, png_infop info) {
        png_set_IHDR(png, info, width, height, 8, isOpaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_text(png, info, list.data(), static_cast<int>(list.size()));
        png_set_compression_level(png, kLevel);
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
        png_write_info(png, info);
        for (size_t y = 0; y < height; ++y) {
            for (size_t i = 0; i < row.size(); ++i)
                row[i] = static_cast<uint8_t>(pixels[y * width + i / channels] >> (8 * (i % channels)));
            png_write_row(png, row.data());
        }
        png_write_end(png, nullptr);
    });
}

} // namespace

std::string encodePng(uint32_t width, uint32_t height, std::span<const uint32_t> pixels,
                      const PngTexts& texts) {
    assert(width > 0 && height > 0 && width <= kMaxImageSide && height <= kMaxImageSide);
    assert(pixels.size() == size_t{width} * height);
    std::string file;
    if (!encode(width, height, pixels, texts, file))
        throw Error(fmt::format("{} x {} pixels do not fit into memory", width, height));
    return file;
}

void writePng(const std::filesystem::path& path, uint32_t width, uint32_t height,
              std::span<const uint32_t> pixels, const PngTexts& texts) {
    writeFileAtomically(path, encodePng(width, height, pixels, texts));
}

} // namespace lavalight
