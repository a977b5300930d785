// A checkpoint's file. Little-endian throughout:
//   "RILLCKPT", format (u32), sections (u32), bytes of the whole file (u64)
//   of each section its name (8 bytes, filled up with zeros) and its bytes (u64)
//   the sections, each filled up to a multiple of 8 bytes
//   64-bit FNV-1a of all before it
// Nothing in it is believed before the checksum holds, and no length, checksum or not, before it fits the file. Whether a state makes sense
// for a scene is judged where a fluid is made from it (engine/fluid/snapshot.cpp).
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>

#include "core/fnv1a.hpp"
#include "core/words.hpp"
#include "rill/offline.hpp"

namespace rill::offline {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

constexpr std::string_view kMagic = "RILLCKPT";
constexpr uint32_t kFormat = 7;
constexpr uint64_t kHeadBytes = 24, kRowBytes = 16, kChecksumBytes = 8;

/// The state's arrays in the order of the file, each with the name of its section: calls visit(name, array).
template <class Snapshot, class Visit>
void forEachArray(Snapshot& s, Visit&& visit) {
  visit("control", s.control);
  visit("sums", s.sums);
  visit("solids", s.solids);
  visit("position", s.position);
  visit("velocity", s.velocity);
  visit("push", s.push);
  visit("warm", s.warm);
  visit("id", s.id);
  visit("nearwall", s.nearWall);
  visit("nearmore", s.nearMore);
  visit("nbrcount", s.neighborCount);
  visit("nbrs", s.neighbors);
  visit("cell", s.cell);
}
constexpr size_t kSections = 14;  // the one about the run first

uint64_t padded(uint64_t bytes) { return (bytes + 7) / 8 * 8; }

class Writer {
 public:
  std::vector<std::byte> bytes;
  void raw(const void* data, size_t size) {
    const auto* from = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), from, from + size);
  }
  template <class Number>
  void number(Number value) {
    raw(&value, sizeof value);
  }
  void text(std::string_view value) {
    number(static_cast<uint64_t>(value.size()));
    raw(value.data(), value.size());
  }
  void name(std::string_view value) {
    std::array<char, 8> eight{};
    std::copy(value.begin(), value.end(), eight.begin());
    raw(eight.data(), eight.size());
  }
  void pad() { bytes.resize(padded(bytes.size())); }
};

/// Takes from the front; what is not there leaves `good` false and gives zero.
class Taker {
 public:
  explicit Taker(std::span<const std::byte> bytes) : left_(bytes) {}
  bool good = true;
  std::span<const std::byte> take(uint64_t size) {
    if (size > left_.size()) {
      good = false;
      return {};
    }
    const auto front = left_.first(size);
    left_ = left_.subspan(size);
    return front;
  }
  template <class Number>
  Number number() {
    Number value{};
    const auto from = take(sizeof value);
    if (!from.empty()) std::memcpy(&value, from.data(), sizeof value);
    return value;
  }
  std::string text() {
    const auto from = take(number<uint64_t>());
    return {reinterpret_cast<const char*>(from.data()), from.size()};
  }
  uint64_t left() const { return left_.size(); }

 private:
  std::span<const std::byte> left_;
};

/// What is wrong with a file whose first bytes and size are these; empty where nothing is.
std::string headTrouble(std::span<const std::byte> head, uint64_t size) {
  Taker taker(head);
  const auto magic = taker.take(std::min<uint64_t>(kMagic.size(), head.size()));
  if (magic.empty() || std::memcmp(magic.data(), kMagic.data(), magic.size()) != 0) return "is no checkpoint of Rill";
  const auto format = taker.number<uint32_t>();
  const auto sections = taker.number<uint32_t>();
  const auto bytes = taker.number<uint64_t>();
  if (!taker.good) return "is cut short: " + grouped(size) + " bytes are left of it";
  if (format > kFormat)
    return "was written by a newer Rill, in format " + std::to_string(format) + "; this one reads format " + std::to_string(kFormat);
  if (format > 0 && format < kFormat)
    return "was written by an older Rill, in format " + std::to_string(format) + "; this one reads format " + std::to_string(kFormat);
  if (format != kFormat || sections != kSections) return "is damaged: its first bytes make no sense";
  if (size < bytes) return "is cut short: " + grouped(size) + " of " + grouped(bytes) + " bytes are left of it";
  if (size > bytes) return "is damaged: it has " + grouped(size - bytes) + " bytes more than it should";
  if (size < kHeadBytes + kSections * kRowBytes + kChecksumBytes) return "is damaged: it is too small to hold anything";
  return {};
}

void writeAbout(Writer& writer, const Checkpoint& c) {
  for (const std::string* text : {&c.rill, &c.scene, &c.device, &c.driver}) writer.text(*text);
  writer.number(c.time_s);
  writer.number(c.frame);
  writer.number(c.fps);
  writer.number(c.fluid.listCapacity);
  writer.number(static_cast<uint32_t>(c.keys.size()));
  for (const auto& [key, value] : c.keys) {
    writer.text(key);
    writer.text(value);
  }
}

