#include "shared/exr.hpp"

#ifdef RILL_OPENEXR
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cstring>
#include <exception>
#include <vector>

#include "shared/atomic_file.hpp"
#endif

namespace rill::apps {

#ifdef RILL_OPENEXR
namespace {

/// A file in memory, so that writeFile() writes it whole or not at all.
class MemoryStream : public Imf::OStream {
 public:
  explicit MemoryStream(const char* name) : Imf::OStream(name) {}
  void write(const char bytes[], int count) override {
    const size_t size = static_cast<size_t>(count);
    if (bytes_.size() < at_ + size) bytes_.resize(at_ + size);
    std::memcpy(bytes_.data() + at_, bytes, size);
    at_ += size;
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t position) override { at_ = position; }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  size_t at_ = 0;
};

}  // namespace

bool writesExr() { return true; }

Expected<void> writeExr(const std::filesystem::path& file, const offline::LinearImage& image) {
  const size_t pixels = size_t{image.width} * image.height;
  if (pixels == 0 || image.rgba.size() != 4 * pixels)
    return Error{ErrorKind::Failed, "can't write " + file.string() + ": the image is empty"};
  MemoryStream stream(file.filename().c_str());
  try {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    std::vector<uint16_t> channel[3];  // the library's interface is not const
    for (size_t c = 0; c < 3; ++c) {
      channel[c].reserve(pixels);
      for (size_t i = 0; i < pixels; ++i) channel[c].push_back(image.rgba[4 * i + c]);
      const char name[] = {"RGB"[c], '\0'};
      header.channels().insert(name, Imf::Channel(Imf::HALF));
      frame.insert(name,
                   Imf::Slice(Imf::HALF, reinterpret_cast<char*>(channel[c].data()), sizeof(uint16_t), sizeof(uint16_t) * image.width));
    }
    Imf::OutputFile out(stream, header);
    out.setFrameBuffer(frame);
    out.writePixels(static_cast<int>(image.height));
  } catch (const std::exception& failed) { return Error{ErrorKind::Failed, "can't encode " + file.string() + ": " + failed.what()}; }
  return writeFile(file, stream.bytes());
}
#else
bool writesExr() { return false; }

Expected<void> writeExr(const std::filesystem::path& file, const offline::LinearImage&) {
  return Error{ErrorKind::Failed, "can't write " + file.string() + ": this build has no OpenEXR"};
}
#endif

}  // namespace rill::apps
