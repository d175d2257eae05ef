// The files that a render writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/input_files.h"
#include "denoise/denoiser.h"
#include "film/film_file.h"
#include "image/exr.h"
#include "image/png.h"
#include "image/rendering.h"
#include "render/tone_mapper.h"
#include "session/render_job.h"

namespace lavalight {

// Paths of files; empty: none.
struct Outputs {
    std::string exr;
    std::string png;
    std::string report;     // JSON
    std::string checkpoint; // kept by a Checkpoint, not by writeOutputs
};

// Sets the picture that the file's ending asks for: .exr or .png. Throws UsageError, which begins with the
// option, for another ending or a second file of the same kind.
void addPicture(Outputs& outputs, const std::string& file, const std::string& option);

// Throws UsageError where a file that comes into being with the outputs, a lock or an unfinished one among
// them, is one that is read, that another output goes to, or that another render keeps its checkpoint in.
// Reads and writes nothing.
void requireApart(const Outputs& outputs, const InputFiles& inputs);

// Throws Error where an output cannot be written.
void requireOutputs(const Outputs& outputs);

// How images are written: what goes into the EXR file, and the PNG's tone mapping.
struct OutputStyle {
    bool keepsFilm = false;                        // the EXR file holds the exact film beside the picture
    ToneSettings tone;                             // tone mapping of the PNG
    bool exposesByImage = false;                   // the first PNG settles the exposure: autoExposure()
    std::shared_ptr<const Denoiser> denoiser{};    // of the picture; null: it is not denoised
    DenoiseQuality quality = DenoiseQuality::high; // of denoising
    uint32_t layers = 0;                           // that the EXR file is asked for (RenderSettings::layers)
};

// An image so far, with all that its files are written from.
struct FinishedImage {
    Rendering rendering;
    ExrContents ids;                    // layers of ids
    std::optional<FilmFile> film;       // where it is needed later
    bool holdsFilm = false;             // the EXR file holds the film
    std::optional<ToneSettings> tone{}; // of the pixels
    std::vector<uint32_t> pixels;       // sRGB with alpha, as PNG files hold them; empty: none were asked for
};

// Completes the job's report. An exposure that the image settles goes into `style`. Pixels are made where
// there is a tone mapper. Throws Error.
[[nodiscard]] FinishedImage finishImage(RenderJob& job, OutputStyle& style, ToneMapper* toneMapper);

// `metadata`: exrMetadata() of a file without a film. Throws Error.
void writeImageExr(const std::filesystem::path& path, const FinishedImage& image, const Metadata& metadata);
void writeImagePng(const std::filesystem::path& path, const FinishedImage& image);

// Writes the image so far: finishImage() and its files. `toneMapper` may be null where there is no PNG.
void writeOutputs(RenderJob& job, const Outputs& outputs, OutputStyle& style, ToneMapper* toneMapper);

// Text chunks of a PNG.
[[nodiscard]] PngTexts pngTexts(const ToneSettings& tone);

// Denoises the rendering (denoise()), and says so in the ledger. Throws Error.
void addDenoised(std::vector<LedgerEntry>& ledger, Rendering& rendering, const Denoiser& denoiser,
                 DenoiseQuality quality, uint32_t asked, bool isSharp);
// Pixels of the layer kDenoisedLayer, which the rendering must have.
[[nodiscard]] std::vector<uint32_t> denoisedPixels(const Rendering& rendering, ToneMapper& toneMapper,
                                                   const ToneSettings& tone);

} // namespace lavalight