/// As a scene's keys and their values are; messages show them.
bool isPlain(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

bool readAbout(std::span<const std::byte> bytes, Checkpoint& c) {
  Taker taker(bytes);
  for (std::string* text : {&c.rill, &c.scene, &c.device, &c.driver}) *text = taker.text();
  c.time_s = taker.number<double>();
  c.frame = taker.number<uint64_t>();
  c.fps = taker.number<double>();
  c.fluid.listCapacity = taker.number<uint32_t>();
  const auto keys = taker.number<uint32_t>();
  for (uint32_t k = 0; k < keys && taker.good; ++k) {
    std::string key = taker.text();
    c.keys.emplace_back(std::move(key), taker.text());
    taker.good = taker.good && isPlain(c.keys.back().first) && isPlain(c.keys.back().second);
  }
  return taker.good && taker.left() == 0 && c.time_s >= 0 && c.time_s <= 1e300 && c.fps >= 0 && c.fps <= 1e300;
}

}  // namespace

std::vector<std::byte> encodeCheckpoint(const Checkpoint& checkpoint) {
  Writer about;
  writeAbout(about, checkpoint);
  uint64_t total = kHeadBytes + kSections * kRowBytes + padded(about.bytes.size()) + kChecksumBytes;
  forEachArray(checkpoint.fluid, [&](const char*, const auto& array) { total += padded(std::as_bytes(std::span(array)).size()); });

  Writer file;
  file.bytes.reserve(total);
  file.raw(kMagic.data(), kMagic.size());
  file.number(kFormat);
  file.number(static_cast<uint32_t>(kSections));
  file.number(total);
  file.name("about");
  file.number(static_cast<uint64_t>(about.bytes.size()));
  forEachArray(checkpoint.fluid, [&](const char* name, const auto& array) {
    file.name(name);
    file.number(static_cast<uint64_t>(std::as_bytes(std::span(array)).size()));
  });
  file.raw(about.bytes.data(), about.bytes.size());
  file.pad();
  forEachArray(checkpoint.fluid, [&](const char*, const auto& array) {
    file.raw(array.data(), std::as_bytes(std::span(array)).size());
    file.pad();
  });
  Fnv1a hash;
  hash.add(std::span<const std::byte>(file.bytes));
  file.number(hash.value());
  return std::move(file.bytes);
}

Expected<Checkpoint> decodeCheckpoint(std::span<const std::byte> bytes, std::string_view name) {
  const auto refused = [&](const std::string& why) { return Error{ErrorKind::BadInput, inQuotes(name) + " " + why}; };
  if (const std::string trouble = headTrouble(bytes.first(std::min<size_t>(kHeadBytes, bytes.size())), bytes.size()); !trouble.empty())
    return refused(trouble);
  const auto body = bytes.first(bytes.size() - kChecksumBytes);
  Fnv1a hash;
  hash.add(body);
  if (Taker(bytes.last(kChecksumBytes)).number<uint64_t>() != hash.value()) return refused("is damaged: its checksum does not hold");

  Taker table(body.subspan(kHeadBytes, kSections * kRowBytes));
  Taker sections(body.subspan(kHeadBytes + kSections * kRowBytes));
  std::string trouble;
  const auto next = [&](std::string_view wanted, uint64_t record) -> std::span<const std::byte> {
    const auto eight = table.take(8);
    const auto size = table.number<uint64_t>();
    std::string found(reinterpret_cast<const char*>(eight.data()), eight.size());
    found.resize(std::strlen(found.c_str()));
    if (!trouble.empty()) return {};
    if (found != wanted || size % record != 0 || size > sections.left()) {
      trouble = "is damaged: it has no proper section " + inQuotes(wanted);
      return {};
    }
    const auto section = sections.take(size);
    sections.take(padded(size) - size);
    return section;
  };
  Checkpoint checkpoint;
  if (!readAbout(next("about", 1), checkpoint) && trouble.empty()) trouble = "is damaged: what it says about its run makes no sense";
  forEachArray(checkpoint.fluid, [&](const char* section, auto& array) {
    using Record = typename std::decay_t<decltype(array)>::value_type;
    const auto from = next(section, sizeof(Record));
    array.resize(from.size() / sizeof(Record));
    if (!from.empty()) std::memcpy(array.data(), from.data(), from.size());
  });
  if (trouble.empty() && (!sections.good || sections.left() > 0)) trouble = "is damaged: its sections do not fill it";
  if (!trouble.empty()) return refused(trouble);
  return checkpoint;
}

Expected<Checkpoint> loadCheckpoint(const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto refused = [&](const std::string& why) { return Error{ErrorKind::BadInput, inQuotes(name) + " " + why}; };
  try {
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) return refused("is not there");
    if (!std::filesystem::is_regular_file(file, failed)) return refused("is no file; expected a checkpoint");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return refused("can't be opened");
    const uint64_t size = std::filesystem::file_size(file, failed);
    if (failed) return refused("can't be read: " + failed.message());
    // A film that was taken for a checkpoint is not read to its end.
    std::array<char, kHeadBytes> head{};
    stream.read(head.data(), static_cast<std::streamsize>(std::min<uint64_t>(size, head.size())));
    const auto found = std::as_bytes(std::span(head)).first(static_cast<size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    if (const std::string trouble = headTrouble(found, size); !trouble.empty()) return refused(trouble);
    std::vector<std::byte> bytes(size);
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<uint64_t>(std::max<std::streamsize>(stream.gcount(), 0)) != size) return refused("can't be read to its end");
    return decodeCheckpoint(bytes, name);
  } catch (const std::bad_alloc&) { return Error{ErrorKind::OutOfMemory, inQuotes(name) + ": not enough memory to read the checkpoint"}; }
}

}  // namespace rill::offline
