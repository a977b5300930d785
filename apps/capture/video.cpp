#include "capture/video.hpp"

#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/words.hpp"

namespace rill::capture {
namespace fs = std::filesystem;
namespace {

struct Format {
  const char *ending, *muxer;  // of the file name; the name of ffmpeg's muxer
};
constexpr Format kFormats[] = {{".mp4", "mp4"}, {".mkv", "matroska"}, {".mov", "mov"}};

const Format* formatOf(const fs::path& file) {
  for (const Format& format : kFormats)
    if (file.extension() == format.ending) return &format;
  return nullptr;
}

std::vector<std::string> encoderArguments(const fs::path& part, const Format& format, uint32_t width, uint32_t height, double fps) {
  std::string filters;
  if (width % 2 != 0 || height % 2 != 0)
    filters = "pad=" + std::to_string(width + width % 2) + ":" + std::to_string(height + height % 2) +
              ",fillborders=right=" + std::to_string(width % 2) + ":bottom=" + std::to_string(height % 2) + ":mode=smear,";
  filters += "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";
  // Without -xerror a disk that is full at the last bytes counts as success.
  return {"-nostdin", "-hide_banner", "-loglevel", "error", "-xerror", "-y",
          // Input: pixels of four bytes, the last one ignored.
          "-f", "rawvideo", "-pixel_format", "rgb0", "-video_size", std::to_string(width) + "x" + std::to_string(height), "-framerate",
          shortestNumber(fps), "-i", "pipe:0",
          // Output. Players guess the color space of a video without tags.
          "-vf", filters, "-c:v", "libx264", "-crf", "18", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
          "-color_range", "tv", "-f", format.muxer, "file:" + part.string()};
}

Error aboutVideo(const Error& error) { return {error.kind, "--video: " + error.message}; }

}  // namespace

bool isVideoName(const fs::path& file) { return formatOf(file) != nullptr; }

Expected<void> Video::check(const fs::path& file) {
  if (apps::isSpecialFile(file))
    return Error{ErrorKind::BadInput, "--video: " + inQuotes(file.string()) + " is a device, pipe or stream; expected a regular file"};
  if (auto place = apps::checkFilePlace("--video", file); !place) return place;
  if (apps::findProgram("ffmpeg")) return {};
  return Error{ErrorKind::BadInput, "--video: needs the program ffmpeg, which is not on PATH (Debian and Ubuntu: apt-get install ffmpeg)"};
}

Expected<Video> Video::start(const fs::path& file, uint32_t width, uint32_t height, double fps) {
  if (auto valid = check(file); !valid) return valid.error();
  if (file.has_parent_path())
    if (auto made = apps::makeFolder("--video", file.parent_path()); !made) return made.error();
  auto part = apps::PartFile::create(file);
  if (!part) return aboutVideo(part.error());
  auto encoder =
      apps::PipedProcess::start(*apps::findProgram("ffmpeg"), encoderArguments(part->path(), *formatOf(file), width, height, fps));
  if (!encoder) return aboutVideo(encoder.error());
  return Video(*std::move(part), *std::move(encoder));
}

Expected<void> Video::add(const offline::Image& image) {
  if (const auto written = encoder_->write(std::as_bytes(std::span(image.rgba))); !written) {
    const auto exited = finishEncoder();
    return exited ? aboutVideo(written.error()) : exited;
  }
  ++frames_;
  return {};
}

Expected<void> Video::finish() {
  if (!encoder_ || frames_ == 0) return {};
  if (auto done = finishEncoder(); !done) return done;
  std::error_code failed;
  if (fs::file_size(part_.path(), failed) == 0 || failed) return Error{ErrorKind::Io, "--video: ffmpeg wrote nothing"};
  if (auto committed = part_.commit(); !committed) return aboutVideo(committed.error());
  finished_ = true;
  return {};
}

Expected<void> Video::finishEncoder() {
  const auto done = encoder_->finish();
  encoder_.reset();
  return done ? done : Expected<void>(aboutVideo(done.error()));
}

}  // namespace rill::capture
