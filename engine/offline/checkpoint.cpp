// The checkpoint file format, little-endian:
//   "RILLCKPT", format version (u32), number of sections (u32), size of the file in bytes (u64)
//   per section: name (8 bytes, zero-padded), size in bytes (u64)
//   the sections, each zero-padded to a multiple of 8 bytes
//   64-bit FNV-1a of everything before
// The checksum is verified before any content is used, and every length is checked against the file even so. Whether the state fits the
// scene is checked when a fluid is created from it (engine/fluid/snapshot_checks.cpp).
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>

#include "core/fnv1a.hpp"
#include "core/words.hpp"
#include "fluid/arrays.hpp"
#include "rill/offline.hpp"

namespace rill::offline {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied without byte swapping");

constexpr std::string_view kMagic = "RILLCKPT";
constexpr uint32_t kFormat = 27;
constexpr uint64_t kHeaderBytes = 24, kTableEntryBytes = 16, kChecksumBytes = 8;

/// Calls visit(section name, array) for the arrays of the state in the order of the file.
template <class AnyCheckpoint, class Visit>
void forEachArray(AnyCheckpoint& checkpoint, Visit&& visit) {
  auto& s = checkpoint.fluid;
  visit("control", s.control);
  visit("sums", s.sums);
  visit("solids", s.solids);
  visit("bodies", s.bodies);
  visit("slips", s.slips);
  visit("loads", s.loads);
  visit("pressure", s.pressures);
  visit("flows", s.flows);
  visit("regions", s.regions);
  forEachSaved([&](const ArrayRow& row, auto member) { visit(row.savedName, s.*member); });
  visit("fluid", s.fluid);
  visit("nearsol", s.nearSolids);
  visit("nbrcount", s.neighborCount);
  visit("nbrs", s.neighbors);
  visit("cell", s.cell);
  auto& white = checkpoint.whitewater;
  visit("wwcounts", white.counts);
  visit("wwplace", white.place);
  visit("wwmotion", white.motion);
}
/// The run information is the first section, then come the arrays.
uint64_t countSections() {
  uint64_t sections = 1;
  const Checkpoint none;
  forEachArray(none, [&](const char*, const auto&) { ++sections; });
  return sections;
}
const uint64_t kSections = countSections();

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

/// Reads from the front. Reading beyond the end clears `good` and returns zero.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : left_(bytes) {}
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

/// Checks the first bytes and the size of a file. Returns what is wrong, or an empty string.
std::string checkHeader(std::span<const std::byte> head, uint64_t size) {
  ByteReader reader(head);
  const auto magic = reader.take(std::min<uint64_t>(kMagic.size(), head.size()));
  if (magic.empty() || std::memcmp(magic.data(), kMagic.data(), magic.size()) != 0) return "is not a Rill checkpoint";
  const auto format = reader.number<uint32_t>();
  const auto sections = reader.number<uint32_t>();
  const auto bytes = reader.number<uint64_t>();
  if (!reader.good) return "is truncated: found " + grouped(size) + " bytes, expected at least " + grouped(kHeaderBytes);
  if (format > kFormat)
    return "was written by a newer Rill: found format " + std::to_string(format) + ", expected " + std::to_string(kFormat);
  if (format > 0 && format < kFormat)
    return "was written by an older Rill: found format " + std::to_string(format) + ", expected " + std::to_string(kFormat);
  if (format != kFormat || sections != kSections) return "is corrupted: invalid header";
  if (size < bytes) return "is truncated: found " + grouped(size) + " bytes, expected " + grouped(bytes);
  if (size > bytes) return "is corrupted: found " + grouped(size) + " bytes, expected " + grouped(bytes);
  if (size < kHeaderBytes + kSections * kTableEntryBytes + kChecksumBytes) return "is corrupted: the size is too small for its sections";
  return {};
}

void writeRunInfo(Writer& writer, const Checkpoint& c) {
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

/// Whether text is printable ASCII, as scene keys and values are. Messages show it on terminals.
bool isPrintable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

bool readRunInfo(std::span<const std::byte> bytes, Checkpoint& c) {
  ByteReader reader(bytes);
  for (std::string* text : {&c.rill, &c.scene, &c.device, &c.driver}) *text = reader.text();
  c.time_s = reader.number<double>();
  c.frame = reader.number<uint64_t>();
  c.fps = reader.number<double>();
  c.fluid.listCapacity = reader.number<uint32_t>();
  const auto keys = reader.number<uint32_t>();
  for (uint32_t k = 0; k < keys && reader.good; ++k) {
    std::string key = reader.text();
    c.keys.emplace_back(std::move(key), reader.text());
    reader.good = reader.good && isPrintable(c.keys.back().first) && isPrintable(c.keys.back().second);
  }
  return reader.good && reader.left() == 0 && c.time_s >= 0 && c.time_s <= 1e300 && c.fps >= 0 && c.fps <= 1e300;
}

}  // namespace

std::vector<std::byte> encodeCheckpoint(const Checkpoint& checkpoint) {
  Writer about;
  writeRunInfo(about, checkpoint);
  uint64_t total = kHeaderBytes + kSections * kTableEntryBytes + padded(about.bytes.size()) + kChecksumBytes;
  forEachArray(checkpoint, [&](const char*, const auto& array) { total += padded(std::as_bytes(std::span(array)).size()); });

  Writer file;
  file.bytes.reserve(total);
  file.raw(kMagic.data(), kMagic.size());
  file.number(kFormat);
  file.number(static_cast<uint32_t>(kSections));
  file.number(total);
  file.name("about");
  file.number(static_cast<uint64_t>(about.bytes.size()));
  forEachArray(checkpoint, [&](const char* name, const auto& array) {
    file.name(name);
    file.number(static_cast<uint64_t>(std::as_bytes(std::span(array)).size()));
  });
  file.raw(about.bytes.data(), about.bytes.size());
  file.pad();
  forEachArray(checkpoint, [&](const char*, const auto& array) {
    file.raw(array.data(), std::as_bytes(std::span(array)).size());
    file.pad();
  });
  Fnv1a hash;
  hash.add(std::span<const std::byte>(file.bytes));
  file.number(hash.value());
  return std::move(file.bytes);
}

Expected<Checkpoint> decodeCheckpoint(std::span<const std::byte> bytes, std::string_view name) {
  const auto badInput = [&](const std::string& why) { return Error{ErrorKind::BadInput, inQuotes(name) + " " + why}; };
  if (const std::string problem = checkHeader(bytes.first(std::min<size_t>(kHeaderBytes, bytes.size())), bytes.size()); !problem.empty())
    return badInput(problem);
  const auto body = bytes.first(bytes.size() - kChecksumBytes);
  Fnv1a hash;
  hash.add(body);
  if (ByteReader(bytes.last(kChecksumBytes)).number<uint64_t>() != hash.value()) return badInput("is corrupted: checksum mismatch");

  ByteReader table(body.subspan(kHeaderBytes, kSections * kTableEntryBytes));
  ByteReader sections(body.subspan(kHeaderBytes + kSections * kTableEntryBytes));
  std::string problem;
  const auto next = [&](std::string_view wanted, uint64_t record) -> std::span<const std::byte> {
    const auto eight = table.take(8);
    const auto size = table.number<uint64_t>();
    std::string found(reinterpret_cast<const char*>(eight.data()), eight.size());
    found.resize(std::strlen(found.c_str()));
    if (!problem.empty()) return {};
    if (found != wanted || size % record != 0 || size > sections.left()) {
      problem = "is corrupted: missing or invalid section " + inQuotes(wanted);
      return {};
    }
    const auto section = sections.take(size);
    sections.take(padded(size) - size);
    return section;
  };
  Checkpoint checkpoint;
  if (!readRunInfo(next("about", 1), checkpoint) && problem.empty()) problem = "is corrupted: invalid run information";
  forEachArray(checkpoint, [&](const char* section, auto& array) {
    using Record = typename std::decay_t<decltype(array)>::value_type;
    const auto from = next(section, sizeof(Record));
    array.resize(from.size() / sizeof(Record));
    if (!from.empty()) std::memcpy(array.data(), from.data(), from.size());
  });
  if (problem.empty() && (!sections.good || sections.left() > 0)) problem = "is corrupted: the sizes of its sections do not add up";
  if (!problem.empty()) return badInput(problem);
  return checkpoint;
}

Expected<Checkpoint> loadCheckpoint(const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto badInput = [&](const std::string& why) { return Error{ErrorKind::BadInput, inQuotes(name) + " " + why}; };
  try {
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) return badInput("does not exist");
    if (!std::filesystem::is_regular_file(file, failed)) return badInput("is not a regular file; expected a checkpoint");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return badInput("cannot be opened");
    const uint64_t size = std::filesystem::file_size(file, failed);
    if (failed) return badInput("cannot be read: " + failed.message());
    // Check the header first, so that large files of other kinds are not read.
    std::array<char, kHeaderBytes> head{};
    stream.read(head.data(), static_cast<std::streamsize>(std::min<uint64_t>(size, head.size())));
    const auto found = std::as_bytes(std::span(head)).first(static_cast<size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    if (const std::string problem = checkHeader(found, size); !problem.empty()) return badInput(problem);
    std::vector<std::byte> bytes(size);
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<uint64_t>(std::max<std::streamsize>(stream.gcount(), 0)) != size) return badInput("cannot be read to its end");
    return decodeCheckpoint(bytes, name);
  } catch (const std::bad_alloc&) { return Error{ErrorKind::OutOfMemory, inQuotes(name) + ": not enough memory to read the checkpoint"}; }
}

}  // namespace rill::offline
